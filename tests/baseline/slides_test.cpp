// SPDX-License-Identifier: MIT
// The slides' voxels, attributes and nodes against zvo's.
#include "baseline/slides_builder.h"
#include "baseline/slides_fixture.h"
#include "io/gltf/gltf_loader.h"
#include "support/dags.h"
#include "support/errors.h"
#include "support/materials_scene.h"
#include "support/param_names.h"
#include "support/scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace zvo::baseline
{
namespace
{

using test::slidesDevice;

// What zvo makes of a scene.
struct Expected
{
    BuildResult build;
    std::vector<std::uint64_t> codes;

    Expected(const GpuScene& scene, const Grid& grid, Coverage coverage, bool attributes)
        : build(buildOctree(slidesDevice(), scene, grid, {coverage, attributes, {}})),
          codes(voxelCodes(slidesDevice(), build.octree))
    {
    }
};

// Levels of different nodes, where levels of zvo's DAG are among them: a node of zvo has the children of two levels.
void expectLevelsOfDag(const SlidesTree& tree, const DeviceTree& octree)
{
    const oracle::ReferenceDag dag = test::referenceDagOf(slidesDevice(), octree);
    for (std::size_t level = 0; 2 * (level + 1) <= tree.level_node_counts.size(); ++level)
    {
        EXPECT_EQ(tree.level_node_counts[2 * level + 1], dag.levels[dag.levels.size() - 1 - level].node_count);
    }
}

// Builds an octree or a DAG, and compares voxels, numbers of nodes, and attributes, if options ask for them.
void expectZvos(const GpuScene& scene, const Grid& grid, const Expected& expected, const SlidesOptions& options)
{
    SCOPED_TRACE(testing::Message() << test::nameOf(options.coverage) << (options.dag ? " DAG" : " octree")
                                    << " at depth " << grid.depth);
    const SlidesResult slides = test::buildSlides(scene, grid, options);
    EXPECT_EQ(slides.dropped, expected.build.dropped);
    test::expectSlidesTree(slides.tree, expected.codes,
                           options.dag ? test::distinctSubtrees(expected.codes, grid.depth)
                                       : test::nodeCounts(expected.codes, grid.depth));
    if (options.dag)
    {
        expectLevelsOfDag(slides.tree, expected.build.octree);
    }
    if (options.attributes)
    {
        test::expectSlidesAttributes(slides.tree, expected.build.octree);
    }
}

void expectZvos(const GpuScene& scene, const Grid& grid, const SlidesOptions& options)
{
    expectZvos(scene, grid, Expected(scene, grid, options.coverage, options.attributes), options);
}

void expectZvosVoxels(const GpuScene& scene, const Grid& grid)
{
    for (const Coverage coverage : {Coverage::Thin, Coverage::Conservative})
    {
        expectZvos(scene, grid, {.coverage = coverage, .attributes = scene.has_attributes});
    }
}

using SlidesScenes = testing::TestWithParam<std::string>;

INSTANTIATE_TEST_SUITE_P(Scenes, SlidesScenes, testing::ValuesIn(test::slidesScenes()), test::paramName<std::string>);

TEST_P(SlidesScenes, HaveZvosVoxelsAndNodes)
{
    const auto path = test::findScene(GetParam());
    if (!path)
    {
        GTEST_SKIP() << GetParam() << " is not there";
    }
    const Scene scene = loadGltf(*path);
    const GpuScene uploaded = uploadScene(slidesDevice(), scene, true);
    const Grid grid128 = Grid::around(scene.bounds(), 7);
    const Grid grid256 = Grid::around(scene.bounds(), 8);
    expectZvos(uploaded, grid128, {.coverage = Coverage::Conservative, .attributes = true});
    expectZvos(uploaded, grid128, {.coverage = Coverage::Thin, .attributes = false, .dag = true});
    expectZvos(uploaded, grid256, {.coverage = Coverage::Conservative, .attributes = false});
    expectZvos(uploaded, grid256, {.coverage = Coverage::Thin, .attributes = true, .dag = true});
}

TEST(Slides, BothKindsOfNodesMakeOctreesAndDags)
{
    for (const std::uint32_t depth : {1U, 2U, 5U, 6U})
    {
        const auto half = static_cast<float>(1U << depth) / 2;
        const GpuScene scene = uploadScene(slidesDevice(), test::sphereScene(glm::vec3(half), 0.9F * half, 16), false);
        const Grid grid{.origin = glm::vec3(0.0F), .voxel_size = 1.0F, .depth = depth};
        const Expected expected(scene, grid, Coverage::Thin, false);
        for (const SlidesNodes nodes : {SlidesNodes::Plain, SlidesNodes::WithSums})
        {
            for (const bool dag : {false, true})
            {
                expectZvos(scene, grid, expected, {.attributes = false, .dag = dag, .nodes = nodes});
            }
        }
    }
}

TEST(Slides, RandomTrianglesHaveZvosVoxels)
{
    for (std::uint32_t depth = 1; depth <= 9; ++depth)
    {
        const auto extent = static_cast<float>(1U << depth);
        const Scene scene = test::randomTriangles(depth, depth <= 6 ? 400 : 25, extent);
        const GpuScene uploaded = uploadScene(slidesDevice(), scene, depth <= 6);
        expectZvosVoxels(uploaded, Grid{.origin = glm::vec3(0.0F), .voxel_size = 1.0F, .depth = depth});
    }
}

// Fragments come in another order then, and other candidates are the first in the table of equal nodes.
TEST(Slides, TheOrderOfTrianglesDoesNotMatter)
{
    const Grid grid{.origin = glm::vec3(0.0F), .voxel_size = 1.0F, .depth = 6};
    const Scene scene = test::randomTriangles(5, 200, 64.0F);
    Scene reversed = scene;
    std::ranges::reverse(reversed.primitives[0].triangles);
    const GpuScene uploaded = uploadScene(slidesDevice(), scene, true);
    const GpuScene uploaded_reversed = uploadScene(slidesDevice(), reversed, true);
    for (const bool dag : {false, true})
    {
        const SlidesTree tree = test::buildSlides(uploaded, grid, {.dag = dag}).tree;
        const SlidesTree other = test::buildSlides(uploaded_reversed, grid, {.dag = dag}).tree;
        EXPECT_TRUE(slidesDevice().download(tree.nodes) == slidesDevice().download(other.nodes));
        const auto attributes = slidesDevice().download(tree.attributes);
        const auto others = slidesDevice().download(other.attributes);
        EXPECT_TRUE(std::ranges::equal(attributes, others,
                                       [](const gpu::Attribute& a, const gpu::Attribute& b)
                                       { return a.color == b.color && a.normal == b.normal; }));
    }
}

// Some triangles' vertices are far outside of the grid.
TEST(Slides, ACutOutOfASceneHasZvosVoxels)
{
    const Scene scene = test::randomTriangles(77, 300, 4000.0F);
    const GpuScene uploaded = uploadScene(slidesDevice(), scene, false);
    for (const std::uint32_t depth : {3U, 7U})
    {
        expectZvosVoxels(uploaded, Grid{.origin = glm::vec3(1900.0F), .voxel_size = 1.0F, .depth = depth});
    }
}

TEST(Slides, MaterialsGiveZvosAttributes)
{
    const Scene scene = test::materialsScene(64.0F);
    const GpuScene uploaded = uploadScene(slidesDevice(), scene, true);
    const Grid grid{.origin = glm::vec3(0.0F), .voxel_size = 1.0F, .depth = 6};
    expectZvos(uploaded, grid, {.coverage = Coverage::Thin});
}

// Walls over the whole grid, in rows that are longer than a piece, and segments: their pieces are many.
TEST(Slides, WallsAndSegmentsAreWalkedInPieces)
{
    const float e = 8192.0F;
    const Scene walls = test::triangleSoup({{0, 5, 0}, {e, 6, 0}, {0, 7, 3}, {1, 1, 1}, {e, 900, 2}, {e, 900, 2}});
    const GpuScene uploaded = uploadScene(slidesDevice(), walls, false);
    expectZvosVoxels(uploaded, Grid{.origin = glm::vec3(0.0F), .voxel_size = 1.0F, .depth = gpu::kSlidesDepthMax});
    const Scene square =
        test::triangleSoup({{0, 0, 1}, {1024, 0, 900}, {0, 1024, 10}, {1, 2, 3}, {900, 950, 1000}, {1, 2, 3}});
    const GpuScene uploaded_square = uploadScene(slidesDevice(), square, false);
    expectZvosVoxels(uploaded_square, Grid{.origin = glm::vec3(0.0F), .voxel_size = 1.0F, .depth = 10});
}

TEST(Slides, AnEmptySceneGivesNoNodes)
{
    const Grid grid{.origin = glm::vec3(0.0F), .voxel_size = 1.0F, .depth = 5};
    const Scene outside = test::triangleSoup({{-9, -9, -9}, {-8, -9, -9}, {-9, -8, -9}});
    for (const Scene& scene : {Scene{}, outside})
    {
        const GpuScene uploaded = uploadScene(slidesDevice(), scene, false);
        const SlidesResult slides = test::buildSlides(uploaded, grid, {.attributes = false});
        test::expectSlidesTree(slides.tree, {}, {});
    }
}

TEST(Slides, StagesAreAllOfTheTime)
{
    const Scene scene = test::sphereScene(glm::vec3(32.0F), 30.0F, 20);
    const GpuScene uploaded = uploadScene(slidesDevice(), scene, true);
    const Grid grid{.origin = glm::vec3(0.0F), .voxel_size = 1.0F, .depth = 6};
    const SlidesResult slides = test::buildSlides(uploaded, grid, {.dag = true});
    double sum = 0;
    for (const SlidesStage stage : {SlidesStage::Voxelize, SlidesStage::Sort, SlidesStage::Unique, SlidesStage::Build})
    {
        EXPECT_GT(slides.stageMs(stage), 0.0);
        sum += slides.stageMs(stage);
    }
    EXPECT_NEAR(sum, slides.ms(), 1e-9);
    EXPECT_GT(slides.fragment_count, slides.tree.voxel_count);
}

TEST(Slides, DepthsThatCannotBeAreRefused)
{
    const GpuScene uploaded = uploadScene(slidesDevice(), test::boxScene(glm::vec3(0.0F), glm::vec3(1.0F)), false);
    for (const std::uint32_t depth : {0U, gpu::kSlidesDepthMax + 1})
    {
        const Grid grid{.origin = glm::vec3(0.0F), .voxel_size = 1.0F, .depth = depth};
        EXPECT_THROW(SlidesBuilder(slidesDevice().device(), uploaded, grid, {.attributes = false}), Error);
    }
    const Grid grid{.origin = glm::vec3(0.0F), .voxel_size = 1.0F, .depth = 3};
    EXPECT_THROW(SlidesBuilder(slidesDevice().device(), uploaded, grid, {.attributes = true}), Error);
}

} // namespace
} // namespace zvo::baseline
