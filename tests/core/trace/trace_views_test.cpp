// SPDX-License-Identifier: MIT
// Views of how voxels are stored, and reports on single pixels.
#include "core/dynamic/dynamic_objects.h"
#include "core/dynamic/dynamic_octree.h"
#include "core/scene/animation.h"
#include "core/trace/trace.h"
#include "core/tree/device_tree.h"
#include "core/tree/tree_data.h"
#include "core/upload/gpu_scene.h"
#include "runtime/trees.h"
#include "support/dags.h"
#include "support/engine_device.h"
#include "support/octree_access.h"
#include "support/pictures.h"
#include "support/scenes.h"
#include "support/trace_octrees.h"
#include "support/trace_rays.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <tuple>
#include <vector>

namespace zvo
{

namespace
{

using test::DeviceHit;
using test::Picture;

constexpr std::uint32_t kViewWidth = 61;
constexpr std::uint32_t kViewHeight = 47;
constexpr gpu::uint kBackground = 255U << 24;

using test::device;

Picture take(const DeviceTree& tree, const ViewCamera& camera, View view, float detail_pixels = 0)
{
    TraceOptions options;
    options.view = view;
    options.detail_pixels = detail_pixels;
    return test::takePicture(device(), tree, traceCamera(camera, tree.grid, kViewHeight), kViewWidth, kViewHeight,
                             options);
}

std::array<int, 3> rgb(gpu::uint pixel)
{
    return {static_cast<int>(pixel & 255U), static_cast<int>(pixel >> 8 & 255U), static_cast<int>(pixel >> 16 & 255U)};
}

/// A sponge of depth 6 with attributes.
DeviceTree sponge()
{
    DeviceTree octree = test::octreeOf(device(), test::spongeCodes(6), 6);
    test::addAttributes(device(), octree);
    return octree;
}

TEST(TraceViews, EveryVoxelHasAColorOfItsOwn)
{
    const DeviceTree octree = sponge();
    using Face = std::tuple<std::uint32_t, std::uint32_t, std::uint32_t, std::uint32_t, std::uint32_t>;
    std::map<Face, gpu::uint> colors;
    for (const ViewCamera& camera : test::manyCameras(octree.grid))
    {
        const Picture picture = take(octree, camera, View::Voxel);
        for (std::size_t i = 0; i < picture.image.size(); ++i)
        {
            const std::optional<DeviceHit> hit = test::unpack(picture.hits[i]);
            if (!hit)
            {
                ASSERT_EQ(picture.image[i], kBackground);
                continue;
            }
            const glm::uvec3& c = hit->cell;
            const auto [known, is_new] = colors.try_emplace({c.x, c.y, c.z, hit->level, hit->face}, picture.image[i]);
            ASSERT_EQ(known->second, picture.image[i]) << "the same from everywhere";
            const std::array<int, 3> color = rgb(picture.image[i]);
            ASSERT_GE(*std::ranges::max_element(color), 48) << "never as dark as the background";
        }
    }
    std::set<gpu::uint> different;
    for (const auto& [face, color] : colors)
    {
        different.insert(color);
    }
    ASSERT_GT(colors.size(), 1000U);
    EXPECT_GT(different.size(), colors.size() * 98 / 100); // of 2^24; some faces are darker
}

// The border that View::Bricks draws at a hit's pixel: 0 none, 1 to 3 those of leaves and larger nodes.
int borderOf(const DeviceHit& hit)
{
    int rank = 0;
    for (std::uint32_t axis = 0; axis < 3; ++axis)
    {
        const std::uint32_t coordinate = hit.cell[static_cast<int>(axis)];
        if (axis != hit.face && hit.face != gpu::kFaceInside)
        {
            rank = std::max(rank, coordinate % 64 == 0 ? 3 : coordinate % 16 == 0 ? 2 : coordinate % 4 == 0 ? 1 : 0);
        }
    }
    return rank;
}

TEST(TraceViews, BricksAreAlbedoWithTheBordersOfNodes)
{
    const DeviceTree octree = sponge();
    constexpr std::array<std::array<double, 3>, 4> kLines = {{{}, {1, 1, 1}, {1, 0.8, 0.1}, {1, 0.2, 0.1}}};
    std::array<int, 4> counts{};
    for (const ViewCamera& camera : test::manyCameras(octree.grid))
    {
        const Picture albedo = take(octree, camera, View::Albedo);
        const Picture bricks = take(octree, camera, View::Bricks);
        for (std::size_t i = 0; i < bricks.image.size(); ++i)
        {
            const std::optional<DeviceHit> hit = test::unpack(bricks.hits[i]);
            const int rank = hit ? borderOf(*hit) : 0;
            ++counts[static_cast<std::size_t>(rank)];
            if (rank == 0)
            {
                ASSERT_EQ(bricks.image[i], albedo.image[i]);
                continue;
            }
            for (std::size_t channel = 0; channel < 3; ++channel)
            {
                const double below = rgb(albedo.image[i])[channel];
                const double line = 255 * kLines[static_cast<std::size_t>(rank)][channel];
                ASSERT_NEAR(rgb(bricks.image[i])[channel], 0.4 * below + 0.6 * line, 1.01) << "border " << rank;
            }
        }
    }
    for (const int count : counts)
    {
        EXPECT_GT(count, 20);
    }
}

/// A static box in the left half of the grid, and another one that moves into the right half.
class TwoBoxes
{
public:
    explicit TwoBoxes(TreeStructure structure)
    {
        const Grid grid = {glm::vec3(0.0F), 1.0F, 6};
        DynamicOptions options;
        options.merge = MergeRule::DynamicWins;
        BuildResult built =
            buildOctree(device(), uploadScene(device(), test::boxScene({4, 20, 20}, {26, 44, 44}), true), grid, {});
        DeviceTree tree = std::move(built.octree);
        if (structure == TreeStructure::Svdag)
        {
            tree = compress(device(), std::move(tree)).dag;
        }
        m_octree = std::make_unique<DynamicOctree>(device(), std::move(tree), options);
        step([&](vk::FrameGraph& graph) { m_octree->update(graph); });
    }

    void addObject()
    {
        const Scene object = test::boxScene({37, 21, 21}, {58, 43, 43});
        m_octree->add(uploadDynamicMesh(device(), object, true, 0.0F), poseAt(object, 0.0));
        do
        {
            step([&](vk::FrameGraph& graph) { m_octree->update(graph); });
        } while (m_octree->needsUpdate());
    }

    void undo()
    {
        step([&](vk::FrameGraph& graph) { ASSERT_TRUE(m_octree->undo(graph)); });
    }

    [[nodiscard]] const DeviceTree& tree() const { return m_octree->tree(); }

private:
    void step(const std::function<void(vk::FrameGraph&)>& record)
    {
        const std::uint64_t frame = m_octree->beginFrame();
        device().run(record);
        m_octree->frameDone(frame);
    }

    std::unique_ptr<DynamicOctree> m_octree;
};

// The numbers of grey and of orange pixels.
std::array<int, 2> originCounts(const Picture& picture, bool object_is_right)
{
    std::array<int, 2> counts{};
    for (std::size_t i = 0; i < picture.image.size(); ++i)
    {
        const std::optional<DeviceHit> hit = test::unpack(picture.hits[i]);
        if (!hit)
        {
            continue;
        }
        const std::array<int, 3> color = rgb(picture.image[i]);
        const bool is_orange = color[0] > color[1] + 20 && color[1] > color[2] + 20;
        EXPECT_TRUE(is_orange || (color[0] == color[1] && color[1] == color[2]));
        const std::uint32_t middle = 1U << (2 * hit->level - 1); // half the grid, in cells of that level
        EXPECT_EQ(is_orange, object_is_right && hit->cell.x >= middle) << "pixel " << i;
        ++counts[is_orange ? 1 : 0];
    }
    return counts;
}

TEST(TraceViews, WhatAnUpdateMadeIsOrange)
{
    const ViewCamera camera = ViewCamera::lookAt({32, 60, 120}, {32, 32, 32}, 0.6);
    for (const TreeStructure structure : {TreeStructure::Svo, TreeStructure::Svdag})
    {
        SCOPED_TRACE(structureName(structure));
        TwoBoxes boxes(structure);
        const std::array<int, 2> before = originCounts(take(boxes.tree(), camera, View::Origin), false);
        EXPECT_GT(before[0], 100);
        boxes.addObject();
        const std::array<int, 2> counts = originCounts(take(boxes.tree(), camera, View::Origin), true);
        EXPECT_GT(counts[0], 100);
        EXPECT_GT(counts[1], 100);
        // A level of detail stops at leaves, none of which the two boxes share.
        const std::array<int, 2> coarse = originCounts(take(boxes.tree(), camera, View::Origin, 4.0F), true);
        EXPECT_GT(coarse[0], 100);
        EXPECT_GT(coarse[1], 100);
    }
}

gpu::PixelReport inspect(const DeviceTree& tree, const ViewCamera& view, const TraceOptions& options, glm::uvec2 pixel)
{
    const TraceCamera camera = traceCamera(view, tree.grid, kViewHeight);
    NodePaths paths(device().device(), tree.isDag());
    TraceBuffers buffers(device().device(), kViewWidth, kViewHeight);
    const std::vector<gpu::uint> both = {0,
                                         pixel.y * kViewWidth + pixel.x}; // the corner's, and the one that is asked for
    const vk::BufferOf<gpu::uint> pixels = device().makeBuffer<gpu::uint>("pixels", both);
    vk::BufferOf<gpu::PixelReport> reports(device().device(), "reports", both.size(), vk::MemoryKind::Readback);
    device().run(
        [&](vk::FrameGraph& graph)
        {
            buildNodePaths(graph, tree, paths);
            trace(graph, tree, paths, camera, options, buffers);
            inspectPixels(graph, tree, camera, options, buffers, pixels, reports);
            graph.releaseToHost();
        });
    return reports.mappedData()[1];
}

constexpr std::array<glm::uvec2, 6> kPixels = {{{30, 23}, {0, 0}, {60, 46}, {17, 40}, {44, 9}, {31, 5}}};

TEST(InspectPixels, TellsWhatThePictureShows)
{
    const DeviceTree octree = sponge();
    const std::vector<gpu::Attribute> voxels = device().download(octree.voxel_attributes);
    const std::vector<gpu::Attribute> averages = device().download(octree.node_attributes);
    const std::vector<gpu::Node> nodes = test::octreeNodes(device(), octree);
    int hit_count = 0;
    for (const ViewCamera& camera : test::manyCameras(octree.grid))
    {
        for (const float detail : {0.0F, 5.0F})
        {
            const Picture picture = take(octree, camera, View::Color, detail);
            for (const glm::uvec2& pixel : kPixels)
            {
                TraceOptions options;
                options.detail_pixels = detail;
                const gpu::PixelReport report = inspect(octree, camera, options, pixel);
                const gpu::Hit& stored = picture.hits[pixel.y * kViewWidth + pixel.x];
                const std::optional<DeviceHit> hit = test::unpack(stored);
                ASSERT_EQ(report.hit != 0, hit.has_value());
                if (!hit)
                {
                    continue;
                }
                ++hit_count;
                EXPECT_EQ(report.t, hit->t);
                EXPECT_EQ(report.cell, hit->cell);
                EXPECT_EQ(report.level, hit->level);
                EXPECT_EQ(report.face, hit->face);
                EXPECT_EQ(report.index, hit->index);
                const bool is_voxel = hit->level == octree.grid.nodeLevels();
                const gpu::Attribute& look = (is_voxel ? voxels : averages).at(hit->index);
                EXPECT_EQ(report.look.color, look.color);
                EXPECT_EQ(report.look.normal, look.normal);
                // In an octree, a hit's index is that of the node's child or voxel.
                const gpu::Node& node = nodes.at(report.node);
                const auto bit = [&hit](int axis, std::uint32_t place) { return hit->cell[axis] >> place & 1U; };
                const std::uint32_t child =
                    bit(0, 0) | bit(1, 0) << 1 | bit(2, 0) << 2 | bit(0, 1) << 3 | bit(1, 1) << 4 | bit(2, 1) << 5;
                const gpu::uint mask = child < 32 ? node.mask_lo : node.mask_hi;
                const gpu::uint base = child < 32 ? node.base_lo : node.base_hi;
                ASSERT_NE(mask >> (child % 32) & 1U, 0U);
                EXPECT_EQ(base + std::popcount(mask & ((1U << child % 32) - 1U)), hit->index);
            }
        }
    }
    EXPECT_GT(hit_count, 20);
}

TEST(InspectPixels, StepsAreThoseOfTheIterationsViewWithoutShortcuts)
{
    const DeviceTree octree = sponge();
    TraceOptions options;
    options.view = View::Iterations;
    options.beam = false;
    for (const ViewCamera& camera : test::manyCameras(octree.grid))
    {
        const Picture picture = test::takePicture(device(), octree, traceCamera(camera, octree.grid, kViewHeight),
                                                  kViewWidth, kViewHeight, options);
        for (const glm::uvec2& pixel : kPixels)
        {
            EXPECT_EQ(inspect(octree, camera, options, pixel).iterations,
                      picture.light[pixel.y * kViewWidth + pixel.x]);
        }
    }
}

TEST(InspectPixels, OfADagLooksLikeThatOfItsOctree)
{
    const DeviceTree octree = sponge();
    const DeviceTree dag = test::svdagOf(device(), octree);
    int hit_count = 0;
    for (const ViewCamera& camera : test::manyCameras(octree.grid))
    {
        for (const glm::uvec2& pixel : kPixels)
        {
            const gpu::PixelReport expected = inspect(octree, camera, {}, pixel);
            const gpu::PixelReport report = inspect(dag, camera, {}, pixel);
            ASSERT_EQ(report.hit, expected.hit);
            EXPECT_EQ(report.iterations, expected.iterations);
            if (expected.hit != 0)
            {
                ++hit_count;
                EXPECT_EQ(report.cell, expected.cell);
                EXPECT_EQ(report.index, expected.index);
                EXPECT_EQ(report.look.color, expected.look.color);
                EXPECT_EQ(report.look.normal, expected.look.normal);
            }
        }
    }
    EXPECT_GT(hit_count, 20);
}

TEST(InspectPixels, OfNothingIsNothing)
{
    const DeviceTree octree = test::octreeOf(device(), {}, 5);
    const ViewCamera camera = ViewCamera::framing({glm::vec3(0.0F), glm::vec3(32.0F)}, 1.0);
    EXPECT_EQ(inspect(octree, camera, {}, {3, 4}).hit, 0U);
}

} // namespace
} // namespace zvo
