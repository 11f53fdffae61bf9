// SPDX-License-Identifier: MIT
// Finds the voxel that a ray hits first by looking at each voxel separately. The traversal on the device must agree bit
// for bit.
//
// The octree's root cube is [1, 2)^3, all numbers have single precision. On each axis, a direction below 1e-20 counts
// as copysign(1e-20, d); for d < 0 the axis is mirrored: o' = 3 - o, c' = R - 1 - c with R voxels per root edge. Plane
// p of axis i, at 1 + p / R, is crossed at the event (t, i), t = (1 + p / R - o'_i) * inv'_i. Events are ordered by t,
// then by axis. A voxel is entered by the planes c'_i and left by the planes c'_i + 1; the ray starts at the event
// (t_min, 3). The ray visits a voxel if the last of entries and start comes strictly before the first exit.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

namespace zvo::oracle
{

struct Ray
{
    glm::vec3 origin{0.0F};    // in unit coordinates
    glm::vec3 direction{0.0F}; // any length
    glm::vec3 inv{0.0F};       // 1 / direction, after small components were replaced, as on the device
    float t_min = 0.0F;
};

struct Hit
{
    std::uint64_t code = 0; // Morton code of the voxel
    float t = 0.0F;
    std::uint32_t face = 0; // axis of the face that the ray entered by; kFaceInside: it starts in the voxel

    friend bool operator==(const Hit&, const Hit&) = default;
};

constexpr std::uint32_t kFaceInside = 3;

/// A ray with components of direction below 1e-20 replaced, and the correctly rounded 1 / direction.
Ray makeRay(const glm::vec3& origin, const glm::vec3& direction, float t_min = 0.0F);

/// Voxels per edge of the root cube for a grid of this depth.
std::uint32_t rootResolution(std::uint32_t depth);

/// The event at which the ray enters a voxel; nothing if it does not visit it. A ray with NaN or infinite numbers
/// visits none.
std::optional<Hit> visitVoxel(std::uint64_t code, std::uint32_t depth, const Ray& ray);

/// The first voxel that the ray visits.
std::optional<Hit> traceBruteForce(const std::vector<std::uint64_t>& codes, std::uint32_t depth, const Ray& ray);

/// traceBruteForce() for many rays. It rejects blocks of voxels by a slab test in double precision, with a margin for
/// the rounding of t, and asks visitVoxel() for the others. It uses nothing else of the rule.
class VoxelTracer
{
public:
    /// codes: sorted and unique. They are copied.
    VoxelTracer(std::span<const std::uint64_t> codes, std::uint32_t depth);

    [[nodiscard]] std::optional<Hit> trace(const Ray& ray) const;

private:
    struct Query;
    void search(Query& query, std::span<const std::uint64_t> codes, std::uint32_t level, std::uint64_t block) const;

    std::vector<std::uint64_t> m_codes;
    std::uint32_t m_depth;
};

} // namespace zvo::oracle
