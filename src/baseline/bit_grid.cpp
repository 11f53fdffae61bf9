// SPDX-License-Identifier: MIT
#include "baseline/bit_grid.h"

#include "core/base/morton.h"

#include <algorithm>
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

    [[nodiscard]] float timeOf(std::uint32_t plane, float root_resolution) const
    {
        return (1.0F + static_cast<float>(plane) / root_resolution - origin) * inverse;
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
    : m_depth(grid.depth), m_root_resolution(static_cast<float>(grid.rootResolution())),
      m_bits(std::max<std::uint64_t>((std::uint64_t{1} << 3 * grid.depth) / 64, 1))
{
    for (const std::uint64_t code : codes)
    {
        const glm::uvec3 cell = cellOfCode(code);
        const std::uint64_t bit = ((std::uint64_t{cell.z} << m_depth | cell.y) << m_depth) | cell.x;
        m_bits[bit / 64] |= std::uint64_t{1} << bit % 64;
    }
}

std::optional<GridHit> BitGrid::firstHit(const glm::vec3& origin, const glm::vec3& direction, float t_min) const
{
    const auto root = static_cast<std::uint32_t>(m_root_resolution);
    const std::uint32_t size = 1U << m_depth;
    const Axis axes[3] = {axisOf(origin.x, direction.x), axisOf(origin.y, direction.y), axisOf(origin.z, direction.z)};
    // The grid is the lower corner of the root cube, for a mirrored axis the upper one.
    glm::uvec3 first(0U);
    float t = t_min;
    for (int i = 0; i < 3; ++i)
    {
        first[i] = axes[i].mirrored ? root - size : 0U;
        t = std::max(t, axes[i].timeOf(first[i], m_root_resolution));
    }
    // The last plane of each axis that is crossed up to the event that enters the grid: a plane that is crossed at the
    // same time comes before it if its axis is not the later one.
    int entered = 3;
    if (t > t_min)
    {
        for (int i = 0; i < 3; ++i)
        {
            entered = axes[i].timeOf(first[i], m_root_resolution) == t ? i : entered;
        }
    }
    glm::uvec3 cell = first;
    glm::vec3 next(0.0F);
    for (int i = 0; i < 3; ++i)
    {
        const auto isCrossed = [&](std::uint32_t plane)
        {
            const float time = axes[i].timeOf(plane, m_root_resolution);
            return time < t || (time == t && i <= entered);
        };
        // By bisection: planes are crossed in order.
        std::uint32_t low = first[i];
        std::uint32_t high = first[i] + size;
        if (!isCrossed(low) || isCrossed(high))
        {
            return std::nullopt;
        }
        while (high - low > 1)
        {
            const std::uint32_t middle = low + (high - low) / 2;
            (isCrossed(middle) ? low : high) = middle;
        }
        cell[i] = low;
        next[i] = axes[i].timeOf(low + 1, m_root_resolution);
    }
    for (;;)
    {
        const glm::uvec3 place(axes[0].mirrored ? root - 1 - cell.x : cell.x,
                               axes[1].mirrored ? root - 1 - cell.y : cell.y,
                               axes[2].mirrored ? root - 1 - cell.z : cell.z);
        if (isOccupied(place))
        {
            return GridHit{t, place};
        }
        const int axis = next.z < std::min(next.x, next.y) ? 2 : next.y < next.x ? 1 : 0;
        t = next[axis];
        if (++cell[axis] == first[axis] + size || t == std::numeric_limits<float>::infinity())
        {
            return std::nullopt;
        }
        next[axis] = axes[axis].timeOf(cell[axis] + 1, m_root_resolution);
    }
}

} // namespace zvo::baseline
