// SPDX-License-Identifier: MIT
#include "runtime/static_part.h"

#include "core/upload/gpu_scene.h"
#include "runtime/trees.h"

#include <algorithm>
#include <utility>

namespace zvo
{

StaticPart makeStaticPart(vk::HeadlessDevice& device, Scene scene, const Grid& grid, const BuildOptions& options,
                          TreeStructure structure, const StaticListener& listener, std::optional<float> emission_scale)
{
    listener.operation("copying to the device");
    const std::uint64_t triangle_count = scene.triangleCount();
    std::optional<GpuScene> uploaded =
        uploadScene(device, scene, options.attributes, emission_scale, {grid, options.coverage, listener.decoded});
    std::ranges::for_each(uploaded->warnings, listener.warn);
    scene = {};
    listener.operation("voxelizing");
    BuildResult built = buildOctree(device, *uploaded, grid, options);
    uploaded.reset();
    listener.built(built);
    StaticPart part;
    if (structure == TreeStructure::Svdag)
    {
        listener.operation("compressing");
        CompressResult compressed = compress(device, std::move(built.octree));
        built.octree = std::move(compressed.dag);
        part.info.compress_passes = std::move(compressed.passes);
    }
    part.tree = std::move(built.octree);
    part.info.triangle_count = triangle_count;
    part.info.voxel_count = part.tree.occupiedCount();
    part.info.node_count = part.tree.node_count;
    part.info.geometry_bytes = part.tree.geometryBytes();
    part.info.attribute_bytes = part.tree.attributeBytes();
    part.info.open = built.open;
    part.info.dropped = std::move(built.dropped);
    part.info.passes = std::move(built.passes);
    return part;
}

} // namespace zvo
