// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
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

/// An equirectangular map, [width * height] texels, blurred by a Gaussian over angles with this standard deviation, in
/// radians, above 0. It has at most as many texels as the map, and no more than its blur needs. Cost: texels, and those
/// that it has times about 150.
HdrImage blurredMap(std::uint32_t width, std::uint32_t height, std::span<const glm::vec3> texels, double deviation);

} // namespace zvo
