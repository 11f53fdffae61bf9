// SPDX-License-Identifier: MIT
#include "oracle/winding.h"

#include "oracle/test_scenes.h"

#include <gtest/gtest.h>

namespace zvo::oracle
{
namespace
{

/// The closed surface of |x - c| + |y - c| + |z - c| <= radius: eight triangles.
std::vector<Triangle> octahedron(const Vec& center, Int128 radius, bool inside_out = false)
{
    std::vector<Triangle> triangles;
    for (int octant = 0; octant < 8; ++octant)
    {
        Triangle triangle = {center, center, center};
        for (std::size_t axis = 0; axis < 3; ++axis)
            triangle[axis][axis] += (octant >> axis & 1) != 0 ? -radius : radius;
        const bool odd = ((octant ^ octant >> 1 ^ octant >> 2) & 1) != 0;
        if (odd != inside_out)
            std::swap(triangle[1], triangle[2]);
        triangles.push_back(triangle);
    }
    return triangles;
}

/// Compares with the octahedron's inequality wherever the centre is not on the surface; returns how many are inside.
std::size_t expectOctahedron(const Vec& center, Int128 radius, std::uint32_t resolution)
{
    const std::vector<Triangle> triangles = octahedron(center, radius);
    EXPECT_TRUE(isClosed(triangles));
    const std::vector<std::int16_t> winding = windingNumbers(triangles, resolution);
    std::size_t i = 0;
    std::size_t inside_count = 0;
    for (const glm::uvec3& voxel : test::allVoxels(resolution))
    {
        const Vec offset = voxelBox(voxel, voxel).low - Vec{-128, -128, -128} - center;
        const Int128 distance = absolute(offset[0]) + absolute(offset[1]) + absolute(offset[2]);
        inside_count += distance < radius ? 1 : 0;
        if (distance != radius)
        {
            EXPECT_EQ(winding[i], distance < radius ? 1 : 0) << voxel.x << " " << voxel.y << " " << voxel.z;
        }
        ++i;
    }
    return inside_count;
}

TEST(OracleWinding, IsOneInsideAnOctahedronWhoseEdgesAndCornersStandOnColumns)
{
    // Sums of three distances in voxels: below 3 there are 1 + 6 + 18 centres.
    const Vec center{4 * 256 + 128, 4 * 256 + 128, 4 * 256 + 128};
    EXPECT_EQ(expectOctahedron(center, 3 * 256, 10), 25U);
    EXPECT_EQ(expectOctahedron(center, 3 * 256 - 64, 10), 25U);
    expectOctahedron({4 * 256, 4 * 256, 4 * 256}, 3 * 256, 10);
}

TEST(OracleWinding, IsOneInsideAnOctahedronAnywhereAlsoPartlyOutsideOfTheGrid)
{
    test::Random random(1);
    std::size_t inside_count = 0;
    for (int i = 0; i < 200; ++i)
        inside_count += expectOctahedron(test::pickPoint(random, 0, 10 * 256), test::pick(random, 300, 2000), 10);
    EXPECT_GT(inside_count, 2000U);
}

// Beside a centre that is not on the surface is what is at the centre.
TEST(OracleWinding, BesideCentresIsThatOfCentresAndDecidesThoseOnTheSurface)
{
    test::Random random(2);
    for (int i = 0; i < 100; ++i)
    {
        const Vec center = test::pickPoint(random, 0, 10 * 256);
        const Int128 radius = test::pick(random, 300, 2000);
        const std::vector<Triangle> triangles = octahedron(center, radius);
        const std::vector<std::int16_t> winding = windingsBesideCentres(triangles, 10);
        std::size_t number = 0;
        for (const glm::uvec3& voxel : test::allVoxels(10))
        {
            const Vec offset = voxelBox(voxel, voxel).low - Vec{-128, -128, -128} - center;
            const Int128 distance = absolute(offset[0]) + absolute(offset[1]) + absolute(offset[2]);
            if (distance != radius)
            {
                EXPECT_EQ(winding[number], distance < radius ? 1 : 0);
            }
            ++number;
        }
    }
    // The corners of this octahedron are centres, which move along x by most.
    const std::vector<std::int16_t> winding =
        windingsBesideCentres(octahedron({4 * 256 + 128, 4 * 256 + 128, 4 * 256 + 128}, 2 * 256), 10);
    const auto at = [&](std::size_t x, std::size_t y, std::size_t z) { return winding[x + 10 * (y + 10 * z)]; };
    EXPECT_EQ(at(2, 4, 4), 1);
    EXPECT_EQ(at(6, 4, 4), 0);
    EXPECT_EQ(at(3, 3, 4), 1); // on an edge: x and y are both below
    EXPECT_EQ(at(5, 3, 4), 0); // x moves out farther than y moves in
    EXPECT_EQ(at(4, 2, 4), 0); // the corner below: x moves out of it
}

TEST(OracleWinding, AddsUpOverSurfaces)
{
    const Vec center{2000, 2000, 2000};
    std::vector<Triangle> triangles = octahedron(center, 1900);
    const std::vector<Triangle> inner = octahedron(center, 900);
    triangles.insert(triangles.end(), inner.begin(), inner.end());
    EXPECT_EQ(windingNumbers(triangles, 16)[7 + 16 * (7 + 16 * 7)], 2);
    triangles = octahedron(center, 1900);
    const std::vector<Triangle> hole = octahedron(center, 900, true);
    triangles.insert(triangles.end(), hole.begin(), hole.end());
    EXPECT_EQ(windingNumbers(triangles, 16)[7 + 16 * (7 + 16 * 7)], 0);
    EXPECT_EQ(windingNumbers(triangles, 16)[7 + 16 * (7 + 16 * 13)], 1);
}

TEST(OracleWinding, SurfaceWithAHoleOrATurnedTriangleIsNotClosed)
{
    std::vector<Triangle> triangles = octahedron({2000, 2000, 2000}, 900);
    EXPECT_TRUE(isClosed(triangles));
    std::swap(triangles[3][0], triangles[3][1]);
    EXPECT_FALSE(isClosed(triangles));
    triangles.erase(triangles.begin() + 3);
    EXPECT_FALSE(isClosed(triangles));
}

} // namespace
} // namespace zvo::oracle
