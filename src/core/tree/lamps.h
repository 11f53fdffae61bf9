// SPDX-License-Identifier: MIT
#pragma once

#include "core/tree/tree_data.h"

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace zvo
{

/// Voxels of about the same light.
struct Lamp
{
    glm::vec3 radiance{0.0F}; // mean
    std::uint32_t color = 0;  // sRGB red | green << 8 | blue << 16: the voxels', or that of the light where it differs
    float strength = 0.0F;    // radiance over the colour in linear light
};

/// The lamps of a tree.
struct Lamps
{
    std::vector<Lamp> lamps;
    std::vector<std::uint8_t> of_light; // [TreeData::emission] index of the lamp
};

/// Chooses at most `most` (32 to 255) lamps for the emissive voxels of a tree. Where there are more kinds of light, the
/// nearest in colour and strength become one.
Lamps lampsOf(const TreeData& tree, std::size_t most);

} // namespace zvo
