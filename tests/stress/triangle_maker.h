// SPDX-License-Identifier: MIT
// Makes triangles of one shape; lattice_triangles.h makes batches of them.
#pragma once

#include "stress/lattice_triangles.h"

#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <random>

namespace zvo::stress
{

/// The range of a triangle's points: low to high in lattice units, on all axes.
struct TriangleRoom
{
    int low = 0;
    int high = 0;
};

/// The nearest point whose coordinates single precision holds, in 24 bits each.
glm::ivec3 representable(const glm::ivec3& p);

/// Makes numbers, points and triangles, which are the same for the same seed.
class TriangleMaker
{
public:
    explicit TriangleMaker(std::uint64_t seed) : m_random(seed) {}

    std::uint64_t bits() { return m_random(); }
    int pick(int low, int high) // both included
    {
        const auto count = static_cast<std::uint64_t>(std::int64_t{high} - low + 1);
        return static_cast<int>(low + static_cast<std::int64_t>(m_random() % count));
    }
    bool oneIn(int count) { return pick(1, count) == 1; }
    double fraction() { return static_cast<double>(m_random() >> 11) * 0x1p-53; }
    /// A size between low and high, all octaves being equally likely.
    int pickSize(int low, int high)
    {
        return static_cast<int>(low * std::exp2(fraction() * std::log2(static_cast<double>(high) / low)));
    }
    glm::ivec3 point(int low, int high) { return {pick(low, high), pick(low, high), pick(low, high)}; }

    /// A triangle of a shape in room; some reach beyond the grid. resolution: of the grid.
    LatticeTriangle triangle(Shape shape, const TriangleRoom& room, int resolution);

    /// slim: the triangle covers only a line of voxels.
    LatticeTriangle huge(int resolution, bool slim);

private:
    TriangleRoom cube(const TriangleRoom& room, int size, glm::ivec3& corner);
    LatticeTriangle random(const TriangleRoom& room);
    LatticeTriangle sliver(const TriangleRoom& room);
    LatticeTriangle needle(const TriangleRoom& room);
    LatticeTriangle tiny(const TriangleRoom& room);
    LatticeTriangle aligned(const TriangleRoom& room);
    LatticeTriangle degenerate(const TriangleRoom& room);
    LatticeTriangle border(int resolution);
    LatticeTriangle threshold(const TriangleRoom& room);
    LatticeTriangle shuffled(LatticeTriangle triangle);
    static LatticeTriangle clamped(LatticeTriangle triangle, const TriangleRoom& room);

    std::mt19937_64 m_random;
};

} // namespace zvo::stress
