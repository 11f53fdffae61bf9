// SPDX-License-Identifier: MIT
// Path tracing through octrees, DAGs, overlays and packed attributes: the same voxels look the same.
#include "core/dynamic/dynamic_octree.h"
#include "core/path/path_tracer.h"
#include "core/scene/animation.h"
#include "runtime/trees.h"
#include "support/dynamic_updates.h"
#include "support/engine_device.h"
#include "support/octree_contents.h"
#include "support/same_bytes.h"
#include "support/scenes.h"

#include <glm/ext/matrix_transform.hpp>
#include <gtest/gtest.h>

#include <cstring>
#include <utility>
#include <vector>

namespace zvo
{
namespace
{

using test::device;

constexpr float kEmission = 4.0F;

// Triangles in [0, 16]^3, a third of which give off light.
Scene litTriangles(std::uint32_t seed)
{
    Scene scene = test::randomTriangles(seed, 40, 16.0F);
    Material lamp;
    lamp.emission = glm::vec3(kEmission, 0.5F * kEmission, 1.0F);
    scene.materials.push_back(lamp);
    Primitive lamps = test::randomTriangles(seed + 1, 20, 16.0F).primitives.front();
    lamps.material = static_cast<std::uint32_t>(scene.materials.size() - 1);
    scene.primitives.push_back(lamps);
    scene.instances.push_back({static_cast<std::uint32_t>(scene.primitives.size() - 1), glm::mat4(1.0F)});
    return scene;
}

Grid gridOf(std::uint32_t depth)
{
    return {.origin = glm::vec3(0.0F), .voxel_size = 16.0F / static_cast<float>(1U << depth), .depth = depth};
}

BuildResult build(const Scene& scene, std::uint32_t depth)
{
    BuildOptions options;
    options.keep_sums = true;
    return buildOctree(device(), uploadScene(device(), scene, true, kEmission), gridOf(depth), options);
}

// Words of the sums of a picture, and the number of its lights.
struct Traced
{
    std::vector<gpu::PixelSum> sums;
    std::uint32_t voxel_lights = 0; // shadow rays to voxels of the first bounce

    friend bool operator==(const Traced& a, const Traced& b)
    {
        return a.voxel_lights == b.voxel_lights && test::sameBytes(a.sums, b.sums);
    }
};

// Adds samples to a picture of a tree.
void addSamples(PathTracer& tracer, DeviceEnvironment& sky, const DeviceTree& tree)
{
    const ViewCamera view = ViewCamera::lookAt({30.0, 22.0, 35.0}, {8.0, 8.0, 8.0}, 0.7);
    const TraceCamera camera = traceCamera(view, tree.grid, 21);
    for (int i = 0; i < 2; ++i)
    {
        device().run([&](vk::FrameGraph& graph) { tracer.addSample(graph, tree, sky, camera, {.bounces = 3}); });
    }
}

Traced tracePaths(PathTracer& tracer, DeviceEnvironment& sky, const DeviceTree& tree)
{
    tracer.resize(30, 21, PathForm::Stages);
    addSamples(tracer, sky, tree);
    const std::vector<gpu::DispatchArgs> lists = device().download(tracer.lists());
    const auto* words = reinterpret_cast<const gpu::uint*>(lists.data() + gpu::kListLengths);
    return {device().download(tracer.picture().sums), words[gpu::kListVoxelLights]};
}

// Traces in both forms, which must make the same picture.
Traced tracePaths(const DeviceTree& tree)
{
    DeviceEnvironment sky(device().device());
    PathTracer tracer(device().device());
    const Traced traced = tracePaths(tracer, sky, tree);
    tracer.resize(30, 21, PathForm::OneKernel);
    addSamples(tracer, sky, tree);
    EXPECT_EQ((Traced{device().download(tracer.picture().sums), traced.voxel_lights}), traced);
    return traced;
}

TEST(PathTrees, OctreesAndDagsLookTheSame)
{
    for (const std::uint32_t depth : {2U, 5U, 6U, 9U})
    {
        BuildResult built = build(litTriangles(5), depth);
        const Traced octree = tracePaths(built.octree);
        EXPECT_GT(octree.voxel_lights, 10U) << depth;
        const CompressResult compressed = compress(device(), std::move(built.octree));
        EXPECT_EQ(tracePaths(compressed.dag), octree) << depth;
    }
}

// Nodes of packed trees have no flags: their emissive voxels are found by the emission table.
TEST(PathTrees, PackedOctreesAndDagsLookTheSame)
{
    for (const AttributeFormat format : {AttributeFormat::Bytes4, AttributeFormat::Blocks})
    {
        BuildResult built = build(litTriangles(5), 7);
        packTree(device(), format, built.octree);
        const Traced octree = tracePaths(built.octree);
        EXPECT_GT(octree.voxel_lights, 20U);
        const CompressResult compressed = compress(device(), std::move(built.octree));
        EXPECT_EQ(tracePaths(compressed.dag), octree);
    }
}

// An octree, or its DAG, with the sums that merging takes.
DynamicOctree dynamicOf(const Scene& scene, bool compressed)
{
    DeviceTree tree = std::move(build(scene, 6).octree);
    FragmentSums sums = std::move(tree.sums);
    if (compressed)
    {
        tree = std::move(compress(device(), std::move(tree)).dag);
    }
    tree.sums = std::move(sums);
    return {device(), std::move(tree), {.merge = MergeRule::Average, .emission_scale = kEmission}};
}

// The scene's instances where they stand.
Pose poseOf(const Scene& scene)
{
    Pose pose;
    for (const Instance& instance : scene.instances)
    {
        pose.transforms.push_back(instance.transform);
    }
    return pose;
}

// An object that is merged with an octree or a DAG looks as if all had been built at once.
TEST(PathTrees, OverlaysLookAsIfBuiltAtOnce)
{
    const Scene fixed = litTriangles(5);
    const Scene object = litTriangles(9);
    Scene both = fixed;
    both.append(Scene(object));
    for (const bool compressed : {false, true})
    {
        const Traced expected = tracePaths(build(both, 6).octree);
        DynamicOctree octree = dynamicOf(fixed, compressed);
        octree.add(uploadDynamicMesh(device(), object, true, kEmission), poseOf(object));
        test::updateAll(device(), octree);
        EXPECT_EQ(tracePaths(octree.tree()), expected) << compressed;
    }
}

// A path tracer that has made other lights before finds those that are there: of objects that have moved, and without
// what brushes have carved and painted.
TEST(PathTrees, LightsFollowMoversAndStrokes)
{
    const Scene fixed = litTriangles(5);
    const Scene object = litTriangles(9);
    const auto posed = [&](const glm::vec3& way)
    {
        Scene moved = object;
        for (Instance& instance : moved.instances)
        {
            instance.transform = glm::translate(glm::mat4(1.0F), way) * instance.transform;
        }
        return moved;
    };
    for (const bool compressed : {false, true})
    {
        SCOPED_TRACE(compressed);
        DynamicOctree octree = dynamicOf(fixed, compressed);
        DeviceEnvironment sky(device().device());
        PathTracer tracer(device().device());
        Traced last = tracePaths(tracer, sky, octree.tree());
        const auto expectLights = [&](const DeviceTree& expected)
        {
            test::updateAll(device(), octree);
            const Traced now = tracePaths(tracer, sky, octree.tree());
            EXPECT_EQ(now, tracePaths(expected));
            EXPECT_FALSE(now == last) << "nothing has changed";
            last = now;
        };
        const auto expectLightsOfMover = [&](const glm::vec3& way)
        {
            Scene both = fixed;
            both.append(posed(way));
            expectLights(build(both, 6).octree);
        };
        // Of the cells that are shown; other tests compare these with models.
        const auto rebuilt = [&]
        {
            test::updateAll(device(), octree);
            return test::octreeOf(device(), test::cellsOf(device(), octree.tree()), gridOf(6), kEmission);
        };
        const auto expectLightsAfter = [&](const auto& edit)
        {
            const std::uint64_t frame = octree.beginFrame();
            device().run([&](vk::FrameGraph& graph) { ASSERT_TRUE(edit(graph)); });
            octree.frameDone(frame);
            octree.endStroke();
            expectLights(rebuilt());
        };
        const auto dab = [&](BrushAction action)
        {
            const Brush brush = {BrushShape::Box, action, {36, 36, 36}, 20, 0xFF0000};
            expectLightsAfter([&](vk::FrameGraph& graph) { return octree.edit(graph, brush); });
        };
        const DynamicObjectId mover =
            octree.add(uploadDynamicMesh(device(), object, true, kEmission), poseOf(posed(glm::vec3(0.0F))));
        expectLightsOfMover(glm::vec3(0.0F));
        octree.setPose(mover, poseOf(posed({1.0F, 2.0F, -1.5F})));
        expectLightsOfMover({1.0F, 2.0F, -1.5F});
        dab(BrushAction::Paint);
        dab(BrushAction::Carve);
        dab(BrushAction::Fill);
        octree.remove(mover);
        expectLights(rebuilt());
        expectLightsAfter([&](vk::FrameGraph& graph) { return octree.undoEdit(graph); });
        expectLightsAfter([&](vk::FrameGraph& graph) { return octree.undoEdit(graph); });
    }
}

} // namespace
} // namespace zvo
