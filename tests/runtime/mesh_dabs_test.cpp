// SPDX-License-Identifier: MIT
// Meshes that edit trees: what is left is the difference, the union or the intersection of sets of voxels.
#include "runtime/mesh_dabs.h"

#include "core/base/morton.h"
#include "core/file/tree_check.h"
#include "core/tree/tree_build.h"
#include "runtime/flatten.h"
#include "runtime/live_scene.h"
#include "runtime/trees.h"
#include "support/engine_device.h"
#include "support/scenes.h"
#include "support/tree_samples.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <iterator>
#include <utility>
#include <vector>

namespace zvo
{
namespace
{

using test::device;

using Cells = std::vector<std::uint64_t>; // codes, ascending

Cells cellsOf(const TreeData& tree)
{
    Cells cells;
    forEachCell(tree, [&](std::uint64_t code, bool) { cells.push_back(code); });
    return cells;
}

TreeData filledTree(const Scene& scene, const Grid& grid)
{
    return downloadTree(device(),
                        buildOctree(device(), uploadScene(device(), scene, true), grid, {.fill = Fill::Solid}).octree);
}

// The tree after what edit() does to it.
TreeData edited(const TreeData& tree,
                const std::function<void(const DeviceTree&, std::function<void(const Brush&)>)>& edit)
{
    LiveScene scene(device(), tree, {});
    edit(scene.tree(),
         [&](const Brush& brush)
         {
             scene.request(brush);
             scene.settle(0);
         });
    TreeData result = flattenTree(device(), scene.tree());
    EXPECT_EQ(checkTree(result), std::nullopt);
    return result;
}

// A box whose triangles all face outwards.
Scene closedBox(const glm::vec3& lo, const glm::vec3& hi)
{
    std::vector<glm::vec3> corners;
    for (const std::uint32_t number : {0U, 2U, 1U, 1U, 2U, 3U, 4U, 5U, 6U, 5U, 7U, 6U, 0U, 1U, 4U, 1U, 5U, 4U,
                                       2U, 6U, 3U, 3U, 6U, 7U, 0U, 4U, 2U, 2U, 4U, 6U, 1U, 3U, 5U, 3U, 7U, 5U})
    {
        corners.emplace_back((number & 1U) != 0 ? hi.x : lo.x, (number & 2U) != 0 ? hi.y : lo.y,
                             (number & 4U) != 0 ? hi.z : lo.z);
    }
    return test::triangleSoup(corners);
}

// A ball with full nodes of 16^3 voxels, and meshes within the grid, whose cells are those of their own filled trees.
TEST(MeshDabs, AreDifferenceUnionAndIntersection)
{
    const Grid grid = {glm::vec3(-3.5F, 2.0F, 0.25F), 0.125F, 6};
    const auto at = [&](float x, float y, float z) { return grid.origin + grid.voxel_size * glm::vec3(x, y, z); };
    const TreeData ball = filledTree(test::sphereScene(at(30, 31, 33), 29.0F * grid.voxel_size, 16), grid);
    const Cells whole = cellsOf(ball);
    ASSERT_LT(ball.nodes.size(),
              downloadTree(device(), uploadTree(device(), octreeOfVoxels(grid, whole))).nodes.size());
    for (const Scene& mesh : {test::sphereScene(at(12, 30, 40), 14.0F * grid.voxel_size, 9),
                              closedBox(at(20.25F, 5.25F, 8.75F), at(40.5F, 60.25F, 50.25F))})
    {
        const Cells cut = cellsOf(filledTree(mesh, grid));
        for (const BrushAction action : {BrushAction::Carve, BrushAction::Fill})
        {
            const TreeData result = edited(ball, [&](const DeviceTree& tree, const auto& dab)
                                           { forMeshDabs(device(), mesh, tree, {.action = action}, dab); });
            Cells expected;
            if (action == BrushAction::Carve)
            {
                std::ranges::set_difference(whole, cut, std::back_inserter(expected));
            }
            else
            {
                std::ranges::set_union(whole, cut, std::back_inserter(expected));
            }
            EXPECT_EQ(cellsOf(result), expected);
        }
        const TreeData result = edited(ball, [&](const DeviceTree& tree, const auto& dab)
                                       { forDabsOutside(device(), mesh, tree, flattenTree(device(), tree), {}, dab); });
        Cells expected;
        std::ranges::set_intersection(whole, cut, std::back_inserter(expected));
        EXPECT_EQ(cellsOf(result), expected);
    }
}

// Voxels of an octree, moved by any number of them and partly out of the grid.
TEST(MeshDabs, AnOctreeAsAStampDoesWhatACopyOfItsVoxelsDoes)
{
    const Grid grid = {glm::vec3(0), 1.0F, 6};
    const TreeData ball = filledTree(test::sphereScene(glm::vec3(30, 31, 33), 29, 16), grid);
    const Grid small = {glm::vec3(0), 1.0F, 5};
    const GpuScene scene = uploadScene(device(), test::sphereScene(glm::vec3(14, 17, 15), 12, 12), true);
    for (const std::pair<BrushAction, Fill>& kind : {std::pair(BrushAction::Carve, Fill::Solid),
                                                     {BrushAction::Carve, Fill::None},
                                                     {BrushAction::Fill, Fill::Solid}})
    {
        const BrushAction action = kind.first;
        const DeviceTree octree = buildOctree(device(), scene, small, {.fill = kind.second}).octree;
        const VoxelClip clip = copyVoxels(device(), octree, 0, {glm::ivec3(0), glm::ivec3(31)});
        for (const glm::ivec3& offset : {glm::ivec3(16, 20, 12), {-7, 33, 41}, {1, 2, 3}})
        {
            const TreeData expected = edited(ball, [&](const DeviceTree& /*tree*/, const auto& dab)
                                             { dab({.action = action, .stamp = clip.stampAt(offset, grid)}); });
            const TreeData result = edited(ball,
                                           [&](const DeviceTree& /*tree*/, const auto& dab) {
                                               dab({.action = action, .tree_stamp = {&octree, offset}});
                                           });
            EXPECT_EQ(test::treeDifference(result, expected), "");
            EXPECT_NE(test::treeDifference(result, ball), "");
        }
    }
}

// A box from below the grid to above it: its top is outside, and yet it is known what is inside.
TEST(MeshDabs, OfAMeshThatReachesOutOfTheGridAreThoseOfItsPartInside)
{
    const Grid grid = {glm::vec3(0), 1.0F, 6};
    const TreeData ball = filledTree(test::sphereScene(glm::vec3(30, 31, 33), 29, 16), grid);
    const Scene mesh = closedBox({20.25F, -70.0F, -9.0F}, {41.25F, 200.0F, 33.25F});
    const TreeData result =
        edited(ball, [&](const DeviceTree& tree, const auto& dab) { forMeshDabs(device(), mesh, tree, {}, dab); });
    Cells expected;
    std::ranges::copy_if(cellsOf(ball), std::back_inserter(expected),
                         [](std::uint64_t code)
                         {
                             const glm::uvec3 cell = cellOfCode(code);
                             return cell.x < 20 || cell.x > 41 || cell.z > 33;
                         });
    EXPECT_EQ(cellsOf(result), expected);
    // What is laid bare at x = 42 faces the box, at least where the ball was not surface.
    std::uint32_t facing = 0;
    std::uint32_t voxel = 0;
    const auto code = [](int value) { return static_cast<std::uint32_t>(value) & 0xFFFFU; };
    forEachCell(result,
                [&](std::uint64_t number, bool has_attributes)
                {
                    if (has_attributes && cellOfCode(number).x == 42)
                    {
                        facing += result.voxel_attributes[voxel].normal == code(-32767) ? 1 : 0;
                    }
                    voxel += has_attributes ? 1 : 0;
                });
    EXPECT_GT(facing, 500U);
    EXPECT_THROW(edited(ball, [&](const DeviceTree& tree, const auto& dab)
                        { forMeshDabs(device(), closedBox(glm::vec3(0), glm::vec3(600)), tree, {}, dab); }),
                 Error);
}

} // namespace
} // namespace zvo
