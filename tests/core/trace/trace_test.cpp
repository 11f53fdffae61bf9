// SPDX-License-Identifier: MIT
// Lists of rays on the device against the reference, bit for bit.
#include "core/trace/trace.h"
#include "oracle/morton.h"
#include "oracle/trace.h"
#include "support/engine_device.h"
#include "support/sweep.h"
#include "support/trace_octrees.h"
#include "support/trace_rays.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <optional>
#include <random>

namespace zvo
{
namespace
{

using test::DeviceHit;
using test::deviceRay;
using test::pickRay;
using test::unpack;

constexpr float kInfinity = std::numeric_limits<float>::infinity();

using test::device;

std::vector<gpu::Hit> traceOnDevice(const DeviceTree& octree, const std::vector<gpu::Ray>& rays,
                                    const TraceOptions& options = {})
{
    return test::traceOnDevice(device(), octree, rays, options);
}

void expectEqualsReference(const test::Codes& codes, std::uint32_t depth, std::uint32_t count,
                           const TraceOptions& options = {})
{
    test::expectEqualsReference(device(), test::octreeOf(device(), codes, depth), codes, count, options);
}

TEST(Trace, HitsOfRandomVoxelsEqualTheReferenceAtEveryDepth)
{
    std::mt19937 random(1);
    const std::uint32_t counts[] = {3, 20, 100, 400, 2049, 8000};
    const std::uint32_t rays = test::isFull() ? 4096 : 1024;
    for (std::uint32_t depth = 1; depth <= Grid::kDepthMax; ++depth)
    {
        expectEqualsReference(test::randomCodes(depth, depth <= 6 ? counts[depth - 1] : 10201, random), depth,
                              depth <= 6 ? 10201 : rays);
    }
}

TEST(Trace, HitsOfOneVoxelEqualTheReference)
{
    for (std::uint32_t depth = 1; depth <= 9; ++depth)
    {
        const std::uint64_t last = (std::uint64_t{1} << (3 * depth)) - 1;
        for (const std::uint64_t code : {std::uint64_t{0}, last, last / 3, last / 2})
        {
            expectEqualsReference({code}, depth, 500);
        }
    }
}

TEST(Trace, HitsOfFullGridsEqualTheReference)
{
    for (std::uint32_t depth = 1; depth <= 5; ++depth)
    {
        expectEqualsReference(test::codesWhere(depth, [](const glm::uvec3&) { return true; }), depth, 2049);
    }
}

TEST(Trace, HitsOfShellsAndSpongesEqualTheReference)
{
    for (std::uint32_t depth = 3; depth <= 7; ++depth)
    {
        expectEqualsReference(test::sphereShell(depth, 0.45 * std::ldexp(1.0, static_cast<int>(depth))), depth, 4096);
        if (depth <= 6)
        {
            expectEqualsReference(test::spongeCodes(depth), depth, 4096);
        }
    }
}

TEST(Trace, RaysThatUseUpTheirIterationsResumeToTheSameHits)
{
    std::mt19937 random(6);
    TraceOptions options;
    options.iterations_max = 14;
    expectEqualsReference(test::spongeCodes(6), 6, 2049, options);
    expectEqualsReference(test::sphereShell(6, 29.0), 6, 2049, options);
    expectEqualsReference(test::randomCodes(7, 4000, random), 7, 2049, options);
    expectEqualsReference(test::randomCodes(11, 4000, random), 11, 2049, options);
}

TEST(Trace, RaysWithoutAnAnswerAreCounted)
{
    // A floor along x, and rays just above it, which test every cell up to a wall at the end.
    constexpr std::uint32_t kDepth = 7;
    const test::Codes codes = test::codesWhere(kDepth, [](const glm::uvec3& v) { return v.y == 64 || v.x == 127; });
    const DeviceTree octree = test::octreeOf(device(), codes, kDepth);
    const float edge = 1.0F / static_cast<float>(octree.grid.rootResolution());
    std::vector<gpu::Ray> rays;
    for (std::uint32_t i = 0; i < 100; ++i) // all but every tenth begin far from the wall
    {
        const glm::vec3 origin =
            1.0F + edge * glm::vec3(i % 10 == 0 ? 120.5F : 0.5F, 65.5F, 0.5F + static_cast<float>(i));
        rays.push_back(deviceRay(oracle::makeRay(origin, {1.0F, 0.0F, 0.0F}, gpu::kTraceTimeMin)));
    }
    TraceOptions options;
    const std::vector<gpu::Hit> expected = traceOnDevice(octree, rays, options);
    options.iterations_max = 16; // more than a sixteenth of what the rays need
    const std::vector<gpu::Hit> in_rounds = traceOnDevice(octree, rays, options);
    options.iterations_max = 10; // less than that
    const std::vector<gpu::Hit> hits = test::traceOnDevice(device(), octree, rays, options, 90);
    for (std::size_t i = 0; i < hits.size(); ++i)
    {
        EXPECT_NE(expected[i].index, gpu::kHitMiss) << i;
        EXPECT_EQ(in_rounds[i].index, expected[i].index) << i;
        EXPECT_EQ(hits[i].index, i % 10 == 0 ? expected[i].index : gpu::kHitMiss) << i;
    }
}

TEST(Trace, RaysAlongTheDeepestGridAreAnswered)
{
    // The same with single voxels, so that rays need more than four times an invocation's iterations.
    constexpr std::uint32_t kLast = (1U << Grid::kDepthMax) - 1;
    test::Codes codes;
    for (std::uint32_t x = 0; x <= kLast; ++x)
    {
        codes.push_back(oracle::mortonEncode({x, 6, 9}));
    }
    codes.push_back(oracle::mortonEncode({kLast, 7, 9}));
    std::sort(codes.begin(), codes.end());
    const DeviceTree octree = test::octreeOf(device(), codes, Grid::kDepthMax);
    const float edge = 1.0F / static_cast<float>(octree.grid.rootResolution());
    const glm::vec3 origin = 1.0F + edge * glm::vec3(0.5F, 7.5F, 9.5F);
    const std::vector<gpu::Hit> hits =
        traceOnDevice(octree, {deviceRay(oracle::makeRay(origin, {1.0F, 0.0F, 0.0F}, gpu::kTraceTimeMin)),
                               deviceRay(oracle::makeRay(origin, {-1.0F, 0.0F, 0.0F}, gpu::kTraceTimeMin))});
    const std::optional<DeviceHit> wall = unpack(hits[0]);
    ASSERT_TRUE(wall.has_value());
    EXPECT_EQ(wall->cell, glm::uvec3(kLast, 7, 9));
    EXPECT_EQ(wall->face, 0U);
    EXPECT_EQ(wall->t, edge * (static_cast<float>(kLast) - 0.5F));
    EXPECT_FALSE(unpack(hits[1]).has_value());
}

TEST(Trace, RayCountsThatDoNotFillAWorkgroup)
{
    std::mt19937 random(3);
    const test::Codes codes = test::randomCodes(5, 3000, random);
    for (const std::uint32_t count : {1U, 27U, 64U, 65U})
    {
        expectEqualsReference(codes, 5, count);
    }
}

TEST(Trace, NoRayLeaksThroughAClosedSphere)
{
    constexpr std::uint32_t kDepth = 7;
    const DeviceTree octree = test::octreeOf(device(), test::sphereShell(kDepth, 50.0), kDepth);
    const auto edge = 1.0F / static_cast<float>(octree.grid.rootResolution());
    std::mt19937 random(4);
    std::normal_distribution<float> normal;
    std::vector<gpu::Ray> rays;
    for (int i = 0; i < 200000; ++i)
    {
        glm::vec3 direction(normal(random), normal(random), normal(random));
        if (i % 3 == 0) // through many edges: small integer directions from voxel corners
        {
            direction = glm::vec3(glm::ivec3(random() % 9, random() % 9, random() % 9) - 4);
        }
        const glm::vec3 voxel(glm::uvec3(60 + random() % 8, 60 + random() % 8, 60 + random() % 8));
        rays.push_back(deviceRay(oracle::makeRay(1.0F + edge * voxel, direction, gpu::kTraceTimeMin)));
    }
    std::uint32_t leak_count = 0;
    for (const gpu::Hit& hit : traceOnDevice(octree, rays))
    {
        leak_count += hit.index == gpu::kHitMiss ? 1 : 0;
    }
    EXPECT_EQ(leak_count, 0U);
}

TEST(Trace, InvalidRaysMiss)
{
    const test::Codes codes = test::codesWhere(3, [](const glm::uvec3&) { return true; });
    const DeviceTree octree = test::octreeOf(device(), codes, 3);
    const gpu::Ray good = {{1.1F, 1.2F, 0.5F}, gpu::kTraceTimeMin, {1e20F, -1e20F, 1.0F}, kInfinity};
    std::vector<gpu::Ray> rays;
    for (const float bad : {std::numeric_limits<float>::quiet_NaN(), kInfinity, -kInfinity})
    {
        for (int axis = 0; axis < 3; ++axis)
        {
            rays.push_back(good);
            rays.back().origin[axis] = bad;
            rays.push_back(good);
            rays.back().inverse_direction[axis] = bad;
        }
        rays.push_back(good);
        rays.back().t_min = bad;
    }
    for (const float bad : {0.0F, -0.0F, 1e-40F})
    {
        rays.push_back(good);
        rays.back().inverse_direction.y = bad;
    }
    rays.push_back(good);
    rays.back().t_max = std::numeric_limits<float>::quiet_NaN();
    rays.push_back(good);
    rays.back().t_max = -1.0F;
    const std::size_t bad_count = rays.size();
    rays.push_back(good);
    rays.push_back(good);
    rays.back().t_min = -5.0F; // counts as the smallest start
    const std::vector<gpu::Hit> hits = traceOnDevice(octree, rays);
    for (std::size_t i = 0; i < hits.size(); ++i)
    {
        EXPECT_EQ(hits[i].index == gpu::kHitMiss, i < bad_count) << i;
    }
}

TEST(Trace, NothingIsHitAfterTheEnd)
{
    const test::Codes codes = {oracle::mortonEncode({5, 3, 3})};
    const DeviceTree octree = test::octreeOf(device(), codes, 4);
    const auto middle = 1.0F + 3.5F / 16.0F;
    const float entry = 0.5F + 5.0F / 16.0F; // from 0.5
    const auto ray = [&](float t_max) {
        return deviceRay(oracle::makeRay({0.5F, middle, middle}, {1.0F, 0.0F, 0.0F}, gpu::kTraceTimeMin), t_max);
    };
    const std::vector<gpu::Hit> hits =
        traceOnDevice(octree, {ray(entry), ray(std::nextafter(entry, 0.0F)), ray(0.1F), ray(2.0F)});
    EXPECT_EQ(hits[0].index, 0U);
    EXPECT_EQ(hits[0].t, entry);
    EXPECT_EQ(hits[1].index, gpu::kHitMiss);
    EXPECT_EQ(hits[2].index, gpu::kHitMiss);
    EXPECT_EQ(hits[3].index, 0U);
}

TEST(Trace, EmptyOctreeIsNeverHit)
{
    const DeviceTree octree = test::octreeOf(device(), {}, 5);
    const gpu::Ray ray = {{1.1F, 1.2F, 0.5F}, gpu::kTraceTimeMin, {1e20F, -1e20F, 1.0F}, kInfinity};
    for (const gpu::Hit& hit : traceOnDevice(octree, {ray, ray, ray}))
    {
        EXPECT_EQ(hit.index, gpu::kHitMiss);
    }
}

TEST(Trace, DetailStopsAtTheNodesOfALevel)
{
    constexpr std::uint32_t kDepth = 8;
    std::mt19937 random(5);
    const test::Codes codes = test::randomCodes(kDepth, 20000, random);
    const DeviceTree octree = test::octreeOf(device(), codes, kDepth);
    std::vector<oracle::Ray> rays;
    std::vector<gpu::Ray> device_rays;
    for (int i = 0; i < 4000; ++i)
    {
        rays.push_back(pickRay(random, octree.grid.rootResolution(), codes));
        device_rays.push_back(deviceRay(rays.back()));
    }
    for (std::uint32_t level = 1; level < octree.grid.nodeLevels(); ++level)
    {
        test::Codes nodes;
        for (const std::uint64_t code : codes)
        {
            nodes.push_back(code >> (6 * (octree.grid.nodeLevels() - level)));
        }
        nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
        const oracle::VoxelTracer tracer(nodes, 2 * level);
        TraceOptions options;
        options.detail_level = level;
        const std::vector<gpu::Hit> hits = traceOnDevice(octree, device_rays, options);
        for (std::size_t i = 0; i < rays.size(); ++i)
        {
            const std::optional<oracle::Hit> expected = tracer.trace(rays[i]);
            const std::optional<DeviceHit> hit = unpack(hits[i]);
            ASSERT_EQ(hit.has_value(), expected.has_value()) << "level " << level << " ray " << i;
            if (!expected)
            {
                continue;
            }
            ASSERT_EQ(hit->level, level);
            ASSERT_EQ(nodes.at(hit->index - octree.levels[level].first_node), expected->code);
            ASSERT_EQ(oracle::mortonEncode(hit->cell), expected->code);
            ASSERT_EQ(hit->t, expected->t);
            ASSERT_EQ(hit->face, expected->face);
        }
    }
}

} // namespace
} // namespace zvo
