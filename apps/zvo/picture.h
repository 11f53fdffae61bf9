// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

namespace zvo::cli
{

/// A picture that becomes a file, or a part of one.
struct Picture
{
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::vector<std::uint32_t> texels; // [width * height] red | green << 8 | blue << 16 | 255 << 24, rows from the top
    std::vector<std::uint8_t> file;    // in place of texels: the file of a picture of radiance
};

} // namespace zvo::cli
