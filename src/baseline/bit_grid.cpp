// SPDX-License-Identifier: MIT
#include "baseline/bit_grid.h"

#include "core/base/morton.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace zvo::baseline
{

namespace
{

constexpr float kDirectionMin = 1e-20F; // smaller components count as this

// An axis of a ray, mirrored if the ray goes down it: then plane p stands for plane size - p.
struct Axis
{
    float origin = 0.0F;
    float inverse = 0.0F;
    bool mirrored = false;

    // cell_size: a power of two, so that the place of the plane is exact.
    [[nodiscard]] float timeOf(std::uint32_t plane, float cell_size) const
    {
        return (1.0F + static_cast<float>(plane) * cell_size - origin) * inverse;
    }
};

Axis axisOf(float origin, float direction)
{
    const float component = std::copysign(std::max(std::abs(direction), kDirectionMin), direction);
    const bool mirrored = component < 0.0F;
    return {mirrored ? 3.0F - origin : origin, std::abs(1.0F / component), mirrored};
}

} // namespace

BitGrid::BitGrid(const Grid& grid, std::span<const std::uint64_t> codes)
    : m_depth(grid.depth), m_root_resolution(grid.rootResolution()),
      m_bits(std::max<std::uint64_t>((std::uint64_t{1} << 3 * grid.depth) / 64, 1))
{
    assert(grid.depth <= kDepthMax);
    for (const std::uint64_t code : codes)
    {
        const std::uint64_t bit = bitOf(cellOfCode(code));
        m_bits[bit / 64] |= std::uint64_t{1} << bit % 64;
    }
}

std::optional<GridHit> BitGrid::firstHit(const glm::vec3& origin, const glm::vec3& direction, float t_min) const
{
    const float cell_size = 1.0F / static_cast<float>(m_root_resolution);
    const std::uint32_t size = 1U << m_depth;
    const Axis axes[3] = {axisOf(origin.x, direction.x), axisOf(origin.y, direction.y), axisOf(origin.z, direction.z)};
    // The grid is the lower corner of the root cube, for a mirrored axis the upper one.
    glm::uvec3 first(0U);
    float t = t_min;
    for (int i = 0; i < 3; ++i)
    {
        first[i] = axes[i].mirrored ? m_root_resolution - size : 0U;
        t = std::max(t, axes[i].timeOf(first[i], cell_size));
    }
    // The last plane of each axis that is crossed up to the event that enters the grid: a plane that is crossed at the
    // same time comes before it if its axis is not the later one.
    int entered = 3;
    if (t > t_min)
    {
        for (int i = 0; i < 3; ++i)
        {
            entered = axes[i].timeOf(first[i], cell_size) == t ? i : entered;
        }
    }
    glm::uvec3 cell(0U);  // counted from first
    glm::uvec3 place(0U); // the same cell in the grid
    glm::vec3 next(0.0F); // when the ray leaves the cell along each axis
    std::int64_t step[3]; // between the bits of neighbours
    for (int i = 0; i < 3; ++i)
    {
        const auto isCrossed = [&](std::uint32_t plane)
        {
            const float time = axes[i].timeOf(first[i] + plane, cell_size);
            return time < t || (time == t && i <= entered);
        };
        if (!isCrossed(0) || isCrossed(size))
        {
            return std::nullopt;
        }
        std::uint32_t low = 0; // by bisection: planes are crossed in order
        std::uint32_t high = size;
        while (high - low > 1)
        {
            const std::uint32_t middle = low + (high - low) / 2;
            (isCrossed(middle) ? low : high) = middle;
        }
        cell[i] = low;
        place[i] = axes[i].mirrored ? size - 1 - low : low;
        next[i] = axes[i].timeOf(first[i] + low + 1, cell_size);
        step[i] = (axes[i].mirrored ? -1 : 1) * (std::int64_t{1} << (static_cast<std::uint32_t>(i) * m_depth));
    }
    std::uint64_t bit = bitOf(place);
    while ((m_bits[bit / 64] >> bit % 64 & 1U) == 0)
    {
        const int axis = next.z < std::min(next.x, next.y) ? 2 : next.y < next.x ? 1 : 0;
        t = next[axis];
        if (++cell[axis] == size || t == std::numeric_limits<float>::infinity())
        {
            return std::nullopt;
        }
        bit += static_cast<std::uint64_t>(step[axis]);
        next[axis] = axes[axis].timeOf(first[axis] + cell[axis] + 1, cell_size);
    }
    const std::uint64_t mask = size - 1;
    return GridHit{t, glm::uvec3(bit & mask, bit >> m_depth & mask, bit >> 2 * m_depth)};
}

} // namespace zvo::baseline
