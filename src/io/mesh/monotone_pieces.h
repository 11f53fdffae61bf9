// SPDX-License-Identifier: MIT
// Pieces of a polygon that grow from left to right and become triangles as they grow.
#pragma once

#include "io/mesh/polygon_plane.h"

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace zvo
{

/// What lies between two edges of a polygon, one above the other, up to the current corner of a sweep: a piece, or two
/// of them, one above the other, that met at a corner and have had no corner in common since. Nothing outside of the
/// polygon.
struct PolygonRegion
{
    static constexpr std::uint32_t kNone = UINT32_MAX;

    std::uint32_t piece = kNone;
    std::uint32_t upper_piece = kNone;

    [[nodiscard]] bool inside() const { return piece != kNone; }
};

/// Cuts monotone pieces into triangles, each in linear time. Corners are numbers of points and come in the order of the
/// points. After: M. Garey, D. Johnson, F. Preparata, R. Tarjan, Triangulating a Simple Polygon, 1978; and for pieces
/// that begin and end in the midst of a sweep: S. Hertel, K. Mehlhorn, Fast Triangulation of Simple Polygons, 1983.
class MonotonePieces
{
public:
    /// Begins a new polygon. Both are kept until the next one: points, a point for each corner, and triangles, to which
    /// three corners are added for each triangle, which turns left.
    void reset(std::span<const PlanePoint> points, std::vector<glm::uvec3>& triangles);

    /// A region that begins at a corner.
    PolygonRegion begin(std::uint32_t corner);

    /// A corner on the region's lower edge, or on the upper one.
    void addBelow(PolygonRegion& region, std::uint32_t corner);
    void addAbove(PolygonRegion& region, std::uint32_t corner);

    /// Two edges begin at one point amid the region, which becomes the region below them, and returns that above them.
    PolygonRegion split(PolygonRegion& region, std::uint32_t lower_corner, std::uint32_t upper_corner);

    /// The region ends at a corner.
    void end(const PolygonRegion& region, std::uint32_t corner);

private:
    /// The corners that await their triangles. All but the first lie on one of the two edges.
    struct Piece
    {
        std::vector<std::uint32_t> corners;
        bool above = false;
    };

    std::uint32_t newPiece(std::uint32_t corner);
    void add(Piece& piece, std::uint32_t corner, bool above);
    void fan(Piece& piece, std::uint32_t corner);
    void endPiece(std::uint32_t index, std::uint32_t corner);
    void addTriangle(std::uint32_t a, std::uint32_t b, std::uint32_t c, bool above);

    std::span<const PlanePoint> m_points;
    std::vector<glm::uvec3>* m_triangles = nullptr;
    std::vector<Piece> m_pieces;
    std::vector<std::uint32_t> m_free; // pieces that have ended
};

} // namespace zvo
