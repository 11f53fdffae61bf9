// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace zvo
{

/// The brightest light from outside of the grid: the square of what 1024 bounces bring, summed over 2^24 samples, is
/// still a float.
inline constexpr float kRadianceMax = 1e12F;

/// A picture of linear radiance in the primaries of sRGB.
struct HdrImage
{
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::vector<glm::vec3> texels; // [width * height] row by row from the top
};

} // namespace zvo
