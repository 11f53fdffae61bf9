// SPDX-License-Identifier: MIT
// Needs -ffp-contract=off.
#include "oracle/trace.h"

#include "oracle/morton.h"

#include <algorithm>
#include <cmath>

namespace zvo::oracle
{
namespace
{

constexpr float kDirectionMin = 1e-20F;
constexpr int kAxes = 3;

struct Event
{
    float t;
    std::uint32_t axis;

    friend bool operator<(const Event& a, const Event& b) { return a.t < b.t || (a.t == b.t && a.axis < b.axis); }
};

float clampedDirection(float d)
{
    return std::fabs(d) < kDirectionMin ? std::copysign(kDirectionMin, d) : d;
}

bool isFinite(const glm::vec3& v)
{
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

bool isFinite(const Ray& ray)
{
    return isFinite(ray.origin) && isFinite(ray.direction) && isFinite(ray.inv) && std::isfinite(ray.t_min);
}

bool isMirrored(const Ray& ray, int axis)
{
    return clampedDirection(ray.direction[axis]) < 0.0F;
}

float mirroredOrigin(const Ray& ray, int axis)
{
    return isMirrored(ray, axis) ? 3.0F - ray.origin[axis] : ray.origin[axis];
}

float mirroredInverse(const Ray& ray, int axis)
{
    return isMirrored(ray, axis) ? -ray.inv[axis] : ray.inv[axis];
}

Event crossing(const Ray& ray, std::uint32_t plane, std::uint32_t resolution, int axis)
{
    const float position = 1.0F + static_cast<float>(plane) / static_cast<float>(resolution);
    const float distance = position - mirroredOrigin(ray, axis);
    const float t = distance * mirroredInverse(ray, axis);
    return {t, static_cast<std::uint32_t>(axis)};
}

Event eventOf(const Hit& hit)
{
    return {hit.t, hit.face};
}

} // namespace

Ray makeRay(const glm::vec3& origin, const glm::vec3& direction, float t_min)
{
    Ray ray{origin, direction, {}, t_min};
    for (int axis = 0; axis < kAxes; ++axis)
    {
        ray.direction[axis] = clampedDirection(direction[axis]);
        ray.inv[axis] = 1.0F / ray.direction[axis];
    }
    return ray;
}

std::uint32_t rootResolution(std::uint32_t depth)
{
    return 1U << (2 * ((depth + 1) / 2));
}

std::optional<Hit> visitVoxel(std::uint64_t code, std::uint32_t depth, const Ray& ray)
{
    if (!isFinite(ray))
        return std::nullopt;
    const std::uint32_t resolution = rootResolution(depth);
    const glm::uvec3 cell = mortonDecode(code);
    Event last_entry{ray.t_min, kFaceInside};
    Event first_exit{INFINITY, 4};
    for (int axis = 0; axis < kAxes; ++axis)
    {
        const std::uint32_t c = isMirrored(ray, axis) ? resolution - 1 - cell[axis] : cell[axis];
        last_entry = std::max(last_entry, crossing(ray, c, resolution, axis));
        first_exit = std::min(first_exit, crossing(ray, c + 1, resolution, axis));
    }
    if (!(last_entry < first_exit))
        return std::nullopt;
    return Hit{code, last_entry.t, last_entry.axis};
}

std::optional<Hit> traceBruteForce(const std::vector<std::uint64_t>& codes, std::uint32_t depth, const Ray& ray)
{
    std::optional<Hit> first;
    for (const std::uint64_t code : codes)
    {
        const std::optional<Hit> hit = visitVoxel(code, depth, ray);
        if (hit && (!first || eventOf(*hit) < eventOf(*first)))
            first = hit;
    }
    return first;
}

/// The search of one ray: its numbers in double precision, not mirrored, and the best hit so far.
struct VoxelTracer::Query
{
    const Ray& ray;
    glm::dvec3 origin;
    glm::dvec3 inv;
    std::uint64_t nearest_octant = 0; // bit set for each axis along which the ray goes down
    std::optional<Hit> best;

    explicit Query(const Ray& traced) : ray(traced), origin(traced.origin), inv(traced.inv)
    {
        for (int axis = 0; axis < kAxes; ++axis)
        {
            if (!isMirrored(ray, axis))
                continue;
            nearest_octant |= std::uint64_t{1} << axis;
            // With the rounding error of the mirrored origin.
            origin[axis] = 3.0 - static_cast<double>(mirroredOrigin(ray, axis));
        }
    }

    /// Whether the ray may visit a voxel of the box before the best hit.
    [[nodiscard]] bool mayImprove(const glm::dvec3& low, double edge) const
    {
        double entry = static_cast<double>(ray.t_min);
        double exit = INFINITY;
        for (int axis = 0; axis < kAxes; ++axis)
        {
            const double a = (low[axis] - origin[axis]) * inv[axis];
            const double b = (low[axis] + edge - origin[axis]) * inv[axis];
            if (std::max(std::fabs(a), std::fabs(b)) > 1e38)
                continue; // single precision may overflow
            // Two roundings to single precision change t by up to 2^-23 of it, denormal results by less than 1e-40.
            entry = std::max(entry, std::min(a - std::fabs(a) * 1e-6, b - std::fabs(b) * 1e-6) - 1e-40);
            exit = std::min(exit, std::max(a + std::fabs(a) * 1e-6, b + std::fabs(b) * 1e-6) + 1e-40);
        }
        return entry <= exit && (!best || entry <= static_cast<double>(best->t));
    }
};

VoxelTracer::VoxelTracer(std::span<const std::uint64_t> codes, std::uint32_t depth)
    : m_codes(codes.begin(), codes.end()), m_depth(depth)
{
}

std::optional<Hit> VoxelTracer::trace(const Ray& ray) const
{
    if (!isFinite(ray))
        return std::nullopt;
    Query query(ray);
    search(query, m_codes, m_depth, 0);
    return query.best;
}

/// codes are the voxels of the block, a cube of 1 << level voxels per edge.
void VoxelTracer::search(Query& query, std::span<const std::uint64_t> codes, std::uint32_t level,
                         std::uint64_t block) const
{
    const double voxel = 1.0 / rootResolution(m_depth);
    const glm::dvec3 low = 1.0 + glm::dvec3(mortonDecode(block << (3 * level))) * voxel;
    if (codes.empty() || !query.mayImprove(low, voxel * static_cast<double>(std::uint64_t{1} << level)))
        return;
    if (codes.size() <= 8)
    {
        for (const std::uint64_t code : codes)
        {
            const std::optional<Hit> hit = visitVoxel(code, m_depth, query.ray);
            if (hit && (!query.best || eventOf(*hit) < eventOf(*query.best)))
                query.best = hit;
        }
        return;
    }
    for (std::uint64_t step = 0; step < 8; ++step) // near octants first
    {
        const std::uint64_t child = block << 3 | (step ^ query.nearest_octant);
        const auto first = std::lower_bound(codes.begin(), codes.end(), child << (3 * (level - 1)));
        const auto last = std::lower_bound(first, codes.end(), (child + 1) << (3 * (level - 1)));
        search(query, {first, last}, level - 1, child);
    }
}

} // namespace zvo::oracle
