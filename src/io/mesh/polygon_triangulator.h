// SPDX-License-Identifier: MIT
#pragma once

#include "io/mesh/polygon_plane.h"
#include "io/mesh/polygon_sweep.h"

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace zvo
{

/// Cuts polygons of files into triangles between their own corners. A polygon may be concave, have holes that bridges
/// join to its boundary, corners that are straight or repeated, and may be bent. One object cuts any number of them.
class PolygonTriangulator
{
public:
    /// Adds the triangles of a polygon, in time n log n: at most two for each corner, none for fewer than three
    /// corners. They turn as the polygon does. positions, vertices: of the corners in sequence; a triangle is three of
    /// these vertices.
    ///
    /// A convex polygon becomes a fan around its first corner. Others are projected along their mean normal and cut
    /// there by PolygonSweep, whose rule says what is inside. Where that has no answer, as all corners lie on a line,
    /// or edges cross too often, the polygon becomes a fan, too.
    void triangulate(std::span<const glm::vec3> positions, std::span<const std::uint32_t> vertices,
                     std::vector<glm::uvec3>& triangles);

private:
    std::vector<PlanePoint> m_points;
    PolygonSweep m_sweep;
};

} // namespace zvo
