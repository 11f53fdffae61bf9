// SPDX-License-Identifier: MIT
#include "core/upload/lost_parts.h"

#include "oracle/snap.h"
#include "support/scenes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

namespace zvo::test
{

namespace
{

const Grid kGrid = {glm::vec3(0.0F), 1.0F, 5};

/// Expects of a triangle on its own what the oracle's voxels say.
void expectAsOracle(const std::array<glm::vec3, 3>& corners, std::uint64_t& lost_count)
{
    const Grid& grid = kGrid;
    const oracle::SnappedTriangle snapped =
        oracle::snapTriangle(corners, glm::mat4(1.0F), grid, Coverage::Conservative);
    std::uint64_t voxel_count = 0;
    if (snapped.dropped == nullptr &&
        oracle::snapTriangle(corners, glm::mat4(1.0F), grid, Coverage::Thin).dropped == nullptr)
    {
        oracle::forEachCoveredVoxel(snapped.triangle, grid.resolution(), Coverage::Thin,
                                    [&](const glm::uvec3&) { ++voxel_count; });
    }
    const PartCount count = countParts(triangleSoup({corners.begin(), corners.end()}), grid);
    EXPECT_EQ(count.parts, snapped.dropped == nullptr ? 1U : 0U);
    EXPECT_EQ(count.lost, snapped.dropped == nullptr && voxel_count == 0 ? 1U : 0U)
        << testing::PrintToString(corners[0].x) << " " << corners[0].y << " " << corners[0].z << ", " << corners[1].x
        << " " << corners[1].y << " " << corners[1].z << ", " << corners[2].x << " " << corners[2].y << " "
        << corners[2].z;
    lost_count += count.lost;
}

TEST(LostParts, AreThoseToWhichTheThinRuleGivesNoVoxel)
{
    std::mt19937 random(5); // NOLINT: the same triangles on every run
    const auto uniform = [&](float low, float high)
    { return std::uniform_real_distribution<float>(low, high)(random); };
    const auto point = [&](float low, float high)
    {
        const float x = uniform(low, high);
        const float y = uniform(low, high);
        return glm::vec3(x, y, uniform(low, high));
    };
    constexpr int kTriangles = 6000;
    std::uint64_t lost_count = 0;
    for (int i = 0; i < kTriangles; ++i)
    {
        const glm::vec3 place = point(-2.0F, 34.0F);
        const float size = std::exp2(uniform(-7.0F, 3.0F));
        std::array<glm::vec3, 3> corners = {place, place + point(-size, size), place + point(-size, size)};
        switch (i % 4)
        {
        case 0: // a needle
            corners[2] = corners[1] + point(-0.01F, 0.01F);
            break;
        case 1: // flat, half of them between two layers
            corners[0][i % 3] = corners[1][i % 3] = corners[2][i % 3] = std::round(2.0F * place[i % 3]) / 2.0F;
            break;
        default:
            break;
        }
        expectAsOracle(corners, lost_count);
    }
    EXPECT_GT(lost_count, kTriangles / 20);
    EXPECT_LT(lost_count, kTriangles / 2);
}

TEST(LostParts, TrianglesAreAPartWhereTheyShareAPlace)
{
    // A rod of two triangles that is thinner than the lattice, and one of them again with vertices of its own.
    const std::vector<glm::vec3> rod = {{0.6F, 3.5F, 3.5F}, {9.0F, 3.5F, 3.5F},    {9.0F, 3.5001F, 3.5F},
                                        {0.6F, 3.5F, 3.5F}, {9.0F, 3.5001F, 3.5F}, {0.6F, 3.5001F, 3.5F}};
    Scene scene = triangleSoup(rod);
    PartCount count = countParts(scene, kGrid);
    EXPECT_EQ(count.parts, 1U);
    EXPECT_EQ(count.lost, 1U);
    // One corner of it reaches a triangle that has voxels: now they are one part, and nothing is lost.
    scene.primitives[0].positions.insert(scene.primitives[0].positions.end(),
                                         {{9.0F, 3.5F, 3.5F}, {12.0F, 3.5F, 3.5F}, {9.0F, 9.5F, 3.5F}});
    scene.primitives[0].triangles.emplace_back(6, 7, 8);
    count = countParts(scene, kGrid);
    EXPECT_EQ(count.lost, 0U);
    // Each instance is there on its own: one is as large as before, one tiny, one outside.
    scene.instances.resize(3);
    scene.instances[1].transform = glm::mat4(0.01F);
    scene.instances[1].transform[3] = glm::vec4(4.01F, 4.01F, 4.01F, 1.0F);
    scene.instances[2].transform[3].x = 1000.0F;
    count = countParts(scene, kGrid);
    EXPECT_EQ(count.parts, 2U);
    EXPECT_EQ(count.lost, 1U);
}

} // namespace

} // namespace zvo::test
