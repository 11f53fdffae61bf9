// SPDX-License-Identifier: MIT
// Forms of voxelization give the same bytes, whatever the triangles.
#include "core/base/morton.h"
#include "oracle/octree_check.h"
#include "oracle/voxelizer.h"
#include "runtime/octree_sha256.h"
#include "runtime/trees.h"
#include "support/engine_device.h"
#include "support/materials_scene.h"
#include "support/octree_access.h"
#include "support/scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <random>
#include <string>
#include <string_view>
#include <vector>

namespace zvo
{
namespace
{

// What GPUs choose.
vk::HeadlessOptions optionsLikeGpus()
{
    vk::HeadlessOptions options = test::deviceOptions();
    options.tuning = {{"block-lanes", 16},
                      {"brick-lanes", 8},
                      {std::string(vk::kLoadsName), static_cast<std::uint32_t>(vk::LoadForm::Addresses)}};
    return options;
}

vk::HeadlessDevice& deviceLikeGpus()
{
    static vk::HeadlessDevice device(optionsLikeGpus(), zvoKernels());
    return device;
}

BuildResult build(vk::HeadlessDevice& device, const Scene& scene, const GridTile& tile, const BuildOptions& options)
{
    const GpuScene uploaded = uploadScene(device, scene, true);
    return buildOctree(device, uploaded, tile, options);
}

bool hasPass(const BuildResult& built, std::string_view name)
{
    return std::ranges::find(built.passes, name, &vk::PassTime::name) != built.passes.end();
}

void expectSameBytes(const Scene& scene, const GridTile& tile)
{
    vk::HeadlessDevice& gpu = deviceLikeGpus();
    const auto emits = [](const Material& material) { return material.emission != glm::vec3(0); };
    for (const Coverage coverage : {Coverage::Thin, Coverage::Conservative})
    {
        const BuildResult software = build(test::device(), scene, tile, {coverage});
        ASSERT_GT(software.octree.voxel_count, 0U);
        for (const bool mixed : {false, true}) // sums of mixed voxels alone
        {
            BuildOptions options = {coverage};
            options.sum_form = SumForm::on(gpu.device());
            options.sum_form->mixed = mixed;
            const BuildResult like_gpus = build(gpu, scene, tile, options);
            EXPECT_EQ(octreeSha256(gpu, like_gpus.octree), octreeSha256(test::device(), software.octree)) << mixed;
            EXPECT_EQ(like_gpus.dropped, software.dropped);
            EXPECT_EQ(hasPass(like_gpus, "voxelize/resolve_leaves"),
                      mixed && std::ranges::none_of(scene.materials, emits));
        }
    }
}

// Triangles of all sizes up to `size`, anywhere in [-extent / 4, extent]^3.
Scene triangles(std::size_t count, float size, float extent)
{
    std::mt19937 random(5);
    const auto uniform = [&](float low, float high)
    { return std::uniform_real_distribution<float>(low, high)(random); };
    const auto point = [&](float low, float high) {
        return glm::vec3{uniform(low, high), uniform(low, high), uniform(low, high)};
    };
    std::vector<glm::vec3> corners;
    for (std::size_t i = 0; i < count; ++i)
    {
        const glm::vec3 corner = point(-extent / 4, extent);
        const float edge = size * uniform(0, 1) * uniform(0, 1);
        corners.insert(corners.end(), {corner, corner + point(-edge, edge), corner + point(-edge, edge)});
    }
    return test::triangleSoup(corners);
}

TEST(Bricks, OfMaterialsGiveTheSameBytes)
{
    expectSameBytes(test::materialsScene(64), Grid{glm::vec3(0), 1.0F, 6});
}

// Later kernels look at triangles again for their alpha alone.
TEST(Bricks, WithoutAttributesHaveTheOraclesVoxels)
{
    const Scene scene = test::materialsScene(64, 60);
    for (const Grid& grid : {Grid{glm::vec3(0), 1.0F, 6}, Grid{glm::vec3(0), 8.0F, 3}}) // large triangles, small ones
    {
        for (const Coverage coverage : {Coverage::Thin, Coverage::Conservative})
        {
            const DeviceTree octree =
                buildOctree(test::device(), uploadScene(test::device(), scene, false), grid, {coverage, false}).octree;
            EXPECT_EQ(voxelCodes(test::device(), octree), oracle::voxelize(scene, grid, coverage).codes);
        }
    }
}

// A cut-out fragment may have no leaf. What lies in its place, behind the nodes, would lead to addresses far outside of
// the device's memory.
TEST(Bricks, OfEmissiveSurfacesThatAreCutOutLoadNoLeafThatDoesNotExist)
{
    Scene scene = test::triangleSoup({{0.5F, 1.5F, 0.5F}, {0.5F, 1.5F, 3.5F}, {3.5F, 1.5F, 3.5F}}); // in the first leaf
    Scene cut_out = test::triangleSoup({{12, 13.5F, 12}, {12, 13.5F, 15}, {15, 13.5F, 15}});        // in the last one
    cut_out.materials[0].alpha_mode = AlphaMode::Mask;
    cut_out.materials[0].base_color.a = 0;
    scene.append(std::move(cut_out));
    scene.materials[0].emission = glm::vec3(1);
    scene.materials[1].emission = glm::vec3(1);
    vk::HeadlessDevice device(optionsLikeGpus(), zvoKernels());
    for (const std::uint32_t index : {1U << 31, 3U << 30, ~255U})
    {
        {
            vk::BufferOf<std::uint32_t> garbage(device.device(), "garbage", std::uint64_t{1} << 22);
            device.run([&](vk::FrameGraph& graph) { graph.fill(garbage, index); });
        }
        const DeviceTree octree = build(device, scene, Grid{glm::vec3(0), 1.0F, 4}, {Coverage::Thin}).octree;
        EXPECT_EQ(octree.node_count, 2U);
        EXPECT_EQ(octree.emission.count(), octree.voxel_count);
    }
}

TEST(Bricks, OfTrianglesAndPointsGiveTheSameBytes)
{
    Scene scene = triangles(100, 9, 30);
    scene.append(test::randomPoints(2, 200, 32));
    expectSameBytes(scene, Grid{glm::vec3(0), 1.0F, 5});
}

TEST(Bricks, OfTrianglesOfAllSizesGiveTheSameBytes)
{
    for (const std::uint32_t depth : {1U, 3U, 4U, 7U})
    {
        SCOPED_TRACE(depth);
        const float extent = static_cast<float>(1U << depth);
        expectSameBytes(triangles(400, extent, extent), Grid{glm::vec3(0), 1.0F, depth});
    }
}

TEST(Bricks, OfTrianglesInSeveralBlocksGiveTheSameBytes)
{
    const Scene scene =
        test::triangleSoup({{-20, 3, 10}, {270, 40, 30}, {100, 200, 290}, {0, 0, 0}, {256, 250, 9}, {9, 2, 200}});
    expectSameBytes(scene, Grid{glm::vec3(0), 1.0F, 8});
}

TEST(Bricks, WithoutVoxelsMakeAnEmptyOctree)
{
    const Scene scene = test::triangleSoup({{-2, 3, 10}, {-1, 4, 3}, {-9, 2, 29}});
    EXPECT_EQ(build(test::device(), scene, Grid{glm::vec3(0), 1.0F, 5}, {Coverage::Thin}).octree.node_count, 0U);
}

TEST(Bricks, OfManySmallTrianglesGiveTheSameBytes)
{
    expectSameBytes(triangles(9000, 12, 128), Grid{glm::vec3(0), 1.0F, 7});
}

TEST(Bricks, OfADeepGridAndOfATileGiveTheSameBytes)
{
    const Scene scene = triangles(900, 40, 100);
    expectSameBytes(scene, Grid{glm::vec3(-8000), 1.0F, 14});
    expectSameBytes(scene, GridTile{Grid{glm::vec3(0), 1.0F, 7}, 5, glm::uvec3(1, 2, 0)});
    expectSameBytes(scene, GridTile{Grid{glm::vec3(0), 1.0F, 7}, 3, glm::uvec3(5, 4, 6)});
}

// In levels of so many nodes, sums of blocks are scanned in a pass of their own.
TEST(Bricks, OfMoreThanHalfAMillionAreNumberedInOrder)
{
    constexpr std::uint32_t kBrickCount = (1U << 19) + 1;
    Scene scene;
    scene.materials.emplace_back();
    scene.instances.emplace_back();
    Primitive& cloud = scene.primitives.emplace_back();
    cloud.is_points = true;
    std::vector<std::uint64_t> codes; // of a voxel in each brick, one brick after the other
    for (std::uint32_t brick = 0; brick < kBrickCount; ++brick)
    {
        codes.push_back((std::uint64_t{brick} << 12) | brick % 4096);
        cloud.triangles.emplace_back(brick);
        cloud.positions.push_back(glm::vec3(cellOfCode(codes.back())) + 0.5F);
    }
    BuildOptions options = {Coverage::Thin, false};
    options.capacities = {.table = 1U << 20, .bricks = kBrickCount, .items = kBrickCount}; // else attempts take long
    vk::HeadlessDevice& device = test::device();
    const GpuScene uploaded = uploadScene(device, scene, false);
    const DeviceTree octree = buildOctree(device, uploaded, Grid{glm::vec3(0), 1.0F, 11}, options).octree;
    const oracle::OctreeContents contents = test::contentsOf(device, octree);
    EXPECT_EQ(contents.violations, std::vector<std::string>());
    EXPECT_TRUE(contents.codes == codes);
    // Their first voxels: a leaf has one.
    const std::vector<gpu::uvec2> groups = device.download(octree.leaf_groups);
    const std::uint32_t first_word = 2 * octree.levels.back().first_node;
    for (std::uint32_t i = gpu::kFirstLeafGroup; i < groups.size(); ++i)
    {
        const std::uint32_t word = std::max((i - gpu::kFirstLeafGroup) * gpu::kLeafGroup, first_word);
        ASSERT_EQ(groups[i].x, word - first_word) << i;
    }
}

TEST(Bricks, ThatAreCrowdedGiveTheSameBytes)
{
    expectSameBytes(triangles(30000, 2, 12), Grid{glm::vec3(-4), 1.0F, 6});
}

TEST(Bricks, WithVoxelsOfVeryManyFragmentsGiveTheSameBytes)
{
    const Scene scene = triangles(300000, 0.2F, 0.5F);
    const Grid grid = {glm::vec3(-4), 1.0F, 3};
    expectSameBytes(scene, grid);
    BuildOptions options = {Coverage::Thin};
    options.capacities = build(test::device(), scene, grid, options).capacities; // everything has room
    EXPECT_EQ(build(test::device(), scene, grid, options).retry_count, 1U);      // values have lost bits
}

TEST(Bricks, OfTrianglesThatReachFarBeyondTheGridGiveTheOraclesVoxels)
{
    const Scene scene = test::triangleSoup(
        {{-1.0e6F, 3, 1}, {9.0e5F, 2, 5}, {7, 3, 12}, {-9, -8.0e5F, 3}, {20, 1.5e6F, 9}, {40, 2, -7.0e5F}});
    for (const std::uint32_t depth : {2U, 4U, 7U})
    {
        for (const Coverage coverage : {Coverage::Thin, Coverage::Conservative})
        {
            const Grid grid = {glm::vec3(0), 1.0F, depth};
            const DeviceTree octree = build(test::device(), scene, grid, {coverage}).octree;
            EXPECT_EQ(voxelCodes(test::device(), octree), oracle::voxelize(scene, grid, coverage).codes);
        }
    }
}

} // namespace
} // namespace zvo
