// SPDX-License-Identifier: MIT
#pragma once

#include "shared/gpu.h"
#include "vk/frame_graph.h"

#include <cstdint>

namespace zvo
{

/// A picture's size in pixels, at most kImageEdgeMax along each edge.
struct PictureSize
{
    std::uint32_t width = 0;
    std::uint32_t height = 0;

    bool operator==(const PictureSize&) const = default;
};

/// Records the pass that scales a picture from from_size to to_size. Each pixel of the result takes the pixel in which
/// its centre lies. Both pictures are stored row by row, a word for each pixel. Cost: pixels of the result.
void scalePicture(vk::FrameGraph& graph, const vk::BufferOf<gpu::uint>& from, PictureSize from_size,
                  vk::BufferOf<gpu::uint>& to, PictureSize to_size);

} // namespace zvo
