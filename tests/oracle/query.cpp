// SPDX-License-Identifier: MIT
#include "oracle/query.h"

#include "oracle/morton.h"

#include <algorithm>
#include <array>
#include <cstdlib>

namespace zvo::oracle
{

namespace
{

__extension__ using Wide = __int128;

constexpr std::int64_t kEdge = 256;

// Whether open intervals share a point.
bool overlap(std::int64_t low, std::int64_t high, std::int64_t other_low, std::int64_t other_high)
{
    return std::max(low, other_low) < std::min(high, other_high);
}

} // namespace

VoxelSet::VoxelSet(std::span<const std::uint64_t> codes)
{
    for (const std::uint64_t code : codes)
    {
        m_cells.emplace_back(mortonDecode(code));
    }
}

std::optional<QueryAnswer> VoxelSet::atPoint(const glm::ivec3& position) const
{
    for (const glm::ivec3& cell : m_cells)
    {
        bool is_inside = true;
        for (int axis = 0; axis < 3; ++axis)
        {
            is_inside = is_inside && position[axis] >= cell[axis] * kEdge && position[axis] < (cell[axis] + 1) * kEdge;
        }
        if (is_inside)
        {
            return QueryAnswer{cell};
        }
    }
    return std::nullopt;
}

std::optional<QueryAnswer> VoxelSet::inBox(const glm::ivec3& low, const glm::ivec3& high) const
{
    for (const glm::ivec3& cell : m_cells)
    {
        bool meets = true;
        for (int axis = 0; axis < 3; ++axis)
        {
            meets = meets && overlap(cell[axis] * kEdge, (cell[axis] + 1) * kEdge, low[axis], high[axis]);
        }
        if (meets)
        {
            return QueryAnswer{cell};
        }
    }
    return std::nullopt;
}

std::optional<QueryAnswer> VoxelSet::nearest(const glm::ivec3& position, std::uint32_t reach) const
{
    std::optional<QueryAnswer> best;
    for (const glm::ivec3& cell : m_cells)
    {
        std::int64_t squared = 0;
        for (int axis = 0; axis < 3; ++axis)
        {
            const std::int64_t at = position[axis];
            const std::int64_t closest = std::clamp(at, cell[axis] * kEdge, (cell[axis] + 1) * kEdge);
            squared += (at - closest) * (at - closest);
        }
        if (Wide{squared} <= Wide{reach} * reach && (!best || squared < best->numerator))
        {
            best = QueryAnswer{cell, 3, squared, 1};
        }
    }
    return best;
}

std::optional<QueryAnswer> VoxelSet::onWay(const glm::ivec3& low, const glm::ivec3& high,
                                           const glm::ivec3& motion) const
{
    if (!(low.x < high.x && low.y < high.y && low.z < high.z))
    {
        return std::nullopt;
    }
    Wide unit = 1; // of times: 1 is the end
    for (int axis = 0; axis < 3; ++axis)
    {
        unit *= motion[axis] == 0 ? 1 : std::abs(motion[axis]);
    }
    std::optional<QueryAnswer> best;
    Wide best_time = unit;
    for (const glm::ivec3& cell : m_cells)
    {
        // The open interval of times at which the box and the voxel share a point along all axes.
        Wide from = -unit * (std::int64_t{1} << 40);
        Wide to = -from;
        QueryAnswer answer = {cell};
        for (int axis = 0; axis < 3; ++axis)
        {
            const std::int64_t start = cell[axis] * kEdge;
            const std::int64_t speed = std::abs(motion[axis]);
            const std::int64_t gap = motion[axis] < 0 ? low[axis] - (start + kEdge) : start - high[axis];
            if (speed == 0)
            {
                to = overlap(start, start + kEdge, low[axis], high[axis]) ? to : from;
                continue;
            }
            const Wide enters = gap * (unit / speed);
            to = std::min(to, (gap + kEdge + high[axis] - low[axis]) * (unit / speed));
            if (enters >= from)
            {
                from = enters;
                answer = {cell, static_cast<std::uint32_t>(axis), gap, speed};
            }
        }
        if (from >= to || from >= unit || to <= 0)
        {
            continue;
        }
        // A voxel in which the box begins comes before one that it only touches there.
        const Wide time = from < 0 ? -1 : from;
        if (time < best_time)
        {
            best_time = time;
            best = from < 0 ? QueryAnswer{cell, 3, 0, 1} : answer;
        }
    }
    return best;
}

} // namespace zvo::oracle
