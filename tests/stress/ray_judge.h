// SPDX-License-Identifier: MIT
// Compares rays with the references, and counts them by kind.
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

/// A tree for tracing, and its voxels.
struct StressTree
{
    std::string name;
    test::Codes codes;
    std::uint32_t depth;
};

/// Counts of all rays since the last printTally().
struct Tally
{
    std::array<std::atomic<std::uint64_t>, 3> kinds{}; // [oracle::RayClass]
    std::atomic<std::uint64_t> exact{0};               // compared bit for bit
    std::atomic<std::uint64_t> hits{0};
    std::atomic<std::uint64_t> invalid{0};
    std::atomic<std::uint64_t> wrong{0};
};

/// The only tally, which threads share.
Tally& tally();

/// Prints a text and the tally, and sets it to zero, except the wrong rays.
void printTally(const std::string& what);

/// Calls work(first, end) for parts of [0, count) on all processors.
void inParallel(std::uint64_t count, const std::function<void(std::uint64_t, std::uint64_t)>& work);

/// Counts a wrong ray, and prints it if it is one of the first.
void reportWrong(const std::string& where, const StressRay& ray, const std::string& what);

/// Compares the device's hits with both references: with oracle/trace.h bit for bit, and with oracle/ray_bounds.h.
class RayJudge
{
public:
    /// tree must outlive the judge.
    explicit RayJudge(const StressTree& tree);

    /// Checks the device's hit, counts the ray, and reports it if it is wrong. levels: of nodes in the tree.
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
