// SPDX-License-Identifier: MIT
// Sparse grids of depth 13 to 17, with brick keys of two words, lattice coordinates up to 2^25, and long rows.
#include "oracle/morton.h"
#include "runtime/octree_sha256.h"
#include "runtime/trees.h"
#include "support/engine_device.h"
#include "support/octree_access.h"
#include "support/param_names.h"
#include "support/same_bytes.h"
#include "support/scenes.h"
#include "support/trace_rays.h"
#include "support/voxel_compare.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <random>
#include <vector>

namespace zvo
{
namespace
{

using test::device;

Grid unitGrid(std::uint32_t depth)
{
    return {.origin = glm::vec3(0.0F), .voxel_size = 1.0F, .depth = depth};
}

/// Small triangles of all shapes, from a 64th of a voxel to 60 voxels: all over the grid, along its faces, and in its
/// first and last corner.
Scene scatteredTriangles(std::uint32_t depth, std::size_t count)
{
    std::mt19937 random(depth);
    const auto uniform = [&](float low, float high)
    { return std::uniform_real_distribution<float>(low, high)(random); };
    const auto point = [&](float size)
    { return glm::vec3(uniform(-size, size), uniform(-size, size), uniform(-size, size)); };
    const float end = std::ldexp(1.0F, static_cast<int>(depth));
    std::vector<glm::vec3> corners;
    for (std::size_t i = 0; i < count; ++i)
    {
        glm::vec3 center = point(end / 2) + glm::vec3(end / 2);
        if (i % 4 == 1)
        {
            center[static_cast<int>(random() % 3)] = i % 8 == 1 ? 0.0F : end;
        }
        if (i % 4 == 2)
        {
            center = glm::vec3(i % 8 == 2 ? 0.0F : end) + point(20.0F);
        }
        const float size = std::exp2(uniform(-6.0F, 5.0F));
        glm::vec3 triangle[3] = {center + point(size), center + point(size), center + point(size)};
        if (i % 5 == 3) // a sliver
        {
            triangle[2] = (triangle[0] + triangle[1]) * 0.5F + point(0.02F);
        }
        if (i % 5 == 4) // on whole units, in a plane of the grid
        {
            for (glm::vec3& corner : triangle)
            {
                corner = glm::round(corner);
                corner[static_cast<int>(i % 3)] = std::round(center[static_cast<int>(i % 3)]);
            }
        }
        corners.insert(corners.end(), std::begin(triangle), std::end(triangle));
    }
    return test::triangleSoup(corners);
}

/// Needles, less than a voxel thick, that reach beyond both ends of the grid, and a segment from corner to corner.
Scene needles(std::uint32_t depth, std::size_t count)
{
    const float end = std::ldexp(1.0F, static_cast<int>(depth));
    const std::vector<std::vector<glm::vec3>> all = {
        {{0.3F, 1.7F, 0.1F}, {end - 0.2F, end - 1.6F, end - 0.9F}, {end - 0.7F, end - 0.6F, end - 0.4F}},
        {{-30.0F, 77.5F, end - 0.5F}, {end + 9.0F, 77.0F, end - 0.25F}, {end + 9.0F, 77.75F, end + 0.5F}},
        {{end, 0.0F, end / 2}, {0.0F, end, end / 3}, {0.5F, end, end / 3}},
        {{5.0F, 6.0F, 0.0F}, {5.0F, 6.0F, end}, {5.5F, 6.5F, end}},
        {{end - 3, end, end / 7}, {1.5F, -9.0F, end / 2}, {2.0F, -9.5F, end / 2}},
        {{0.0F, end, 3.25F}, {end / 5, 0.0F, 9.5F}, {end / 5, 1.0F, 8.5F}}};
    std::vector<glm::vec3> corners;
    for (std::size_t i = 0; i < count; ++i)
    {
        corners.insert(corners.end(), all.at(i).begin(), all.at(i).end());
    }
    corners.insert(corners.end(), {{1.25F, end - 2, 3.5F}, {end - 4, 3.0F, end - 1}, {end - 4, 3.0F, end - 1}});
    return test::triangleSoup(corners);
}

/// Triangles as large as millions of voxels, which meet the grid only in its corners.
Scene cutCorners(std::uint32_t depth)
{
    const float end = std::ldexp(1.0F, static_cast<int>(depth));
    const auto onPlane = [](float x, float y, float sum) { return glm::vec3(x, y, sum - x - y); };
    std::vector<glm::vec3> corners;
    for (const float sum : {40.0F, 3 * end - 40.0F})
    {
        const float middle = sum / 3;
        corners.insert(corners.end(),
                       {onPlane(middle + 1.2e6F, middle - 5e5F, sum), onPlane(middle - 6e5F, middle + 1.1e6F, sum),
                        onPlane(middle - 6e5F, middle - 6e5F, sum)});
    }
    // The corner of a long triangle, the rest of which lies outside.
    corners.insert(corners.end(), {{end - 9, end - 7, end - 5}, {2e6F, 1.9e6F, end}, {1.9e6F, 2e6F, 1.5e6F}});
    return test::triangleSoup(corners);
}

/// Corners of long triangles, the rest of which lies outside: edges of 2^18 voxels, up to which a tile is 4x4 columns,
/// and a few lattice units more and less.
Scene cornersAtTheTileLimit(std::uint32_t depth)
{
    const float end = std::ldexp(1.0F, static_cast<int>(depth));
    const float limit = static_cast<float>(gpu::kTileExtent) / gpu::kVoxelLattice;
    std::vector<glm::vec3> corners;
    for (const float length : {limit - 1.0F / 32, limit, limit + 1.0F / 32})
    {
        for (int axis = 0; axis < 3; ++axis)
        {
            const glm::vec3 near(end - 40.0F - 20.0F * static_cast<float>(axis));
            glm::vec3 far = near + glm::vec3(0.3F, 0.7F, 0.9F) * length;
            far[axis] = near[axis] + length;
            glm::vec3 other = near + glm::vec3(0.8F, 0.1F, 0.5F) * length;
            other[(axis + 1) % 3] = near[(axis + 1) % 3] - length;
            corners.insert(corners.end(), {near, far, other});
        }
    }
    return test::triangleSoup(corners);
}

struct DeepCase
{
    std::uint32_t depth;
    Coverage coverage;
};

void PrintTo(const DeepCase& test_case, std::ostream* out)
{
    *out << "depth " << test_case.depth << ", " << test::nameOf(test_case.coverage);
}

using DeepGrid = testing::TestWithParam<DeepCase>;

std::vector<DeepCase> deepCases()
{
    std::vector<DeepCase> cases;
    for (std::uint32_t depth = 13; depth <= Grid::kDepthMax; ++depth)
    {
        cases.push_back({depth, Coverage::Thin});
        cases.push_back({depth, Coverage::Conservative});
    }
    return cases;
}

INSTANTIATE_TEST_SUITE_P(Depths, DeepGrid, testing::ValuesIn(deepCases()),
                         [](const auto& test_case)
                         { return std::to_string(test_case.param.depth) + test::nameOf(test_case.param.coverage); });

TEST_P(DeepGrid, ScatteredTrianglesEqualTheOracle)
{
    const auto [depth, coverage] = GetParam();
    const std::size_t voxel_count =
        test::expectEqualsOracle(device(), scatteredTriangles(depth, 2049), unitGrid(depth), coverage);
    EXPECT_GT(voxel_count, 30000U);
}

TEST_P(DeepGrid, NeedlesFromEndToEndEqualTheOracle)
{
    const auto [depth, coverage] = GetParam();
    const std::size_t count = depth == 13 ? 6 : depth == 14 ? 4 : 2;
    const std::size_t voxel_count =
        test::expectEqualsOracle(device(), needles(depth, count), unitGrid(depth), coverage);
    EXPECT_GT(voxel_count, count << depth);
}

TEST_P(DeepGrid, HugeTrianglesThatCutCornersEqualTheOracle)
{
    const auto [depth, coverage] = GetParam();
    const std::size_t voxel_count = test::expectEqualsOracle(device(), cutCorners(depth), unitGrid(depth), coverage);
    EXPECT_GT(voxel_count, 1000U);
}

TEST_P(DeepGrid, CornersOfTrianglesAtTheLimitOf32BitTilesEqualTheOracle)
{
    const auto [depth, coverage] = GetParam();
    const std::size_t voxel_count =
        test::expectEqualsOracle(device(), cornersAtTheTileLimit(depth), unitGrid(depth), coverage);
    EXPECT_GT(voxel_count, 1000U);
}

TEST(DeepGrids, CrampedBuffersGiveTheSameOctree)
{
    const Grid grid = unitGrid(17);
    const GpuScene scene = uploadScene(device(), scatteredTriangles(17, 600), true);
    const BuildResult roomy = buildOctree(device(), scene, grid, {Coverage::Thin, true, {}});
    const BuildResult cramped =
        buildOctree(device(), scene, grid, {Coverage::Thin, true, VoxelizeCapacities{1, 1, 1, 1, 1}});
    EXPECT_GT(cramped.retry_count, 2U);
    EXPECT_EQ(octreeSha256(device(), cramped.octree), octreeSha256(device(), roomy.octree));
}

TEST(DeepGrids, VoxelsAFewThousandApartShareWordsOfTheirKeysAndStayApart)
{
    // Bricks at multiples of 1024 bricks have equal lower words; those of one block have equal upper words.
    std::vector<std::uint64_t> expected;
    std::vector<glm::vec3> corners;
    const auto add = [&](const glm::uvec3& voxel)
    {
        const glm::vec3 at = glm::vec3(voxel) + 0.25F;
        expected.push_back(oracle::mortonEncode(voxel));
        for (int i = 0; i < 3; ++i) // several triangles in each
        {
            corners.insert(corners.end(), {at, at + glm::vec3(0.5F, 0.0F, 0.0F), at + glm::vec3(0.0F, 0.5F, 0.5F)});
        }
    };
    for (std::uint32_t i = 0; i < 32 * 32 * 32; ++i)
    {
        const glm::uvec3 cell(i % 32, i / 32 % 32, i / 1024);
        add(4096U * cell + glm::uvec3(5, 6, 7));
        add(4U * cell + glm::uvec3(4096 * 7, 4096 * 9, 4096 * 31));
    }
    std::sort(expected.begin(), expected.end());
    const GpuScene scene = uploadScene(device(), test::triangleSoup(corners), false);
    const BuildResult result = buildOctree(device(), scene, unitGrid(17), {Coverage::Conservative, false, {}});
    const oracle::OctreeContents contents = test::contentsOf(device(), result.octree);
    EXPECT_TRUE(contents.violations.empty()) << contents.violations.front();
    EXPECT_EQ(contents.codes, expected);
}

// Triangles with corners on the lattice of every depth, off the lower faces, and with vertex colours, emission and a
// blended surface.
Scene colorfulTriangles()
{
    Scene scene = test::randomTriangles(6, 400, 256.0F);
    std::mt19937 random(9);
    const auto uniform = [&] { return std::uniform_real_distribution<float>(0.0F, 1.0F)(random); };
    for (glm::vec3& position : scene.primitives[0].positions)
    {
        position = glm::clamp(glm::round(position * 128.0F) / 128.0F, 1.0F, 256.0F);
        scene.primitives[0].colors.emplace_back(uniform(), uniform(), uniform(), 0.5F + 0.5F * uniform());
    }
    scene.materials[0].emission = {0.5F, 2.0F, 1.0F};
    Scene blended = scene;
    blended.materials[0].alpha_mode = AlphaMode::Blend;
    blended.materials[0].emission = glm::vec3(0.0F);
    for (glm::vec3& position : blended.primitives[0].positions)
    {
        position = {position.y, position.z, position.x};
    }
    scene.append(std::move(blended));
    return scene;
}

TEST(DeepGrids, MovedByWholeVoxelsTheAttributesAreThoseOfAShallowGrid)
{
    const GpuScene scene = uploadScene(device(), colorfulTriangles(), true);
    const BuildResult shallow = buildOctree(device(), scene, unitGrid(8), {Coverage::Thin, true, {}});
    for (const std::uint32_t depth : {13U, 14U, 16U})
    {
        Grid deep = unitGrid(depth);
        deep.origin = glm::vec3(256.0F - std::ldexp(1.0F, static_cast<int>(depth))); // the scene fills the last corner
        const BuildResult moved = buildOctree(device(), scene, deep, {Coverage::Thin, true, {}});
        ASSERT_EQ(moved.octree.voxel_count, shallow.octree.voxel_count);
        const auto expectEqualBytes = [](const auto& a, const auto& b)
        {
            EXPECT_GT(a.count(), 0U);
            EXPECT_TRUE(test::sameBytes(device().download(a), device().download(b)));
        };
        expectEqualBytes(moved.octree.voxel_attributes, shallow.octree.voxel_attributes);
        expectEqualBytes(moved.octree.emission_words, shallow.octree.emission_words);
        expectEqualBytes(moved.octree.emission, shallow.octree.emission);
        const std::vector<std::uint64_t> codes = voxelCodes(device(), moved.octree);
        const std::vector<std::uint64_t> shallow_codes = voxelCodes(device(), shallow.octree);
        for (std::size_t i = 0; i < codes.size(); ++i)
        {
            const std::uint64_t corner = (std::uint64_t{1} << (3 * depth)) - (std::uint64_t{1} << 24);
            ASSERT_EQ(codes[i], corner + shallow_codes[i]);
        }
    }
}

TEST(DeepGrids, RaysEqualTheReference)
{
    for (std::uint32_t depth = 13; depth <= Grid::kDepthMax; ++depth)
    {
        const GpuScene scene = uploadScene(device(), scatteredTriangles(depth, 600), false);
        const DeviceTree octree = buildOctree(device(), scene, unitGrid(depth), {Coverage::Thin, false, {}}).octree;
        test::expectEqualsReference(device(), octree, voxelCodes(device(), octree), 5000);
    }
}

} // namespace
} // namespace zvo
