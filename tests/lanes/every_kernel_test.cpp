// SPDX-License-Identifier: MIT
// Runs every kernel of the library once, but for those of brushes. The work is so small that it can be watched by tools
// that slow programs down a hundredfold: valgrind, instrumented kernels, poisoned memory.
#include "core/algebra/components.h"
#include "core/algebra/tree_operator.h"
#include "core/base/grid.h"
#include "core/deform/deform_mesh.h"
#include "core/dynamic/dynamic_octree.h"
#include "core/octree/octree_build.h"
#include "core/scene/animation.h"
#include "core/tree/device_tree.h"
#include "lanes/kernel_names.h"
#include "lanes/traced_pictures.h"
#include "oracle/voxelizer.h"
#include "runtime/distances.h"
#include "runtime/run_job.h"
#include "runtime/svdag_forest.h"
#include "runtime/trees.h"
#include "support/dag_compare.h"
#include "support/dags.h"
#include "support/edit_model.h"
#include "support/engine_device.h"
#include "support/octree_contents.h"
#include "support/scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace zvo
{

namespace
{

using test::askQuestions;
using test::device;
using test::keepLight;
using test::noteKernels;
using test::run;
using test::traceForHosts;
using test::tracePacked;
using test::tracePaths;
using test::tracePictures;

// The path to a voxel's rank in a DAG goes below the table of ranks, through every kind of list.
constexpr std::uint32_t kDepthOfRankSums = 11;

std::vector<std::uint64_t> voxelCodesOf(const std::vector<test::Cell>& cells, const Grid& grid)
{
    std::vector<std::uint64_t> codes;
    for (const test::Cell& cell : cells)
    {
        if (cell.level == grid.nodeLevels())
        {
            codes.push_back(cell.code);
        }
    }
    return codes;
}

// Deforms 70 vertices with all that a deforming mesh can have, in two instances; the second one has no skin.
void deformVertices()
{
    Scene scene;
    Primitive& primitive = scene.primitives.emplace_back();
    for (std::uint32_t i = 0; i < 70; ++i)
    {
        const auto place = static_cast<float>(i);
        primitive.positions.emplace_back(place, 1.0F, 2.0F);
        primitive.normals.emplace_back(0.0F, 1.0F, 0.0F);
        primitive.joints.emplace_back(i % 3, 1, 2, 0);
        primitive.weights.emplace_back(0.5F, 0.25F, 0.25F, 0.0F);
    }
    primitive.morph_targets = {{primitive.normals, {}}, {primitive.positions, primitive.normals}};
    scene.skins.push_back({{0, 0, 0}, std::vector<glm::mat4>(3, glm::mat4(1.0F))});
    scene.instances.push_back({0, glm::mat4(1.0F), kNone, 0});
    scene.instances.push_back({0, glm::mat4(1.0F), kNone, kNone});
    Pose pose;
    pose.transforms.assign(2, glm::mat4(1.0F));
    pose.joint_matrices = {std::vector<glm::mat4>(3, glm::mat4(2.0F)), {}};
    pose.morph_weights = {{0.5F, 0.25F}, {1.0F, 0.0F}};
    const DeformMesh mesh = uploadDeformMesh(device(), scene);
    PoseBuffers buffers(device().device(), mesh);
    vk::BufferOf<gpu::vec3> positions(device().device(), "positions", mesh.position_count);
    vk::BufferOf<gpu::vec3> normals(device().device(), "normals", mesh.normal_count);
    run(
        [&](vk::FrameGraph& graph)
        {
            updatePose(graph, mesh, pose, buffers);
            deform(graph, mesh, buffers, positions, normals);
        });
    const std::vector<gpu::vec3> moved = device().download(positions);
    EXPECT_EQ(moved.at(69), gpu::vec3(172.5F, 3.5F, 5.0F)); // (69, 1, 2) * 1.25 and (0, 0.5, 0), doubled
    EXPECT_EQ(moved.at(139), gpu::vec3(69.0F, 2.0F, 2.0F)); // 1 added to y
}

// Averages the nodes of an octree in which voxels are some way apart.
void averageNodesOf(const GpuScene& scene, std::uint32_t depth, std::uint64_t voxel_count, std::uint64_t distance)
{
    const Grid grid{.origin = glm::vec3(0.0F), .voxel_size = 1.0F, .depth = depth};
    std::vector<test::Cell> voxels;
    for (std::uint64_t i = 0; i < voxel_count; ++i)
    {
        const auto noise = static_cast<gpu::uint>(i * 0x9E3779B97F4A7C15U >> 32);
        voxels.push_back({grid.nodeLevels(), i * distance, {noise & 0xFFFFFF, noise * 0x85EBCA6B}});
    }
    const std::vector<test::Cell> expected = test::EditModel(grid, voxels, true).cells();
    std::vector<test::Cell> cells = expected;
    for (test::Cell& cell : cells)
    {
        cell.attribute = cell.level < grid.nodeLevels() ? gpu::Attribute{} : cell.attribute;
    }
    DeviceTree octree = test::octreeOf(device(), cells, grid, 1.0F);
    run([&](vk::FrameGraph& graph) { averageNodes(graph, scene, octree); });
    EXPECT_EQ(test::difference(test::cellsOf(device(), octree), expected), "");
}

// Merges the scene, as an octree or a DAG, with a copy of itself that is moved by two voxels, traces pictures of it,
// and undoes it.
void mergeObjects(const Scene& scene, const Grid& grid, Coverage coverage, bool compressed)
{
    const float emission_scale = brightestEmission(scene);
    const GpuScene gpu_scene = uploadScene(device(), scene, true, emission_scale);
    BuildOptions build{coverage};
    build.keep_sums = true;
    BuildResult built = buildOctree(device(), gpu_scene, grid, build);
    DeviceTree fixed;
    if (compressed)
    {
        fixed = test::svdagOf(device(), built.octree);
        fixed.sums = std::move(built.octree.sums);
    }
    else
    {
        fixed = std::move(built.octree);
    }
    DynamicOctree octree(device(), std::move(fixed),
                         {.coverage = coverage, .merge = MergeRule::Average, .emission_scale = emission_scale});
    const std::vector<test::Cell> before = test::cellsOf(device(), octree.tree());

    Scene moved = scene;
    Pose pose;
    for (Instance& instance : moved.instances)
    {
        instance.transform[3].x += 2.0F * grid.voxel_size;
        pose.transforms.push_back(instance.transform);
    }
    octree.add(uploadDynamicMesh(device(), scene, true, emission_scale), pose);
    do
    {
        const std::uint64_t frame = octree.beginFrame();
        run([&](vk::FrameGraph& graph) { octree.update(graph); });
        octree.frameDone(frame);
    } while (octree.needsUpdate());
    Scene both = scene;
    both.append(std::move(moved));
    EXPECT_EQ(voxelCodesOf(test::cellsOf(device(), octree.tree()), grid), oracle::voxelize(both, grid, coverage).codes);

    tracePictures(octree.tree());
    for (const char* kernel : {"trace/node_ranks", "trace/primary_ranks", "trace/ranks"}) // for overlays of DAGs
    {
        EXPECT_EQ(test::hasRun(kernel), compressed) << kernel;
    }

    run([&](vk::FrameGraph& graph) { octree.undo(graph); });
    EXPECT_EQ(test::difference(test::cellsOf(device(), octree.tree()), before), "");
}

// Carves the scene by itself, filled: nothing is left.
void carveObjects(const Scene& scene, const Grid& grid)
{
    DynamicOctree octree(device(),
                         buildOctree(device(), uploadScene(device(), scene, false), grid, {.attributes = false}).octree,
                         {.attributes = false});
    EXPECT_GT(voxelCodesOf(test::cellsOf(device(), octree.tree()), grid).size(), 0U);
    Pose pose;
    for (const Instance& instance : scene.instances)
    {
        pose.transforms.push_back(instance.transform);
    }
    octree.add(uploadDynamicMesh(device(), scene, false, 0.0F), pose, {.carves = true, .fill = Fill::Solid});
    do
    {
        const std::uint64_t frame = octree.beginFrame();
        run([&](vk::FrameGraph& graph) { octree.update(graph); });
        octree.frameDone(frame);
    } while (octree.needsUpdate());
    EXPECT_EQ(voxelCodesOf(test::cellsOf(device(), octree.tree()), grid).size(), 0U);
}

// Compresses the octree to a DAG, and that DAG again, in which nothing more can be shared.
void compressOctree(DeviceTree octree, const CompressOptions& options)
{
    const DeviceTree expected = test::svdagOf(device(), octree);
    CompressResult once = compress(device(), std::move(octree), options);
    noteKernels(once.passes);
    EXPECT_EQ(once.retry_count != 0, options.table_slots != 0);
    EXPECT_EQ(test::difference(device(), once.dag, expected), "");
    const CompressResult twice = compress(device(), std::move(once.dag));
    noteKernels(twice.passes);
    EXPECT_EQ(test::difference(device(), twice.dag, expected), "");
}

// Makes the same DAG, joined of eight tiles.
void joinTiles(const GpuScene& scene, const Grid& grid, Coverage coverage, const DeviceTree& octree)
{
    const std::uint32_t tile_depth = grid.depth - 1;
    SvdagForest forest(device(), grid, tile_depth);
    for (std::uint32_t code = 0; code < 8; ++code)
    {
        const GridTile tile(grid, tile_depth, {code & 1, code >> 1 & 1, code >> 2});
        BuildResult built = buildOctree(device(), scene, tile, {coverage, false, {}});
        if (built.octree.node_count != 0)
        {
            forest.add(code, std::move(compress(device(), std::move(built.octree)).dag));
        }
    }
    const std::vector<gpu::Node> pool = device().download(forest.finish(true).nodes);
    const std::vector<gpu::Node> expected = device().download(test::svdagOf(device(), octree).nodes);
    EXPECT_EQ(pool.size(), expected.size());
    EXPECT_TRUE(std::ranges::equal(std::as_bytes(std::span(pool)), std::as_bytes(std::span(expected))));
    noteKernels(forest.passes());
}

// Builds the octree of a scene in each form of sums of all voxels.
void addInAllForms(const Scene& scene, const Grid& grid, Coverage coverage)
{
    const GpuScene gpu_scene = uploadScene(device(), scene, true);
    const DeviceTree octree = buildOctree(device(), gpu_scene, grid, {coverage}).octree;
    EXPECT_EQ(voxelCodes(device(), octree), oracle::voxelize(scene, grid, coverage).codes);
    std::vector<SumForm> forms(1);
    if (SumForm::on(device().device()).int64)
    {
        forms.push_back({.int64 = true});
    }
    for (const SumForm form : forms)
    {
        BuildOptions options = {coverage};
        options.sum_form = form;
        const BuildResult built = buildOctree(device(), gpu_scene, grid, options);
        noteKernels(built.passes);
        EXPECT_EQ(test::difference(test::cellsOf(device(), built.octree), test::cellsOf(device(), octree)), "");
    }
}

// Builds an octree of a scene that emits nothing, with sums of mixed voxels alone and of all voxels.
void buildDark(const Grid& grid, Coverage coverage)
{
    const GpuScene dark = uploadScene(device(), test::sphereScene(glm::vec3(8.0F), 6.0F, 6), true);
    std::vector<test::Cell> expected;
    for (const bool int64 : {false, SumForm::on(device().device()).int64})
    {
        for (const bool mixed : {false, true})
        {
            BuildOptions options = {coverage};
            options.sum_form = SumForm{.int64 = int64, .mixed = mixed};
            const BuildResult built = buildOctree(device(), dark, grid, options);
            noteKernels(built.passes);
            const std::vector<test::Cell> cells = test::cellsOf(device(), built.octree);
            expected = expected.empty() ? cells : expected;
            EXPECT_EQ(test::difference(expected, cells), "");
        }
    }
    if (grid.nodeLevels() > 2)
    {
        for (const Fill fill : {Fill::Solid, Fill::Robust})
        {
            const BuildResult filled = buildOctree(device(), dark, grid, {.coverage = coverage, .fill = fill});
            noteKernels(filled.passes);
            EXPECT_GT(filled.octree.interior_count, 0U);
        }
        const DistanceResult near = findDistances(device(), dark, grid, {.band = 2});
        noteKernels(near.passes);
        EXPECT_GT(near.distances.leaf_count, 0U);
    }
}

// Makes trees of an octree by each operation on trees, whose results follow from one another.
void calculate(const DeviceTree& octree)
{
    const GpuScene color_tables = uploadColorTables(device());
    const auto countOf = [&](const OperationInfo& info)
    {
        const OperationResult result = runJob(device(), TreeOperator(device().device(), color_tables, info));
        noteKernels(result.passes);
        return result.octree.occupiedCount();
    };
    const std::uint64_t all = octree.occupiedCount();
    EXPECT_EQ(countOf({.operation = TreeOperation::Unite, .a = &octree, .b = &octree}), all);
    EXPECT_EQ(countOf({.operation = TreeOperation::Intersect, .a = &octree, .b = &octree}), all);
    EXPECT_EQ(countOf({.operation = TreeOperation::Subtract, .a = &octree, .b = &octree}), 0U);
    EXPECT_GT(countOf({.operation = TreeOperation::Dilate, .corners = true, .a = &octree}), all);
    EXPECT_LT(countOf({.operation = TreeOperation::Erode, .a = &octree}), all);
    for (const ComponentOptions options : {ComponentOptions{.corners = true}, ComponentOptions{.background = true}})
    {
        const Components components = runJob(device(), ComponentFinder(device().device(), octree, options));
        noteKernels(components.passes);
        vk::BufferOf<gpu::uvec2> masks(device().device(), "masks", octree.node_count);
        run([&](vk::FrameGraph& graph)
            { maskComponents(graph, octree, options, components, componentsFrom(1), masks); });
        const TreeOperation operation = options.background ? TreeOperation::Enclose : TreeOperation::Keep;
        const std::uint64_t count = countOf({.operation = operation, .a = &octree, .masks = &masks});
        EXPECT_TRUE(options.background ? count >= all : count == all);
    }
}

TEST(EveryKernel, RunsOnASmallScene)
{
    const Scene scene = test::smallScene();
    Scene plain = scene; // has fewer variants of the raster kernels
    plain.instances.resize(1);
    const GpuScene gpu_scene = uploadScene(device(), scene, true);
    test::forgetKernels();
    deformVertices();
    for (std::uint32_t levels = 1; levels <= gpu::kNodeLevelsMax; ++levels)
    {
        averageNodesOf(gpu_scene, 2 * levels - 1, levels == 1 ? 8 : 60, 1);
    }
    averageNodesOf(gpu_scene, 2, 64, 1);
    averageNodesOf(gpu_scene, 8, 1000, 65);
    averageNodesOf(gpu_scene, 8, 200, 83'800); // the root has 64 children
    struct Case
    {
        Coverage coverage;
        std::uint32_t depth;
        float voxel_size;
        bool pictures;
        std::uint64_t table_slots; // at first, of the table of equal nodes; too few, or an estimate
    };
    // Rays begin below the root from depth 7 on, and keys have two words from depth 13 on.
    const Case cases[] = {{Coverage::Conservative, 3, 2.0F, false, 2},
                          {Coverage::Thin, 7, 0.25F, true, 0},
                          {Coverage::Thin, 13, 1.0F, false, 0}};
    for (const Case& c : cases)
    {
        const Grid grid{.origin = glm::vec3(0.0F), .voxel_size = c.voxel_size, .depth = c.depth};
        // Instrumented kernels search for each access in a list of all buffers, in loops of which lavapipe ends a long
        // sum: a scene is on the device only as long as needed.
        const Scene& built_scene = c.pictures ? scene : plain;
        BuildResult built = buildOctree(device(), uploadScene(device(), built_scene, true), grid, {c.coverage});
        EXPECT_EQ(voxelCodes(device(), built.octree), oracle::voxelize(built_scene, grid, c.coverage).codes);
        noteKernels(built.passes);
        buildDark(grid, c.coverage);
        if (c.pictures)
        {
            addInAllForms(plain, grid, c.coverage);
            mergeObjects(scene, grid, c.coverage, false);
            carveObjects(plain, grid);
            tracePictures(built.octree);
            traceForHosts(built.octree);
            tracePaths(built.octree);
            keepLight(built.octree);
            const DeviceTree dag = test::svdagOf(device(), built.octree);
            tracePictures(dag);
            keepLight(dag);
            askQuestions(built.octree);
            askQuestions(dag);
            const Grid deep{.origin = grid.origin, .voxel_size = grid.voxel_size, .depth = kDepthOfRankSums};
            mergeObjects(scene, deep, c.coverage, true);
            tracePictures(test::svdagOf(device(), buildOctree(device(), gpu_scene, deep, {c.coverage}).octree));
            for (const AttributeFormat format : {AttributeFormat::Bytes4, AttributeFormat::Blocks})
            {
                tracePacked(buildOctree(device(), gpu_scene, grid, {c.coverage}), format);
            }
        }
        if (c.depth != 3)
        {
            calculate(built.octree);
        }
        if (c.depth == 7)
        {
            joinTiles(gpu_scene, grid, c.coverage, built.octree);
        }
        compressOctree(std::move(built.octree), {.table_slots = c.table_slots});
    }
    test::scalePictures();
    test::expectAllRan(false);
}

} // namespace
} // namespace zvo
