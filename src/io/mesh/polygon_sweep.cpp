// SPDX-License-Identifier: MIT
#include "io/mesh/polygon_sweep.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

namespace zvo
{

bool PolygonSweep::triangulate(std::span<const PlanePoint> polygon, std::vector<glm::uvec3>& triangles)
{
    m_points = polygon;
    findPlaces();
    const auto count = static_cast<std::uint32_t>(polygon.size());
    m_lines.resize(count);
    for (std::uint32_t i = 0; i < count; ++i)
    {
        m_lines[i] = {i, i + 1 < count ? i + 1 : 0};
    }
    const std::size_t triangle_count = triangles.size();
    const int passes_max = polygon.size() > 4 ? kPassesMax : 1;
    std::size_t crossings_before = SIZE_MAX;
    for (int pass = 0; pass < passes_max; ++pass)
    {
        makeEdges();
        m_pieces.reset(m_points, triangles);
        sweep();
        if (m_crossings.empty())
        {
            return true;
        }
        triangles.resize(triangle_count);
        if (m_crossings.size() >= crossings_before)
        {
            return false;
        }
        crossings_before = m_crossings.size();
        leadThroughCorners();
    }
    return false;
}

void PolygonSweep::findPlaces()
{
    std::vector<std::pair<PlanePoint, std::uint32_t>> corners;
    corners.reserve(m_points.size());
    for (std::size_t i = 0; i < m_points.size(); ++i)
    {
        corners.emplace_back(m_points[i], static_cast<std::uint32_t>(i));
    }
    std::sort(corners.begin(), corners.end());
    m_place_of.resize(m_points.size());
    m_places.clear();
    m_corner_at.clear();
    for (const auto& [point, corner] : corners)
    {
        if (m_places.empty() || m_places.back() != point)
        {
            m_places.push_back(point);
            m_corner_at.push_back(corner);
        }
        m_place_of[corner] = static_cast<std::uint32_t>(m_places.size() - 1);
    }
}

void PolygonSweep::makeEdges()
{
    m_edges.clear();
    m_first_edge.assign(m_places.size(), kNone);
    for (std::size_t i = 0; i < m_lines.size(); ++i)
    {
        const auto [from, to] = m_lines[i];
        addEdge({m_place_of[from], m_place_of[to], from, to, static_cast<std::uint32_t>(i), kNone});
    }
}

void PolygonSweep::addEdge(Edge edge)
{
    if (edge.left == edge.right)
    {
        return;
    }
    if (edge.left > edge.right)
    {
        std::swap(edge.left, edge.right);
        std::swap(edge.left_corner, edge.right_corner);
    }
    edge.next = std::exchange(m_first_edge[edge.left], static_cast<std::uint32_t>(m_edges.size()));
    m_edges.push_back(edge);
}

/// After: M. Shamos, D. Hoey, Geometric Intersection Problems, 1976. Edges in m_status never cross: of two neighbours
/// that do, one is dropped. So their order holds, whatever the polygon.
void PolygonSweep::sweep()
{
    m_status.clear();
    m_crossings.clear();
    for (std::uint32_t place = 0; place < m_places.size(); ++place)
    {
        visit(place);
    }
}

void PolygonSweep::visit(std::uint32_t place)
{
    Status::iterator above = m_status.lower_bound(m_places[place]);
    takeEnds(place, above);
    takeStarts(place);
    const Status::iterator below = above != m_status.begin() ? std::prev(above) : m_status.end();
    dropCrossings(below, above);
    if (m_crossings.empty())
    {
        updateRegions(below != m_status.end() ? &below->second : nullptr);
    }
    for (const ReachedEdge& start : m_starts)
    {
        const Edge& edge = m_edges[start.edge];
        m_status.emplace_hint(above, Segment{m_places[edge.left], m_places[edge.right], start.edge}, start.above);
    }
}

/// Takes the edges through a place out of m_status. above: the first of them, and afterwards that above them. The rest
/// of an edge that goes on behind the place begins anew there.
void PolygonSweep::takeEnds(std::uint32_t place, Status::iterator& above)
{
    m_ends.clear();
    while (above != m_status.end() && turn(above->first.left, above->first.right, m_places[place]) == 0)
    {
        m_ends.push_back({above->first.edge, above->second});
        Edge& edge = m_edges[above->first.edge];
        if (edge.right != place)
        {
            const std::uint32_t corner = m_corner_at[place];
            const Edge rest = {place, edge.right, corner, edge.right_corner, edge.line, kNone};
            edge.right = place;
            edge.right_corner = corner;
            addEdge(rest);
        }
        above = m_status.erase(above);
    }
}

void PolygonSweep::takeStarts(std::uint32_t place)
{
    m_starts.clear();
    for (std::uint32_t edge = m_first_edge[place]; edge != kNone; edge = m_edges[edge].next)
    {
        m_starts.push_back({edge, {}});
    }
    const auto right = [this](const ReachedEdge& start) { return m_edges[start.edge].right; };
    std::sort(m_starts.begin(), m_starts.end(),
              [&](const ReachedEdge& a, const ReachedEdge& b)
              {
                  const int turned = turn(m_places[place], m_places[right(a)], m_places[right(b)]);
                  return turned != 0 ? turned > 0 : right(a) < right(b);
              });
    // Of edges in the same direction, what an even number of them covers is no part of the boundary.
    std::size_t kept = 0;
    for (std::size_t first = 0, end = 0; first < m_starts.size(); first = end)
    {
        for (end = first + 1; end < m_starts.size() && side(m_starts[first].edge, right(m_starts[end])) == 0; ++end)
        {
        }
        if ((end - first) % 2 != 0)
        {
            m_starts[kept++] = m_starts[first++];
        }
        for (; first < end; first += 2)
        {
            const Edge& a = m_edges[m_starts[first].edge];
            const Edge& b = m_edges[m_starts[first + 1].edge];
            addEdge({a.right, b.right, a.right_corner, b.right_corner, b.line, kNone});
        }
    }
    m_starts.resize(kept);
}

/// Drops edges until none of those that become neighbours cross: the edges below and above the place, and m_starts.
void PolygonSweep::dropCrossings(Status::iterator below, Status::iterator& above)
{
    const bool has_below = below != m_status.end();
    auto lowest = m_starts.begin();
    while (has_below && lowest != m_starts.end() && cross(below->first.edge, lowest->edge))
    {
        ++lowest;
    }
    m_starts.erase(m_starts.begin(), lowest);
    while (above != m_status.end() && !m_starts.empty() && cross(m_starts.back().edge, above->first.edge))
    {
        m_starts.pop_back();
    }
    while (has_below && above != m_status.end() && m_starts.empty() && cross(below->first.edge, above->first.edge))
    {
        above = m_status.erase(above);
    }
}

/// below: the region between the edge below the place and the lowest edge that ends or begins there, or else the edge
/// above; null where there is no edge below.
void PolygonSweep::updateRegions(PolygonRegion* below)
{
    const bool inside = below != nullptr && below->inside();
    PolygonRegion highest; // between the highest edge at the place and the edge above
    if (!m_ends.empty())
    {
        for (std::size_t i = 0; i + 1 < m_ends.size(); ++i)
        {
            if (m_ends[i].above.inside())
            {
                m_pieces.end(m_ends[i].above, m_edges[m_ends[i].edge].right_corner);
            }
        }
        if (inside)
        {
            m_pieces.addAbove(*below, m_edges[m_ends.front().edge].right_corner);
        }
        highest = m_ends.back().above;
        if (highest.inside())
        {
            m_pieces.addBelow(highest, m_edges[m_ends.back().edge].right_corner);
        }
        if (inside && m_starts.empty())
        {
            below->upper_piece = highest.piece;
        }
    }
    else if (inside && !m_starts.empty())
    {
        highest = m_pieces.split(*below, m_edges[m_starts.front().edge].left_corner,
                                 m_edges[m_starts.back().edge].left_corner);
    }
    for (std::size_t i = 0; i < m_starts.size(); ++i)
    {
        const bool begins = inside == (i % 2 != 0);
        m_starts[i].above = i + 1 == m_starts.size() ? highest
                            : begins                 ? m_pieces.begin(m_edges[m_starts[i].edge].left_corner)
                                                     : PolygonRegion{};
    }
}

/// Whether two edges cross. If so, m_crossings receives the end that is nearest to the other edge.
bool PolygonSweep::cross(std::uint32_t a, std::uint32_t b)
{
    const Edge& first = m_edges[a];
    const Edge& second = m_edges[b];
    if (side(a, second.left) * side(a, second.right) >= 0 || side(b, first.left) * side(b, first.right) >= 0)
    {
        return false;
    }
    double smallest = INFINITY;
    Crossing nearest;
    const auto consider = [&](const Edge& edge, std::uint32_t corner)
    {
        const PlanePoint& left = m_places[edge.left];
        const PlanePoint& right = m_places[edge.right];
        const double length = std::hypot(static_cast<double>(right.x - left.x), static_cast<double>(right.y - left.y));
        const double distance = std::abs(doubleArea(left, right, m_points[corner])) / length;
        if (distance < smallest)
        {
            smallest = distance;
            nearest = {edge.line, corner};
        }
    };
    consider(first, second.left_corner);
    consider(first, second.right_corner);
    consider(second, first.left_corner);
    consider(second, first.right_corner);
    m_crossings.push_back(nearest);
    return true;
}

/// Leads lines through corners, each through one. Others may come in the next sweep.
void PolygonSweep::leadThroughCorners()
{
    std::sort(m_crossings.begin(), m_crossings.end(),
              [](const Crossing& a, const Crossing& b)
              { return a.line != b.line ? a.line < b.line : a.through < b.through; });
    std::uint32_t previous = kNone;
    for (const Crossing& crossing : m_crossings)
    {
        if (crossing.line != previous)
        {
            Line& line = m_lines[crossing.line];
            const Line rest = {crossing.through, line.to};
            line.to = crossing.through;
            m_lines.push_back(rest);
        }
        previous = crossing.line;
    }
}

/// 1 where the place lies above the edge, -1 where it lies below, 0 where it lies on the line of the edge.
int PolygonSweep::side(std::uint32_t edge, std::uint32_t place) const
{
    return turn(m_places[m_edges[edge].left], m_places[m_edges[edge].right], m_places[place]);
}

bool PolygonSweep::Below::operator()(const Segment& a, const Segment& b) const
{
    if (b.left > a.left)
    {
        return turn(a.left, a.right, b.left) > 0;
    }
    const int begins = turn(b.left, b.right, a.left);
    return begins != 0 ? begins < 0 : turn(b.left, b.right, a.right) < 0;
}

} // namespace zvo
