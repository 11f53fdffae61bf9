// SPDX-License-Identifier: MIT
#include "io/mesh/polygon_triangulator.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/gtc/quaternion.hpp>
#include <gtest/gtest.h>
#include <numeric>
#include <random>
#include <tuple>
#include <vector>

namespace zvo::test
{

namespace
{

using Lattice = glm::i64vec2;
using Outline = std::vector<Lattice>; // corners in sequence
using Triangles = std::vector<glm::uvec3>;

std::int64_t cross(const Lattice& a, const Lattice& b, const Lattice& c)
{
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

int signOf(std::int64_t value)
{
    return value > 0 ? 1 : value < 0 ? -1 : 0;
}

std::int64_t doubleArea(const Outline& outline)
{
    std::int64_t sum = 0;
    for (std::size_t i = 0; i < outline.size(); ++i)
    {
        sum += cross({0, 0}, outline[i], outline[(i + 1) % outline.size()]);
    }
    return sum;
}

bool crosses(const Lattice& a, const Lattice& b, const Lattice& c, const Lattice& d)
{
    return signOf(cross(a, b, c)) * signOf(cross(a, b, d)) < 0 && signOf(cross(c, d, a)) * signOf(cross(c, d, b)) < 0;
}

bool touches(const Lattice& a, const Lattice& b, const Lattice& point)
{
    return cross(a, b, point) == 0 && glm::all(glm::lessThanEqual(glm::min(a, b), point)) &&
           glm::all(glm::lessThanEqual(point, glm::max(a, b)));
}

/// Whether no edge crosses another one, and none touches a corner but its own two.
bool isSimple(const Outline& outline)
{
    const std::size_t count = outline.size();
    for (std::size_t i = 0; i < count; ++i)
    {
        const std::size_t next = (i + 1) % count;
        for (std::size_t j = 0; j < count; ++j)
        {
            if ((j != i && j != next && touches(outline[i], outline[next], outline[j])) ||
                crosses(outline[i], outline[next], outline[j], outline[(j + 1) % count]))
            {
                return false;
            }
        }
    }
    return true;
}

/// A random outline in which no two edges cross; they may touch. Each pair of edges that cross is exchanged for one
/// that does not, which makes the outline shorter.
Outline randomOutline(std::mt19937& random, std::size_t corner_count, std::int64_t size)
{
    Outline outline(corner_count);
    for (Lattice& corner : outline)
    {
        corner = {random() % size, random() % size};
    }
    for (bool again = true; again;)
    {
        again = false;
        for (std::size_t i = 0; i < corner_count; ++i)
        {
            for (std::size_t j = i + 2; j < corner_count; ++j)
            {
                if (crosses(outline[i], outline[i + 1], outline[j], outline[(j + 1) % corner_count]))
                {
                    std::reverse(outline.begin() + i + 1, outline.begin() + j + 1);
                    again = true;
                }
            }
        }
    }
    return outline;
}

Outline turned(Outline outline, std::size_t first, bool backwards)
{
    std::rotate(outline.begin(), outline.begin() + first, outline.end());
    if (backwards)
    {
        std::reverse(outline.begin(), outline.end());
    }
    return outline;
}

Triangles triangulate(const std::vector<glm::vec3>& positions)
{
    std::vector<std::uint32_t> vertices(positions.size());
    std::iota(vertices.begin(), vertices.end(), 0U);
    Triangles triangles;
    PolygonTriangulator().triangulate(positions, vertices, triangles);
    return triangles;
}

Triangles triangulate(const Outline& outline)
{
    std::vector<glm::vec3> positions;
    for (const Lattice& corner : outline)
    {
        positions.emplace_back(corner.x, corner.y, 0);
    }
    return triangulate(positions);
}

/// Twice the area of each triangle.
std::vector<std::int64_t> doubleAreas(const Outline& outline, const Triangles& triangles)
{
    std::vector<std::int64_t> areas;
    for (const glm::uvec3& triangle : triangles)
    {
        areas.push_back(cross(outline.at(triangle.x), outline.at(triangle.y), outline.at(triangle.z)));
    }
    return areas;
}

/// Triangles turn as the outline does, and their areas add up to its area. Only fans may have some without area.
void expectTurnAs(const Outline& outline, const Triangles& triangles)
{
    const int sign = signOf(doubleArea(outline));
    const bool fan =
        std::all_of(triangles.begin(), triangles.end(), [](const auto& triangle) { return triangle.x == 0; });
    std::int64_t sum = 0;
    for (const std::int64_t area : doubleAreas(outline, triangles))
    {
        EXPECT_TRUE(signOf(area) == sign || (fan && area == 0)) << area;
        sum += area;
    }
    EXPECT_EQ(sum, doubleArea(outline));
}

/// Whether a ray from the point to the right crosses the outline an odd number of times. The point lies on no line
/// through two corners.
bool isInside(const Outline& outline, const glm::dvec2& point)
{
    bool inside = false;
    for (std::size_t i = 0; i < outline.size(); ++i)
    {
        const glm::dvec2 a(outline[i]);
        const glm::dvec2 b(outline[(i + 1) % outline.size()]);
        if ((a.y > point.y) != (b.y > point.y))
        {
            inside ^= point.x < a.x + (point.y - a.y) / (b.y - a.y) * (b.x - a.x);
        }
    }
    return inside;
}

std::size_t coveringCount(const Outline& outline, const Triangles& triangles, const glm::dvec2& point)
{
    return std::count_if(triangles.begin(), triangles.end(),
                         [&](const glm::uvec3& triangle) {
                             return isInside({outline[triangle.x], outline[triangle.y], outline[triangle.z]}, point);
                         });
}

/// Compares with the rule of odd crossings at random points, whose coordinates no line through corners has.
void expectEvenOdd(const Outline& outline, const Triangles& triangles, std::int64_t size, std::mt19937& random)
{
    for (int i = 0; i < 20; ++i)
    {
        std::uniform_real_distribution<double> coordinate(0.0, static_cast<double>(size));
        const glm::dvec2 point(coordinate(random), coordinate(random));
        ASSERT_EQ(coveringCount(outline, triangles, point), isInside(outline, point) ? 1U : 0U)
            << point.x << " " << point.y;
    }
}

const Outline kL = {{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}}; // its notch lies on its diagonal

TEST(PolygonTriangulator, ConvexPolygonsBecomeFansAroundTheirFirstCorner)
{
    EXPECT_EQ(triangulate(Outline{{0, 0}, {1, 0}, {0, 1}}), (Triangles{{0, 1, 2}}));
    EXPECT_EQ(triangulate(Outline{{0, 0}, {0, 1}, {1, 1}, {1, 0}}), (Triangles{{0, 1, 2}, {0, 2, 3}}));
    EXPECT_EQ(triangulate(Outline{{0, 0}, {1, 0}, {2, 0}, {2, 2}, {0, 2}}),
              (Triangles{{0, 1, 2}, {0, 2, 3}, {0, 3, 4}}));
    EXPECT_EQ(triangulate(Outline{{0, 0}, {0, 0}, {1, 0}, {0, 1}}), (Triangles{{0, 1, 2}, {0, 2, 3}}));
    EXPECT_EQ(triangulate({{0, 0, 0}, {1, 0, 0.25F}, {1, 1, 0}, {0, 1, 0.25F}}), (Triangles{{0, 1, 2}, {0, 2, 3}}));
}

TEST(PolygonTriangulator, ConcaveFacesAreRightFromEveryCornerAndSide)
{
    for (const Outline& outline : {kL, Outline{{0, 0}, {4, 0}, {1, 1}, {0, 4}}})
    {
        for (int variant = 0; variant < 6 * 2 * 6 * 3; ++variant)
        {
            const Outline start = turned(outline, variant % outline.size(), variant / 6 % 2 != 0);
            const int axis = variant / 12 % 3;
            const float sign = variant / 36 % 2 != 0 ? -1.0F : 1.0F;
            const int tilt = variant / 72;
            std::vector<glm::vec3> positions;
            for (const Lattice& corner : start)
            {
                glm::vec3 position(0);
                position[axis] = static_cast<float>(corner.x);
                position[(axis + 1) % 3] = sign * static_cast<float>(corner.y);
                position[(axis + 2) % 3] = static_cast<float>(tilt * (corner.x - corner.y)) * 0.75F;
                positions.push_back(position);
            }
            const Triangles triangles = triangulate(positions);
            EXPECT_EQ(triangles.size(), outline.size() - 2) << variant;
            expectTurnAs(start, triangles);
        }
    }
}

TEST(PolygonTriangulator, RandomPolygonsAreFilledByTheEvenOddRule)
{
    std::mt19937 random(21); // NOLINT: the same polygons on every run
    std::size_t simple_count = 0;
    for (int i = 0; i < 10000; ++i)
    {
        const std::int64_t size = i % 2 == 0 ? 8 : 1000; // many corners touch edges in the small square
        const Outline outline = randomOutline(random, 4 + random() % 14, size);
        const Triangles triangles = triangulate(outline);
        if (isSimple(outline))
        {
            ++simple_count;
            ASSERT_EQ(triangles.size(), outline.size() - 2);
            expectTurnAs(outline, triangles);
        }
        expectEvenOdd(outline, triangles, size, random);
        ASSERT_FALSE(HasFailure()) << "polygon " << i;
    }
    EXPECT_GT(simple_count, 5000U);
    EXPECT_LT(simple_count, 9000U);
}

TEST(PolygonTriangulator, SlightlyBentPolygonsInAnyDirectionAreCutAsFlatOnes)
{
    std::mt19937 random(22); // NOLINT: the same polygons on every run
    std::normal_distribution<float> normal;
    for (int i = 0; i < 2000; ++i)
    {
        const Outline outline = randomOutline(random, 4 + random() % 14, 50);
        if (!isSimple(outline))
        {
            continue;
        }
        const glm::quat rotation =
            glm::normalize(glm::quat(normal(random), normal(random), normal(random), normal(random)));
        std::vector<glm::vec3> positions;
        for (const Lattice& corner : outline)
        {
            positions.push_back(rotation * glm::vec3(glm::vec2(corner), 0.005F * normal(random)) + glm::vec3(7, -3, 1));
        }
        const Triangles triangles = triangulate(positions);
        ASSERT_EQ(triangles.size(), outline.size() - 2);
        std::int64_t sum = 0;
        for (const std::int64_t area : doubleAreas(outline, triangles))
        {
            ASSERT_GE(area * signOf(doubleArea(outline)), 0) << i;
            sum += area;
        }
        ASSERT_EQ(sum, doubleArea(outline)) << i;
    }
}

TEST(PolygonTriangulator, EdgesThatAreWalkedTwiceAreBridgesOrSpikes)
{
    const Outline ring = {{0, 0}, {9, 0}, {9, 9}, {0, 9}, {0, 0}, {3, 3}, {3, 6}, {6, 6}, {6, 3}, {3, 3}};
    const Outline same_turn = {{0, 0}, {9, 0}, {9, 9}, {0, 9}, {0, 0}, {3, 3}, {6, 3}, {6, 6}, {3, 6}, {3, 3}};
    const Outline two_holes = {{0, 0}, {9, 0}, {9, 9}, {0, 9}, {0, 0}, {1, 1}, {1, 2}, {2, 2},
                               {2, 1}, {5, 5}, {5, 8}, {8, 8}, {8, 5}, {5, 5}, {2, 1}, {1, 1}};
    for (const auto& [outline, area, count] :
         {std::tuple(ring, 144, 8U), std::tuple(same_turn, 144, 8U), std::tuple(two_holes, 142, 14U)})
    {
        for (std::size_t start = 0; start < outline.size(); ++start)
        {
            const Triangles triangles = triangulate(turned(outline, start, start % 2 != 0));
            const std::vector<std::int64_t> areas = doubleAreas(turned(outline, start, start % 2 != 0), triangles);
            EXPECT_EQ(std::abs(std::accumulate(areas.begin(), areas.end(), std::int64_t{0})), area);
            EXPECT_EQ(triangles.size(), count);
        }
    }
    const Outline spikes = {{0, 0}, {4, 0}, {7, 0}, {4, 0}, {4, 4}, {2, 2}, {4, 4}, {0, 4}};
    const Outline spike_in_parts = {{0, 0}, {4, 0}, {4, 4}, {4, 9}, {4, 7}, {4, 8}, {4, 4}, {0, 4}};
    const Outline along_an_edge = {{0, 0}, {4, 0}, {4, 4}, {2, 4}, {2, 0}, {1, 0}, {1, 4}, {0, 4}};
    EXPECT_EQ(triangulate(spikes).size(), 2U);
    expectTurnAs(spikes, triangulate(spikes));
    EXPECT_EQ(triangulate(spike_in_parts).size(), 2U);
    expectTurnAs(spike_in_parts, triangulate(spike_in_parts));
    expectTurnAs(along_an_edge, triangulate(along_an_edge));
}

TEST(PolygonTriangulator, StraightAndRepeatedCornersCloseNoGaps)
{
    Outline outline;
    for (std::size_t side = 0; side < kL.size(); ++side)
    {
        const Lattice step = kL[(side + 1) % kL.size()] - kL[side];
        for (std::int64_t i = 0; i < 8; ++i)
        {
            outline.push_back(std::int64_t{8} * kL[side] + i * step);
        }
        outline.push_back(outline.back());
    }
    const Triangles triangles = triangulate(outline);
    EXPECT_EQ(triangles.size(), outline.size() - 6 - 2); // without the repeated corners
    expectTurnAs(outline, triangles);
}

/// A circle around a square hole; the bridge begins at the first corner.
Outline circleWithHole(std::size_t corner_count)
{
    const double radius = 1e9;
    Outline outline;
    for (std::size_t i = 0; i <= corner_count; ++i)
    {
        const double angle = 2 * M_PI * static_cast<double>(i % corner_count) / static_cast<double>(corner_count);
        // Coordinates that single precision has.
        outline.emplace_back(std::llround(radius * std::cos(angle) / 64) * 64,
                             std::llround(radius * std::sin(angle) / 64) * 64);
        outline.back() = Lattice(glm::vec2(outline.back()));
    }
    const std::int64_t half = std::int64_t{1} << 29U;
    for (const Lattice& corner :
         {Lattice(half, half), Lattice(half, -half), Lattice(-half, -half), Lattice(-half, half), Lattice(half, half)})
    {
        outline.push_back(corner);
    }
    return outline;
}

TEST(PolygonTriangulator, LargePolygonsKeepTheirHoles)
{
    for (const std::size_t corner_count : {20000U, 200000U}) // minutes if the time grew with the square
    {
        const Outline outline = circleWithHole(corner_count);
        const Triangles triangles = triangulate(outline);
        EXPECT_EQ(triangles.size(), outline.size() - 2);
        expectTurnAs(outline, triangles);
        EXPECT_EQ(coveringCount(outline, triangles, {1e8 + 0.3, 2e8 + 0.7}), 0U);
        EXPECT_EQ(coveringCount(outline, triangles, {7e8 + 0.3, 1e8 + 0.7}), 1U);
    }
}

TEST(PolygonTriangulator, JaggedOutlinesOfManyCornersAreExact)
{
    std::mt19937 random(23); // NOLINT: the same polygon on every run
    Outline comb;
    for (std::int64_t i = 0; i < 100000; ++i)
    {
        comb.emplace_back(2 * i, -static_cast<std::int64_t>(random() % 1000000));
    }
    for (std::int64_t i = 100000; i > 0; --i)
    {
        comb.emplace_back(2 * i - 1, random() % 1000000);
    }
    const Triangles triangles = triangulate(comb);
    EXPECT_EQ(triangles.size(), comb.size() - 2);
    expectTurnAs(comb, triangles);
}

TEST(PolygonTriangulator, OutlinesThatCrossThemselvesByLittleHardlyChange)
{
    std::mt19937 random(24); // NOLINT: the same polygons on every run
    Outline outline = circleWithHole(20000);
    const double area = static_cast<double>(doubleArea(outline));
    for (int i = 0; i < 200; ++i)
    {
        const std::size_t at = random() % 19000;
        std::swap(outline[at], outline[at + 1]); // a loop
    }
    const std::vector<std::int64_t> areas = doubleAreas(outline, triangulate(outline));
    EXPECT_GE(*std::min_element(areas.begin(), areas.end()), 0);
    EXPECT_NEAR(static_cast<double>(std::accumulate(areas.begin(), areas.end(), std::int64_t{0})) / area, 1.0, 1e-5);
}

TEST(PolygonTriangulator, OutlinesThatCrossThemselvesBecomeTrianglesOfTheirCorners)
{
    const Triangles fan = {{0, 1, 2}, {0, 2, 3}};
    EXPECT_EQ(triangulate(Outline{{0, 0}, {4, 4}, {4, 0}, {0, 3}}), fan);
    EXPECT_EQ(triangulate(Outline{{0, 0}, {4, 4}, {4, 0}, {0, 4}}), fan); // both halves are as large
    std::mt19937 random(25);                                              // NOLINT: the same polygons on every run
    for (int i = 0; i < 2000; ++i)
    {
        std::vector<glm::vec3> positions(4 + random() % (i % 100 == 0 ? 500 : 20));
        for (glm::vec3& position : positions)
        {
            position = {random() % 16, random() % 16, random() % (i % 3 + 1)};
        }
        const Triangles triangles = triangulate(positions);
        EXPECT_LE(triangles.size(), 2 * positions.size());
        for (const glm::uvec3& triangle : triangles)
        {
            EXPECT_LT(std::max({triangle.x, triangle.y, triangle.z}), positions.size());
        }
    }
}

TEST(PolygonTriangulator, PolygonsWithoutAPlaneBecomeFans)
{
    const Triangles fan = {{0, 1, 2}, {0, 2, 3}};
    EXPECT_EQ(triangulate({{1, 2, 3}, {1, 2, 3}, {1, 2, 3}, {1, 2, 3}}), fan);
    EXPECT_EQ(triangulate({{0, 0, 0}, {1, 2, 3}, {2, 4, 6}, {3, 6, 9}}), fan);
    EXPECT_EQ(triangulate({{0, 0, 0}, {1, 0, 0}, {NAN, 1, 0}, {0, 1, 0}}), fan);
    EXPECT_EQ(triangulate({{0, 0, 0}, {1, 0, 0}, {INFINITY, 1, 0}, {0, 1, 0}}), fan);
    EXPECT_TRUE(triangulate({{0, 0, 0}, {1, 0, 0}}).empty());
    EXPECT_TRUE(triangulate(std::vector<glm::vec3>()).empty());
}

TEST(PolygonTriangulator, SizesMayBeThoseOfAnyNumber)
{
    for (const float scale : {1e-44F, 1e-38F, 1e-20F, 1.0F, 1e20F, 1e38F})
    {
        std::vector<glm::vec3> positions;
        for (const Lattice& corner : kL)
        {
            positions.push_back(scale * glm::vec3(corner.x, corner.x, corner.y));
        }
        const Triangles triangles = triangulate(positions);
        EXPECT_EQ(triangles.size(), 4U) << scale;
        expectTurnAs(kL, triangles);
    }
}

} // namespace

} // namespace zvo::test
