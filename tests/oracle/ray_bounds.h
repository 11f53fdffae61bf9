// SPDX-License-Identifier: MIT
// Classifies voxels as those that the line of a ray must hit, may hit or must miss, whatever the rounding. A second
// reference beside oracle/trace.h: it does not use events and their order, and is fast enough for millions of rays.
//
// The device computes the time at which a ray crosses a plane with at most five roundings to single precision (3 - o, p
// - o', 1 / d, their product). So the plane that it effectively takes lies up to delta = 2^-24 (4 |p - o| + |3 - o|)
// away; delta is bounded for each axis over the root cube. A ray visits a voxel if it passes through it even with its
// planes moved inwards by delta. It does not visit a voxel that it misses even with its planes moved outwards.
#pragma once

#include "oracle/trace.h"

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace zvo::oracle
{

enum class RayClass : std::uint32_t
{
    MustHit,
    MayHit, // depends on rounding
    MustMiss
};

/// The hits that are possible for a ray.
struct RayBounds
{
    RayClass kind = RayClass::MustMiss;
    double latest = 0.0; // MustHit: the latest time at which the hit voxel is entered
};

/// The occupied cells of all levels of a small grid, as bits.
class BitPyramid
{
public:
    static constexpr std::uint32_t kDepthMax = 7;

    /// codes: Morton codes of the voxels of a grid of this depth (at most kDepthMax).
    BitPyramid(std::span<const std::uint64_t> codes, std::uint32_t depth);

    [[nodiscard]] bool isSet(std::uint32_t level, const glm::uvec3& cell) const;
    [[nodiscard]] std::uint32_t depth() const { return m_depth; }

    /// Classifies the hits of a ray after its start and before t_max. A ray with NaN or infinite numbers misses.
    [[nodiscard]] RayBounds classify(const Ray& ray, double t_max) const;

    /// Returns why the device may not report that the ray enters this voxel at t; nothing if it may.
    [[nodiscard]] std::optional<std::string> objection(const Ray& ray, double t_max, const glm::uvec3& voxel,
                                                       float t) const;

private:
    std::uint32_t m_depth;
    std::array<std::vector<std::uint64_t>, kDepthMax + 1> m_bits; // [level] x + y * edge + z * edge^2
};

} // namespace zvo::oracle
