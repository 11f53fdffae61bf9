// SPDX-License-Identifier: MIT
// Needs -ffp-contract=off and round to nearest even, the default.
#include "oracle/snap.h"

#include <algorithm>
#include <cmath>

namespace zvo::oracle
{
namespace
{

constexpr float kLatticeMax = 536870912.0F; // 2^29

float transformedComponent(const glm::mat4& transform, const glm::vec3& point, int row)
{
    const float x = transform[0][row] * point.x;
    const float y = transform[1][row] * point.y;
    const float z = transform[2][row] * point.z;
    const float xy = x + y;
    const float xyz = xy + z;
    return xyz + transform[3][row];
}

/// The coordinate in lattice units, not yet checked against the range.
float latticeCoordinate(float world, float origin, float scale)
{
    const float offset = world - origin;
    const float scaled = offset * scale;
    return std::nearbyint(scaled);
}

bool touchesGrid(const Triangle& triangle, const Grid& grid)
{
    const Int128 end = Int128{grid.resolution()} * kLatticeVoxel;
    for (std::size_t i = 0; i < 3; ++i)
    {
        const auto [low, high] = std::minmax({triangle[0][i], triangle[1][i], triangle[2][i]});
        if (high < 0 || low > end)
            return false;
    }
    return true;
}

} // namespace

SnappedTriangle snapTriangle(const std::array<glm::vec3, 3>& corners, const glm::mat4& transform, const Grid& grid,
                             Coverage coverage)
{
    const auto scale = static_cast<float>(256.0 / static_cast<double>(grid.voxel_size));
    SnappedTriangle result;
    bool out_of_range = false;
    for (std::size_t corner = 0; corner < 3; ++corner)
    {
        for (int axis = 0; axis < 3; ++axis)
        {
            const float world = transformedComponent(transform, corners[corner], axis);
            if (!std::isfinite(world))
            {
                result.dropped = "nonfinite";
                return result;
            }
            const float q = latticeCoordinate(world, grid.origin[axis], scale);
            if (std::fabs(q) <= kLatticeMax)
                result.triangle[corner][static_cast<std::size_t>(axis)] = static_cast<std::int64_t>(q);
            else
                out_of_range = true;
        }
    }
    if (out_of_range)
        result.dropped = "out_of_range";
    else if (!touchesGrid(result.triangle, grid))
        result.dropped = "outside";
    else if (coverage == Coverage::Thin && normalOf(result.triangle) == Vec{0, 0, 0})
        result.dropped = "zero_area";
    return result;
}

} // namespace zvo::oracle
