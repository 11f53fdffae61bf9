// SPDX-License-Identifier: MIT
// The thesis: voxelization, construction, dynamic update and ray casting.
#include "baseline/baseline_fixture.h"
#include "io/gltf/gltf_loader.h"
#include "oracle/voxelizer.h"
#include "support/errors.h"
#include "support/param_names.h"
#include "support/pictures.h"
#include "support/scenes.h"

#include <gtest/gtest.h>

#include <cstring>

namespace zvo
{
namespace
{

using baseline::PointerOctree;
using test::baselineDevice;
using test::ThesisWay;

GpuScene uploaded(const Scene& scene, bool attributes = false)
{
    return uploadScene(baselineDevice(), scene, attributes);
}

Grid gridOf(std::uint32_t depth)
{
    return {.origin = glm::vec3(0.0F), .voxel_size = 1.0F, .depth = depth};
}

std::vector<std::uint64_t> thesisCodes(const GpuScene& scene, const Grid& grid, const ThesisWay& way)
{
    return baseline::listCodes(baselineDevice(), test::thesisOctree(scene, grid, way));
}

void expectEqualsOracle(const Scene& scene, const Grid& grid, const ThesisWay& way)
{
    test::expectSameCodes(thesisCodes(uploaded(scene), grid, way), oracle::voxelize(scene, grid, way.coverage).codes);
}

using ThesisBothCoverages = testing::TestWithParam<Coverage>;

INSTANTIATE_TEST_SUITE_P(Coverages, ThesisBothCoverages, testing::Values(Coverage::Conservative, Coverage::Thin),
                         test::paramName<Coverage>);

TEST_P(ThesisBothCoverages, EmptySceneGivesARootWithoutVoxels)
{
    const PointerOctree octree = test::thesisOctree(uploaded(test::triangleSoup({})), gridOf(3), {GetParam()});
    EXPECT_EQ(octree.node_count, 1U);
    EXPECT_TRUE(baseline::listCodes(baselineDevice(), octree).empty());
}

TEST_P(ThesisBothCoverages, RandomTrianglesEqualTheOracleAtEveryDepth)
{
    for (std::uint32_t depth = 1; depth <= 6; ++depth)
    {
        SCOPED_TRACE(depth);
        const Grid grid = gridOf(depth);
        expectEqualsOracle(test::randomTriangles(depth, 300, static_cast<float>(grid.resolution())), grid,
                           {GetParam()});
    }
}

TEST_P(ThesisBothCoverages, BoxesInManyPartsAndWholeOnesEqualTheOracle)
{
    for (const std::uint32_t cells : {1U, 70U, 1000U})
    {
        expectEqualsOracle(test::randomTriangles(3, 100, 32.0F), gridOf(5),
                           {.coverage = GetParam(), .cells_per_part = cells});
    }
    expectEqualsOracle(test::randomTriangles(3, 100, 8.0F), gridOf(3),
                       {.coverage = GetParam(), .cells_per_part = 1U << 31});
}

TEST_P(ThesisBothCoverages, HugeTrianglesFarBeyondTheGridEqualTheOracle)
{
    Scene scene = test::randomTriangles(7, 100, 2.0e6F);
    scene.instances[0].transform[3] = glm::vec4(-1.0e6F, -1.0e6F, -1.0e6F, 1.0F);
    scene.append(test::triangleSoup({{-2e6F, 3, -1e6F}, {2e6F, 7, -2e6F}, {31, 12, 2e6F}}));
    expectEqualsOracle(scene, gridOf(5), {GetParam()});
}

TEST_P(ThesisBothCoverages, FacesOnCellBordersSegmentsAndPointsEqualTheOracle)
{
    const Grid grid{.origin = glm::vec3(0.0F), .voxel_size = 0.5F, .depth = 5};
    expectEqualsOracle(test::boxScene(glm::vec3(0.0F), glm::vec3(16.0F)), grid, {GetParam()});
    expectEqualsOracle(test::boxScene(glm::vec3(1.5F), glm::vec3(8.0F)), grid, {GetParam()});
    expectEqualsOracle(test::triangleSoup({{1, 2, 3}, {1, 2, 3}, {1, 2, 3}, {0.5F, 0.5F, 0.5F}, {14, 9, 7}, {1, 1, 1}}),
                       grid, {GetParam()});
}

TEST(Thesis, BoundsLeaveTheSameNodes)
{
    const GpuScene scene = uploaded(test::sphereScene(glm::vec3(20.0F, 9.0F, 40.0F), 7.0F, 12));
    const PointerOctree all = test::thesisOctree(scene, gridOf(6), {});
    const PointerOctree bounded = test::thesisOctree(scene, gridOf(6), {.bounds = true});
    EXPECT_EQ(all.node_count, bounded.node_count);
    const auto nodes = baselineDevice().download(all.nodes);
    const auto bounded_nodes = baselineDevice().download(bounded.nodes);
    EXPECT_EQ(std::memcmp(nodes.data(), bounded_nodes.data(), all.bytes()), 0);
}

TEST(Thesis, BoundsOfAnEmptySceneLeaveARoot)
{
    EXPECT_TRUE(thesisCodes(uploaded(test::triangleSoup({})), gridOf(4), {.bounds = true}).empty());
}

TEST(Thesis, AtomicNumberingGivesTheSameVoxels)
{
    const GpuScene scene = uploaded(test::sphereScene(glm::vec3(30.0F), 27.0F, 20));
    test::expectSameCodes(thesisCodes(scene, gridOf(6), {.numbering = baseline::TileNumbering::Atomic}),
                          thesisCodes(scene, gridOf(6), {}));
}

// A node whose eight children are allocated takes a tile, so the count follows from the voxels.
TEST(Thesis, NodesAreTheTilesAboveVoxels)
{
    const GpuScene scene = uploaded(test::sphereScene(glm::vec3(30.0F), 27.0F, 20));
    const PointerOctree octree = test::thesisOctree(scene, gridOf(6), {});
    std::vector<std::uint64_t> codes = baseline::listCodes(baselineDevice(), octree);
    std::uint64_t expected = 1;
    for (std::uint32_t level = 0; level < 6; ++level)
    {
        for (std::uint64_t& code : codes)
        {
            code >>= 3;
        }
        codes.erase(std::unique(codes.begin(), codes.end()), codes.end());
        expected += 8 * codes.size();
    }
    EXPECT_EQ(octree.node_count, expected);
    EXPECT_EQ(octree.bytes(), 12 * expected);
}

TEST(Thesis, SumsGiveZvosAttributes)
{
    const Scene scene = loadGltf(test::ownScene("atrium.glb"));
    const Grid grid = Grid::around(scene.bounds(), 6);
    const GpuScene gpu_scene = uploaded(scene, true);
    const DeviceTree tree = buildOctree(baselineDevice(), gpu_scene, grid, {Coverage::Conservative, true, {}}).octree;
    const auto expected = baselineDevice().download(tree.voxel_attributes);
    const auto voxels = baseline::listVoxels(
        baselineDevice(), test::thesisOctree(gpu_scene, grid, {.target = baseline::ThesisTarget::Sums}));
    ASSERT_EQ(voxels.size(), expected.size());
    const std::uint32_t rgb = (1U << 24) - 1;
    std::uint32_t differences = 0;
    for (std::size_t i = 0; i < voxels.size(); ++i)
    {
        const bool same =
            (voxels[i].look.color & rgb) == (expected[i].color & rgb) && voxels[i].look.normal == expected[i].normal;
        differences += same ? 0 : 1;
    }
    EXPECT_EQ(differences, 0U) << "of " << voxels.size();
}

// Of a mesh with one colour, the last writer's is everybody's.
TEST(Thesis, ColorsOfAPlainMeshAreItsMaterials)
{
    Scene scene = test::sphereScene(glm::vec3(30.0F), 27.0F, 20);
    scene.materials[0].base_color = glm::vec4(1.0F, 0.0F, 0.0F, 1.0F);
    const PointerOctree octree =
        test::thesisOctree(uploaded(scene, true), gridOf(6), {.target = baseline::ThesisTarget::Colors});
    const auto nodes = baselineDevice().download(octree.nodes);
    const std::uint32_t red = 255U | gpu::kOpaqueColor;
    std::uint32_t others = 0;
    for (std::uint32_t i = 0; i < octree.node_count; ++i)
    {
        others += nodes[i].child != 0 && nodes[i].color != red ? 1 : 0;
    }
    EXPECT_EQ(others, 0U) << "means of the levels above included";
}

TEST(Thesis, GridsThatAreTooDeepAreRefused)
{
    const auto cells = [] { baseline::ThesisCells(baselineDevice().device(), gridOf(11)); };
    test::expectParts(test::messageOf(cells, ErrorCode::Usage), {"depth 11", "10 is the most"});
}

class ThesisUpdate : public testing::Test
{
protected:
    // Merges an object with the octree, and expects the voxels of both, and the static nodes as they were.
    void expectUpdate(const Scene& object)
    {
        const GpuScene gpu_object = uploaded(object);
        for (const bool bounds : {false, true})
        {
            const test::DenseCells dense = test::cellsOf(gpu_object, m_grid, {.bounds = bounds});
            baseline::ThesisBuildOptions options;
            if (bounds)
            {
                options.range = dense.range;
            }
            baseline::updateThesis(baselineDevice(), dense.cells, options, m_levels, m_octree);
            Scene both = m_scene;
            both.append(Scene(object));
            test::expectSameCodes(baseline::listCodes(baselineDevice(), m_octree),
                                  thesisCodes(uploaded(both), m_grid, {}));
            EXPECT_EQ(m_octree.root, m_octree.static_count);
        }
        const auto nodes = baselineDevice().download(m_octree.nodes, 0, m_octree.static_count);
        EXPECT_EQ(std::memcmp(nodes.data(), m_static_nodes.data(), nodes.size() * sizeof(gpu::PointerNode)), 0);
    }

    Grid m_grid = gridOf(6);
    Scene m_scene = test::sphereScene(glm::vec3(25.0F), 20.0F, 16);
    PointerOctree m_octree = test::thesisOctree(uploaded(m_scene), m_grid, {});
    std::vector<gpu::PointerNode> m_static_nodes = baselineDevice().download(m_octree.nodes);
    baseline::ThesisLevels m_levels{baselineDevice().device(), m_grid};
};

TEST_F(ThesisUpdate, EqualsABuildOfEverything)
{
    expectUpdate(test::boxScene(glm::vec3(3.3F), glm::vec3(15.0F)));       // crosses the sphere
    expectUpdate(test::boxScene(glm::vec3(50.0F), glm::vec3(63.0F)));      // is far from it
    expectUpdate(test::randomTriangles(5, 60, 64.0F));                     // is everywhere
    expectUpdate(test::triangleSoup({{9, 9, 9}, {9, 9, 10}, {9, 10, 9}})); // is small
}

TEST_F(ThesisUpdate, AnEmptyObjectLeavesTheStaticVoxels)
{
    expectUpdate(test::triangleSoup({}));
    EXPECT_EQ(m_octree.node_count, m_octree.static_count + 1);
}

TEST_F(ThesisUpdate, RaysSeeBoth)
{
    Scene both = m_scene;
    const Scene object = test::randomTriangles(5, 60, 64.0F);
    both.append(Scene(object));
    const test::DenseCells dense = test::cellsOf(uploaded(object), m_grid, {});
    baseline::updateThesis(baselineDevice(), dense.cells, {}, m_levels, m_octree);
    const DeviceTree tree =
        buildOctree(baselineDevice(), uploaded(both), m_grid, {Coverage::Conservative, false, {}}).octree;
    test::expectSameHits({&m_octree}, tree, test::manyCameras(m_grid));
}

// The knot flies through the atrium; each update replaces the last one.
TEST(ThesisUpdateOfAScene, EqualsZvosBuildOfEverything)
{
    const Scene atrium = loadGltf(test::ownScene("atrium.glb"));
    Scene knot = loadGltf(test::ownScene("knot.glb"));
    const Grid grid = Grid::around(atrium.bounds(), 7);
    PointerOctree octree = test::thesisOctree(uploaded(atrium), grid, {Coverage::Thin});
    baseline::ThesisLevels levels(baselineDevice().device(), grid);
    const glm::vec3 step = 0.1F * (atrium.bounds().max - atrium.bounds().min);
    for (int frame = 0; frame < 3; ++frame)
    {
        for (Instance& instance : knot.instances)
        {
            instance.transform[3] += glm::vec4(step, 0.0F);
        }
        const test::DenseCells dense =
            test::cellsOf(uploaded(knot), grid, {.coverage = Coverage::Thin, .bounds = true});
        baseline::updateThesis(baselineDevice(), dense.cells, {.range = dense.range}, levels, octree);
        Scene both = atrium;
        both.append(Scene(knot));
        const DeviceTree tree = buildOctree(baselineDevice(), uploaded(both), grid, {Coverage::Thin, false, {}}).octree;
        test::expectSameCodes(baseline::listCodes(baselineDevice(), octree), voxelCodes(baselineDevice(), tree));
        EXPECT_GT(octree.node_count, octree.static_count + 8) << "the knot is in the grid";
        test::expectSameHits({&octree}, tree, test::fewCameras(atrium.bounds()));
    }
}

TEST(ThesisTrace, HitsAreZvosFromEverywhereInEvenAndOddGrids)
{
    for (const std::uint32_t depth : {1U, 4U, 5U})
    {
        SCOPED_TRACE(depth);
        const Grid grid = gridOf(depth);
        const GpuScene scene = uploaded(test::randomTriangles(2, 20, static_cast<float>(grid.resolution())));
        const DeviceTree tree = buildOctree(baselineDevice(), scene, grid, {Coverage::Thin, false, {}}).octree;
        const PointerOctree octree = test::thesisOctree(scene, grid, {Coverage::Thin});
        test::expectSameHits({&octree}, tree, test::manyCameras(grid));
    }
}

TEST(ThesisTrace, AnOctreeWithoutVoxelsIsMissed)
{
    const PointerOctree octree = test::thesisOctree(uploaded(test::triangleSoup({})), gridOf(4), {});
    baseline::PointerPicture picture(baselineDevice().device(), 9, 17);
    const TraceCamera camera = traceCamera(test::manyCameras(octree.grid).front(), octree.grid, 17);
    baselineDevice().run([&](vk::FrameGraph& graph) { baseline::tracePicture(graph, octree, camera, picture); });
    for (const gpu::Hit& hit : baselineDevice().download(picture.hits))
    {
        EXPECT_EQ(hit.index, gpu::kHitMiss);
    }
}

} // namespace
} // namespace zvo
