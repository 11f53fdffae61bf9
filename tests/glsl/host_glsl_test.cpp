// SPDX-License-Identifier: MIT
// Kernels of a host that trace with zvo/trace.glsl (tests/glsl) make the same pictures as zvo's own kernels.
#include "core/dynamic/dynamic_octree.h"
#include "glsl/host_device.h"
#include "glsl/host_trees.h"
#include "glsl/zvo_picture.h"
#include "oracle/morton.h"
#include "support/dags.h"
#include "support/dynamic_updates.h"
#include "support/pictures.h"
#include "support/scenes.h"
#include "support/trace_octrees.h"

#include <glm/ext/matrix_transform.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <random>
#include <string>
#include <vector>

namespace zvo
{
namespace
{

using test::CodeSet;
using test::dagWith;
using test::deviceOfHosts;
using test::HostVariant;
using test::octreeWith;
using test::ZvoPicture;

constexpr HostVariant kAnyTree = {"host/picture"};
constexpr std::array kVariants = {kAnyTree, HostVariant{"host/picture_levels", true}};

// Sets of voxels whose pictures are made quickly in every format.
std::vector<CodeSet> smallSets()
{
    std::vector<CodeSet> sets = test::codeSets();
    std::erase_if(sets, [](const CodeSet& set) { return set.depth > 7; });
    return sets;
}

// Views in perspective from outside and from inside, and an orthographic one.
std::array<ViewCamera, 3> threeViews(const Grid& grid)
{
    const std::vector<ViewCamera> views = test::manyCameras(grid);
    return {views[0], views[1], views[12]};
}

constexpr std::array kFormats = {AttributeFormat::None, AttributeFormat::Bytes4, AttributeFormat::Bytes8,
                                 AttributeFormat::Blocks};

TEST(HostGlsl, PicturesOfOctreesAndDagsAreZvos)
{
    std::size_t number = 0;
    for (const CodeSet& set : smallSets())
    {
        for (const AttributeFormat format : kFormats)
        {
            const DeviceTree octree = octreeWith(set, format);
            const DeviceTree dag = dagWith(set, format);
            const std::array<ViewCamera, 3> views = threeViews(octree.grid);
            for (const DeviceTree& tree : {std::cref(octree), std::cref(dag)})
            {
                SCOPED_TRACE("depth " + std::to_string(set.depth) + ", format " + formatName(format) + ", lists " +
                             std::to_string(tree.entriesPerWord()));
                const ZvoPicture outside(tree, views[0]);
                EXPECT_GT(outside.hitCount(), 0U);
                for (const HostVariant& variant : kVariants)
                {
                    ASSERT_NO_FATAL_FAILURE(outside.expectSame(variant));
                }
                ASSERT_NO_FATAL_FAILURE(
                    ZvoPicture(tree, views.at(1 + number % 2)).expectSame(kVariants.at(number / 2 % 2)));
                ++number;
            }
        }
    }
}

TEST(HostGlsl, EveryCameraSeesTheSame)
{
    const CodeSet set = {6, test::sphereShell(6, 24.0)};
    const DeviceTree octree = octreeWith(set, AttributeFormat::Bytes8);
    const DeviceTree dag = dagWith(set, AttributeFormat::Bytes8);
    std::size_t number = 0;
    for (const ViewCamera& view : test::manyCameras(octree.grid))
    {
        SCOPED_TRACE("camera " + std::to_string(number));
        ASSERT_NO_FATAL_FAILURE(ZvoPicture(octree, view).expectSame(kVariants.at(number % 2)));
        ASSERT_NO_FATAL_FAILURE(ZvoPicture(dag, view).expectSame(kVariants.at((number + 1) % 2)));
        ++number;
    }
}

TEST(HostGlsl, AnyEntriesAWordGiveTheSame)
{
    std::mt19937 random(72);
    const CodeSet set = {9, test::randomCodes(9, 3000, random)};
    for (const std::uint32_t entries : {2U, 3U, 4U})
    {
        const DeviceTree dag = dagWith(set, AttributeFormat::Bytes8, entries);
        const ZvoPicture picture(dag, threeViews(dag.grid)[0]);
        EXPECT_GT(picture.hitCount(), 0U) << entries;
        for (const HostVariant& variant : kVariants)
        {
            ASSERT_NO_FATAL_FAILURE(picture.expectSame(variant)) << entries;
        }
    }
}

TEST(HostGlsl, EveryDepthIsTheSame)
{
    std::mt19937 random(73);
    for (std::uint32_t depth = 1; depth <= Grid::kDepthMax; ++depth)
    {
        SCOPED_TRACE("depth " + std::to_string(depth));
        const CodeSet set = {depth, test::randomCodes(depth, 300, random)};
        const AttributeFormat format = kFormats.at(1 + depth % 3);
        const DeviceTree octree = octreeWith(set, format);
        const DeviceTree dag = dagWith(set, format);
        const glm::dvec3 voxel = glm::dvec3(oracle::mortonDecode(set.codes.back())) + 0.5;
        const ViewCamera view = ViewCamera::lookAt(voxel + glm::dvec3(3.0, 4.0, 5.0), voxel, 0.5);
        for (const DeviceTree& tree : {std::cref(octree), std::cref(dag)})
        {
            const ZvoPicture picture(tree, view);
            EXPECT_GT(picture.hitCount(), 0U);
            ASSERT_NO_FATAL_FAILURE(picture.expectSame(kAnyTree));
        }
    }
}

TEST(HostGlsl, LevelsOfDetailStopAtTheSameNodes)
{
    for (const CodeSet& set : smallSets())
    {
        for (const AttributeFormat format : {AttributeFormat::Bytes8, AttributeFormat::Blocks})
        {
            const DeviceTree octree = octreeWith(set, format);
            const DeviceTree dag = dagWith(set, format);
            for (const std::uint32_t level : {0U, 1U, 2U, UINT32_MAX})
            {
                TraceOptions options;
                options.detail_level = level;
                options.detail_pixels = level == UINT32_MAX ? 6.0F : 0.0F;
                const ViewCamera view = test::manyCameras(octree.grid).at(level == 1 ? 12 : 0);
                SCOPED_TRACE("depth " + std::to_string(set.depth) + ", level " + std::to_string(level));
                // The attributes of a DAG's nodes have another order, which pictures do not show.
                for (const DeviceTree& tree : {std::cref(octree), std::cref(dag)})
                {
                    const ZvoPicture picture(tree, view, options);
                    EXPECT_GT(picture.hitCount(), 0U);
                    ASSERT_NO_FATAL_FAILURE(picture.expectSame({"host/picture_detail"}));
                }
            }
        }
    }
}

struct OverlayCase
{
    std::uint32_t depth;
    bool compressed;
    bool attributes;
};

using HostGlslOverlays = testing::TestWithParam<OverlayCase>;

INSTANTIATE_TEST_SUITE_P(Trees, HostGlslOverlays,
                         testing::Values(OverlayCase{5, false, true}, OverlayCase{5, true, true},
                                         OverlayCase{8, false, true}, OverlayCase{8, true, true},
                                         OverlayCase{8, false, false}, OverlayCase{8, true, false},
                                         OverlayCase{11, true, true}),
                         [](const auto& test_case)
                         {
                             return std::string(test_case.param.compressed ? "Dag" : "Octree") +
                                    std::to_string(test_case.param.depth) +
                                    (test_case.param.attributes ? "" : "WithoutAttributes");
                         });

// A merged box, and a dab of a brush.
TEST_P(HostGlslOverlays, AreSeen)
{
    const auto& [depth, compressed, attributes] = GetParam();
    std::mt19937 random(depth);
    const CodeSet set = {depth, test::randomCodes(depth, 9000, random)};
    const AttributeFormat format = attributes ? AttributeFormat::Bytes8 : AttributeFormat::None;
    DynamicOptions options;
    options.merge = MergeRule::DynamicWins;
    options.attributes = attributes;
    options.emission_scale = 3.5F;
    DynamicOctree octree(deviceOfHosts(), compressed ? dagWith(set, format) : octreeWith(set, format), options);
    const float edge = std::ldexp(1.0F, static_cast<int>(depth));
    const Scene box = test::boxScene(glm::vec3(0.0F), glm::vec3(std::min(0.4F * edge, 30.0F)));
    octree.add(uploadDynamicMesh(deviceOfHosts(), box, attributes, options.emission_scale),
               {{glm::translate(glm::mat4(1.0F), glm::vec3(0.3F * edge))}, {}, {}});
    const glm::ivec3 dab(static_cast<int>(0.7F * edge));
    const Brush brush = {BrushShape::Sphere, BrushAction::Fill, dab, 3, 0x2060C0};
    for (bool is_done = false; !is_done;)
    {
        const std::uint64_t frame = octree.beginFrame();
        deviceOfHosts().run([&](vk::FrameGraph& graph) { is_done = octree.edit(graph, brush); });
        octree.frameDone(frame);
    }
    test::updateAll(deviceOfHosts(), octree);
    ASSERT_TRUE(octree.tree().hasOverlays());
    ASSERT_EQ(octree.tree().isDag(), compressed);
    const glm::dvec3 near = glm::dvec3(dab) + glm::dvec3(12.0, 9.0, 15.0);
    for (const ViewCamera& view :
         {test::manyCameras(octree.tree().grid).front(), ViewCamera::lookAt(near, glm::dvec3(dab), 0.8)})
    {
        const ZvoPicture picture(octree.tree(), view);
        EXPECT_GT(picture.hitCount(), 0U);
        for (const HostVariant& variant : kVariants)
        {
            ASSERT_NO_FATAL_FAILURE(picture.expectSame(variant));
        }
        TraceOptions coarse;
        coarse.detail_level = 2;
        ASSERT_NO_FATAL_FAILURE(ZvoPicture(octree.tree(), view, coarse).expectSame({"host/picture_detail"}));
    }
}

TEST(HostGlsl, AnEmptyTreeIsMissed)
{
    const CodeSet empty = {4, {}};
    const DeviceTree octree = test::octreeOf(deviceOfHosts(), empty.codes, empty.depth);
    const DeviceTree dag = test::svdagOf(deviceOfHosts(), octree);
    for (const DeviceTree& tree : {std::cref(octree), std::cref(dag)})
    {
        const ZvoPicture picture(tree, threeViews(octree.grid)[0]);
        EXPECT_EQ(picture.hitCount(), 0U);
        picture.expectSame(kAnyTree);
    }
}

} // namespace
} // namespace zvo
