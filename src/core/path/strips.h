// SPDX-License-Identifier: MIT
#pragma once

#include "path/path.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace zvo
{

/// Calls visit(number, x, y) for each pixel, in the order in which path tracing numbers them (shaders/path/path.h).
template <typename Visit> void forEachPixel(std::uint32_t width, std::uint32_t height, const Visit& visit)
{
    std::size_t number = 0;
    for (std::uint32_t strip = 0; strip < height; strip += gpu::kStripRows)
    {
        const std::uint32_t end = std::min(strip + gpu::kStripRows, height);
        for (std::uint32_t x = 0; x < width; ++x)
        {
            for (std::uint32_t y = strip; y < end; ++y)
            {
                visit(number++, x, y);
            }
        }
    }
}

} // namespace zvo
