// SPDX-License-Identifier: MIT
#include "oracle/trace.h"

#include "oracle/morton.h"
#include "oracle/test_scenes.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>

namespace zvo::oracle
{
namespace
{

constexpr std::uint32_t kDepth = 2; // 4 voxels per edge, each a quarter of a unit

std::vector<std::uint64_t> allCodes(std::uint32_t depth)
{
    std::vector<std::uint64_t> codes(std::size_t{1} << (3 * depth));
    for (std::size_t i = 0; i < codes.size(); ++i)
        codes[i] = i;
    return codes;
}

/// The voxels that the ray visits, in order.
std::vector<Hit> path(const Ray& ray, std::uint32_t depth = kDepth)
{
    std::vector<Hit> hits;
    for (const std::uint64_t code : allCodes(depth))
        if (const std::optional<Hit> hit = visitVoxel(code, depth, ray))
            hits.push_back(*hit);
    std::sort(hits.begin(), hits.end(),
              [](const Hit& a, const Hit& b) { return a.t != b.t ? a.t < b.t : a.face < b.face; });
    return hits;
}

std::vector<Hit> hitsOf(const std::vector<std::tuple<glm::uvec3, float, std::uint32_t>>& list)
{
    std::vector<Hit> hits;
    for (const auto& [voxel, t, face] : list)
        hits.push_back({mortonEncode(voxel), t, face});
    return hits;
}

TEST(OracleTrace, RayAlongAnAxisVisitsTheRow)
{
    const Ray up = makeRay({0.5F, 1.3F, 1.9F}, {1.0F, 0.0F, 0.0F});
    EXPECT_EQ(path(up), hitsOf({{{0, 1, 3}, 0.5F, 0},
                                {{1, 1, 3}, 0.75F, 0},
                                {{2, 1, 3}, 1.0F, 0}, //
                                {{3, 1, 3}, 1.25F, 0}}));
    const Ray down = makeRay({2.5F, 1.3F, 1.9F}, {-2.0F, 0.0F, 0.0F});
    EXPECT_EQ(path(down), hitsOf({{{3, 1, 3}, 0.25F, 0},
                                  {{2, 1, 3}, 0.375F, 0},
                                  {{1, 1, 3}, 0.5F, 0}, //
                                  {{0, 1, 3}, 0.625F, 0}}));
}

TEST(OracleTrace, RayBesideTheCubeOrBehindTheOriginVisitsNothing)
{
    EXPECT_TRUE(path(makeRay({0.5F, 2.1F, 1.5F}, {1.0F, 0.0F, 0.0F})).empty());
    EXPECT_TRUE(path(makeRay({2.5F, 1.5F, 1.5F}, {1.0F, 0.0F, 0.0F})).empty());
    EXPECT_TRUE(path(makeRay({2.0F, 1.5F, 1.5F}, {1.0F, 0.0F, 0.0F})).empty()); // leaves at t = 0
}

TEST(OracleTrace, RayStartsInsideAVoxelWithoutAFace)
{
    const Ray ray = makeRay({1.6F, 1.1F, 1.1F}, {1.0F, 0.0F, 0.0F});
    const std::vector<Hit> hits = path(ray);
    ASSERT_EQ(hits.size(), 2U);
    EXPECT_EQ(hits[0], (Hit{mortonEncode({2, 0, 0}), 0.0F, kFaceInside}));
    EXPECT_EQ(hits[1].face, 0U);
}

TEST(OracleTrace, CrossingsUpToTMinAreBehindTheStart)
{
    Ray ray = makeRay({0.5F, 1.1F, 1.1F}, {1.0F, 0.0F, 0.0F}, 0.75F); // starts on the plane between voxels 0 and 1
    EXPECT_EQ(path(ray), hitsOf({{{1, 0, 0}, 0.75F, kFaceInside}, {{2, 0, 0}, 1.0F, 0}, {{3, 0, 0}, 1.25F, 0}}));
    ray.t_min = std::nextafter(0.75F, 0.0F);
    EXPECT_EQ(path(ray).at(0), (Hit{mortonEncode({0, 0, 0}), ray.t_min, kFaceInside}));
    // Downwards, too, the plane itself counts as crossed.
    EXPECT_EQ(path(makeRay({1.75F, 1.1F, 1.1F}, {-1.0F, 0.0F, 0.0F})).at(0),
              (Hit{mortonEncode({2, 0, 0}), 0.0F, kFaceInside}));
}

TEST(OracleTrace, RayThroughAnEdgeCrossesTheAxesInOrder)
{
    const Ray ray = makeRay({1.0F, 1.0F, 1.1F}, {1.0F, 1.0F, 0.0F});
    EXPECT_EQ(path(ray), hitsOf({{{0, 0, 0}, 0.0F, 3},
                                 {{1, 0, 0}, 0.25F, 0},
                                 {{1, 1, 0}, 0.25F, 1},
                                 {{2, 1, 0}, 0.5F, 0},
                                 {{2, 2, 0}, 0.5F, 1},
                                 {{3, 2, 0}, 0.75F, 0},
                                 {{3, 3, 0}, 0.75F, 1}}));
}

TEST(OracleTrace, RayThroughCornersCrossesTheAxesInOrderInEveryDirection)
{
    for (std::uint32_t signs = 0; signs < 8; ++signs)
    {
        glm::vec3 origin(1.0F);
        glm::vec3 direction(1.0F);
        glm::uvec3 mirror(0U);
        for (int axis = 0; axis < 3; ++axis)
        {
            if ((signs >> axis & 1) == 0)
                continue;
            origin[axis] = 2.0F;
            direction[axis] = -1.0F;
            mirror[axis] = 3;
        }
        const auto cell = [&](std::uint32_t x, std::uint32_t y, std::uint32_t z)
        { return glm::uvec3(x, y, z) ^ mirror; };
        const std::vector<Hit> hits = path(makeRay(origin, direction));
        ASSERT_EQ(hits.size(), 10U) << signs;
        EXPECT_EQ(hits[0], (Hit{mortonEncode(cell(0, 0, 0)), 0.0F, 3}));
        EXPECT_EQ(hits[1], (Hit{mortonEncode(cell(1, 0, 0)), 0.25F, 0}));
        EXPECT_EQ(hits[2], (Hit{mortonEncode(cell(1, 1, 0)), 0.25F, 1}));
        EXPECT_EQ(hits[3], (Hit{mortonEncode(cell(1, 1, 1)), 0.25F, 2}));
        EXPECT_EQ(hits[9], (Hit{mortonEncode(cell(3, 3, 3)), 0.75F, 2}));
    }
}

TEST(OracleTrace, GrazingRayInAPlaneBelongsToTheUpperSide)
{
    // y = 1.5 exactly, direction (1, +0, +0): the crossing of the plane lies at t = 0 and so before the start.
    EXPECT_EQ(path(makeRay({0.5F, 1.5F, 1.1F}, {1.0F, 0.0F, 0.0F})).at(0).code, mortonEncode({0, 2, 0}));
    // A negative zero mirrors the axis: then it is the lower side.
    EXPECT_EQ(path(makeRay({0.5F, 1.5F, 1.1F}, {1.0F, -0.0F, 0.0F})).at(0).code, mortonEncode({0, 1, 0}));
    // In the cube's faces: the upper one is outside, the lower one inside.
    EXPECT_TRUE(path(makeRay({0.5F, 2.0F, 1.1F}, {1.0F, 0.0F, 0.0F})).empty());
    EXPECT_EQ(path(makeRay({0.5F, 1.0F, 1.1F}, {1.0F, 0.0F, 0.0F})).size(), 4U);
}

TEST(OracleTrace, RayWithNanOrInfinityMisses)
{
    const Ray good = makeRay({0.5F, 1.3F, 1.9F}, {1.0F, 0.0F, 0.0F});
    for (const float bad : {std::numeric_limits<float>::quiet_NaN(), INFINITY, -INFINITY})
    {
        Ray ray = good;
        ray.origin.y = bad;
        EXPECT_TRUE(path(ray).empty());
        ray = good;
        ray.direction.x = bad;
        EXPECT_TRUE(path(ray).empty());
        ray = good;
        ray.t_min = bad;
        EXPECT_TRUE(path(ray).empty());
        EXPECT_FALSE(VoxelTracer(allCodes(kDepth), kDepth).trace(ray));
    }
}

TEST(OracleTrace, OddDepthFillsTheLowerOctantOfTheRoot)
{
    EXPECT_EQ(rootResolution(1), 4U);
    EXPECT_EQ(rootResolution(2), 4U);
    EXPECT_EQ(rootResolution(5), 64U);
    EXPECT_EQ(path(makeRay({0.5F, 1.1F, 1.1F}, {1.0F, 0.0F, 0.0F}), 1).size(), 2U);
    EXPECT_EQ(path(makeRay({2.5F, 1.1F, 1.1F}, {-1.0F, 0.0F, 0.0F}), 1).at(0), (Hit{mortonEncode({1, 0, 0}), 1.0F, 0}));
}

TEST(OracleTrace, FirstOccupiedVoxelWins)
{
    const std::vector<std::uint64_t> codes{mortonEncode({1, 1, 3}), mortonEncode({3, 1, 3})};
    EXPECT_EQ(traceBruteForce(codes, kDepth, makeRay({0.5F, 1.3F, 1.9F}, {1.0F, 0.0F, 0.0F})),
              (Hit{codes[0], 0.75F, 0}));
    EXPECT_EQ(traceBruteForce(codes, kDepth, makeRay({2.5F, 1.3F, 1.9F}, {-1.0F, 0.0F, 0.0F})),
              (Hit{codes[1], 0.5F, 0}));
    EXPECT_EQ(traceBruteForce(codes, kDepth, makeRay({0.5F, 1.6F, 1.9F}, {1.0F, 0.0F, 0.0F})), std::nullopt);
}

/// Rays from inside and outside, some along axes and diagonals or from voxel corners, some from far away.
Ray pickRay(test::Random& random, std::uint32_t resolution)
{
    std::uniform_real_distribution<float> coordinate(0.5F, 2.5F);
    std::uniform_real_distribution<float> component(-1.0F, 1.0F);
    glm::vec3 origin(coordinate(random), coordinate(random), coordinate(random));
    glm::vec3 direction(component(random), component(random), component(random));
    const std::int64_t kind = test::pick(random, 0, 7);
    for (int axis = 0; axis < 3; ++axis)
    {
        if (kind == 1 || kind == 2)
            origin[axis] =
                1.0F + static_cast<float>(test::pick(random, -2, resolution + 2)) / static_cast<float>(resolution);
        if (kind == 2 || kind == 3)
            direction[axis] = static_cast<float>(test::pick(random, -1, 1));
        if (kind == 4)
            direction[axis] *= axis == static_cast<int>(test::pick(random, 0, 2)) ? 1.0F : 1e-6F;
        if (kind == 5)
            origin[axis] = 1.5F - direction[axis] * 100.0F + component(random);
        if (kind == 6)
            origin[axis] = 1.5F - direction[axis] * 1e6F;
        if (kind == 7)
            direction[axis] *= std::ldexp(1.0F, static_cast<int>(test::pick(random, -120, 100)));
    }
    const float t_min = test::pick(random, 0, 3) == 0 ? component(random) : 0.0F;
    return makeRay(origin, direction, t_min);
}

TEST(OracleTrace, VisitedVoxelsAreAConnectedChain)
{
    test::Random random(12);
    std::uint32_t visited = 0;
    for (int i = 0; i < 3000; ++i)
    {
        const Ray ray = pickRay(random, 4);
        if (glm::length(ray.origin) > 10.0F) // from far away, planes may fall together
            continue;
        const std::vector<Hit> hits = path(ray);
        visited += hits.empty() ? 0 : 1;
        for (std::size_t k = 1; k < hits.size(); ++k)
        {
            const glm::ivec3 step = glm::ivec3(mortonDecode(hits[k].code)) - glm::ivec3(mortonDecode(hits[k - 1].code));
            glm::ivec3 expected(0);
            ASSERT_LT(hits[k].face, 3U);
            expected[static_cast<int>(hits[k].face)] = ray.direction[static_cast<int>(hits[k].face)] < 0 ? -1 : 1;
            ASSERT_EQ(step, expected) << "case " << i;
        }
    }
    EXPECT_GT(visited, 400U);
}

TEST(OracleTrace, AcceleratedTracerAgreesWithBruteForce)
{
    test::Random random(13);
    for (const auto& [depth, count] :
         {std::pair{1U, 3U}, {2U, 20U}, {3U, 100U}, {5U, 2049U}, {8U, 10201U}, {12U, 3000U}})
    {
        std::vector<std::uint64_t> codes;
        for (std::uint32_t i = 0; i < count; ++i)
            codes.push_back(static_cast<std::uint64_t>(test::pick(random, 0, (std::int64_t{1} << (3 * depth)) - 1)));
        std::sort(codes.begin(), codes.end());
        codes.erase(std::unique(codes.begin(), codes.end()), codes.end());
        const VoxelTracer tracer(codes, depth);
        std::uint32_t hits = 0;
        for (int i = 0; i < 600; ++i)
        {
            Ray ray = pickRay(random, rootResolution(depth));
            if (i % 2 == 0) // aim at a voxel
            {
                const glm::uvec3 voxel = mortonDecode(codes[static_cast<std::size_t>(
                    test::pick(random, 0, static_cast<std::int64_t>(codes.size()) - 1))]);
                const glm::vec3 target = 1.0F + (glm::vec3(voxel) + 0.5F) / static_cast<float>(rootResolution(depth));
                ray = makeRay(ray.origin, target - ray.origin, ray.t_min);
            }
            const std::optional<Hit> expected = traceBruteForce(codes, depth, ray);
            ASSERT_EQ(tracer.trace(ray), expected) << "depth " << depth << " case " << i;
            hits += expected ? 1 : 0;
        }
        EXPECT_GT(hits, 120U) << depth;
    }
}

TEST(OracleTrace, EmptySetIsNeverHit)
{
    const Ray ray = makeRay({0.5F, 1.3F, 1.9F}, {1.0F, 0.0F, 0.0F});
    EXPECT_EQ(traceBruteForce({}, 5, ray), std::nullopt);
    EXPECT_EQ(VoxelTracer({}, 5).trace(ray), std::nullopt);
}

} // namespace
} // namespace zvo::oracle
