// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <glm/glm.hpp>

namespace zvo::oracle
{

/// 64-bit Morton code, x in bit 0; coordinates below 2^21.
inline std::uint64_t mortonEncode(const glm::uvec3& cell)
{
    std::uint64_t code = 0;
    for (std::uint32_t bit = 0; bit < 21; ++bit)
        for (std::uint32_t axis = 0; axis < 3; ++axis)
            code |= std::uint64_t{(cell[static_cast<int>(axis)] >> bit) & 1U} << (3 * bit + axis);
    return code;
}

inline glm::uvec3 mortonDecode(std::uint64_t code)
{
    glm::uvec3 cell{0U};
    for (std::uint32_t bit = 0; bit < 21; ++bit)
        for (std::uint32_t axis = 0; axis < 3; ++axis)
            cell[static_cast<int>(axis)] |= static_cast<std::uint32_t>((code >> (3 * bit + axis)) & 1U) << bit;
    return cell;
}

} // namespace zvo::oracle
