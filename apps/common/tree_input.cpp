// SPDX-License-Identifier: MIT
#include "common/tree_input.h"

#include "common/output.h"
#include "common/progress.h"
#include "core/base/read_file.h"
#include "core/octree/octree_build.h"
#include "core/tree/tree_build.h"
#include "core/upload/gpu_scene.h"
#include "io/voxel/vox_file.h"

#include <fmt/format.h>

#include <optional>

namespace zvo::cli
{

bool isVoxFile(const std::filesystem::path& path)
{
    return extensionOf(path.string()) == ".vox";
}

TreeData loadVox(const std::filesystem::path& path, vk::HeadlessDevice& device)
{
    VoxVoxels voxels;
    {
        const std::vector<std::uint8_t> bytes = readFile(path);
        voxels = readVox(bytes, path);
    }
    for (const std::string& warning : voxels.warnings)
    {
        talk(fmt::format("warning: {}", warning));
    }
    TreeData tree = octreeOfVoxels(voxels.grid, voxels.codes);
    if (tree.nodes.empty())
    {
        talk("warning: the file has no voxels");
        return tree;
    }
    addColors(tree, voxels.colors);
    voxels = {};
    const GpuScene tables = uploadColorTables(device);
    DeviceTree octree = uploadTree(device, tree);
    octree.node_attributes = {device.device(), "octree/node_attributes", octree.node_count};
    device.run([&](vk::FrameGraph& graph) { averageNodes(graph, tables, octree); });
    tree.node_attributes = device.download(octree.node_attributes);
    return tree;
}

Bounds boundsOf(const TreeData& tree)
{
    const std::optional<CellBox> box = voxelBox(tree);
    Bounds bounds;
    if (box)
    {
        const auto corner = [&grid = tree.grid](const glm::uvec3& cell)
        { return glm::vec3(glm::dvec3(grid.origin) + glm::dvec3(cell) * double{grid.voxel_size}); };
        bounds = {corner(box->min), corner(box->max)};
    }
    return bounds;
}

} // namespace zvo::cli
