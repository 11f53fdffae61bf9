// SPDX-License-Identifier: MIT
#pragma once

#include "baseline/slides_tree.h"
#include "core/scene/camera.h"
#include "vk/frame_graph.h"

#include <cstdint>

namespace zvo::baseline
{

/// How rays go through the nodes. All combinations find the same hits.
struct SlidesTraceOptions
{
    /// Puts all children that the ray meets on the stack, in place of keeping the state and going down to the next one.
    bool push_children = false;
    bool stop_at_far_side = true; // a node is done where the ray leaves it: the slides' first tip
    bool skip_behind = true;      // nodes that end behind the ray's origin are not entered: the second
};

/// What a trace of a picture writes.
struct SlidesTraceBuffers
{
    SlidesTraceBuffers(vk::Device& device, std::uint32_t width, std::uint32_t height);

    std::uint32_t width;
    std::uint32_t height;
    vk::BufferOf<gpu::Hit> hits;                 // [width * height] row by row from the top left
    vk::BufferOf<gpu::SlidesTraceStatus> status; // [1]
};

/// Records the pass that finds the first voxel along the ray of each pixel of a camera in tree's grid, after HERO (M.
/// Agate, R. Grimsdale, P. Lister, The HERO Algorithm for Ray-Tracing Octrees, 1991), as the slides have it;
/// shaders/baseline/slides_trace.comp says how. Hits are those of zvo's trace/primary: Hit::t in unit space, the
/// voxel's cell, face and, with SlidesNodes::WithSums, its number in Morton order (0 without). Every hit is written.
///
/// Times of planes are halved from level to level, as in the original, and not computed for each plane anew, as zvo
/// does: they differ from zvo's in the last bits, so that rays close to an edge may take the other side of it.
///
/// What differs from the original: a voxel around the ray's origin is hit, as in zvo, where the original passes it; the
/// stack is in registers or private memory, and not 1 GB of device memory; the depth of a node and the Morton code of
/// the path are kept, which the original does not need for a color; a thread takes one pixel of a tile of 8x8, without
/// a queue of tasks. The masks of children are not in their pointers, so a child's mask is loaded with the child.
///
/// Cost: a thread a pixel, with at most gpu::kSlidesIterationsMax nodes or children; rays that need more count as
/// misses and in status.
void slidesTrace(vk::FrameGraph& graph, const SlidesTree& tree, const TraceCamera& camera,
                 const SlidesTraceOptions& options, SlidesTraceBuffers& buffers);

} // namespace zvo::baseline
