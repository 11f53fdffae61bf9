// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <glm/glm.hpp>

namespace zvo
{

/// The coordinates of the cell with this Morton code: x in bits 0, 3, 6 and so on.
constexpr glm::uvec3 cellOfCode(std::uint64_t code)
{
    glm::uvec3 cell(0U);
    for (std::uint32_t bit = 0; code != 0; ++bit, code >>= 3)
    {
        cell |= glm::uvec3(code & 1U, code >> 1 & 1U, code >> 2 & 1U) << bit;
    }
    return cell;
}

/// The Morton code of a cell, of whose coordinates the lowest 21 bits count.
constexpr std::uint64_t codeOfCell(const glm::uvec3& cell)
{
    const auto spread = [](std::uint64_t v) // two zeros between each two bits
    {
        v &= 0x1fffffU;
        v = (v | v << 32) & 0x1f00000000ffffU;
        v = (v | v << 16) & 0x1f0000ff0000ffU;
        v = (v | v << 8) & 0x100f00f00f00f00fU;
        v = (v | v << 4) & 0x10c30c30c30c30c3U;
        return (v | v << 2) & 0x1249249249249249U;
    };
    return spread(cell.x) | spread(cell.y) << 1 | spread(cell.z) << 2;
}

} // namespace zvo
