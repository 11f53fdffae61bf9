// SPDX-License-Identifier: MIT
#include "baseline/pointer_tree.h"

#include "baseline/thesis.h"
#include "core/base/divide_up.h"
#include "zvo/error.h"

#include <fmt/format.h>

#include <span>

namespace zvo::baseline
{

namespace
{

// Lists the voxels below a node, whose level counts from the voxels up.
void listBelow(std::span<const gpu::PointerNode> nodes, std::uint32_t number, std::uint32_t levels_below,
               std::uint64_t code, std::vector<PointerVoxel>& voxels)
{
    const gpu::PointerNode& node = nodes[number];
    if (node.child == 0)
    {
        return;
    }
    if (levels_below == 0)
    {
        voxels.push_back({code, {node.color, node.normal}});
        return;
    }
    for (std::uint32_t i = 0; i < gpu::kTileNodes; ++i)
    {
        listBelow(nodes, node.child + i, levels_below - 1, code << 3 | i, voxels);
    }
}

} // namespace

std::vector<PointerVoxel> listVoxels(vk::HeadlessDevice& device, const PointerOctree& octree)
{
    std::vector<PointerVoxel> voxels;
    const std::vector<gpu::PointerNode> nodes = device.download(octree.nodes, 0, octree.node_count);
    if (!nodes.empty())
    {
        listBelow(nodes, octree.root, octree.grid.depth, 0, voxels);
    }
    return voxels;
}

std::vector<std::uint64_t> listCodes(vk::HeadlessDevice& device, const PointerOctree& octree)
{
    std::vector<std::uint64_t> codes;
    for (const PointerVoxel& voxel : listVoxels(device, octree))
    {
        codes.push_back(voxel.code);
    }
    return codes;
}

void requireDepth(const Grid& grid, std::uint32_t depth_max, std::string_view what)
{
    if (grid.depth > depth_max)
    {
        throw Error(ErrorCode::Usage, fmt::format("{} cannot take a grid of depth {}: {} is the most; lower the depth",
                                                  what, grid.depth, depth_max));
    }
}

PointerPicture::PointerPicture(vk::Device& device, std::uint32_t picture_width, std::uint32_t picture_height)
    : width(picture_width), height(picture_height),
      hits(device, "baseline/hits", std::uint64_t{picture_width} * picture_height),
      status(device, "baseline/trace_status", 1)
{
}

void tracePicture(vk::FrameGraph& graph, const PointerOctree& octree, const TraceCamera& camera,
                  PointerPicture& picture)
{
    requireDepth(octree.grid, gpu::kPointerDepthMax, "the thesis's ray casting");
    graph.fill(picture.status, 0);
    vk::Pass pass = graph.addPass(gpu::baseline::ThesisTrace{.orthographic = camera.orthographic});
    gpu::ThesisTraceParams params{};
    params.nodes = pass.read(octree.nodes);
    params.hits = pass.write(picture.hits);
    params.status = pass.accumulate(picture.status);
    params.camera = camera.rays;
    params.width = picture.width;
    params.height = picture.height;
    params.root = octree.root;
    params.depth = octree.grid.depth;
    const std::uint64_t tiles =
        divideUp(picture.width, gpu::kThesisTileEdge) * divideUp(picture.height, gpu::kThesisTileEdge);
    pass.dispatch(tiles * gpu::kThesisTileEdge * gpu::kThesisTileEdge, params);
}

} // namespace zvo::baseline
