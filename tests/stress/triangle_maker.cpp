// SPDX-License-Identifier: MIT
#include "stress/triangle_maker.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace zvo::stress
{

namespace
{

constexpr int kLatticeMax = 1 << 29;

} // namespace

glm::ivec3 representable(const glm::ivec3& p)
{
    return glm::ivec3(glm::vec3(p));
}

LatticeTriangle TriangleMaker::triangle(Shape shape, const TriangleRoom& room, int resolution)
{
    switch (shape)
    {
    case Shape::Random:
        return random(room);
    case Shape::Sliver:
        return sliver(room);
    case Shape::Needle:
        return needle(room);
    case Shape::Tiny:
        return tiny(room);
    case Shape::Aligned:
        return aligned(room);
    case Shape::Degenerate:
        return degenerate(room);
    case Shape::Border:
        return border(resolution);
    case Shape::Huge:
        return huge(resolution, false);
    case Shape::Threshold:
        return threshold(room);
    }
    return {};
}

// slim: the triangle covers only a line of voxels.
LatticeTriangle TriangleMaker::huge(int resolution, bool slim)
{
    // A point of the grid in the triangle.
    const glm::dvec3 inside = glm::dvec3(point(0, resolution * 256));
    const double reach = std::exp2(14 + 14.5 * fraction());
    const auto direction = [&](double size)
    { return glm::dvec3(2 * fraction() - 1, 2 * fraction() - 1, 2 * fraction() - 1) * size; };
    glm::dvec3 a = direction(reach);
    glm::dvec3 b = slim ? a * (0.5 + fraction()) : direction(oneIn(3) ? std::exp2(14 + 14.5 * fraction()) : reach);
    if (slim)
        b = (oneIn(2) ? b : -b) + direction(std::exp2(1 + 8 * fraction()));
    const int axis = pick(0, 2);
    if (!slim && oneIn(4)) // almost or exactly parallel to an axis' planes
    {
        a[axis] = oneIn(2) ? 0 : a[axis] * 1e-6;
        b[axis] = oneIn(2) ? 0 : b[axis] * 1e-6;
    }
    LatticeTriangle triangle{};
    const glm::dvec3 corners[3] = {inside + a, inside + b, inside - (a + b) * fraction()};
    constexpr double kEnd = kLatticeMax;
    for (std::size_t i = 0; i < 3; ++i)
        triangle[i] = representable(glm::ivec3(glm::clamp(glm::round(corners[i]), -kEnd, kEnd)));
    if (!slim && oneIn(8))
        triangle[0][axis] = oneIn(2) ? kLatticeMax : -kLatticeMax;
    return triangle;
}

// A cube of this size or less within room.
TriangleRoom TriangleMaker::cube(const TriangleRoom& room, int size, glm::ivec3& corner)
{
    const int edge = std::min(size, room.high - room.low);
    corner = point(room.low, room.high - edge);
    return {0, edge};
}

LatticeTriangle TriangleMaker::random(const TriangleRoom& room)
{
    glm::ivec3 corner{};
    const TriangleRoom local = cube(room, pickSize(16, room.high - room.low), corner);
    LatticeTriangle triangle{};
    for (glm::ivec3& p : triangle)
        p = corner + point(local.low, local.high);
    if (oneIn(8)) // flat
    {
        const int axis = pick(0, 2);
        for (glm::ivec3& p : triangle)
            p[axis] = triangle[0][axis];
    }
    return clamped(triangle, room);
}

LatticeTriangle TriangleMaker::sliver(const TriangleRoom& room)
{
    LatticeTriangle triangle = random(room);
    const glm::dvec3 along = glm::dvec3(triangle[1] - triangle[0]) * (1.2 * fraction() - 0.1);
    const int width = pick(0, 4);
    triangle[2] = triangle[0] + glm::ivec3(glm::round(along)) + point(-width, width);
    return shuffled(clamped(triangle, room));
}

LatticeTriangle TriangleMaker::needle(const TriangleRoom& room)
{
    LatticeTriangle triangle = random(room);
    const int width = pick(1, 6);
    triangle[2] = triangle[1] + point(-width, width);
    if (oneIn(4)) // along an axis
    {
        const int axis = pick(0, 2);
        for (int k = 0; k < 3; ++k)
            if (k != axis)
                triangle[0][k] = triangle[1][k] + pick(-1, 1);
    }
    return shuffled(clamped(triangle, room));
}

LatticeTriangle TriangleMaker::tiny(const TriangleRoom& room)
{
    // Corners, middles of edges and faces, centres, and points of the diamonds between them.
    const int step = oneIn(3) ? 64 : 128;
    const glm::ivec3 place = point(room.low / step, room.high / step) * step;
    const int size = pickSize(1, 400);
    LatticeTriangle triangle{};
    for (glm::ivec3& p : triangle)
        p = place + point(-size, size);
    if (oneIn(3))
        triangle[0] = place;
    if (oneIn(3)) // parallel to a plane, its edges at 45 degrees
    {
        const int axis = pick(0, 2);
        const int u = (axis + 1) % 3;
        const int v = (axis + 2) % 3;
        triangle[1] = triangle[2] = triangle[0];
        triangle[1][u] += size;
        triangle[2][v] += oneIn(2) ? size : -size;
        if (oneIn(2))
            triangle[2][axis] += pick(-1, 1);
    }
    return clamped(triangle, room);
}

LatticeTriangle TriangleMaker::aligned(const TriangleRoom& room)
{
    const int step = 256 >> pick(0, 3);
    const int reach = std::max(1, pickSize(1, (room.high - room.low) / step + 1));
    const glm::ivec3 center = point(room.low / step, room.high / step);
    LatticeTriangle triangle{};
    for (glm::ivec3& p : triangle)
        p = (center + point(-reach, reach)) * step;
    const int axis = pick(0, 2);
    const int u = (axis + 1) % 3;
    const int v = (axis + 2) % 3;
    switch (pick(0, 4))
    {
    case 0: // in a plane of the lattice, perhaps a unit beside it
        for (glm::ivec3& p : triangle)
            p[axis] = triangle[0][axis];
        if (oneIn(3))
            for (glm::ivec3& p : triangle)
                p[axis] += pick(0, 2) - 1;
        break;
    case 1: // at 45 degrees: two components of the normal are equal
        for (glm::ivec3& p : triangle)
            p[u] = triangle[0][u] + (p[v] - triangle[0][v]);
        break;
    case 2: // all three components are equal
        for (glm::ivec3& p : triangle)
            p[axis] = triangle[0][axis] - (p[u] - triangle[0][u]) + (triangle[0][v] - p[v]);
        break;
    case 3: // edges along diagonals of voxels
        for (std::size_t i = 1; i < 3; ++i)
            for (int k = 0; k < 3; ++k)
                triangle[i][k] = triangle[0][k] + (pick(0, 2) - 1) * reach * step;
        break;
    default:
        break;
    }
    return clamped(triangle, room);
}

LatticeTriangle TriangleMaker::degenerate(const TriangleRoom& room)
{
    const int step = oneIn(2) ? 1 : 64 << pick(0, 2);
    const glm::ivec3 start = point(room.low / step, room.high / step) * step;
    const int size = pickSize(1, std::max(2, (room.high - room.low) / (8 * step)));
    glm::ivec3 along = point(-size, size) * step;
    if (oneIn(3)) // along an axis or a diagonal
        along = point(-1, 1) * size * step;
    if (oneIn(5))
        along = glm::ivec3(0);
    LatticeTriangle triangle = {start, start + along * pick(-4, 4), start + along * pick(-4, 4)};
    for (int k = 0; k < 3; ++k) // moved as a whole, because clamping would deform it
    {
        const auto [low, high] = std::minmax({triangle[0][k], triangle[1][k], triangle[2][k]});
        const int move = low < room.low ? room.low - low : std::min(0, room.high - high);
        for (glm::ivec3& p : triangle)
            p[k] += move;
    }
    return clamped(triangle, room);
}

LatticeTriangle TriangleMaker::border(int resolution)
{
    const int end = resolution * 256;
    const auto coordinate = [&]
    {
        switch (pick(0, 5))
        {
        case 0:
            return pick(-2, 2);
        case 1:
            return end + pick(-2, 2);
        case 2:
            return pick(-end, 2 * end);
        case 3:
            return pick(-1, resolution + 1) * 256 + pick(-1, 1);
        default:
            return pick(0, end);
        }
    };
    LatticeTriangle triangle{};
    for (glm::ivec3& p : triangle)
        p = {coordinate(), coordinate(), coordinate()};
    const int axis = pick(0, 2);
    if (oneIn(3)) // in one of the grid's faces, or beside it
    {
        const int face = (oneIn(2) ? 0 : end) + (oneIn(2) ? 0 : pick(-1, 1));
        for (glm::ivec3& p : triangle)
            p[axis] = face;
    }
    if (oneIn(6)) // a slope that meets a face at a column's centre
        triangle[0][axis] = end - 64 * pick(0, 8);
    return triangle;
}

// A triangle whose box touches columns x rows voxels across its major axis.
LatticeTriangle TriangleMaker::threshold(const TriangleRoom& room)
{
    static constexpr std::array<glm::ivec2, 18> kExtents{{{31, 1},
                                                          {32, 1},
                                                          {33, 1},
                                                          {16, 2},
                                                          {8, 4},
                                                          {11, 3},
                                                          {6, 5},
                                                          {7, 5},
                                                          {32, 7},
                                                          {33, 8},
                                                          {34, 9},
                                                          {255, 8},
                                                          {256, 7},
                                                          {257, 9},
                                                          {256, 16},
                                                          {258, 17},
                                                          {300, 1},
                                                          {64, 24}}};
    const int cells = (room.high - room.low) / 256;
    glm::ivec2 extent = kExtents[static_cast<std::size_t>(pick(0, kExtents.size() - 1))];
    while (std::max(extent.x, extent.y) > cells)
        extent = kExtents[static_cast<std::size_t>(pick(0, 9))];
    if (oneIn(2))
        std::swap(extent.x, extent.y);
    const auto size = [&](int columns) { return std::max(1, (columns - 1) * 256 + pick(-254, 254)); };
    glm::ivec2 edge = {size(extent.x), size(extent.y)};
    if (oneIn(3)) // at the limits of 32-bit arithmetic
        edge[pick(0, 1)] = std::min(8192 + pick(-1, 1), cells * 256);
    const int height = pick(0, std::min(edge.x, edge.y));
    const int axis = pick(0, 2);
    const int u = (axis + 1) % 3;
    const int v = (axis + 2) % 3;
    glm::ivec3 corner{};
    corner[u] = pick(room.low, std::max(room.low, room.high - edge.x));
    corner[v] = pick(room.low, std::max(room.low, room.high - edge.y));
    corner[axis] = pick(room.low, std::max(room.low, room.high - height));
    LatticeTriangle triangle = {corner, corner, corner};
    triangle[1][u] += edge.x;
    triangle[1][axis] += pick(0, height);
    triangle[2][v] += edge.y;
    triangle[2][u] += pick(0, edge.x);
    triangle[2][axis] += height;
    if (oneIn(3))
        triangle[1][v] += edge.y;
    return shuffled(clamped(triangle, room));
}

LatticeTriangle TriangleMaker::shuffled(LatticeTriangle triangle)
{
    std::swap(triangle[0], triangle[static_cast<std::size_t>(pick(0, 2))]);
    return triangle;
}

LatticeTriangle TriangleMaker::clamped(LatticeTriangle triangle, const TriangleRoom& room)
{
    for (glm::ivec3& p : triangle)
        p = glm::clamp(p, glm::ivec3(room.low), glm::ivec3(room.high));
    return triangle;
}

} // namespace zvo::stress
