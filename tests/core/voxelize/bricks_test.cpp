// SPDX-License-Identifier: MIT
// Voxelization by bricks gives the bytes of that by triangles.
#include "runtime/octree_sha256.h"
#include "runtime/trees.h"
#include "support/engine_device.h"
#include "support/materials_scene.h"
#include "support/scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <random>
#include <string>
#include <string_view>
#include <vector>

namespace zvo
{
namespace
{

// A device that voxelizes by bricks.
vk::HeadlessDevice deviceOfBricks(std::map<std::string_view, std::uint32_t> tuning)
{
    vk::HeadlessOptions options = test::deviceOptions();
    options.tuning["voxels"] = 1;
    for (const auto& [name, value] : tuning)
    {
        options.tuning[std::string(name)] = value;
    }
    return {options, zvoKernels()};
}

// What the software device chooses beside it, and what GPUs choose.
std::vector<vk::HeadlessDevice*> devicesOfBricks()
{
    static vk::HeadlessDevice software = deviceOfBricks({});
    static vk::HeadlessDevice like_gpus =
        deviceOfBricks({{"band-lanes", 16}, {vk::kLoadsName, static_cast<std::uint32_t>(vk::LoadForm::Addresses)}});
    return {&software, &like_gpus};
}

BuildResult build(vk::HeadlessDevice& device, const Scene& scene, const GridTile& tile)
{
    const GpuScene uploaded = uploadScene(device, scene, true);
    return buildOctree(device, uploaded, tile, {});
}

bool wentByBricks(const BuildResult& result)
{
    return std::ranges::any_of(result.passes, [](const vk::PassTime& pass) { return pass.name == "voxelize/cover"; });
}

void expectSameBytes(const Scene& scene, const GridTile& tile)
{
    const BuildResult expected = build(test::device(), scene, tile);
    ASSERT_GT(expected.octree.voxel_count, 0U);
    for (vk::HeadlessDevice* const device : devicesOfBricks())
    {
        const BuildResult result = build(*device, scene, tile);
        EXPECT_TRUE(wentByBricks(result));
        EXPECT_EQ(octreeSha256(*device, result.octree), octreeSha256(test::device(), expected.octree));
        EXPECT_EQ(result.dropped, expected.dropped);
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
    Scene scene = test::materialsScene(64);
    for (Material& material : scene.materials)
    {
        material.emission = glm::vec3(0);
    }
    expectSameBytes(scene, Grid{glm::vec3(0), 1.0F, 6});
}

TEST(Bricks, OfTrianglesAndPointsGiveTheSameBytes)
{
    Scene scene = triangles(100, 9, 30);
    scene.append(test::randomPoints(2, 200, 32));
    expectSameBytes(scene, Grid{glm::vec3(0), 1.0F, 5});
}

TEST(Bricks, AreTakenAgainWithTheCapacitiesOfAnEarlierBuild)
{
    vk::HeadlessDevice& device = *devicesOfBricks().front();
    const GpuScene uploaded = uploadScene(device, triangles(100, 9, 30), true);
    const Grid grid = {glm::vec3(0), 1.0F, 5};
    BuildOptions options;
    options.capacities = buildOctree(device, uploaded, grid, {}).capacities;
    EXPECT_TRUE(wentByBricks(buildOctree(device, uploaded, grid, options)));
}

TEST(Bricks, OfTrianglesOfAllSizesGiveTheSameBytes)
{
    for (const std::uint32_t depth : {3U, 4U, 7U})
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
    EXPECT_EQ(build(*devicesOfBricks().front(), scene, Grid{glm::vec3(0), 1.0F, 5}).octree.node_count, 0U);
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

TEST(Bricks, ThatAreCrowdedGiveTheSameBytes)
{
    expectSameBytes(triangles(30000, 2, 12), Grid{glm::vec3(-4), 1.0F, 6});
}

TEST(Bricks, WithVoxelsOfVeryManyFragmentsGiveTheSameBytes)
{
    const Scene scene = triangles(300000, 0.2F, 0.5F);
    const Grid grid = {glm::vec3(-4), 1.0F, 3};
    expectSameBytes(scene, grid);
    EXPECT_GT(build(*devicesOfBricks().front(), scene, grid).retry_count, 0U); // values have lost bits
}

TEST(Bricks, DoNotTakeTrianglesBeyondTheirIntegers)
{
    const Scene scene = test::triangleSoup({{-1.0e6F, 3, 1}, {9.0e5F, 2, 5}, {7, 3, 12}});
    const Grid grid = {glm::vec3(0), 1.0F, 4};
    vk::HeadlessDevice& device = *devicesOfBricks().front();
    for (const GridTile& tile : {GridTile(grid), GridTile(grid, 2, glm::uvec3(0, 0, 0))})
    {
        const BuildResult result = build(device, scene, tile);
        EXPECT_FALSE(wentByBricks(result));
        EXPECT_EQ(octreeSha256(device, result.octree),
                  octreeSha256(test::device(), build(test::device(), scene, tile).octree));
    }
}

} // namespace
} // namespace zvo
