// SPDX-License-Identifier: MIT
// Triangles of any polygon in the plane, by a sweep from left to right.
#pragma once

#include "io/mesh/monotone_pieces.h"
#include "io/mesh/polygon_plane.h"

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <map>
#include <span>
#include <vector>

namespace zvo
{

/// Cuts polygons into triangles in time n log n. A point is inside where a ray from it crosses the boundary an odd
/// number of times. So edges that are walked twice count as none: bridges to holes, and spikes without area. Edges may
/// touch corners and each other.
///
/// Where two edges cross, one of them is led through the nearest of their four ends, and the sweep begins anew. A
/// boundary that crosses itself only by rounding hardly changes by that.
class PolygonSweep
{
public:
    /// Adds three corners for each triangle, which turns left. polygon: its corners in sequence. Returns false, and
    /// adds nothing, where a sweep finds no fewer crossings than the one before, or kPassesMax sweeps all find some;
    /// also where edges of a quadrilateral cross, as its two triangles cover it whatever their diagonal.
    bool triangulate(std::span<const PlanePoint> polygon, std::vector<glm::uvec3>& triangles);

private:
    static constexpr int kPassesMax = 16;

    /// Places are the different points of the polygon, numbered from left to right. Corners are numbers of points.
    struct Edge
    {
        std::uint32_t left = 0; // places
        std::uint32_t right = 0;
        std::uint32_t left_corner = 0; // at these places
        std::uint32_t right_corner = 0;
        std::uint32_t line = 0; // that it is a part of
        std::uint32_t next = 0; // of those that begin at the same place, or kNone
    };

    /// A part of the boundary between two corners: at first, an edge of the polygon.
    struct Line
    {
        std::uint32_t from = 0;
        std::uint32_t to = 0;
    };

    struct Crossing
    {
        std::uint32_t line = 0;
        std::uint32_t through = 0; // the corner that it is led through
    };

    /// An edge that the sweep has reached, with the region above it.
    struct ReachedEdge
    {
        std::uint32_t edge = 0;
        PolygonRegion above;
    };

    /// An edge in m_status. Its ends stand here, as every search compares with them.
    struct Segment
    {
        PlanePoint left;
        PlanePoint right;
        std::uint32_t edge = 0;
    };

    /// Orders segments that reach over a point, and the point among them, from below to above.
    struct Below
    {
        using is_transparent = void;

        bool operator()(const Segment& a, const Segment& b) const;
        bool operator()(const Segment& segment, const PlanePoint& point) const
        {
            return turn(segment.left, segment.right, point) > 0;
        }
        bool operator()(const PlanePoint& point, const Segment& segment) const
        {
            return turn(segment.left, segment.right, point) < 0;
        }
    };

    using Status = std::map<Segment, PolygonRegion, Below>;

    static constexpr std::uint32_t kNone = UINT32_MAX;

    void findPlaces();
    void makeEdges();
    void addEdge(Edge edge);
    void sweep();
    void visit(std::uint32_t place);
    void takeEnds(std::uint32_t place, Status::iterator& above);
    void takeStarts(std::uint32_t place);
    void dropCrossings(Status::iterator below, Status::iterator& above);
    void updateRegions(PolygonRegion* below);
    bool cross(std::uint32_t a, std::uint32_t b);
    void leadThroughCorners();
    [[nodiscard]] int side(std::uint32_t edge, std::uint32_t place) const;

    std::span<const PlanePoint> m_points;
    std::vector<std::uint32_t> m_place_of;  // [corner count]
    std::vector<PlanePoint> m_places;       // from left to right
    std::vector<std::uint32_t> m_corner_at; // [place count] one of the corners
    std::vector<Line> m_lines;
    std::vector<Edge> m_edges;
    std::vector<std::uint32_t> m_first_edge; // [place count] that begins there, or kNone
    std::vector<Crossing> m_crossings;
    std::vector<ReachedEdge> m_ends;   // at the current place, from below to above
    std::vector<ReachedEdge> m_starts; // at the current place, from below to above
    Status m_status;
    MonotonePieces m_pieces;
};

} // namespace zvo
