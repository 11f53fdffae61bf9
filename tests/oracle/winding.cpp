// SPDX-License-Identifier: MIT
#include "oracle/winding.h"

#include <algorithm>
#include <map>

namespace zvo::oracle
{
namespace
{

using Edge = std::array<std::int64_t, 6>;

Edge edgeOf(const Vec& from, const Vec& to)
{
    Edge edge{};
    for (std::size_t i = 0; i < 3; ++i)
    {
        edge[i] = static_cast<std::int64_t>(from[i]);
        edge[3 + i] = static_cast<std::int64_t>(to[i]);
    }
    return edge;
}

/// Whether the column through (x, y) along z meets the triangle, whose normal has the given sign. A column through an
/// edge meets one of the two triangles beside it.
bool meetsColumn(const Triangle& triangle, Int128 sign, Int128 x, Int128 y)
{
    for (std::size_t i = 0; i < 3; ++i)
    {
        const Vec& from = triangle[i];
        const Vec edge = triangle[(i + 1) % 3] - from;
        const Int128 e_x = sign * edge[0];
        const Int128 e_y = sign * edge[1];
        const Int128 side = e_x * (y - from[1]) - e_y * (x - from[0]);
        const bool owned = e_y > 0 || (e_y == 0 && e_x > 0);
        if (side < 0 || (side == 0 && !owned))
            return false;
    }
    return true;
}

/// The range of columns, along one axis, whose centres lie between low and high.
std::array<std::int64_t, 2> centersBetween(Int128 low, Int128 high, std::uint32_t resolution)
{
    const Int128 first = floorDivide(low - 128 + kLatticeVoxel - 1, kLatticeVoxel);
    const Int128 last = floorDivide(high - 128, kLatticeVoxel);
    return {static_cast<std::int64_t>(std::max(first, Int128{0})),
            static_cast<std::int64_t>(std::min(last, Int128{resolution} - 1))};
}

} // namespace

bool isClosed(std::span<const Triangle> triangles)
{
    std::map<Edge, std::int64_t> balance; // [edge, in the direction that sorts first]
    for (const Triangle& triangle : triangles)
    {
        for (std::size_t i = 0; i < 3; ++i)
        {
            const Edge there = edgeOf(triangle[i], triangle[(i + 1) % 3]);
            const Edge back = edgeOf(triangle[(i + 1) % 3], triangle[i]);
            if (there < back)
                ++balance[there];
            else if (back < there)
                --balance[back];
        }
    }
    return std::all_of(balance.begin(), balance.end(), [](const auto& entry) { return entry.second == 0; });
}

std::vector<std::int16_t> windingNumbers(std::span<const Triangle> triangles, std::uint32_t resolution)
{
    const std::size_t layer = std::size_t{resolution} * resolution;
    std::vector<std::int16_t> winding(layer * resolution);
    for (const Triangle& triangle : triangles)
    {
        const Vec normal = normalOf(triangle);
        if (normal[2] == 0)
            continue;
        const Int128 sign = normal[2] < 0 ? -1 : 1;
        const auto [x_low, x_high] = std::minmax({triangle[0][0], triangle[1][0], triangle[2][0]});
        const auto [y_low, y_high] = std::minmax({triangle[0][1], triangle[1][1], triangle[2][1]});
        const auto columns = centersBetween(x_low, x_high, resolution);
        const auto rows = centersBetween(y_low, y_high, resolution);
        for (std::int64_t row = rows[0]; row <= rows[1]; ++row)
        {
            for (std::int64_t column = columns[0]; column <= columns[1]; ++column)
            {
                const Int128 x = Int128{column} * kLatticeVoxel + 128;
                const Int128 y = Int128{row} * kLatticeVoxel + 128;
                if (!meetsColumn(triangle, sign, x, y))
                    continue;
                // The crossing's height is V0_z + rise / |n_z|. The centres from first on lie above it.
                const Int128 rise = -sign * (normal[0] * (x - triangle[0][0]) + normal[1] * (y - triangle[0][1]));
                const Int128 size = sign * normal[2];
                const Int128 first = floorDivide((triangle[0][2] - 128) * size + rise, kLatticeVoxel * size) + 1;
                if (first >= resolution)
                    continue;
                const auto start = static_cast<std::size_t>(std::max(first, Int128{0}));
                winding[static_cast<std::size_t>(row) * resolution + static_cast<std::size_t>(column) +
                        start * layer] -= static_cast<std::int16_t>(sign);
            }
        }
    }
    for (std::size_t i = layer; i < winding.size(); ++i)
        winding[i] = static_cast<std::int16_t>(winding[i] + winding[i - layer]);
    return winding;
}

} // namespace zvo::oracle
