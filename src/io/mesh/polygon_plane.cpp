// SPDX-License-Identifier: MIT
#include "io/mesh/polygon_plane.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace zvo
{

namespace
{

__extension__ typedef __int128 Int128;

// Differences of coordinates stay below 2^51 in space, and below 2^60 in the plane.
constexpr int kSpaceBits = 50;

// The direction of projection has the normal's slopes, rounded to multiples of 1 / kSlopeSteps. So the projection of
// integers is exact.
constexpr std::int64_t kSlopeSteps = 256;

Int128 cross(const PlanePoint& a, const PlanePoint& b, const PlanePoint& c)
{
    return static_cast<Int128>(b.x - a.x) * (c.y - a.y) - static_cast<Int128>(b.y - a.y) * (c.x - a.x);
}

// Mean normals that are this much shorter than that of one triangle are due to the rounding of single precision.
constexpr double kCancelled = 1.0 / (1 << 20U);

/// The mean normal; where the loops of a polygon cancel each other, as those of an 8, the normal of one triangle.
glm::dvec3 polygonNormal(std::span<const glm::vec3> corners)
{
    const glm::dvec3 first(corners[0]);
    glm::dvec3 sum(0.0);
    glm::dvec3 longest(0.0);
    for (std::size_t i = 1; i + 1 < corners.size(); ++i)
    {
        const glm::dvec3 normal = glm::cross(glm::dvec3(corners[i]) - first, glm::dvec3(corners[i + 1]) - first);
        sum += normal;
        longest = glm::dot(normal, normal) > glm::dot(longest, longest) ? normal : longest;
    }
    if (glm::length(sum) > kCancelled * glm::length(longest))
    {
        return sum;
    }
    return glm::dot(sum, longest) < 0.0 ? -longest : longest;
}

} // namespace

int turn(const PlanePoint& a, const PlanePoint& b, const PlanePoint& c)
{
    const Int128 area = cross(a, b, c);
    return area > 0 ? 1 : area < 0 ? -1 : 0;
}

double doubleArea(const PlanePoint& a, const PlanePoint& b, const PlanePoint& c)
{
    return static_cast<double>(cross(a, b, c));
}

bool projectPolygon(std::span<const glm::vec3> corners, std::vector<PlanePoint>& points)
{
    const glm::dvec3 first(corners[0]);
    double extent = 0.0;
    for (const glm::vec3& corner : corners)
    {
        for (int axis = 0; axis < 3; ++axis)
        {
            if (!std::isfinite(corner[axis]))
            {
                return false;
            }
            extent = std::max(extent, std::abs(corner[axis] - first[axis]));
        }
    }
    const glm::dvec3 normal = polygonNormal(corners);
    const glm::dvec3 size = glm::abs(normal);
    const int depth = size.x > std::max(size.y, size.z) ? 0 : size.y > size.z ? 1 : 2;
    if (size[depth] == 0.0)
    {
        return false;
    }
    std::array<int, 2> axes = {(depth + 1) % 3, (depth + 2) % 3};
    if (normal[depth] < 0.0)
    {
        std::swap(axes[0], axes[1]);
    }
    const std::array<std::int64_t, 2> slopes = {
        std::llround(normal[axes[0]] / normal[depth] * static_cast<double>(kSlopeSteps)),
        std::llround(normal[axes[1]] / normal[depth] * static_cast<double>(kSlopeSteps))};
    const int shift = kSpaceBits - 1 - std::ilogb(extent);
    points.clear();
    points.reserve(corners.size());
    for (const glm::vec3& corner : corners)
    {
        const auto whole = [&](int axis) { return std::llround(std::ldexp(corner[axis] - first[axis], shift)); };
        const std::int64_t deep = whole(depth);
        points.push_back(
            {kSlopeSteps * whole(axes[0]) - slopes[0] * deep, kSlopeSteps * whole(axes[1]) - slopes[1] * deep});
    }
    return true;
}

bool isConvex(std::span<const PlanePoint> polygon)
{
    std::size_t last = polygon.size() - 1;
    while (last > 0 && polygon[last] == polygon[0])
    {
        --last;
    }
    PlanePoint previous = polygon[last];
    std::size_t rightmost_count = 0;
    for (std::size_t i = 0; i < polygon.size(); ++i)
    {
        const PlanePoint& corner = polygon[i];
        const PlanePoint& next = polygon[i + 1 < polygon.size() ? i + 1 : 0];
        if (next == corner)
        {
            continue;
        }
        if (turn(previous, corner, next) < 0)
        {
            return false;
        }
        rightmost_count += previous < corner && next < corner ? 1 : 0;
        previous = corner;
    }
    return rightmost_count == 1;
}

} // namespace zvo
