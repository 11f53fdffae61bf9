// SPDX-License-Identifier: MIT
// Which voxels the line of a ray must hit, may hit or must miss, whatever the rounding: a second reference beside
// oracle/trace.h, which knows nothing of events and their order, and is fast enough for millions of rays.
//
// The device computes when a ray crosses a plane with at most five roundings to single precision (3 - o, p - o',
// 1 / d, their product), so it takes every plane for one that lies up to delta = 2^-24 (4 |p - o| + |3 - o|) elsewhere,
// which is bounded here over the root cube, for each axis. A ray that passes through a voxel even if its planes move
// inwards by delta visits it; a ray that does not touch it even if they move outwards does not.
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

/// What the line of a ray allows.
struct RayBounds
{
    RayClass kind = RayClass::MustMiss;
    double latest = 0.0; // MustHit: when, at the latest, the hit voxel is entered
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

    /// What the ray can meet after its start and before t_max. A ray with NaN or infinite numbers misses.
    [[nodiscard]] RayBounds classify(const Ray& ray, double t_max) const;

    /// Why the device may not report that the ray enters this voxel at t; nothing if it may.
    [[nodiscard]] std::optional<std::string> objection(const Ray& ray, double t_max, const glm::uvec3& voxel,
                                                       float t) const;

private:
    std::uint32_t m_depth;
    std::array<std::vector<std::uint64_t>, kDepthMax + 1> m_bits; // [level] x + y * edge + z * edge^2
};

} // namespace zvo::oracle
