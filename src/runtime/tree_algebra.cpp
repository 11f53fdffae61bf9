// SPDX-License-Identifier: MIT
#include "runtime/tree_algebra.h"

#include "core/upload/gpu_scene.h"
#include "runtime/run_job.h"

#include <utility>

namespace zvo
{

namespace
{

DeviceTree apply(vk::HeadlessDevice& device, const OperationInfo& info)
{
    const GpuScene color_tables = uploadColorTables(device);
    return runJob(device, TreeOperator(device.device(), color_tables, info)).octree;
}

// What an operation makes of an octree and of cells that components say.
DeviceTree applyMasks(vk::HeadlessDevice& device, TreeOperation operation, const DeviceTree& octree,
                      const ComponentOptions& options, const Components& components,
                      const ComponentThreshold& threshold)
{
    vk::BufferOf<gpu::uvec2> masks(device.device(), "algebra/kept", octree.node_count);
    device.run([&](vk::FrameGraph& graph) { maskComponents(graph, octree, options, components, threshold, masks); });
    return apply(device, {.operation = operation, .a = &octree, .masks = &masks});
}

} // namespace

DeviceTree combineTrees(vk::HeadlessDevice& device, TreeOperation operation, const DeviceTree& a, const DeviceTree& b)
{
    return apply(device, {.operation = operation, .a = &a, .b = &b});
}

DeviceTree spreadTree(vk::HeadlessDevice& device, TreeOperation operation, bool corners, std::uint32_t voxels,
                      DeviceTree tree)
{
    for (std::uint32_t i = 0; i < voxels; ++i)
    {
        tree = apply(device, {.operation = operation, .corners = corners, .a = &tree});
    }
    return tree;
}

Components findComponents(vk::HeadlessDevice& device, const DeviceTree& octree, bool corners)
{
    return runJob(device, ComponentFinder(device.device(), octree, {.corners = corners}));
}

DeviceTree keepComponents(vk::HeadlessDevice& device, const DeviceTree& octree, bool corners,
                          const Components& components, const ComponentThreshold& threshold)
{
    return applyMasks(device, TreeOperation::Keep, octree, {.corners = corners}, components, threshold);
}

DeviceTree encloseTree(vk::HeadlessDevice& device, const DeviceTree& octree)
{
    const ComponentOptions background = {.background = true};
    const Components components = runJob(device, ComponentFinder(device.device(), octree, background));
    return applyMasks(device, TreeOperation::Enclose, octree, background, components, {});
}

} // namespace zvo
