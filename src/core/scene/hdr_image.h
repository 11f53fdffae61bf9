// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace zvo
{

/// A picture of linear radiance in the primaries of sRGB.
struct HdrImage
{
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::vector<glm::vec3> texels; // [width * height] row by row from the top
};

} // namespace zvo
