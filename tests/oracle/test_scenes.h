// SPDX-License-Identifier: MIT
// Small inputs for the oracles' own tests.
#pragma once

#include "core/scene/scene.h"
#include "oracle/coverage.h"

#include <random>
#include <vector>

namespace zvo::oracle::test
{

using Random = std::mt19937;

/// A grid of 4^3 voxels of size 1.
inline const Grid kUnitGrid{.origin = glm::vec3(0.0F), .voxel_size = 1.0F, .depth = 2};

inline std::int64_t pick(Random& random, std::int64_t low, std::int64_t high)
{
    return std::uniform_int_distribution<std::int64_t>(low, high)(random);
}

inline Vec pickPoint(Random& random, std::int64_t low, std::int64_t high)
{
    return {pick(random, low, high), pick(random, low, high), pick(random, low, high)};
}

inline Triangle pickTriangle(Random& random, std::int64_t low, std::int64_t high)
{
    return {pickPoint(random, low, high), pickPoint(random, low, high), pickPoint(random, low, high)};
}

inline Material materialOf(AlphaMode mode, const glm::vec4& base_color = glm::vec4(1.0F), float cutoff = 0.5F)
{
    Material material;
    material.base_color = base_color;
    material.alpha_mode = mode;
    material.alpha_cutoff = cutoff;
    return material;
}

/// Every voxel of the grid.
inline std::vector<glm::uvec3> allVoxels(std::uint32_t resolution)
{
    std::vector<glm::uvec3> voxels;
    for (std::uint32_t z = 0; z < resolution; ++z)
        for (std::uint32_t y = 0; y < resolution; ++y)
            for (std::uint32_t x = 0; x < resolution; ++x)
                voxels.emplace_back(x, y, z);
    return voxels;
}

} // namespace zvo::oracle::test
