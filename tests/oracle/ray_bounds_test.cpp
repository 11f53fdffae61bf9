// SPDX-License-Identifier: MIT
#include "oracle/ray_bounds.h"

#include "oracle/morton.h"
#include "oracle/test_scenes.h"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>

namespace zvo::oracle
{
namespace
{

constexpr std::uint32_t kDepth = 2; // 4 voxels per edge, each a quarter of a unit

BitPyramid pyramidOf(const glm::uvec3& voxel)
{
    const std::uint64_t code = mortonEncode(voxel);
    return {std::span(&code, 1), kDepth};
}

TEST(OracleRayBounds, OddDepthFillsTheLowerOctantOfTheRoot)
{
    const std::uint64_t last = 511; // of 8^3 voxels in a root cube of 16^3
    const BitPyramid pyramid({&last, 1}, 3);
    const Ray ray = makeRay({0.5F, 1.47F, 1.47F}, {1.0F, 0.0F, 0.0F});
    EXPECT_NEAR(pyramid.classify(ray, INFINITY).latest, 0.9375, 1e-5);
    EXPECT_EQ(pyramid.classify(makeRay({0.5F, 1.97F, 1.97F}, {1.0F, 0.0F, 0.0F}), INFINITY).kind, RayClass::MustMiss);
}

TEST(OracleRayBounds, RayThroughTheMiddleMustHit)
{
    const Ray ray = makeRay({0.5F, 1.3F, 1.9F}, {2.0F, 0.0F, 0.0F});
    const RayBounds bounds = pyramidOf({2, 1, 3}).classify(ray, INFINITY);
    EXPECT_EQ(bounds.kind, RayClass::MustHit);
    EXPECT_NEAR(bounds.latest, 0.5, 1e-6);
    EXPECT_GT(bounds.latest, 0.5);
    EXPECT_EQ(pyramidOf({2, 1, 3}).classify(ray, 0.4).kind, RayClass::MustMiss);
    EXPECT_EQ(pyramidOf({2, 2, 3}).classify(ray, INFINITY).kind, RayClass::MustMiss);
    EXPECT_EQ(pyramidOf({2, 1, 3}).classify(makeRay({2.5F, 1.3F, 1.9F}, {2.0F, 0.0F, 0.0F}), INFINITY).kind,
              RayClass::MustMiss);
}

TEST(OracleRayBounds, RayAlongAnEdgeMayHitAllAroundIt)
{
    const Ray ray = makeRay({0.5F, 1.5F, 1.5F}, {1.0F, 0.0F, -0.0F});
    for (const glm::uvec3 voxel : {glm::uvec3(1, 1, 1), glm::uvec3(1, 2, 1), glm::uvec3(3, 1, 2), glm::uvec3(0, 2, 2)})
        EXPECT_EQ(pyramidOf(voxel).classify(ray, INFINITY).kind, RayClass::MayHit);
    EXPECT_EQ(pyramidOf({1, 1, 3}).classify(ray, INFINITY).kind, RayClass::MustMiss);
}

TEST(OracleRayBounds, NearestVoxelSetsTheTime)
{
    const std::uint64_t codes[] = {mortonEncode({1, 1, 3}), mortonEncode({3, 1, 3})};
    const BitPyramid pyramid(codes, kDepth);
    EXPECT_NEAR(pyramid.classify(makeRay({0.5F, 1.3F, 1.9F}, {1.0F, 0.0F, 0.0F}), INFINITY).latest, 0.75, 1e-5);
    EXPECT_NEAR(pyramid.classify(makeRay({2.5F, 1.3F, 1.9F}, {-1.0F, 0.0F, 0.0F}), INFINITY).latest, 0.5, 1e-5);
}

TEST(OracleRayBounds, ObjectsToWhatCannotBe)
{
    const BitPyramid pyramid = pyramidOf({2, 1, 3});
    const Ray ray = makeRay({0.5F, 1.3F, 1.9F}, {2.0F, 0.0F, 0.0F});
    EXPECT_FALSE(pyramid.objection(ray, INFINITY, {2, 1, 3}, 0.5F));
    EXPECT_TRUE(pyramid.objection(ray, INFINITY, {2, 1, 3}, 0.50001F));
    EXPECT_TRUE(pyramid.objection(ray, INFINITY, {2, 1, 3}, 0.49999F));
    EXPECT_TRUE(pyramid.objection(ray, 0.4, {2, 1, 3}, 0.5F));
    EXPECT_TRUE(pyramid.objection(ray, INFINITY, {1, 1, 3}, 0.375F)); // empty
    EXPECT_TRUE(pyramid.objection(makeRay({0.5F, 1.6F, 1.9F}, {2.0F, 0.0F, 0.0F}), INFINITY, {2, 1, 3}, 0.5F));
}

TEST(OracleRayBounds, RayWithNanOrInfinityMustMiss)
{
    Ray ray = makeRay({0.5F, 1.3F, 1.9F}, {2.0F, 0.0F, 0.0F});
    for (const float bad : {std::numeric_limits<float>::quiet_NaN(), INFINITY})
    {
        Ray broken = ray;
        broken.origin.y = bad;
        EXPECT_EQ(pyramidOf({2, 1, 3}).classify(broken, INFINITY).kind, RayClass::MustMiss);
        EXPECT_TRUE(pyramidOf({2, 1, 3}).objection(broken, INFINITY, {2, 1, 3}, 0.5F));
    }
}

TEST(OracleRayBounds, TheRuleStaysWithinThem)
{
    test::Random random(21);
    std::uniform_real_distribution<float> coordinate(0.5F, 2.5F);
    std::uniform_real_distribution<float> component(-1.0F, 1.0F);
    std::uint32_t count[3] = {};
    for (int i = 0; i < 30000; ++i)
    {
        std::vector<std::uint64_t> codes;
        for (int k = 0; k < 60; ++k)
            codes.push_back(static_cast<std::uint64_t>(test::pick(random, 0, 511)));
        glm::vec3 origin(coordinate(random), coordinate(random), coordinate(random));
        glm::vec3 direction(component(random), component(random), component(random));
        if (i % 3 == 0) // from a corner of a voxel along few directions
            for (int axis = 0; axis < 3; ++axis)
            {
                origin[axis] = 1.0F + static_cast<float>(test::pick(random, -2, 18)) / 16.0F;
                direction[axis] = static_cast<float>(test::pick(random, -2, 2));
            }
        if (i % 3 == 1) // from far away
            origin -= direction * 1e4F;
        const Ray ray = makeRay(origin, direction, 1e-30F);
        const BitPyramid pyramid(codes, 3);
        const RayBounds bounds = pyramid.classify(ray, INFINITY);
        const std::optional<Hit> hit = traceBruteForce(codes, 3, ray);
        ++count[static_cast<int>(bounds.kind)];
        if (hit)
        {
            ASSERT_NE(bounds.kind, RayClass::MustMiss) << i;
            ASSERT_EQ(pyramid.objection(ray, INFINITY, mortonDecode(hit->code), hit->t), std::nullopt) << i;
        }
        if (bounds.kind == RayClass::MustHit)
        {
            ASSERT_TRUE(hit) << i;
            ASSERT_LE(static_cast<double>(hit->t), bounds.latest) << i;
        }
    }
    for (const std::uint32_t kind : count)
        EXPECT_GT(kind, 500U);
}

} // namespace
} // namespace zvo::oracle
