// SPDX-License-Identifier: MIT
#include "oracle/coverage.h"

#include "oracle/morton.h"
#include "oracle/polygon_clip.h"
#include "oracle/test_scenes.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <set>

namespace zvo::oracle
{
namespace
{

using Key = std::array<std::uint32_t, 3>;
using Voxels = std::set<Key>;

Key key(const glm::uvec3& voxel)
{
    return {voxel.x, voxel.y, voxel.z};
}

Voxels covered(const Triangle& triangle, std::uint32_t resolution, Coverage coverage)
{
    Voxels voxels;
    forEachCoveredVoxel(triangle, resolution, coverage,
                        [&](const glm::uvec3& voxel)
                        { EXPECT_TRUE(voxels.insert(key(voxel)).second) << "visited twice"; });
    return voxels;
}

/// All voxels of the box first to last.
Voxels block(const glm::uvec3& first, const glm::uvec3& last)
{
    Voxels voxels;
    for (std::uint32_t z = first.z; z <= last.z; ++z)
        for (std::uint32_t y = first.y; y <= last.y; ++y)
            for (std::uint32_t x = first.x; x <= last.x; ++x)
                voxels.insert({x, y, z});
    return voxels;
}

Triangle scaled(const Triangle& triangle, Int128 factor)
{
    Triangle result = triangle;
    for (Vec& corner : result)
        for (Int128& coordinate : corner)
            coordinate *= factor;
    return result;
}

/// A triangle parallel to (x, y) at height z that covers all columns of a grid of resolution^3.
Triangle floorAt(std::int64_t z, std::uint32_t resolution)
{
    const std::int64_t end = std::int64_t{resolution} * kLatticeVoxel;
    return {Vec{-end, -end, z}, Vec{4 * end, -end, z}, Vec{-end, 4 * end, z}};
}

/// axes of each corner rotated: x to y, y to z, z to x.
Triangle rotated(const Triangle& triangle)
{
    Triangle result = triangle;
    for (Vec& corner : result)
        corner = {corner[2], corner[0], corner[1]};
    return result;
}

TEST(OracleConservative, PointInsideAVoxelCoversIt)
{
    const Vec p{300, 10, 700};
    EXPECT_EQ(covered({p, p, p}, 4, Coverage::Conservative), block({1, 0, 2}, {1, 0, 2}));
}

TEST(OracleConservative, PointOnACornerCoversAllEightVoxels)
{
    const Vec p{512, 512, 512};
    EXPECT_EQ(covered({p, p, p}, 4, Coverage::Conservative), block({1, 1, 1}, {2, 2, 2}));
}

TEST(OracleConservative, PointOnTheGridsCornersCoversTheCornerVoxels)
{
    const Vec low{0, 0, 0};
    const Vec high{1024, 1024, 1024};
    EXPECT_EQ(covered({low, low, low}, 4, Coverage::Conservative), block({0, 0, 0}, {0, 0, 0}));
    EXPECT_EQ(covered({high, high, high}, 4, Coverage::Conservative), block({3, 3, 3}, {3, 3, 3}));
    const Vec beyond{1025, 1024, 1024};
    EXPECT_EQ(covered({beyond, beyond, beyond}, 4, Coverage::Conservative), Voxels{});
}

TEST(OracleConservative, SegmentInsideARowCoversTheRow)
{
    EXPECT_EQ(covered({Vec{10, 100, 100}, Vec{600, 100, 100}, Vec{300, 100, 100}}, 4, Coverage::Conservative),
              block({0, 0, 0}, {2, 0, 0}));
}

TEST(OracleConservative, DiagonalSegmentThroughCornersTouchesTheirNeighbors)
{
    // From the middle of (0,0,0) to the middle of (1,1,0) through the edge that four voxels share.
    EXPECT_EQ(covered({Vec{128, 128, 128}, Vec{384, 384, 128}, Vec{128, 128, 128}}, 4, Coverage::Conservative),
              block({0, 0, 0}, {1, 1, 0}));
    // If it is moved by one unit, it does not touch the voxel across.
    const Voxels beside = covered({Vec{129, 128, 128}, Vec{385, 384, 128}, Vec{129, 128, 128}}, 4, //
                                  Coverage::Conservative);
    EXPECT_EQ(beside, (Voxels{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}));
}

TEST(OracleConservative, WallBetweenLayersCoversBoth)
{
    EXPECT_EQ(covered(floorAt(512, 4), 4, Coverage::Conservative), block({0, 0, 1}, {3, 3, 2}));
    EXPECT_EQ(covered(floorAt(513, 4), 4, Coverage::Conservative), block({0, 0, 2}, {3, 3, 2}));
}

TEST(OracleConservative, NeedleThroughVoxelsWithoutTouchingACenterCoversThem)
{
    const Voxels voxels = covered({Vec{1, 1, 1}, Vec{1023, 2, 1}, Vec{1023, 1, 2}}, 4, Coverage::Conservative);
    EXPECT_EQ(voxels, block({0, 0, 0}, {3, 0, 0}));
}

TEST(OracleConservative, AgreesWithClippingOnSmallTriangles)
{
    test::Random random(1);
    std::uint32_t overlapping = 0;
    for (int i = 0; i < 60000; ++i)
    {
        const std::int64_t spread = i % 3 == 0 ? 4 : i % 3 == 1 ? 12 : 40;
        const Triangle triangle = test::pickTriangle(random, -spread, spread);
        const Box box{{-3, -3, -3}, {3, 3, 3}};
        const bool expected = test::overlapsByClipping(triangle, box);
        overlapping += expected ? 1 : 0;
        ASSERT_EQ(overlaps(triangle, box), expected) << "case " << i;
        // The largest possible coordinates.
        const Int128 factor = Int128{1} << 23;
        const Vec corner{3 * factor, 3 * factor, 3 * factor};
        ASSERT_EQ(overlaps(scaled(triangle, factor), {Vec{0, 0, 0} - corner, corner}), expected) << "case " << i;
    }
    EXPECT_GT(overlapping, 10000U);
    EXPECT_LT(overlapping, 50000U);
}

TEST(OracleConservative, PruningChangesNothing)
{
    test::Random random(2);
    for (int i = 0; i < 300; ++i)
    {
        const Triangle triangle = test::pickTriangle(random, -600, 2600);
        Voxels expected;
        for (const glm::uvec3& voxel : test::allVoxels(8))
            if (overlaps(triangle, voxelBox(voxel, voxel)))
                expected.insert(key(voxel));
        ASSERT_EQ(covered(triangle, 8, Coverage::Conservative), expected) << "case " << i;
    }
}

TEST(OracleConservative, PruningChangesNothingForTrianglesOfAllSizes)
{
    // Above 2^18 units the arithmetic changes; at 2^29 numbers are largest.
    test::Random random(6);
    std::uint32_t count = 0;
    for (int i = 0; i < 500; ++i)
    {
        static constexpr std::array<std::int64_t, 5> kReaches{1 << 10, 1 << 16, (1 << 17) - 1, 1 << 18, 1 << 28};
        const std::int64_t reach = kReaches[static_cast<std::size_t>(i) % kReaches.size()];
        const Vec inside = test::pickPoint(random, 0, 8 * kLatticeVoxel);
        const Vec a = test::pickPoint(random, -reach, reach);
        const Vec b = i % 3 == 0 ? a - test::pickPoint(random, -9, 9) : test::pickPoint(random, -reach, reach);
        const Vec c = i % 7 == 0 ? Vec{0, 0, 0} : Vec{-(a[0] + b[0]) / 2, -(a[1] + b[1]) / 2, -(a[2] + b[2]) / 2};
        const Triangle triangle{inside - a, inside - b, inside - c};
        Voxels expected;
        for (const glm::uvec3& voxel : test::allVoxels(8))
            if (overlaps(triangle, voxelBox(voxel, voxel)))
                expected.insert(key(voxel));
        ASSERT_EQ(covered(triangle, 8, Coverage::Conservative), expected) << "case " << i;
        count += expected.empty() ? 0 : 1;
    }
    EXPECT_GT(count, 300U);
}

TEST(OracleThin, WallBetweenLayersBelongsToTheUpperOne)
{
    for (Triangle wall : {floorAt(512, 4), Triangle{floorAt(512, 4)[1], floorAt(512, 4)[0], floorAt(512, 4)[2]}})
    {
        EXPECT_EQ(covered(wall, 4, Coverage::Thin), block({0, 0, 2}, {3, 3, 2}));
        wall = rotated(wall);
        EXPECT_EQ(covered(wall, 4, Coverage::Thin), block({2, 0, 0}, {2, 3, 3}));
        wall = rotated(wall);
        EXPECT_EQ(covered(wall, 4, Coverage::Thin), block({0, 2, 0}, {3, 2, 3}));
    }
    EXPECT_EQ(covered(floorAt(511, 4), 4, Coverage::Thin), block({0, 0, 1}, {3, 3, 1}));
}

TEST(OracleThin, WallsInTheGridsFacesBelongToFirstAndLastLayer)
{
    EXPECT_EQ(covered(floorAt(0, 4), 4, Coverage::Thin), block({0, 0, 0}, {3, 3, 0}));
    EXPECT_EQ(covered(floorAt(1024, 4), 4, Coverage::Thin), block({0, 0, 3}, {3, 3, 3}));
    EXPECT_EQ(covered(floorAt(1025, 4), 4, Coverage::Thin), Voxels{});
}

TEST(OracleThin, SlopeThatReachesTheUpperFaceAtAColumnsCenterIsNotInTheLastLayer)
{
    // Height 960 + x / 2: 1024 at the first column's centre.
    const Triangle slope{Vec{0, 0, 960}, Vec{512, 0, 1216}, Vec{0, 512, 960}};
    EXPECT_FALSE(coversThin(slope, {0, 0, 3}, 4));
    EXPECT_TRUE(coversThin(slope, {0, 0, 4}, 8));
}

TEST(OracleThin, TriangleWithoutAreaCoversNothing)
{
    EXPECT_EQ(covered({Vec{0, 0, 0}, Vec{500, 500, 500}, Vec{1000, 1000, 1000}}, 4, Coverage::Thin), Voxels{});
    EXPECT_EQ(covered({Vec{100, 100, 100}, Vec{100, 100, 100}, Vec{100, 100, 100}}, 4, Coverage::Thin), Voxels{});
}

TEST(OracleThin, DiagonalWallHasOneVoxelPerColumnWhereConservativeHasThree)
{
    // The plane x = z; x is the major axis by the order of axes.
    const Triangle wall{Vec{-2000, -9000, -2000}, Vec{-2000, 9000, -2000}, Vec{9000, 0, 9000}};
    Voxels diagonal;
    Voxels touched;
    for (const glm::uvec3& voxel : test::allVoxels(4))
    {
        if (voxel.x == voxel.z)
            diagonal.insert(key(voxel));
        if (voxel.x <= voxel.z + 1 && voxel.z <= voxel.x + 1)
            touched.insert(key(voxel));
    }
    EXPECT_EQ(covered(wall, 4, Coverage::Thin), diagonal);
    EXPECT_EQ(covered(wall, 4, Coverage::Conservative), touched);
}

TEST(OracleThin, MajorAxisOfEqualOnesIsTheFirst)
{
    // The plane x = z + 128. Along x its heights are 256 (z + 1), at the lower end of voxel z + 1; along z the voxels
    // with x = z would be covered.
    const Triangle wall{Vec{-2000, -9000, -2128}, Vec{-2000, 9000, -2128}, Vec{9128, 0, 9000}};
    Voxels expected;
    for (const glm::uvec3& voxel : test::allVoxels(4))
        if (voxel.x == voxel.z + 1)
            expected.insert(key(voxel));
    EXPECT_EQ(covered(wall, 4, Coverage::Thin), expected);
}

TEST(OracleThin, SmallTriangleCoversTheVoxelWhoseDiamondItReaches)
{
    // In the corner of the voxel, away from the diamond.
    EXPECT_EQ(covered({Vec{5, 5, 100}, Vec{25, 5, 100}, Vec{5, 25, 100}}, 4, Coverage::Thin), Voxels{});
    // Its long edge x + y = 127, then 128, touches the diamond's side.
    EXPECT_EQ(covered({Vec{0, 0, 100}, Vec{127, 0, 100}, Vec{0, 127, 100}}, 4, Coverage::Thin), Voxels{});
    EXPECT_EQ(covered({Vec{0, 0, 100}, Vec{128, 0, 100}, Vec{0, 128, 100}}, 4, Coverage::Thin),
              block({0, 0, 0}, {0, 0, 0}));
}

TEST(OracleThin, EdgeConditionIsTheDistanceFromTheDiamond)
{
    // The rule written in another way: for each edge, a corner of the diamond around C lies on its inner side.
    test::Random random(3);
    std::uint32_t count = 0;
    for (int i = 0; i < 20000; ++i)
    {
        const Triangle triangle = test::pickTriangle(random, -700, 1200);
        const Vec normal = normalOf(triangle);
        const std::size_t w = majorAxis(normal);
        bool expected = normal != Vec{0, 0, 0};
        for (std::size_t axis = 0; axis < 3; ++axis)
        {
            const auto [low, high] = std::minmax({triangle[0][axis], triangle[1][axis], triangle[2][axis]});
            expected = expected && low <= 256 && high >= 0;
        }
        // The plane passes between the column's ends: normal . (P - V0) changes its sign there.
        Vec bottom{128, 128, 128};
        bottom[w] = 0;
        Vec top = bottom;
        top[w] = 256;
        const Int128 at_bottom = dot(normal, bottom - triangle[0]);
        const Int128 at_top = dot(normal, top - triangle[0]);
        expected = expected && (at_bottom == 0 || (at_bottom < 0) != (at_top < 0)) && at_top != 0;
        for (std::size_t a = 0; a < 3 && expected; ++a)
        {
            const std::size_t b = (a + 1) % 3;
            const Int128 turn = normal[(a + 2) % 3] < 0 ? -1 : 1;
            for (std::size_t from = 0; from < 3; ++from)
            {
                const std::size_t to = (from + 1) % 3;
                bool reached = false;
                for (const auto& [da, db] : {std::pair{-128, 0}, {128, 0}, {0, -128}, {0, 128}})
                {
                    const Int128 p_a = 128 + da - triangle[from][a];
                    const Int128 p_b = 128 + db - triangle[from][b];
                    const Int128 e_a = triangle[to][a] - triangle[from][a];
                    const Int128 e_b = triangle[to][b] - triangle[from][b];
                    reached = reached || turn * (e_a * p_b - e_b * p_a) >= 0;
                }
                expected = expected && reached;
            }
        }
        ASSERT_EQ(coversThin(triangle, {0, 0, 0}, 4), expected) << "case " << i;
        count += expected ? 1 : 0;
    }
    EXPECT_GT(count, 1000U);
}

TEST(OracleThin, IsASubsetOfConservative)
{
    test::Random random(4);
    for (int i = 0; i < 2000; ++i)
    {
        // Multiples of 32 meet voxel borders, corners and centres often.
        const std::int64_t step = i % 2 == 0 ? 1 : 32;
        const std::int64_t reach = i % 5 == 0 ? 6000 : 1200;
        const Triangle triangle = scaled(test::pickTriangle(random, -200 / step, reach / step), step);
        Voxels thin;
        for (const glm::uvec3& voxel : test::allVoxels(4))
        {
            if (!coversThin(triangle, voxel, 4))
                continue;
            thin.insert(key(voxel));
            ASSERT_TRUE(overlaps(triangle, voxelBox(voxel, voxel))) << "case " << i;
        }
        ASSERT_EQ(covered(triangle, 4, Coverage::Thin), thin) << "case " << i;
    }
}

TEST(OracleThin, PlaneSeparatesUncoveredNeighbors)
{
    test::Random random(5);
    for (int i = 0; i < 300; ++i)
    {
        // A triangle that cuts the whole grid, in a plane through three points of the grid.
        const std::int64_t step = i % 2 == 0 ? 1 : 128;
        const Triangle inner = scaled(test::pickTriangle(random, 0, 2048 / step), step);
        const Vec normal = normalOf(inner);
        if (absolute(normal[majorAxis(normal)]) < 4000) // too slim for this test
            continue;
        const Vec center = inner[0];
        const Vec u = inner[1] - center;
        const Vec v = inner[2] - center;
        Triangle plane{};
        for (std::size_t axis = 0; axis < 3; ++axis)
        {
            const Int128 far = 4000;
            plane[0][axis] = center[axis] - far * (u[axis] + v[axis]);
            plane[1][axis] = center[axis] + far * (2 * u[axis] - v[axis]);
            plane[2][axis] = center[axis] + far * (2 * v[axis] - u[axis]);
        }
        const auto side = [&](const glm::uvec3& voxel)
        {
            const Int128 d = dot(normal, voxelBox(voxel, voxel).low - Vec{-128, -128, -128} - center);
            return d < 0 ? -1 : d > 0 ? 1 : 0;
        };
        const Voxels voxels = covered(plane, 8, Coverage::Thin);
        for (const glm::uvec3& voxel : test::allVoxels(8))
        {
            if (voxels.contains(key(voxel)))
                continue;
            ASSERT_NE(side(voxel), 0) << "case " << i;
            for (int axis = 0; axis < 3; ++axis)
            {
                glm::uvec3 next = voxel;
                ++next[axis];
                const bool uncovered = next[axis] < 8 && !voxels.contains(key(next));
                ASSERT_TRUE(!uncovered || side(voxel) == side(next)) << "case " << i;
            }
        }
    }
}

} // namespace
} // namespace zvo::oracle
