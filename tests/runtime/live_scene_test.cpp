// SPDX-License-Identifier: MIT
// Live scenes: strokes, offsets, and the project's animated scenes over time. Updated octrees and their pictures are
// compared with rebuilds. By default there are a few frames in a coarse grid; ZVO_TEST_STAGE_DEPTH and
// ZVO_TEST_STAGE_FRAMES set more (scripts/check-dynamic).
#include "core/scene/camera.h"
#include "core/trace/trace.h"
#include "runtime/live_scene.h"
#include "support/engine_device.h"
#include "support/octree_contents.h"
#include "support/scenes.h"
#include "support/tree_samples.h"
#include "support/tree_words.h"

#include <glm/ext/matrix_transform.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <string>
#include <tuple>
#include <vector>

namespace zvo
{
namespace
{

using test::device;

std::uint32_t numberFrom(const char* variable, std::uint32_t otherwise)
{
    const char* text = std::getenv(variable);
    return text != nullptr ? static_cast<std::uint32_t>(std::stoul(text)) : otherwise;
}

std::vector<gpu::uint> pictureOf(const DeviceTree& tree, const ViewCamera& view, TraceBuffers& buffers)
{
    NodePaths paths(device().device());
    TraceOptions options;
    options.occlusion_rays = 2;
    const TraceCamera camera = traceCamera(view, tree.grid, buffers.height);
    device().run(
        [&](vk::FrameGraph& graph)
        {
            buildNodePaths(graph, tree, paths);
            trace(graph, tree, paths, camera, options, buffers);
        });
    return device().download(buffers.image);
}

// The static part: nodes and lists with the copy of the root behind them, attributes of nodes and voxels.
std::vector<gpu::uint> staticWords(const DeviceTree& tree)
{
    std::vector<gpu::uint> words;
    test::addWords(words, device(), tree.nodes, 1, tree.overlays.static_root);
    test::addWords(words, device(), tree.node_attributes, 1, tree.octreeNodeCount());
    test::addWords(words, device(), tree.voxel_attributes, 0, tree.voxel_count);
    return words;
}

constexpr Grid kGrid64 = {.origin = glm::vec3(0.0F), .voxel_size = 0.25F, .depth = 6};
const Brush kCarve = {BrushShape::Sphere, BrushAction::Carve, gpu::ivec3(20, 20, 20), 9, 0};

// A static box, and one that may move.
AnimatedScene boxes(const glm::dvec3& offset)
{
    AnimatedScene animated;
    animated.fixed = test::boxScene(glm::vec3(2.0F), glm::vec3(6.0F));
    animated.objects.emplace_back();
    animated.objects.back().scene = std::make_shared<const Scene>(test::boxScene(glm::vec3(3.0F), glm::vec3(7.0F)));
    animated.objects.back().transform = glm::translate(glm::dmat4(1.0), offset);
    return animated;
}

std::string difference(const LiveScene& a, const LiveScene& b)
{
    return test::difference(test::cellsOf(device(), a.tree()), test::cellsOf(device(), b.tree()));
}

TEST(LiveScene, RecordsAgainWhatALostFrameWasToShow)
{
    LiveScene lost(device(), boxes({}), kGrid64, {});
    LiveScene kept(device(), boxes({}), kGrid64, {});
    for (LiveScene* const live : {&lost, &kept})
    {
        live->settle(0);
        live->request(kCarve);
        live->request(EndStroke{});
    }
    EXPECT_NE(lost.edits(), nullptr);
    lost.beginFrame();
    device().run([&](vk::FrameGraph& graph) { lost.update(graph, 0); });
    lost.frameLost();
    lost.settle(0);
    kept.settle(0);
    EXPECT_EQ(lost.edits()->undoCount(), 1U);
    EXPECT_EQ(difference(lost, kept), "");
    kept.request(UndoStroke{});
    kept.settle(0);
    EXPECT_NE(difference(lost, kept), "");
    kept.request(RedoStroke{});
    kept.settle(0);
    EXPECT_EQ(difference(lost, kept), "");
}

TEST(LiveScene, PutsWhatMovesElsewhere)
{
    const glm::dvec3 by(2.0, 0.5, -1.0);
    LiveScene moved(device(), boxes({}), kGrid64, {});
    LiveScene there(device(), boxes(by), kGrid64, {});
    moved.settle(0);
    there.settle(0);
    EXPECT_NE(difference(moved, there), "");
    moved.setOffset(0, by);
    moved.settle(0);
    EXPECT_EQ(difference(moved, there), "");
    EXPECT_EQ(moved.shownPose(0).transforms, there.shownPose(0).transforms);
}

TEST(LiveScene, UndoesMovesAndStrokesInTheirOrder)
{
    LiveScene live(device(), boxes({}), kGrid64, {});
    const glm::dvec3 first(1.0, 0, 0);
    const glm::dvec3 second(0, 1.0, 0);
    const auto move = [&](const glm::dvec3& to)
    {
        live.request(ObjectMove{0, live.offset(0), to});
        live.setOffset(0, to);
        live.settle(0);
    };
    const auto state = [&] { return std::tuple(live.offset(0).x, live.offset(0).y, live.edits()->undoCount()); };
    move(first);
    live.request(kCarve);
    live.request(EndStroke{});
    move(second);
    const std::vector<std::tuple<double, double, std::size_t>> states = {{0, 1, 1}, {1, 0, 1}, {1, 0, 0}, {0, 0, 0}};
    EXPECT_EQ(state(), states[0]);
    EXPECT_EQ(live.undoCount(), 3U);
    std::vector<EditPoint> points = {live.editPoint()};
    for (std::size_t i = 1; i < 5; ++i)
    {
        live.request(UndoStroke{});
        live.settle(0);
        EXPECT_EQ(state(), states[std::min<std::size_t>(i, 3)]) << i;
        EXPECT_EQ(live.editPoint() != points.back(), i < 4) << i;
        points.push_back(live.editPoint());
    }
    EXPECT_EQ(live.editPoint(), EditPoint{});
    EXPECT_EQ(live.redoCount(), 3U);
    for (std::size_t i = 3; i-- > 0;)
    {
        live.request(RedoStroke{});
        live.settle(0);
        EXPECT_EQ(state(), states[i]) << i;
        EXPECT_EQ(live.editPoint(), points[i]) << i;
    }
    for (int i = 0; i < 3; ++i)
    {
        live.request(UndoStroke{});
    }
    move(second);
    EXPECT_EQ(live.undoCount(), 1U);
    EXPECT_EQ(live.redoCount(), 0U) << "neither the moves nor the stroke";
    EXPECT_EQ(std::ranges::count(points, live.editPoint()), 0) << "as many entries, but not the same";
    live.request(UndoStroke{});
    live.beginFrame();
    device().run([&](vk::FrameGraph& graph) { live.update(graph, 0); });
    live.frameLost(); // it is recorded again
    live.settle(0);
    EXPECT_EQ(live.undoCount(), 0U);
    EXPECT_EQ(live.redoCount(), 1U);
    live.request(kCarve);
    live.settle(0);
    EXPECT_EQ(live.redoCount(), 0U);
}

TEST(LiveScene, MergesNothingWithPackedAttributes)
{
    for (const auto& [name, tree] : test::treeSamples())
    {
        SCOPED_TRACE(name);
        LiveScene live(device(), tree, {});
        EXPECT_EQ(live.canEdit(), !isPacked(tree.attributeFormat()));
        EXPECT_EQ(live.edits() != nullptr, live.canEdit());
        EXPECT_TRUE(live.settle(0).passes.empty());
        EXPECT_EQ(live.tree().voxel_count, tree.voxel_count);
        EXPECT_EQ(live.info().fixed.voxel_count, tree.voxel_count);
    }
    EXPECT_FALSE(LiveScene(device()).canEdit());
}

// By name, with an octree or a DAG as the static part.
class AnimatedScenes : public testing::TestWithParam<std::tuple<std::string, TreeStructure>>
{
};

TEST_P(AnimatedScenes, UpdatedIsRebuilt)
{
    const auto& [name, structure] = GetParam();
    const std::filesystem::path path = test::ownScene(name + ".scene.json");
    if (const std::string model = test::missingModelOf(name); !model.empty())
    {
        GTEST_SKIP() << model << " is not there";
    }
    AnimatedSceneOptions folder;
    if (std::filesystem::is_directory(test::modelsFolder()))
    {
        folder.scenes_folder = test::modelsFolder();
    }
    const AnimatedScene animated = loadAnimatedScene(path, folder);
    const Bounds bounds = boundsOverTime(animated);
    const Grid grid = Grid::around(bounds, numberFrom("ZVO_TEST_STAGE_DEPTH", 6));
    const auto frame_count = static_cast<std::uint32_t>(std::lround(animated.seconds * animated.frames_per_second));
    const std::uint32_t shown = std::min(frame_count, numberFrom("ZVO_TEST_STAGE_FRAMES", 4));
    const float emission_scale = brightestEmission(animated);
    const glm::dvec3 low(bounds.min);
    const glm::dvec3 high(bounds.max);
    const ViewCamera view = ViewCamera::lookAt(high + 0.7 * (high - low), 0.5 * (low + high), 0.8);
    TraceBuffers buffers(device().device(), 160, 90);

    LiveOptions options;
    options.structure = structure;
    LiveScene live(device(), AnimatedScene(animated), grid, options);
    EXPECT_EQ(live.tree().isDag(), structure == TreeStructure::Svdag);
    const std::vector<gpu::uint> static_before = staticWords(live.tree());
    for (std::uint32_t i = 0; i < shown; ++i)
    {
        const std::uint32_t frame = i * frame_count / shown;
        SCOPED_TRACE(frame);
        const double seconds = frameTime(animated, frame);
        const LiveUpdate update = live.updateAndWait(seconds);
        EXPECT_GT(update.report.dynamic_count, 0U);
        const GpuScene scene = uploadScene(device(), sceneAt(animated, seconds), true, emission_scale);
        const BuildResult rebuilt = buildOctree(device(), scene, grid, {});
        ASSERT_EQ(test::difference(test::cellsOf(device(), live.tree()), test::cellsOf(device(), rebuilt.octree)), "");
        EXPECT_EQ(pictureOf(live.tree(), view, buffers), pictureOf(rebuilt.octree, view, buffers));
    }
    EXPECT_TRUE(staticWords(live.tree()) == static_before);
}

std::string nameOfCase(const testing::TestParamInfo<AnimatedScenes::ParamType>& info)
{
    return std::get<0>(info.param) + "_" + structureName(std::get<1>(info.param));
}

INSTANTIATE_TEST_SUITE_P(Scenes, AnimatedScenes,
                         testing::Combine(testing::Values("atrium_knot", "buddha_dragon", "sponza_bunny"),
                                          testing::Values(TreeStructure::Svo, TreeStructure::Svdag)),
                         nameOfCase);

} // namespace
} // namespace zvo
