// SPDX-License-Identifier: MIT
#include "stress/ray_judge.h"

#include "oracle/morton.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstdio>
#include <mutex>
#include <thread>
#include <vector>

namespace zvo::stress
{

namespace
{

constexpr std::uint64_t kChunk = 1U << 12;      // rays that a host thread takes at a time
constexpr std::size_t kVoxelsForFarRays = 5000; // from far away, the first reference has to look at almost every voxel
constexpr std::uint32_t kReportedMax = 20;      // wrong rays to print

std::mutex g_print;
Tally g_tally;

} // namespace

Tally& tally()
{
    return g_tally;
}

void printTally(const std::string& what)
{
    fmt::print("{:<24} {:>10} must hit {:>10} may hit {:>10} must miss {:>9} invalid; {:>10} hit, {:>10} equal the "
               "rule bit for bit; {} wrong\n",
               what, g_tally.kinds[0].load(), g_tally.kinds[1].load(), g_tally.kinds[2].load(), g_tally.invalid.load(),
               g_tally.hits.load(), g_tally.exact.load(), g_tally.wrong.load());
    std::fflush(stdout);
    for (auto& kind : g_tally.kinds)
    {
        kind = 0;
    }
    g_tally.exact = g_tally.hits = g_tally.invalid = 0;
}

void inParallel(std::uint64_t count, const std::function<void(std::uint64_t, std::uint64_t)>& work)
{
    std::atomic<std::uint64_t> next{0};
    const auto run = [&]
    {
        for (std::uint64_t first = next.fetch_add(kChunk); first < count; first = next.fetch_add(kChunk))
        {
            work(first, std::min(first + kChunk, count));
        }
    };
    std::vector<std::thread> threads;
    for (unsigned i = 1; i < std::max(1U, std::thread::hardware_concurrency()); ++i)
    {
        threads.emplace_back(run);
    }
    run();
    for (std::thread& thread : threads)
    {
        thread.join();
    }
}

void reportWrong(const std::string& where, const StressRay& ray, const std::string& what)
{
    if (g_tally.wrong.fetch_add(1) >= kReportedMax)
    {
        return;
    }
    const gpu::Ray& r = ray.device;
    const std::lock_guard lock(g_print);
    fmt::print("WRONG {}: origin {:a} {:a} {:a} inverse {:a} {:a} {:a} t {:a} to {:a}: {}\n", where, r.origin.x,
               r.origin.y, r.origin.z, r.inverse_direction.x, r.inverse_direction.y, r.inverse_direction.z, r.t_min,
               r.t_max, what);
}

RayJudge::RayJudge(const StressTree& tree) : m_tree(tree), m_tracer(tree.codes, tree.depth)
{
    if (tree.depth <= oracle::BitPyramid::kDepthMax)
    {
        m_pyramid.emplace(tree.codes, tree.depth);
    }
}

void RayJudge::check(const StressRay& ray, const std::optional<test::DeviceHit>& hit, std::uint32_t levels) const
{
    g_tally.hits += hit ? 1 : 0;
    if (ray.invalid)
    {
        ++g_tally.invalid;
        objectIf(hit.has_value(), ray, "hit although it is invalid");
        return;
    }
    if (hit && (hit->index >= m_tree.codes.size() || oracle::mortonEncode(hit->cell) != m_tree.codes[hit->index] ||
                hit->level != levels))
    {
        objectIf(true, ray, "index, cell and level do not name one voxel");
        return;
    }
    if (m_pyramid)
    {
        checkBounds(ray, hit);
    }
    if (!ray.far || m_tree.codes.size() <= kVoxelsForFarRays)
    {
        checkExactly(ray, hit);
    }
}

void RayJudge::objectIf(bool wrong, const StressRay& ray, const std::string& what) const
{
    if (wrong)
    {
        reportWrong(m_tree.name, ray, what);
    }
}

void RayJudge::checkBounds(const StressRay& ray, const std::optional<test::DeviceHit>& hit) const
{
    const oracle::RayBounds bounds = m_pyramid->classify(ray.ray, ray.t_max);
    ++g_tally.kinds[static_cast<std::size_t>(bounds.kind)];
    if (hit)
    {
        objectIf(bounds.kind == oracle::RayClass::MustMiss, ray, "hit, but must miss");
        const auto objection = m_pyramid->objection(ray.ray, ray.t_max, hit->cell, hit->t);
        objectIf(objection.has_value(), ray, objection.value_or(""));
    }
    if (bounds.kind == oracle::RayClass::MustHit)
    {
        objectIf(!hit, ray, "missed, but must hit");
        objectIf(hit && static_cast<double>(hit->t) > bounds.latest, ray, "passed through a nearer voxel");
    }
}

void RayJudge::checkExactly(const StressRay& ray, const std::optional<test::DeviceHit>& hit) const
{
    ++g_tally.exact;
    std::optional<oracle::Hit> expected = m_tracer.trace(ray.ray);
    if (expected && expected->t > ray.t_max)
    {
        expected.reset();
    }
    const bool same = expected.has_value() == hit.has_value() &&
                      (!hit || (m_tree.codes[hit->index] == expected->code && hit->face == expected->face &&
                                std::bit_cast<std::uint32_t>(hit->t) == std::bit_cast<std::uint32_t>(expected->t)));
    objectIf(!same, ray, "differs from the rule");
}

} // namespace zvo::stress
