// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <glm/glm.hpp>

namespace zvo::cli
{

/// The coordinates of the voxel with that Morton code: x in bits 0, 3, 6 and so on.
inline glm::uvec3 cellOf(std::uint64_t code)
{
    glm::uvec3 cell(0U);
    for (std::uint32_t bit = 0; code != 0; ++bit, code >>= 3)
    {
        cell |= glm::uvec3(code & 1U, code >> 1 & 1U, code >> 2 & 1U) << bit;
    }
    return cell;
}

} // namespace zvo::cli
