// SPDX-License-Identifier: MIT
// Converts types of the public headers to those of the engine, and back.
#pragma once

#include "core/base/grid.h"
#include "zvo/types.h"

#include <glm/glm.hpp>

namespace zvo
{

inline glm::vec3 toGlm(const Vec3& v)
{
    return {v[0], v[1], v[2]};
}

inline glm::dvec3 toGlm(const DVec3& v)
{
    return {v[0], v[1], v[2]};
}

inline glm::mat4 toGlm(const Mat4& m)
{
    glm::mat4 result;
    for (int i = 0; i < 16; ++i)
    {
        result[i / 4][i % 4] = m[static_cast<std::size_t>(i)];
    }
    return result;
}

inline glm::dmat4 toGlm(const DMat4& m)
{
    glm::dmat4 result;
    for (int i = 0; i < 16; ++i)
    {
        result[i / 4][i % 4] = m[static_cast<std::size_t>(i)];
    }
    return result;
}

inline Grid toGrid(const GridInfo& grid)
{
    return {toGlm(grid.origin), grid.voxel_size, grid.depth};
}

inline GridInfo gridInfo(const Grid& grid)
{
    return {{grid.origin.x, grid.origin.y, grid.origin.z}, grid.voxel_size, grid.depth};
}

} // namespace zvo
