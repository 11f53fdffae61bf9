// SPDX-License-Identifier: MIT
#pragma once

#include "baseline/slides.h"
#include "vk/frame_graph.h"

#include <cstddef>
#include <cstdint>
#include <functional>

namespace zvo::baseline
{

/// The number of blocks whose sums a scan of so many values needs room for.
std::uint64_t partialCount(std::uint64_t count);

/// Declares that a pass writes the sum of all values, and returns where. The word becomes gpu::kSlidesTooMany if the
/// sum does not fit.
using TotalPlace = std::function<gpu::Ptr<gpu::uint>(vk::AnyPass&)>;

/// The first word of a buffer, or a later one.
template <typename T> TotalPlace totalAt(vk::BufferOf<T>& buffer, std::size_t bytes_before = 0)
{
    return [&buffer, bytes_before](vk::AnyPass& pass)
    { return gpu::Ptr<gpu::uint>{pass.readWrite(buffer).address + bytes_before}; };
}

/// Records the pass that replaces each of the first `count` sums of blocks by the sum of those before it.
void scanPartials(vk::FrameGraph& graph, vk::BufferOf<gpu::uint>& partials, std::uint64_t count,
                  const TotalPlace& total);

/// Records the passes that replace each of the first `count` values by the sum of those before it: the sums of blocks,
/// their prefix sums by one workgroup, and the values. partials: [partialCount(count)] of any content. Cost: count.
void scanValues(vk::FrameGraph& graph, vk::BufferOf<gpu::uint>& values, std::uint64_t count,
                vk::BufferOf<gpu::uint>& partials, const TotalPlace& total);

} // namespace zvo::baseline
