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

/// The sign of a + b e + c e^2 + d e^3 for a small e.
int signOf(Int128 a, Int128 b, Int128 c, Int128 d)
{
    for (const Int128 number : {a, b, c, d})
    {
        if (number != 0)
            return number > 0 ? 1 : -1;
    }
    return 0;
}

/// Whether the line along y through (x + e, z + e^2) meets the triangle, whose normal's y has this sign.
bool meetsLine(const Triangle& triangle, int facing, Int128 x, Int128 z)
{
    for (std::size_t i = 0; i < 3; ++i)
    {
        const Vec& from = triangle[i];
        const Vec edge = triangle[(i + 1) % 3] - from;
        // Seen from above, z goes right and x goes up: counterclockwise triangles face up.
        if (signOf(edge[2] * (x - from[0]) - edge[0] * (z - from[2]), edge[2], -edge[0], 0) != facing)
            return false;
    }
    return true;
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

std::vector<std::int16_t> windingsBesideCentres(std::span<const Triangle> triangles, std::uint32_t resolution)
{
    std::vector<std::int16_t> winding(std::size_t{resolution} * resolution * resolution);
    const auto centre = [](std::int64_t cell) { return Int128{cell} * kLatticeVoxel + 128; };
    for (const Triangle& triangle : triangles)
    {
        const Vec normal = normalOf(triangle);
        const int facing = signOf(normal[1], 0, 0, 0);
        const auto [x_low, x_high] = std::minmax({triangle[0][0], triangle[1][0], triangle[2][0]});
        const auto [z_low, z_high] = std::minmax({triangle[0][2], triangle[1][2], triangle[2][2]});
        const auto columns = centersBetween(x_low, x_high, resolution);
        const auto rows = centersBetween(z_low, z_high, resolution);
        for (std::int64_t z = rows[0]; facing != 0 && z <= rows[1]; ++z)
        {
            for (std::int64_t x = columns[0]; x <= columns[1]; ++x)
            {
                if (!meetsLine(triangle, facing, centre(x), centre(z)))
                    continue;
                for (std::int64_t y = 0; y < resolution; ++y)
                {
                    const Vec to = Vec{centre(x), centre(y), centre(z)} - triangle[0];
                    const Int128 over = normal[0] * to[0] + normal[1] * to[1] + normal[2] * to[2];
                    if (signOf(over, normal[0], normal[2], normal[1]) == facing)
                        break; // this point, and those above it, are on the upper side
                    const std::int64_t number = x + resolution * (y + resolution * z);
                    winding[static_cast<std::size_t>(number)] += static_cast<std::int16_t>(facing);
                }
            }
        }
    }
    return winding;
}

} // namespace zvo::oracle
