// SPDX-License-Identifier: MIT
// Converts types of the public headers to those of the engine, and back.
#pragma once

#include "core/base/grid.h"
#include "zvo/types.h"

#include <glm/glm.hpp>
#include <glm/gtc/type_ptr.hpp>

#include <array>

namespace zvo
{

template <typename Number> glm::vec<3, Number> toGlm(const std::array<Number, 3>& v)
{
    return {v[0], v[1], v[2]};
}

template <typename Number> glm::mat<4, 4, Number> toGlm(const std::array<Number, 16>& m)
{
    return glm::make_mat4(m.data());
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
