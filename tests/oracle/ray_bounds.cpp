// SPDX-License-Identifier: MIT
// Computes in double precision. Its own roundings are 2^-29 of those of single precision; kSlack covers them.
#include "oracle/ray_bounds.h"

#include "oracle/morton.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace zvo::oracle
{
namespace
{

constexpr double kRounding = 0x1p-24; // of single precision, relative
constexpr double kSlack = 1.0 + 0x1p-18;
constexpr double kOverflow = 1e38; // from here on, times in single precision may be infinite

/// The times between which a line is inside a box; empty if first > last.
struct Interval
{
    double first;
    double last;
};

/// A ray in double precision, with the distances by which rounding may move planes, for each axis.
struct Line
{
    glm::dvec3 origin;
    glm::dvec3 direction; // as oracle::makeRay() clamps it, without zeros
    glm::dvec3 delta;
    double t_min;

    explicit Line(const Ray& ray) : origin(ray.origin), direction(ray.direction), delta(0.0), t_min(ray.t_min)
    {
        for (int axis = 0; axis < 3; ++axis)
        {
            const double o = origin[axis];
            const double farthest = std::max(std::fabs(1.0 - o), std::fabs(2.0 - o));
            delta[axis] = kSlack * kRounding * (4.0 * farthest + std::fabs(3.0 - o));
        }
    }

    /// The times between which the line lies between low and low + edge on all axes, with each plane moved outwards by
    /// grow * delta.
    [[nodiscard]] Interval inside(const glm::dvec3& low, double edge, double grow) const
    {
        Interval interval{-INFINITY, INFINITY};
        for (int axis = 0; axis < 3; ++axis)
        {
            const bool down = direction[axis] < 0.0;
            const double enter = down ? low[axis] + edge + grow * delta[axis] : low[axis] - grow * delta[axis];
            const double leave = down ? low[axis] - grow * delta[axis] : low[axis] + edge + grow * delta[axis];
            interval.first = std::max(interval.first, (enter - origin[axis]) / direction[axis]);
            interval.last = std::min(interval.last, (leave - origin[axis]) / direction[axis]);
        }
        return interval;
    }
};

bool isFiniteRay(const Ray& ray)
{
    for (int axis = 0; axis < 3; ++axis)
        if (!std::isfinite(ray.origin[axis]) || !std::isfinite(ray.direction[axis]) || !std::isfinite(ray.inv[axis]))
            return false;
    return std::isfinite(ray.t_min);
}

/// The state of one classification.
struct Search
{
    const BitPyramid& pyramid;
    Line line;
    double t_max;
    double voxel;
    std::array<int, 8> order{}; // octants, near ones first
    bool may = false;
    double latest = INFINITY;

    Search(const BitPyramid& searched, const Ray& ray, double end)
        : pyramid(searched), line(ray), t_max(end), voxel(1.0 / rootResolution(searched.depth()))
    {
        int nearest = 0;
        for (int axis = 0; axis < 3; ++axis)
            nearest |= line.direction[axis] < 0.0 ? 1 << axis : 0;
        for (int i = 0; i < 8; ++i)
            order[static_cast<std::size_t>(i)] = i ^ nearest;
    }

    void visit(std::uint32_t level, const glm::uvec3& cell)
    {
        const double edge = voxel * static_cast<double>(1U << (pyramid.depth() - level));
        const glm::dvec3 low = 1.0 + glm::dvec3(cell) * edge;
        const Interval grown = line.inside(low, edge, 1.0);
        if (!(std::max(grown.first, line.t_min) <= std::min(grown.last, t_max * kSlack)) || grown.first > latest)
            return;
        if (level < pyramid.depth())
        {
            for (const int octant : order)
            {
                const glm::uvec3 child = 2U * cell + glm::uvec3(octant & 1, octant >> 1 & 1, octant >> 2);
                if (pyramid.isSet(level + 1, child))
                    visit(level + 1, child);
            }
            return;
        }
        may = true;
        const Interval shrunk = line.inside(low, edge, -1.0);
        const double start = std::max(shrunk.first, line.t_min);
        if (start < shrunk.last && start < t_max / kSlack && start < kOverflow)
            latest = std::min(latest, start);
    }
};

} // namespace

BitPyramid::BitPyramid(std::span<const std::uint64_t> codes, std::uint32_t depth) : m_depth(depth)
{
    assert(depth <= kDepthMax);
    for (std::uint32_t level = 0; level <= depth; ++level)
    {
        m_bits[level].resize(((std::uint64_t{1} << (3 * level)) + 63) / 64);
        for (const std::uint64_t code : codes)
        {
            const glm::u64vec3 cell(mortonDecode(code >> (3 * (depth - level))));
            const std::uint64_t bit = cell.x | cell.y << level | cell.z << (2 * level);
            m_bits[level][bit / 64] |= std::uint64_t{1} << (bit % 64);
        }
    }
}

bool BitPyramid::isSet(std::uint32_t level, const glm::uvec3& cell) const
{
    const std::uint32_t edge = 1U << level;
    if (cell.x >= edge || cell.y >= edge || cell.z >= edge)
        return false;
    const std::uint64_t bit = cell.x | std::uint64_t{cell.y} << level | std::uint64_t{cell.z} << (2 * level);
    return (m_bits[level][bit / 64] >> (bit % 64) & 1) != 0;
}

RayBounds BitPyramid::classify(const Ray& ray, double t_max) const
{
    if (!isFiniteRay(ray) || !isSet(0, glm::uvec3(0U)))
        return {};
    Search search(*this, ray, t_max);
    search.visit(0, glm::uvec3(0U));
    if (search.latest < INFINITY)
        return {RayClass::MustHit, search.latest};
    return {search.may ? RayClass::MayHit : RayClass::MustMiss, 0.0};
}

std::optional<std::string> BitPyramid::objection(const Ray& ray, double t_max, const glm::uvec3& voxel, float t) const
{
    if (!isFiniteRay(ray))
        return "a ray with numbers that are not finite";
    if (!isSet(m_depth, voxel))
        return "the voxel is empty";
    const double time = t;
    if (!(time >= static_cast<double>(ray.t_min) && time <= t_max))
        return "before the start or after the end";
    const Line line(ray);
    const double edge = 1.0 / rootResolution(m_depth);
    const glm::dvec3 low = 1.0 + glm::dvec3(voxel) * edge;
    const Interval grown = line.inside(low, edge, 1.0);
    if (!(std::max(grown.first, line.t_min) <= grown.last))
        return "the line does not touch the voxel";
    const double latest = std::max(line.inside(low, edge, -1.0).first, line.t_min);
    const double earliest = std::max(grown.first, line.t_min);
    // Times below the smallest normal number count as that one.
    if (time < earliest - kSlack * 0x1p-126 || time > latest + kSlack * 0x1p-126)
        return "the line enters the voxel at another time";
    return std::nullopt;
}

} // namespace zvo::oracle
