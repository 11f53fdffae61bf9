// SPDX-License-Identifier: MIT
// The plane in which a polygon is cut into triangles, with integer coordinates: which side of a line a point lies on is
// decided without rounding.
#pragma once

#include <compare>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace zvo
{

/// Coordinates between -2^60 and 2^60. Points are ordered by x, then by y.
struct PlanePoint
{
    std::int64_t x = 0;
    std::int64_t y = 0;

    friend auto operator<=>(const PlanePoint&, const PlanePoint&) = default;
};

/// 1 where the way from a by b to c turns left, -1 where it turns right, 0 where the three lie on a line.
int turn(const PlanePoint& a, const PlanePoint& b, const PlanePoint& c);

/// Twice the area of the triangle a b c, rounded; above 0 where it turns left.
double doubleArea(const PlanePoint& a, const PlanePoint& b, const PlanePoint& c);

/// Projects a polygon along its mean normal, or, where its loops cancel each other, that of one of its triangles.
/// points: receives a point for each corner; the polygon turns left there. Corners that lie on a line do so in points,
/// too, unless some of their coordinates are less than 2^-26 of the polygon's size. Returns false where a coordinate is
/// not finite or all corners lie on a line. The mean normal is that of M. Newell: I. Sutherland, R. Sproull, R.
/// Schumacker, A Characterization of Ten Hidden-Surface Algorithms, 1974.
bool projectPolygon(std::span<const glm::vec3> corners, std::vector<PlanePoint>& points);

/// Whether the boundary never turns right and goes around once. Corners may be straight or repeated.
bool isConvex(std::span<const PlanePoint> polygon);

} // namespace zvo
