// SPDX-License-Identifier: MIT
#include "oracle/coverage.h"

#include <algorithm>

namespace zvo::oracle
{
namespace
{

struct Interval
{
    Int128 low;
    Int128 high;
};

Interval project(const Triangle& triangle, const Vec& axis)
{
    const Int128 p[3] = {dot(axis, triangle[0]), dot(axis, triangle[1]), dot(axis, triangle[2])};
    return {std::min({p[0], p[1], p[2]}), std::max({p[0], p[1], p[2]})};
}

Interval project(const Box& box, const Vec& axis)
{
    Interval interval{0, 0};
    for (std::size_t i = 0; i < 3; ++i)
    {
        interval.low += axis[i] * (axis[i] < 0 ? box.high[i] : box.low[i]);
        interval.high += axis[i] * (axis[i] < 0 ? box.low[i] : box.high[i]);
    }
    return interval;
}

bool separates(const Vec& axis, const Triangle& triangle, const Box& box)
{
    const Interval a = project(triangle, axis);
    const Interval b = project(box, axis);
    return a.high < b.low || b.high < a.low;
}

constexpr Int128 kOne = 1;
constexpr std::array<Vec, 3> kUnit{Vec{kOne, 0, 0}, Vec{0, kOne, 0}, Vec{0, 0, kOne}};

/// Whether the height of the triangle's plane, at the centre of the voxel's column along w, lies in the voxel.
bool planeInVoxel(const Triangle& triangle, const Vec& normal, const glm::uvec3& voxel, std::uint32_t resolution,
                  const ThinRule& rule)
{
    const std::size_t w = majorAxis(normal, rule.tie_order);
    const std::size_t u = (w + 1) % 3;
    const std::size_t v = (w + 2) % 3;
    const Vec center = voxelBox(voxel, voxel).low - Vec{-128, -128, -128};

    // normal . (P - V0) = 0 with P = (center_u, center_v, height); height = V0_w + numerator / |normal_w|.
    const Int128 rise = -(normal[u] * (center[u] - triangle[0][u]) + normal[v] * (center[v] - triangle[0][v]));
    const Int128 numerator = normal[w] < 0 ? -rise : rise;
    const Int128 denominator = absolute(normal[w]);
    const Int128 layer = voxel[static_cast<int>(w)];
    const Int128 low = (layer * kLatticeVoxel - triangle[0][w]) * denominator;
    const Int128 high = ((layer + 1) * kLatticeVoxel - triangle[0][w]) * denominator;

    const bool level = normal[u] == 0 && normal[v] == 0;
    if (level && rule.border_below[w] && triangle[0][w] == 0)
        return layer == 0;
    if (level && !rule.border_below[w] && triangle[0][w] == Int128{resolution} * kLatticeVoxel)
        return layer == Int128{resolution} - 1;
    return rule.border_below[w] ? low < numerator && numerator <= high : low <= numerator && numerator < high;
}

/// Whether the voxel's diamond in the plane (a, b) reaches the inner side of all three edges.
bool diamondInsideEdges(const Triangle& triangle, const Vec& normal, const Vec& center, std::size_t a)
{
    const std::size_t b = (a + 1) % 3;
    const std::size_t c = (a + 2) % 3;
    const Int128 sign = normal[c] < 0 ? -1 : 1;
    for (std::size_t i = 0; i < 3; ++i)
    {
        const Vec& from = triangle[i];
        const Vec edge = triangle[(i + 1) % 3] - from;
        const Int128 m_a = -sign * edge[b];
        const Int128 m_b = sign * edge[a];
        const Int128 reach = 128 * std::max(absolute(edge[a]), absolute(edge[b]));
        if (m_a * (center[a] - from[a]) + m_b * (center[b] - from[b]) + reach < 0)
            return false;
    }
    return true;
}

/// A box of voxels.
struct VoxelRange
{
    glm::uvec3 first;
    glm::uvec3 last;
};

/// overlaps() for many boxes of voxels; what depends on the triangle alone is computed once. Int may have 64 bits if
/// isModest(). The boxes must touch the triangle's box.
template <typename Int> class OverlapTest
{
public:
    explicit OverlapTest(const Triangle& triangle)
    {
        for (std::size_t i = 0; i < 3; ++i)
            m_origin[i] = static_cast<Int>(triangle[0][i]);
        for (const Vec& unit : kUnit)
            add(unit, triangle);
        add(normalOf(triangle), triangle);
        for (std::size_t i = 0; i < 3; ++i)
            for (const Vec& unit : kUnit)
                add(cross(triangle[(i + 1) % 3] - triangle[i], unit), triangle);
    }

    [[nodiscard]] bool overlaps(const VoxelRange& box) const
    {
        // Twice the box's middle, and its size.
        std::array<Int, 3> middle;
        std::array<Int, 3> size;
        for (std::size_t i = 0; i < 3; ++i)
        {
            const Int first = box.first[static_cast<int>(i)];
            const Int last = box.last[static_cast<int>(i)];
            middle[i] = (first + last + 1) * kLatticeVoxel - 2 * m_origin[i];
            size[i] = (last - first + 1) * kLatticeVoxel;
        }
        for (const Axis& axis : m_axes)
        {
            const Int at = axis.x * middle[0] + axis.y * middle[1] + axis.z * middle[2];
            const Int reach = axis.size_x * size[0] + axis.size_y * size[1] + axis.size_z * size[2];
            if (axis.high < at - reach || at + reach < axis.low)
                return false;
        }
        return true;
    }

private:
    struct Axis
    {
        Int x, y, z;
        Int size_x, size_y, size_z; // absolute values
        Int low, high;              // twice the triangle's interval, relative to its first corner
    };

    void add(const Vec& direction, const Triangle& triangle)
    {
        const Interval interval = project(triangle, direction);
        const Int128 origin = dot(direction, triangle[0]);
        m_axes[m_count++] = {static_cast<Int>(direction[0]),
                             static_cast<Int>(direction[1]),
                             static_cast<Int>(direction[2]),
                             static_cast<Int>(absolute(direction[0])),
                             static_cast<Int>(absolute(direction[1])),
                             static_cast<Int>(absolute(direction[2])),
                             static_cast<Int>(2 * (interval.low - origin)),
                             static_cast<Int>(2 * (interval.high - origin))};
    }

    std::array<Axis, 13> m_axes{};
    std::size_t m_count = 0;
    std::array<Int, 3> m_origin{};
};

/// Whether 64 bits hold all that OverlapTest computes: three terms of the normal, below 2^38, times twice the distance
/// of a voxel, below 2^20; and the same with the box's size.
bool isModest(const Triangle& triangle)
{
    for (const Vec& unit : kUnit)
    {
        const Interval range = project(triangle, unit);
        if (range.high - range.low > (1 << 18))
            return false;
    }
    return true;
}

template <typename Int> struct Walk
{
    const Triangle& triangle;
    const OverlapTest<Int>& test;
    std::uint32_t resolution;
    Coverage coverage;
    const ThinRule& rule;
    const std::function<void(const glm::uvec3&)>& visit;
};

/// Visits the covered voxels of a box, which is halved until the triangle misses it or it is one voxel.
template <typename Int> void subdivide(const Walk<Int>& walk, const VoxelRange& box)
{
    if (!walk.test.overlaps(box)) // thin coverage is a subset, as a test checks
        return;
    const auto& [first, last] = box;
    const glm::uvec3 extent = last - first;
    if (extent == glm::uvec3{0U})
    {
        if (walk.coverage == Coverage::Conservative || coversThin(walk.triangle, first, walk.resolution, walk.rule))
            walk.visit(first);
        return;
    }
    const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2;
    VoxelRange lower = box;
    VoxelRange upper = box;
    lower.last[axis] = first[axis] + extent[axis] / 2;
    upper.first[axis] = lower.last[axis] + 1;
    subdivide(walk, lower);
    subdivide(walk, upper);
}

} // namespace

Vec normalOf(const Triangle& triangle)
{
    return cross(triangle[1] - triangle[0], triangle[2] - triangle[0]);
}

std::uint32_t majorAxis(const Vec& normal, const std::array<std::uint32_t, 3>& tie_order)
{
    std::uint32_t axis = tie_order[0];
    for (const std::uint32_t i : {tie_order[1], tie_order[2]})
        if (absolute(normal[i]) > absolute(normal[axis]))
            axis = i;
    return axis;
}

bool overlaps(const Triangle& triangle, const Box& box)
{
    for (const Vec& unit : kUnit)
        if (separates(unit, triangle, box))
            return false;
    if (separates(normalOf(triangle), triangle, box))
        return false;
    for (std::size_t i = 0; i < 3; ++i)
        for (const Vec& unit : kUnit)
            if (separates(cross(triangle[(i + 1) % 3] - triangle[i], unit), triangle, box))
                return false;
    return true;
}

bool coversThin(const Triangle& triangle, const glm::uvec3& voxel, std::uint32_t resolution, const ThinRule& rule)
{
    const Vec normal = normalOf(triangle);
    if (normal == Vec{0, 0, 0})
        return false;
    const Box box = voxelBox(voxel, voxel);
    const Vec center = box.low - Vec{-128, -128, -128};
    for (const Vec& unit : kUnit)
        if (separates(unit, triangle, box))
            return false;
    if (!planeInVoxel(triangle, normal, voxel, resolution, rule))
        return false;
    for (std::size_t a = 0; a < 3; ++a)
        if (!diamondInsideEdges(triangle, normal, center, a))
            return false;
    return true;
}

Box voxelBox(const glm::uvec3& first, const glm::uvec3& last)
{
    Box box{};
    for (std::size_t i = 0; i < 3; ++i)
    {
        box.low[i] = Int128{first[static_cast<int>(i)]} * kLatticeVoxel;
        box.high[i] = (Int128{last[static_cast<int>(i)]} + 1) * kLatticeVoxel;
    }
    return box;
}

void forEachCoveredVoxel(const Triangle& triangle, std::uint32_t resolution, Coverage coverage,
                         const std::function<void(const glm::uvec3&)>& visit, const ThinRule& rule)
{
    glm::uvec3 first{};
    glm::uvec3 last{};
    for (std::size_t i = 0; i < 3; ++i)
    {
        // Voxels are closed: one that ends where the triangle begins is a candidate, too.
        const Interval range = project(triangle, kUnit[i]);
        const Int128 low = floorDivide(range.low - 1, kLatticeVoxel);
        const Int128 high = floorDivide(range.high, kLatticeVoxel);
        if (high < 0 || low >= resolution)
            return;
        first[static_cast<int>(i)] = static_cast<std::uint32_t>(std::max(low, Int128{0}));
        last[static_cast<int>(i)] = static_cast<std::uint32_t>(std::min(high, Int128{resolution} - 1));
    }
    if (isModest(triangle))
        subdivide<std::int64_t>({triangle, OverlapTest<std::int64_t>(triangle), resolution, coverage, rule, visit},
                                {first, last});
    else
        subdivide<Int128>({triangle, OverlapTest<Int128>(triangle), resolution, coverage, rule, visit}, {first, last});
}

} // namespace zvo::oracle
