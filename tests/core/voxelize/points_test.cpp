// SPDX-License-Identifier: MIT
// Clouds of points against voxels that are computed here, in double precision.
#include "core/base/srgb.h"
#include "core/scene/points.h"
#include "core/upload/lost_parts.h"
#include "oracle/morton.h"
#include "runtime/trees.h"
#include "support/engine_device.h"
#include "support/octree_access.h"
#include "support/param_names.h"
#include "support/scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <string>
#include <vector>

namespace zvo
{
namespace
{

using test::device;

constexpr std::uint32_t kDepth = 5;
constexpr int kResolution = 1 << kDepth;

struct PointVoxel
{
    glm::dvec3 color{0.0}; // sums, linear
    glm::dvec3 normal{0.0};
    double count = 0.0;
};

struct Expected
{
    std::map<std::uint64_t, PointVoxel> voxels; // by Morton code
    std::map<std::string, std::uint64_t> dropped;
};

/// The voxels of a cloud on the grid of kResolution^3 voxels of edge 1 at 0, each point with its cube of size^3.
Expected expectedOf(const Primitive& cloud, int size)
{
    Expected expected;
    const auto cell_count = static_cast<std::uint64_t>(size) * size * size;
    for (std::size_t i = 0; i < cloud.positions.size(); ++i)
    {
        const glm::dvec3 point(cloud.positions[i]);
        const glm::dvec3 q = glm::dvec3(std::nearbyint(point.x * 256.0), std::nearbyint(point.y * 256.0),
                                        std::nearbyint(point.z * 256.0)) /
                             256.0;
        const glm::dvec3 size_of = glm::abs(point);
        const double largest = std::max({size_of.x, size_of.y, size_of.z});
        const bool is_finite = std::isfinite(point.x + point.y + point.z);
        const bool is_inside = std::min({q.x, q.y, q.z}) >= 0.0 && std::max({q.x, q.y, q.z}) <= kResolution;
        const char* const reason = !is_finite          ? "nonfinite"
                                   : largest > 1 << 21 ? "out_of_range"
                                   : !is_inside        ? "outside"
                                                       : nullptr;
        if (reason != nullptr)
        {
            expected.dropped[reason] += cell_count;
            continue;
        }
        const glm::dvec3 middle = glm::min(q, kResolution - 1.0 / 256.0) - 0.5 * (size - 1);
        const glm::ivec3 first(glm::floor(middle));
        for (int cell = 0; cell < size * size * size; ++cell)
        {
            const glm::ivec3 voxel = first + glm::ivec3(cell % size, cell / size % size, cell / size / size);
            if (std::min({voxel.x, voxel.y, voxel.z}) < 0 || std::max({voxel.x, voxel.y, voxel.z}) >= kResolution)
            {
                continue;
            }
            PointVoxel& sums = expected.voxels[oracle::mortonEncode(glm::uvec3(voxel))];
            sums.color += glm::dvec3(cloud.colors[i]);
            sums.normal += glm::dvec3(cloud.normals.empty() ? glm::vec3(0.0F) : cloud.normals[i]);
            sums.count += 1.0;
        }
    }
    return expected;
}

void expectAttributes(const std::map<std::uint64_t, PointVoxel>& voxels, const std::vector<gpu::Attribute>& attributes)
{
    ASSERT_EQ(attributes.size(), voxels.size());
    auto attribute = attributes.begin();
    for (const auto& [code, sums] : voxels)
    {
        for (int channel = 0; channel < 3; ++channel)
        {
            const double srgb = 255.0 * linearToSrgb(sums.color[channel] / sums.count);
            ASSERT_NEAR((attribute->color >> (8 * channel)) & 255U, srgb, 0.6) << code;
        }
        const double length = glm::length(sums.normal) / sums.count;
        if (length > 0.26)
        {
            ASSERT_LT(glm::distance(test::normalOf(*attribute), glm::normalize(sums.normal)), 1e-3) << code;
        }
        else if (length < 0.24)
        {
            ASSERT_EQ(attribute->normal, gpu::kNoNormal) << code;
        }
        ++attribute;
    }
}

void expectVoxels(Scene scene, int size, Coverage coverage)
{
    SCOPED_TRACE(size);
    const Expected expected = expectedOf(scene.primitives[0], size);
    widenPoints(scene, static_cast<std::uint32_t>(size));
    const BuildResult result = buildOctree(device(), uploadScene(device(), scene, true),
                                           Grid{glm::vec3(0.0F), 1.0F, kDepth}, {coverage, true, {}});
    std::vector<std::uint64_t> codes;
    std::ranges::transform(expected.voxels, std::back_inserter(codes), [](const auto& voxel) { return voxel.first; });
    ASSERT_EQ(voxelCodes(device(), result.octree), codes);
    EXPECT_EQ(result.dropped, expected.dropped);
    expectAttributes(expected.voxels, device().download(result.octree.voxel_attributes));
}

using Points = testing::TestWithParam<Coverage>;

INSTANTIATE_TEST_SUITE_P(Coverages, Points, testing::Values(Coverage::Conservative, Coverage::Thin),
                         test::paramName<Coverage>);

TEST_P(Points, HaveTheVoxelThatContainsThem)
{
    Scene scene = test::randomPoints(1, 4000, kResolution);
    std::vector<glm::vec3>& positions = scene.primitives[0].positions;
    positions[7].y = std::numeric_limits<float>::quiet_NaN();
    positions[8].x = 1e9F;
    for (const int size : {1, 2, 3})
    {
        expectVoxels(scene, size, GetParam());
    }
    scene.primitives[0].normals.clear();
    expectVoxels(scene, 1, GetParam());
}

TEST_P(Points, OnTheGridsFacesAreInside)
{
    Scene scene = test::randomPoints(1, 27, kResolution);
    for (int i = 0; i < 27; ++i)
    {
        scene.primitives[0].positions[i] = glm::vec3(i % 3, i / 3 % 3, i / 9) * (0.5F * kResolution);
    }
    EXPECT_TRUE(expectedOf(scene.primitives[0], 1).dropped.empty());
    expectVoxels(scene, 1, GetParam());
    expectVoxels(scene, 4, GetParam());
}

// By hand: a cube of two voxels reaches from the middle of a point to the nearer voxel on each axis.
TEST(PointCubes, LieAroundTheirPoints)
{
    Scene scene = test::randomPoints(1, 1, kResolution);
    scene.primitives[0].positions = {{3.25F, 4.75F, 5.5F}};
    widenPoints(scene, 2);
    const BuildResult result = buildOctree(device(), uploadScene(device(), scene, true),
                                           Grid{glm::vec3(0.0F), 1.0F, kDepth}, {Coverage::Thin, true, {}});
    std::vector<std::uint64_t> codes;
    for (std::uint32_t i = 0; i < 8; ++i)
    {
        codes.push_back(oracle::mortonEncode(glm::uvec3(2 + i % 2, 4 + i / 2 % 2, 5 + i / 4)));
    }
    std::ranges::sort(codes);
    EXPECT_EQ(voxelCodes(device(), result.octree), codes);
}

TEST(PointParts, AreNotLost)
{
    const PartCount parts = countParts(test::randomPoints(1, 100, kResolution), {glm::vec3(0.0F), 1.0F, kDepth});
    EXPECT_EQ(parts.lost, 0U);
}

// Instances move, turn and mirror points as they do triangles.
TEST(PointInstances, StandWhereTheirTransformsPutThem)
{
    Scene scene = test::randomPoints(4, 500, kResolution);
    Scene placed = scene;
    for (std::size_t i = 0; i < scene.primitives[0].positions.size(); ++i)
    {
        const glm::vec3 p = scene.primitives[0].positions[i];
        placed.primitives[0].positions[i] = 2.0F * glm::vec3(p.y - 4.0F, p.z, p.x); // exact
    }
    placed.instances[0].transform = {{0, 0.5F, 0, 0}, {0, 0, 0.5F, 0}, {0.5F, 0, 0, 0}, {0, 4, 0, 1}};
    std::vector<std::vector<std::uint64_t>> codes;
    for (const Scene& each : {scene, placed})
    {
        const BuildResult result = buildOctree(device(), uploadScene(device(), each, false),
                                               Grid{glm::vec3(0.0F), 1.0F, kDepth}, {Coverage::Thin, false, {}});
        codes.push_back(voxelCodes(device(), result.octree));
    }
    EXPECT_GT(codes[0].size(), 100U);
    EXPECT_EQ(codes[0], codes[1]);
}

} // namespace
} // namespace zvo
