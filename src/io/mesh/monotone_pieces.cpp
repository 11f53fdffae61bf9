// SPDX-License-Identifier: MIT
#include "io/mesh/monotone_pieces.h"

#include <utility>

namespace zvo
{

void MonotonePieces::reset(std::span<const PlanePoint> points, std::vector<glm::uvec3>& triangles)
{
    m_points = points;
    m_triangles = &triangles;
    m_free.clear();
    for (std::size_t i = m_pieces.size(); i > 0; --i)
    {
        m_free.push_back(static_cast<std::uint32_t>(i - 1));
    }
}

PolygonRegion MonotonePieces::begin(std::uint32_t corner)
{
    return {newPiece(corner), PolygonRegion::kNone};
}

void MonotonePieces::addBelow(PolygonRegion& region, std::uint32_t corner)
{
    if (region.upper_piece != PolygonRegion::kNone)
    {
        endPiece(region.piece, corner);
        region = {region.upper_piece, PolygonRegion::kNone};
    }
    add(m_pieces[region.piece], corner, false);
}

void MonotonePieces::addAbove(PolygonRegion& region, std::uint32_t corner)
{
    if (region.upper_piece != PolygonRegion::kNone)
    {
        endPiece(region.upper_piece, corner);
        region.upper_piece = PolygonRegion::kNone;
    }
    add(m_pieces[region.piece], corner, true);
}

PolygonRegion MonotonePieces::split(PolygonRegion& region, std::uint32_t lower_corner, std::uint32_t upper_corner)
{
    std::uint32_t upper_piece = region.upper_piece;
    if (upper_piece == PolygonRegion::kNone)
    {
        // The diagonal goes to the last corner, from which the point is visible: no corner of the region lies between.
        const std::uint32_t last = m_pieces[region.piece].corners.back();
        upper_piece = newPiece(last);
        if (!m_pieces[region.piece].above)
        {
            std::swap(region.piece, upper_piece); // what has grown so far lies above the diagonal
        }
    }
    region.upper_piece = PolygonRegion::kNone;
    add(m_pieces[region.piece], lower_corner, true);
    add(m_pieces[upper_piece], upper_corner, false);
    return {upper_piece, PolygonRegion::kNone};
}

void MonotonePieces::end(const PolygonRegion& region, std::uint32_t corner)
{
    endPiece(region.piece, corner);
    if (region.upper_piece != PolygonRegion::kNone)
    {
        endPiece(region.upper_piece, corner);
    }
}

std::uint32_t MonotonePieces::newPiece(std::uint32_t corner)
{
    if (m_free.empty())
    {
        m_free.push_back(static_cast<std::uint32_t>(m_pieces.size()));
        m_pieces.emplace_back();
    }
    const std::uint32_t index = m_free.back();
    m_free.pop_back();
    m_pieces[index].corners.assign(1, corner);
    m_pieces[index].above = false;
    return index;
}

void MonotonePieces::add(Piece& piece, std::uint32_t corner, bool above)
{
    std::vector<std::uint32_t>& corners = piece.corners;
    if (corners.size() > 1 && piece.above != above)
    {
        const std::uint32_t last = corners.back();
        fan(piece, corner);
        corners.assign(1, last);
    }
    else
    {
        const int wanted = above ? -1 : 1;
        while (corners.size() > 1 &&
               turn(m_points[corners[corners.size() - 2]], m_points[corners.back()], m_points[corner]) == wanted)
        {
            addTriangle(corners[corners.size() - 2], corners.back(), corner, above);
            corners.pop_back();
        }
    }
    corners.push_back(corner);
    piece.above = above;
}

/// All of the piece's corners are visible from this one.
void MonotonePieces::fan(Piece& piece, std::uint32_t corner)
{
    for (std::size_t i = 1; i < piece.corners.size(); ++i)
    {
        addTriangle(piece.corners[i - 1], piece.corners[i], corner, piece.above);
    }
}

void MonotonePieces::endPiece(std::uint32_t index, std::uint32_t corner)
{
    fan(m_pieces[index], corner);
    m_free.push_back(index);
}

/// a, b: corners of one edge from left to right.
void MonotonePieces::addTriangle(std::uint32_t a, std::uint32_t b, std::uint32_t c, bool above)
{
    m_triangles->emplace_back(above ? b : a, above ? a : b, c);
}

} // namespace zvo
