// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <glm/glm.hpp>

namespace zvo::test
{

/// The cube with a Morton code, bit by bit.
inline glm::uvec3 mortonIndex(std::uint64_t code)
{
    glm::uvec3 index{0};
    for (std::uint32_t bit = 0; code >> (3 * bit) != 0; ++bit)
    {
        for (std::uint32_t axis = 0; axis < 3; ++axis)
        {
            index[static_cast<int>(axis)] |= static_cast<std::uint32_t>(code >> (3 * bit + axis) & 1) << bit;
        }
    }
    return index;
}

} // namespace zvo::test
