// SPDX-License-Identifier: MIT
// What references say of rays, and how many of them were of which kind.
#pragma once

#include "oracle/ray_bounds.h"
#include "stress/stress_rays.h"
#include "support/trace_rays.h"

#include <array>
#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>

namespace zvo::stress
{

/// Occupied voxels that rays are traced through.
struct StressTree
{
    std::string name;
    test::Codes codes;
    std::uint32_t depth;
};

/// Of all rays since the last printTally().
struct Tally
{
    std::array<std::atomic<std::uint64_t>, 3> kinds{}; // by oracle::RayClass
    std::atomic<std::uint64_t> exact{0};               // compared bit for bit
    std::atomic<std::uint64_t> hits{0};
    std::atomic<std::uint64_t> invalid{0};
    std::atomic<std::uint64_t> wrong{0};
};

/// The only one; threads count in it together.
Tally& tally();

/// Prints the tally, after a text, and begins a new one; wrong rays stay counted.
void printTally(const std::string& what);

/// Calls work(first, end) for parts of [0, count) on all processors.
void inParallel(std::uint64_t count, const std::function<void(std::uint64_t, std::uint64_t)>& work);

/// Counts a wrong ray, and prints it if it is one of the first.
void reportWrong(const std::string& where, const StressRay& ray, const std::string& what);

/// Compares the device's answers with both references: oracle/trace.h, bit for bit, and oracle/ray_bounds.h.
class RayJudge
{
public:
    /// tree must outlive the judge.
    explicit RayJudge(const StressTree& tree);

    /// hit: the device's answer; levels: of nodes in the tree. Counts and reports.
    void check(const StressRay& ray, const std::optional<test::DeviceHit>& hit, std::uint32_t levels) const;

private:
    void objectIf(bool wrong, const StressRay& ray, const std::string& what) const;
    void checkBounds(const StressRay& ray, const std::optional<test::DeviceHit>& hit) const;
    void checkExactly(const StressRay& ray, const std::optional<test::DeviceHit>& hit) const;

    const StressTree& m_tree;
    oracle::VoxelTracer m_tracer;
    std::optional<oracle::BitPyramid> m_pyramid;
};

} // namespace zvo::stress
