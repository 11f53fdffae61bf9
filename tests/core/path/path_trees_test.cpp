// SPDX-License-Identifier: MIT
// Path tracing through octrees, DAGs, overlays and packed attributes: the same voxels look the same.
#include "core/dynamic/dynamic_octree.h"
#include "core/headless/attribute_packer.h"
#include "core/headless/compress.h"
#include "core/headless/pipeline.h"
#include "core/path/path_tracer.h"
#include "core/scene/animation.h"
#include "support/engine_device.h"
#include "support/scenes.h"

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
        return a.sums.size() == b.sums.size() && a.voxel_lights == b.voxel_lights &&
               std::memcmp(a.sums.data(), b.sums.data(), a.sums.size() * sizeof(gpu::PixelSum)) == 0;
    }
};

// Adds samples to a picture of a tree.
void addSamples(PathTracer& tracer, const DeviceTree& tree)
{
    DeviceEnvironment sky(device().device());
    const ViewCamera view = ViewCamera::lookAt({30.0, 22.0, 35.0}, {8.0, 8.0, 8.0}, 0.7);
    const TraceCamera camera = traceCamera(view, tree.grid, 21);
    PathOptions options;
    options.bounces = 3;
    for (int i = 0; i < 2; ++i)
    {
        device().run([&](vk::FrameGraph& graph) { tracer.addSample(graph, tree, sky, camera, options); });
    }
}

// Traces in both forms, which must make the same picture.
Traced tracePaths(const DeviceTree& tree)
{
    PathTracer tracer(device().device());
    tracer.resize(30, 21, PathForm::Stages);
    addSamples(tracer, tree);
    const std::vector<gpu::DispatchArgs> lists = device().download(tracer.lists());
    const auto* words = reinterpret_cast<const gpu::uint*>(lists.data() + gpu::kListLengths);
    const Traced traced = {device().download(tracer.picture().sums), words[gpu::kListVoxelLights]};
    tracer.resize(30, 21, PathForm::OneKernel);
    addSamples(tracer, tree);
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

// An object that is merged with an octree or a DAG looks as if all had been built at once.
TEST(PathTrees, OverlaysLookAsIfBuiltAtOnce)
{
    const Scene fixed = litTriangles(5);
    const Scene object = litTriangles(9);
    Scene both = fixed;
    both.append(Scene(object));
    Pose pose;
    for (const Instance& instance : object.instances)
    {
        pose.transforms.push_back(instance.transform);
    }
    for (const bool compressed : {false, true})
    {
        const Traced expected = tracePaths(build(both, 6).octree);
        BuildResult built = build(fixed, 6);
        FragmentSums sums = std::move(built.octree.sums);
        DeviceTree base =
            compressed ? std::move(compress(device(), std::move(built.octree)).dag) : std::move(built.octree);
        base.sums = std::move(sums);
        DynamicOctree octree(device(), std::move(base), {.merge = MergeRule::Average, .emission_scale = kEmission});
        octree.add(uploadDynamicMesh(device(), object, true, kEmission), pose);
        do
        {
            const std::uint64_t frame = octree.beginFrame();
            device().run([&](vk::FrameGraph& graph) { octree.update(graph); });
            octree.frameDone(frame);
        } while (octree.needsUpdate());
        EXPECT_EQ(tracePaths(octree.tree()), expected) << compressed;
    }
}

} // namespace
} // namespace zvo
