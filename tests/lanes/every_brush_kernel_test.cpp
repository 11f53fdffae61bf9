// SPDX-License-Identifier: MIT
// Runs every kernel of brushes once, on work as small as that of every_kernel_test.cpp.
#include "core/base/grid.h"
#include "core/dynamic/dynamic_octree.h"
#include "core/edit/edit.h"
#include "core/edit/voxel_clip.h"
#include "lanes/kernel_names.h"
#include "runtime/trees.h"
#include "support/edit_model.h"
#include "support/engine_device.h"
#include "support/octree_contents.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <utility>
#include <vector>

namespace zvo
{

namespace
{

using test::device;
using test::run;

void edit(DynamicOctree& octree, const Brush& brush)
{
    for (bool is_done = false; !is_done;)
    {
        const std::uint64_t frame = octree.beginFrame();
        run([&](vk::FrameGraph& graph) { is_done = octree.edit(graph, brush); });
        octree.frameDone(frame);
    }
    octree.endStroke();
}

// Carves, fills and paints with so little room that states have to move, undoes a step, and places a copy.
void editVoxels(DeviceTree fixed, bool attributes, float emission_scale, const DeviceTree& stamp_tree)
{
    DynamicOptions options;
    options.merge = MergeRule::Average;
    options.emission_scale = emission_scale;
    options.attributes = attributes;
    options.edits = {.entries_max = 4, .bytes_max = 0};
    DynamicOctree octree(device(), std::move(fixed), options);
    const auto cells = [&] { return test::cellsOf(device(), octree.tree()); };
    test::EditModel model(octree.tree().grid, cells(), attributes);
    std::vector<test::Cell> before;
    for (std::uint32_t i = 0; i < 4; ++i)
    {
        const auto action = static_cast<BrushAction>(i % 3);
        const Brush brush = {BrushShape::Sphere, action, gpu::ivec3(30 + 3 * i, 32, 34), 2 + 2 * i, 0x2060C0};
        before = model.cells();
        model.apply(brush, false);
        edit(octree, brush);
    }
    EXPECT_EQ(test::difference(cells(), model.cells()), "");
    if (octree.edits().undoCount() != 0)
    {
        run([&](vk::FrameGraph& graph) { octree.undoEdit(graph); });
        EXPECT_EQ(test::difference(cells(), before), "");
    }
    const Grid& grid = octree.tree().grid;
    const VoxelBox box = {{26, 28, 30}, {37, 37, 39}};
    const auto extent =
        DabExtent::of({.shape = BrushShape::Box, .center = box.lo, .span = box.hi - box.lo}, grid).value();
    DabBuffers buffers(device().device(), extent.cell_count);
    vk::BufferOf<gpu::uint> words(device().device(), "words", std::uint64_t{extent.leafCount()} * gpu::kStampWords);
    run([&](vk::FrameGraph& graph) { recordCopy(graph, octree.tree(), octree.editedRoot(), extent, words, buffers); });
    const VoxelClip clip(Stamp{box, device().download(words)});
    EXPECT_NE(clip.voxelCount(), 0U);
    const Brush stamp = {.action = BrushAction::Fill, .stamp = clip.stampAt({29, 21, 30}, grid)};
    test::EditModel copied(grid, cells(), attributes);
    copied.apply(stamp, false);
    edit(octree, stamp);
    EXPECT_EQ(test::difference(cells(), copied.cells()), "");
    const std::size_t cell_count = cells().size();
    edit(octree, {.action = BrushAction::Carve, .tree_stamp = {&stamp_tree, {1, 2, 3}}});
    EXPECT_LT(cells().size(), cell_count);
}

// Edits the scene as an octree, as a DAG, and without attributes; compiling more variants would take too long.
void editTrees(const Scene& scene, const Grid& grid)
{
    const float emission_scale = brightestEmission(scene);
    for (const bool attributes : {true, false})
    {
        const float scale = attributes ? emission_scale : 0;
        const GpuScene gpu_scene = uploadScene(device(), scene, attributes, scale);
        BuildOptions build;
        build.attributes = attributes;
        build.keep_sums = attributes;
        const DeviceTree stamp = buildOctree(device(), gpu_scene, grid, build).octree;
        if (attributes)
        {
            editVoxels(buildOctree(device(), gpu_scene, grid, build).octree, attributes, scale, stamp);
        }
        BuildResult built = buildOctree(device(), gpu_scene, grid, build);
        editVoxels(compress(device(), std::move(built.octree)).dag, attributes, scale, stamp);
    }
}

TEST(EveryKernel, OfBrushesRunsOnASmallScene)
{
    test::forgetKernels();
    editTrees(test::smallScene(), {.origin = glm::vec3(0.0F), .voxel_size = 0.25F, .depth = 6});
    test::expectAllRan(true);
}

} // namespace
} // namespace zvo
