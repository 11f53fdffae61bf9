// SPDX-License-Identifier: MIT
#pragma once

#include "tree.h"

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace zvo::python
{

/// What rays find, a row for each ray.
struct Hits
{
    std::vector<std::uint8_t> state; // [rays] QueryState
    std::vector<float> t;            // [rays] in lengths of the ray's direction; infinity where nothing was found
    std::vector<std::int32_t> voxel; // [3 * rays] the voxel's cell; -1 where nothing was found
    std::vector<std::int8_t> face;   // [rays] 0 to 2, or 3 (QueryAnswer::face); -1 where nothing was found
    std::vector<float> normal;       // [3 * rays] of the voxel
    std::vector<std::uint8_t> color; // [3 * rays] of the voxel, sRGB
};

/// Traces rays, from t_min to t_max in lengths of their directions. origins, directions: one for each, in world space.
/// Waits. Throws Error{Memory}.
Hits trace(const Tree& tree, std::span<const glm::vec3> origins, std::span<const glm::vec3> directions, float t_min,
           float t_max);

} // namespace zvo::python
