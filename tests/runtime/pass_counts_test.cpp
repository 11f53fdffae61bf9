// SPDX-License-Identifier: MIT
// What a GPU pays for even where it has nothing to do: dispatches that depend on each other, and barriers. A static
// scene of 512^3 voxels, of one material class, is built, compressed, updated and traced.
#include "core/base/kernels.h"
#include "core/dynamic/dynamic_octree.h"
#include "core/octree/octree_builder.h"
#include "core/scene/camera.h"
#include "core/svdag/svdag_builder.h"
#include "core/trace/tree_tracer.h"
#include "runtime/trees.h"
#include "support/device.h"
#include "support/scenes.h"

#include <glm/ext/matrix_transform.hpp>
#include <gtest/gtest.h>

#include <memory>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace zvo
{

namespace
{

// Its dispatches are whole, as those in frames of hosts.
vk::HeadlessDevice& wholeDevice()
{
    static vk::HeadlessDevice shared(
        []
        {
            vk::HeadlessOptions options = test::deviceOptions();
            options.slices.submission_ms = 0;
            return options;
        }(),
        zvoKernels());
    return shared;
}

constexpr Grid kGrid{.origin = glm::vec3(0.0F), .voxel_size = 1.0F, .depth = 9};

struct PassCounts
{
    int dispatches = 0;
    int barriers = 0;
    std::string passes;
};

// Adds the passes of a frame graph's dump.
void addPasses(PassCounts& counts, const std::string& dump)
{
    std::istringstream lines(dump);
    for (std::string line; std::getline(lines, line);)
    {
        const bool runs = line.find(" in ") != std::string::npos || line.find(": indirect") != std::string::npos;
        const bool dispatch =
            line.starts_with("pass ") && line.find('/') < line.find(':') && runs && !line.starts_with("pass fill ");
        counts.dispatches += dispatch ? 1 : 0;
        counts.barriers += line.starts_with("barrier ") ? 1 : 0;
        counts.passes += line + "\n";
    }
}

template <typename Record> void run(PassCounts& counts, const Record& record)
{
    wholeDevice().run(
        [&](vk::FrameGraph& graph)
        {
            record(graph);
            addPasses(counts, graph.dump());
        });
}

PassCounts runAll(StepJob& job)
{
    PassCounts counts;
    while (!job.isDone())
    {
        run(counts, [&](vk::FrameGraph& graph) { job.record(graph); });
        job.resume({});
    }
    return counts;
}

void expectAtMost(const PassCounts& counts, int dispatches, int barriers)
{
    EXPECT_LE(counts.dispatches, dispatches) << counts.passes;
    EXPECT_LE(counts.barriers, barriers) << counts.passes;
    EXPECT_GT(counts.dispatches, dispatches / 2) << "the limit tells nothing\n" << counts.passes;
}

Scene ball()
{
    return test::sphereScene(glm::vec3(256.0F), 120.0F, 24);
}

Pose poseAt(float x)
{
    Pose pose;
    pose.transforms.push_back(glm::translate(glm::mat4(1.0F), glm::vec3(x, 0.0F, 0.0F)));
    return pose;
}

TEST(PassCounts, OfABuildAndACompression)
{
    const GpuScene scene = uploadScene(wholeDevice(), ball(), true);
    OctreeBuilder octree(wholeDevice().device(), scene, kGrid, {});
    expectAtMost(runAll(octree), 24, 28);
    SvdagBuilder dag(wholeDevice().device(), octree.take().octree, {});
    expectAtMost(runAll(dag), 30, 40);
}

// The passes of an update of a ball's tree, in which a smaller ball moves.
PassCounts countUpdate(const BuildOptions& build, const DynamicObjectInfo& info)
{
    const GpuScene scene = uploadScene(wholeDevice(), ball(), true);
    DynamicOctree octree(wholeDevice(), buildOctree(wholeDevice(), scene, kGrid, build).octree, {});
    const Scene mover = test::sphereScene(glm::vec3(300.0F), 40.0F, 16);
    const std::shared_ptr<const DynamicMesh> mesh = uploadDynamicMesh(wholeDevice(), mover, true, 0.0F);
    const DynamicObjectId object = octree.add(mesh, poseAt(0.0F), info);
    PassCounts counts;
    for (int frame = 0; frame < 8; ++frame) // the first ones find out how much room is needed
    {
        octree.setPose(object, poseAt(static_cast<float>(frame)));
        const std::uint64_t number = octree.beginFrame();
        counts = {};
        run(counts, [&](vk::FrameGraph& graph) { octree.update(graph); });
        octree.frameDone(number);
    }
    EXPECT_FALSE(octree.needsUpdate());
    return counts;
}

TEST(PassCounts, OfAnUpdate)
{
    expectAtMost(countUpdate({.keep_sums = true}, {}), 21, 22);
}

TEST(PassCounts, OfAnUpdateThatCarves)
{
    expectAtMost(countUpdate({.fill = Fill::Solid}, {.carves = true, .fill = Fill::Solid}), 25, 26);
}

TEST(PassCounts, OfAPicture)
{
    const GpuScene scene = uploadScene(wholeDevice(), ball(), true);
    const DeviceTree tree = buildOctree(wholeDevice(), scene, kGrid, {}).octree;
    TreeTracer tracer(wholeDevice().device());
    tracer.resize(320, 180);
    const ViewCamera view = ViewCamera::lookAt(glm::dvec3(20.0), glm::dvec3(256.0), 0.8);
    const TraceCamera camera = traceCamera(view, tree.grid, 180);
    PassCounts first;
    run(first, [&](vk::FrameGraph& graph) { tracer.trace(graph, tree, camera, {}); });
    PassCounts second;
    run(second, [&](vk::FrameGraph& graph) { tracer.trace(graph, tree, camera, {}); });
    EXPECT_LT(second.dispatches, first.dispatches) << "node paths are made anew, although the tree is the same";
    expectAtMost(first, 9, 9);
    expectAtMost(second, 8, 8);
}

} // namespace

} // namespace zvo
