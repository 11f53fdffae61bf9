// SPDX-License-Identifier: MIT
// Construction from a list of fragments, after Crassin and Green.
#include "baseline/baseline_fixture.h"
#include "io/gltf/gltf_loader.h"
#include "oracle/voxelizer.h"
#include "support/errors.h"
#include "support/octree_access.h"
#include "support/pictures.h"
#include "support/scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <random>
#include <vector>

namespace zvo
{
namespace
{

using baseline::PointerOctree;
using test::baselineDevice;

Grid unitGrid(std::uint32_t depth)
{
    return {.origin = glm::vec3(0.0F), .voxel_size = 1.0F, .depth = depth};
}

void expectEqualsOracle(const Scene& scene, const Grid& grid)
{
    const GpuScene gpu_scene = uploadScene(baselineDevice(), scene, false);
    const PointerOctree octree = test::crassinGreenOctree(gpu_scene, grid, Coverage::Thin);
    test::expectSameCodes(baseline::listCodes(baselineDevice(), octree),
                          oracle::voxelize(scene, grid, Coverage::Thin).codes);
}

TEST(CrassinGreen, EmptySceneGivesARootWithoutVoxels)
{
    expectEqualsOracle(test::triangleSoup({}), unitGrid(3));
}

TEST(CrassinGreen, RandomTrianglesEqualTheOracleAtEveryDepth)
{
    for (std::uint32_t depth = 1; depth <= 6; ++depth)
    {
        SCOPED_TRACE(depth);
        expectEqualsOracle(test::randomTriangles(depth, 200, static_cast<float>(1U << depth)), unitGrid(depth));
    }
}

// Scattered voxels have hardly a node in common: the first guess at the number of nodes is too low.
TEST(CrassinGreen, ScatteredPointsGetNodesInAnotherRun)
{
    const Grid grid = unitGrid(gpu::kPointerDepthMax);
    std::mt19937 random(4);
    std::uniform_real_distribution<float> coordinate(0.0F, static_cast<float>(grid.resolution()));
    std::vector<glm::vec3> corners;
    for (std::uint32_t i = 0; i < 600; ++i)
    {
        const glm::vec3 point(coordinate(random), coordinate(random), coordinate(random));
        corners.insert(corners.end(), 3, point);
    }
    const Scene scene = test::triangleSoup(corners);
    const GpuScene gpu_scene = uploadScene(baselineDevice(), scene, false);
    const PointerOctree octree = test::crassinGreenOctree(gpu_scene, grid, Coverage::Conservative);
    EXPECT_GT(octree.node_count, 4096U);
    test::expectSameCodes(baseline::listCodes(baselineDevice(), octree),
                          oracle::voxelize(scene, grid, Coverage::Conservative).codes);
}

TEST(CrassinGreen, TheDeepestGridIsTracedLikeZvos)
{
    const Grid grid = unitGrid(gpu::kPointerDepthMax);
    Scene scene = test::sphereScene(glm::vec3(5000.0F, 3000.0F, 8000.0F), 30.0F, 12);
    scene.append(test::sphereScene(glm::vec3(5040.0F, 3010.0F, 7990.0F), 9.0F, 12));
    const GpuScene gpu_scene = uploadScene(baselineDevice(), scene, false);
    const DeviceTree tree = buildOctree(baselineDevice(), gpu_scene, grid, {Coverage::Thin, false, {}}).octree;
    const PointerOctree octree = test::crassinGreenOctree(gpu_scene, grid, Coverage::Thin);
    test::expectSameCodes(baseline::listCodes(baselineDevice(), octree), voxelCodes(baselineDevice(), tree));
    test::expectSameHits({&octree}, tree, test::fewCameras(scene.bounds()));
}

TEST(CrassinGreen, DeeperGridsAreRefused)
{
    const GpuScene scene = uploadScene(baselineDevice(), test::triangleSoup({}), false);
    const auto build = [&] { test::crassinGreenOctree(scene, unitGrid(gpu::kPointerDepthMax + 1), Coverage::Thin); };
    test::expectParts(test::messageOf(build, ErrorCode::Usage), {"depth 14", "13 is the most"});
}

// Fragments have 8-bit colours, and normals in an octahedral code: the mean of a voxel may differ from zvo's by a code
// or two and by a few degrees.
TEST(CrassinGreen, MeansAreZvosButForRounding)
{
    const Scene scene = loadGltf(test::ownScene("cornell_box.glb"));
    const Grid grid = Grid::around(scene.bounds(), 6);
    const GpuScene gpu_scene = uploadScene(baselineDevice(), scene, true);
    const DeviceTree tree = buildOctree(baselineDevice(), gpu_scene, grid, {Coverage::Conservative, true, {}}).octree;
    const auto expected = baselineDevice().download(tree.voxel_attributes);
    const auto voxels =
        baseline::listVoxels(baselineDevice(), test::crassinGreenOctree(gpu_scene, grid, Coverage::Conservative));
    ASSERT_EQ(voxels.size(), expected.size());
    int largest = 0;
    std::size_t turned = 0;
    for (std::size_t i = 0; i < voxels.size(); ++i)
    {
        for (const std::uint32_t shift : {0U, 8U, 16U})
        {
            largest = std::max(largest, std::abs(static_cast<int>(voxels[i].look.color >> shift & 255) -
                                                 static_cast<int>(expected[i].color >> shift & 255)));
        }
        turned += glm::dot(test::normalOf(voxels[i].look), test::normalOf(expected[i])) < 0.9 ? 1 : 0;
    }
    EXPECT_LE(largest, 2);
    EXPECT_LT(turned, voxels.size() / 50) << "where normals all but cancel each other";
}

// A white box: means of white are white, on every level.
TEST(CrassinGreen, MeansOfTheLevelsAboveAreThoseOfTheirChildren)
{
    const GpuScene scene = uploadScene(baselineDevice(), test::boxScene(glm::vec3(3.0F), glm::vec3(29.0F)), true);
    const PointerOctree octree = test::crassinGreenOctree(scene, unitGrid(5), Coverage::Thin);
    std::uint32_t others = 0;
    for (const gpu::PointerNode& node : baselineDevice().download(octree.nodes, 0, octree.node_count))
    {
        others += node.child != 0 && node.color != UINT32_MAX ? 1 : 0;
    }
    EXPECT_EQ(others, 0U);
}

// With fewer nodes than it takes, makeNodes() counts what is missing and writes nothing beyond.
TEST(CrassinGreen, NodesWithoutRoomAreCounted)
{
    vk::HeadlessDevice& device = baselineDevice();
    const Grid grid = unitGrid(5);
    const GpuScene scene = uploadScene(device, test::boxScene(glm::vec3(3.0F), glm::vec3(29.0F)), false);
    baseline::ThesisTriangles triangles(device.device(), scene);
    const baseline::FragmentList list = baseline::listFragments(device, {scene, grid, Coverage::Thin, triangles});
    baseline::CrassinGreenBuffers buffers(device.device());
    PointerOctree octree;
    octree.grid = grid;
    octree.nodes = {device.device(), "few nodes", 100};
    device.run([&](vk::FrameGraph& graph) { baseline::makeNodes(graph, {scene, list.fragments, buffers, octree}); });
    EXPECT_GT(8 * device.download(buffers.tile_count).front(), 100U);
}

} // namespace
} // namespace zvo
