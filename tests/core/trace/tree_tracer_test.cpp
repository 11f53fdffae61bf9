// SPDX-License-Identifier: MIT
// The tracer of programs and hosts, compared with the functions below it.
#include "core/trace/tree_tracer.h"

#include "core/dynamic/dynamic_octree.h"
#include "support/dags.h"
#include "support/engine_device.h"
#include "support/pictures.h"
#include "support/trace_octrees.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>
#include <vector>

namespace zvo
{
namespace
{

using test::device;

constexpr std::uint32_t kTracedEdge = 40;

// So deep that rays begin below the root.
DeviceTree tracedShell(double radius)
{
    DeviceTree octree = test::octreeOf(device(), test::sphereShell(7, radius), 7);
    test::addAttributes(device(), octree);
    return octree;
}

// Pictures by one tracer.
class TracedPictures
{
public:
    TracedPictures() { tracer.resize(kTracedEdge, kTracedEdge); }

    // Whether the picture made node paths, which must equal those in new buffers.
    bool makesPaths(const DeviceTree& tree)
    {
        const std::uint32_t height = tracer.buffers().height;
        const TraceCamera camera = traceCamera(test::manyCameras(tree.grid).front(), tree.grid, height);
        const std::vector<vk::PassTime> passes =
            device().run([&](vk::FrameGraph& graph) { tracer.trace(graph, tree, camera, {}); });
        const test::Picture picture = test::takePicture(device(), tree, camera, height, height, {});
        EXPECT_EQ(device().download(tracer.buffers().image), picture.image);
        EXPECT_GT(picture.live_tiles, 0U);
        return std::ranges::any_of(passes, [](const vk::PassTime& pass) { return pass.name == "trace/node_paths"; });
    }

    vk::DeletionQueue deletion_queue;
    TreeTracer tracer{device().device(), &deletion_queue};
};

TEST(TreeTracer, MakesTheNodePathsOncePerTree)
{
    TracedPictures pictures;
    const DeviceTree small = tracedShell(28.0);
    const DeviceTree large = tracedShell(56.0);
    EXPECT_TRUE(pictures.makesPaths(small));
    EXPECT_FALSE(pictures.makesPaths(small));
    EXPECT_TRUE(pictures.makesPaths(large));
    EXPECT_TRUE(pictures.makesPaths(small));
    pictures.tracer.forget();
    EXPECT_TRUE(pictures.makesPaths(small));
}

TEST(TreeTracer, TracesOctreesAndDagsInTurn)
{
    TracedPictures pictures;
    const DeviceTree octree = tracedShell(56.0);
    const DeviceTree dag = test::svdagOf(device(), octree);
    for (int turn = 0; turn < 2; ++turn)
    {
        EXPECT_TRUE(pictures.makesPaths(octree));
        EXPECT_TRUE(pictures.makesPaths(dag));
        EXPECT_FALSE(pictures.makesPaths(dag));
    }
}

TEST(TreeTracer, KeepsOldBuffersUntilTheFrameIsDone)
{
    TracedPictures pictures;
    const DeviceTree octree = tracedShell(56.0);
    pictures.deletion_queue.beginFrame(1);
    pictures.makesPaths(octree);
    const vk::MemoryAllocator& memory = device().device().memory();
    const std::uint64_t old_bytes = pictures.tracer.buffers().bytes();
    const std::uint64_t used_bytes = memory.usedBytes();
    pictures.tracer.resize(2 * kTracedEdge, 2 * kTracedEdge);
    EXPECT_GE(memory.usedBytes(), used_bytes + pictures.tracer.buffers().bytes());
    EXPECT_FALSE(pictures.makesPaths(octree));
    const std::uint64_t both_bytes = memory.usedBytes();
    pictures.deletion_queue.frameDone(1);
    EXPECT_LE(memory.usedBytes() + old_bytes, both_bytes);
    EXPECT_FALSE(pictures.makesPaths(octree));
}

TEST(TreeTracer, NoticesWhatADynamicOctreeShows)
{
    TracedPictures pictures;
    DeviceTree fixed = tracedShell(28.0);
    const std::uint64_t static_version = fixed.version;
    DynamicOptions options;
    options.merge = MergeRule::DynamicWins;
    options.emission_scale = fixed.emission_scale;
    DynamicOctree dynamic(device(), std::move(fixed), options);
    EXPECT_NE(dynamic.tree().version, static_version);
    EXPECT_TRUE(pictures.makesPaths(dynamic.tree()));
    EXPECT_FALSE(pictures.makesPaths(dynamic.tree()));
    const Brush brush = {BrushShape::Sphere, BrushAction::Fill, gpu::ivec3(80, 48, 64), 24, 0x80FF40};
    const auto fill = [&] { return device().run([&](vk::FrameGraph& graph) { dynamic.edit(graph, brush); }); };
    std::uint64_t frame = dynamic.beginFrame();
    fill();
    dynamic.frameDone(frame);
    EXPECT_TRUE(pictures.makesPaths(dynamic.tree()));
    EXPECT_FALSE(pictures.makesPaths(dynamic.tree()));
    frame = dynamic.beginFrame();
    device().run([&](vk::FrameGraph& graph) { dynamic.undoEdit(graph); });
    EXPECT_TRUE(pictures.makesPaths(dynamic.tree()));
    dynamic.frameLost();
    EXPECT_TRUE(pictures.makesPaths(dynamic.tree()));
    dynamic.frameLost(); // nothing more was recorded
    EXPECT_FALSE(pictures.makesPaths(dynamic.tree()));
}

} // namespace
} // namespace zvo
