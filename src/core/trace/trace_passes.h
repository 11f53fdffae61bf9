// SPDX-License-Identifier: MIT
// Functions that all files that record passes of the tracer share.
#pragma once

#include "core/base/divide_up.h"
#include "core/trace/trace.h"
#include "core/tree/device_tree.h"

#include <cstdint>

namespace zvo
{

/// The numbers of tiles of a picture along x and y, and of the blocks of tiles, one for each workgroup of trace/beam.
struct PictureTiles
{
    std::uint64_t x;
    std::uint64_t y;
    std::uint64_t blocks;

    explicit PictureTiles(const TraceBuffers& buffers)
        : x(divideUp(buffers.width, gpu::kTileEdge)), y(divideUp(buffers.height, gpu::kTileEdge)),
          blocks(divideUp(x, gpu::kBlockEdge) * divideUp(y, gpu::kBlockEdge))
    {
    }
};

bool isEmpty(const DeviceTree& tree);

/// Whether there are attributes for every hit that can occur.
bool usesAttributes(const DeviceTree& tree, const TraceOptions& options);

/// Whether a view shows any attributes of hits.
bool showsAttributes(const TraceOptions& options);

/// The format in which kernels read attributes; None where they read none.
AttributeFormat formatToRead(const DeviceTree& tree, const TraceOptions& options);

/// Declares that pass reads the attributes, in whatever format they are, and sets their addresses in params.
template <typename Params> void readAttributes(vk::AnyPass& pass, const DeviceTree& tree, Params& params)
{
    if (isPacked(tree.attributeFormat()))
    {
        params.attributes = {pass.read(tree.packed.voxels).address};
        params.node_attributes = {pass.read(tree.packed.nodes).address};
        return;
    }
    params.attributes = pass.read(tree.voxel_attributes);
    params.node_attributes = pass.read(tree.node_attributes);
}

/// Sets the constants of a kernel that includes lib/traverse.glsl for a tree and options.
template <typename Kernel> Kernel traversing(Kernel kernel, const DeviceTree& tree, const TraceOptions& options)
{
    kernel.node_levels = tree.grid.nodeLevels();
    kernel.detail = options.hasDetail();
    kernel.iterations_max = options.iterations_max;
    kernel.entries_per_word = tree.entriesPerWord();
    return kernel;
}

/// The number of rounds after which every ray has its answer. In a grid of n voxels per edge a ray crosses at most 3 n
/// planes and goes down into at most n nodes; each round begins again at the root.
std::uint32_t roundsFor(const DeviceTree& tree, const TraceOptions& options);

/// Whether traceLight() has anything to do.
bool needsLight(const TraceOptions& options);

/// Records a pass of kernel for each round that rays may need. declare(pass) declares its accesses and returns its
/// parameters. dispatch_first(pass, params) dispatches the first round. Every other round is dispatched indirectly,
/// over as many workgroups as the round before asks for, at most max_groups; none once all rays are answered.
template <typename Kernel, typename Declare, typename Dispatch>
void addRounds(vk::FrameGraph& graph, Kernel kernel, std::uint32_t round_count, vk::BufferOf<gpu::DispatchArgs>& rounds,
               std::uint64_t max_groups, const Declare& declare, const Dispatch& dispatch_first)
{
    if (round_count > 1)
    {
        graph.fill(rounds, 0);
    }
    for (std::uint32_t round = 0; round < round_count; ++round)
    {
        const bool more = round + 1 < round_count;
        kernel.resume = round != 0;
        kernel.more = more;
        vk::Pass pass = graph.addPass(kernel);
        typename Kernel::Params params = declare(pass);
        if (more)
        {
            params.next_round = {pass.readWrite(rounds).address + (round + 1) * sizeof(gpu::DispatchArgs)};
        }
        if (round == 0)
        {
            dispatch_first(pass, params);
        }
        else
        {
            pass.dispatchIndirect(rounds, round, params, max_groups);
        }
    }
}

/// The level of detail, as traverse() takes it: a ray stops at a node whose edge is at most max(x * t, y).
gpu::vec2 detailOf(const TraceOptions& options, const TraceCamera* camera);

/// Declares that pass reads how many elements a list has, and returns where; null without a length.
gpu::ConstPtr<gpu::uint> readLength(vk::AnyPass& pass, const RayListLength* length);

/// Dispatches a thread for each element of a list: for all `count` of them without a length.
template <typename Pass, typename Params>
void dispatchList(Pass& pass, const Params& params, std::uint64_t count, const RayListLength* length)
{
    if (length == nullptr)
    {
        pass.dispatch(count, params);
        return;
    }
    pass.dispatchIndirect(length->buffer, length->args, params, divideUp(count, gpu::kRaysGroup));
}

/// Returns a function that dispatches the first round of the rays of live tiles (for addRounds).
inline auto dispatchLive(const TraceBuffers& buffers)
{
    return [&](auto& pass, const auto& params)
    { pass.dispatchIndirect(buffers.args, 0, params, buffers.live.count()); };
}

} // namespace zvo
