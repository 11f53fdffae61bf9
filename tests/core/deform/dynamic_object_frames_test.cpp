// SPDX-License-Identifier: MIT
// Dynamic objects in command buffers, frame by frame: barriers, memory, refusals.
#include "core/deform/dynamic_object.h"

#include "core/base/kernels.h"
#include "core/octree/octree_build.h"
#include "core/scene/animation.h"
#include "runtime/trees.h"
#include "support/deforming_scenes.h"
#include "support/device.h"
#include "support/engine_device.h"
#include "support/errors.h"
#include "support/moved_scene.h"
#include "support/scenes.h"
#include "zvo/error.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>
#include <regex>
#include <string>
#include <utility>
#include <vector>

namespace zvo
{
namespace
{

using test::expectEqualsPosed;
using test::kGrid;
using test::makeAnew;
using test::makeOctree;
using test::mixedScene;
using test::MovedScene;

using test::device;

TEST(DynamicObject, PlacesAndVoxelizesInOneCommandBuffer)
{
    std::mt19937 random(25);
    const std::pair<Scene, Pose> made = mixedScene(random);
    const Scene& scene = made.first;
    const Pose& pose = made.second;
    const GpuScene posed = uploadScene(device(), posedScene(scene, pose), true);
    MovedScene object(device(), scene);
    const VoxelizeCapacities capacities = VoxelizeCapacities::estimate(posed, kGrid, Coverage::Thin);
    const auto cover =
        [&](vk::FrameGraph& graph, const PosedGpuScene& placed, VoxelizeBuffers& voxelize, OctreeBuildBuffers& work)
    {
        voxelizeCoverage(graph, {placed, kGrid, voxelize});
        listNodes(graph, kGrid, voxelize, work);
    };
    std::vector<gpu::BinCounters> counters;
    std::string dump;
    for (const bool moves : {false, true})
    {
        VoxelizeBuffers voxelize(device().device(), capacities, posed, {});
        OctreeBuildBuffers work(device().device(), capacities.table, capacities.bricks);
        device().run(
            [&](vk::FrameGraph& graph)
            {
                if (moves)
                {
                    Pose other = pose; // overwritten before anything reads it
                    test::changePose(random, other);
                    setPose(graph, object.mesh(), other, object.buffers());
                    setPose(graph, object.mesh(), pose, object.buffers());
                    cover(graph, {object.uploaded(), object.buffers()}, voxelize, work);
                    dump = graph.dump();
                }
                else
                {
                    cover(graph, posed, voxelize, work);
                }
            });
        counters.push_back(device().download(voxelize.counters).front());
    }
    EXPECT_GT(counters[0].voxel_count, 5000U);
    EXPECT_EQ(counters[1].voxel_count, counters[0].voxel_count);
    EXPECT_EQ(counters[1].leaf_count, counters[0].leaf_count);
    // A barrier from kernels to kernels stands between the last deformation and the first triangle.
    const std::size_t deformed = dump.rfind("pass deform/vertices");
    const std::size_t walked = dump.find("pass voxelize/bin");
    ASSERT_LT(deformed, walked);
    const std::string between = dump.substr(deformed, walked - deformed);
    EXPECT_TRUE(std::regex_search(between, std::regex("\\nbarrier compute(\\|transfer)? -> compute\\n"))) << dump;
    EXPECT_NE(dump.find("reads mover/positions"), std::string::npos);
}

TEST(DynamicObject, PassesThatWalkItWaitForItsDraws)
{
    const Scene scene = test::boxScene(glm::vec3(-1.0F), glm::vec3(1.0F));
    MovedScene object(device(), scene);
    std::string dump;
    VoxelizeBuffers voxelize(device().device(), {1 << 10, 1 << 8, 1 << 8, 1 << 12, 1 << 8}, object.uploaded(), {});
    device().run(
        [&](vk::FrameGraph& graph)
        {
            setPose(graph, std::vector{glm::mat4(1.0F)}, object.buffers());
            voxelizeCoverage(graph, {{object.uploaded(), object.buffers()}, kGrid, voxelize});
            dump = graph.dump();
        });
    const std::size_t updated = dump.find("pass update mover/draws");
    const std::size_t barrier = dump.find("barrier transfer -> compute");
    const std::size_t walked = dump.find("pass voxelize/bin");
    EXPECT_LT(updated, barrier);
    EXPECT_LT(barrier, walked);
    EXPECT_NE(dump.find("reads mover/draws", walked), std::string::npos) << dump;
}

TEST(DynamicObject, WhatIsNotFiniteIsCountedAndTheRestIsThere)
{
    std::mt19937 random(26);
    auto [scene, pose] = mixedScene(random);
    MovedScene object(device(), scene);
    const float nan = std::numeric_limits<float>::quiet_NaN();
    pose.joint_matrices[1][2][3].x = std::numeric_limits<float>::infinity();
    pose.transforms[0][1][1] = nan;
    pose.morph_weights[8][0] = nan;
    EXPECT_GT(expectEqualsPosed(object, scene, pose), 3000U);
    // The instances 0 and 8 are dropped, and a part of instance 1.
    EXPECT_GT(object.make().dropped["nonfinite"], 2U * 58);
    EXPECT_LT(object.make().dropped["nonfinite"], 3U * 58);
}

TEST(DynamicObject, ComesBackToTheSameBytesInConstantMemory)
{
    std::mt19937 random(27);
    auto [scene, first] = mixedScene(random);
    Pose second = first;
    test::changePose(random, second);
    MovedScene object(device(), scene);
    const std::string shas[2] = {makeAnew(posedScene(scene, first)).sha, makeAnew(posedScene(scene, second)).sha};
    object.setPose(first);
    vk::MemoryAllocator& memory = device().device().memory();
    const std::uint64_t used = memory.usedBytes();
    memory.resetPeak();
    const auto* const draws = object.buffers().host_draws.data();
    const auto* const joints = object.buffers().pose.host_joint_matrices.data();
    const auto* const terms = object.buffers().pose.host_morph_terms.data();
    for (int frame = 0; frame < 500; ++frame)
    {
        object.setPose(frame % 2 == 0 ? second : first);
    }
    EXPECT_EQ(memory.usedBytes(), used);
    EXPECT_EQ(memory.peakBytes(), used) << "a frame allocates nothing on the device";
    EXPECT_EQ(object.buffers().host_draws.data(), draws);
    EXPECT_EQ(object.buffers().pose.host_joint_matrices.data(), joints);
    EXPECT_EQ(object.buffers().pose.host_morph_terms.data(), terms);
    EXPECT_EQ(object.make().sha, shas[0]);
    object.setPose(second);
    EXPECT_EQ(object.make().sha, shas[1]);
}

TEST(DynamicObject, TwoSetsOfBuffersOfOneSceneAreIndependent)
{
    std::mt19937 random(28);
    const std::pair<Scene, Pose> made = mixedScene(random);
    const Scene& scene = made.first;
    const Pose& pose = made.second;
    Pose other = pose;
    test::changePose(random, other);
    MovedScene object(device(), scene);
    DynamicObjectBuffers second =
        makeDynamicObject(device(), planDynamicObject(scene, object.mesh()), object.uploaded(), object.mesh());
    device().run(
        [&](vk::FrameGraph& graph)
        {
            setPose(graph, object.mesh(), pose, object.buffers());
            setPose(graph, object.mesh(), other, second);
        });
    EXPECT_EQ(object.make().sha, makeAnew(posedScene(scene, pose)).sha);
    EXPECT_EQ(makeOctree(device(), {object.uploaded(), second}).sha, makeAnew(posedScene(scene, other)).sha);
}

TEST(DynamicObject, SplitOverSubmissionsItHasTheSameBytes)
{
    std::mt19937 random(29);
    const auto [scene, pose] = mixedScene(random);
    vk::HeadlessOptions options = test::deviceOptions();
    options.slices.most_units = 2;
    vk::HeadlessDevice sliced(options, zvoKernels());
    MovedScene object(sliced, scene);
    object.setPose(pose);
    EXPECT_EQ(object.make().sha, makeAnew(posedScene(scene, pose)).sha);
}

TEST(DynamicObject, TransformsOfAnotherSceneAreRefused)
{
    std::mt19937 random(30);
    auto [scene, pose] = mixedScene(random);
    MovedScene object(device(), scene);
    Pose other = pose;
    other.transforms.pop_back();
    EXPECT_THROW(object.setPose(other), Error);
    EXPECT_THROW(object.setPose({}), Error);
    EXPECT_GT(expectEqualsPosed(object, scene, pose), 5000U) << "and it goes on";
}

TEST(DynamicObject, NeedsAreNamedBeforeMemoryIsTaken)
{
    std::mt19937 random(31);
    Scene scene;
    Pose pose;
    scene.materials.emplace_back();
    scene.primitives.push_back(test::deformingPrimitive(random, 1000, {true, 4, 0}));
    for (int i = 0; i < 400; ++i)
    {
        test::addDeforming(random, scene, pose, 0, 4);
    }
    vk::HeadlessOptions options = test::deviceOptions();
    options.memory_budget_bytes = 8 << 20;
    vk::HeadlessDevice limited(options, zvoKernels());
    const GpuScene uploaded = uploadScene(limited, scene, true);
    const DeformMesh mesh = uploadDeformMesh(limited, scene);
    const std::uint64_t used = limited.device().memory().usedBytes();
    // 400 instances of 1000 vertices take 24 bytes each.
    const auto make = [&] { makeDynamicObject(limited, planDynamicObject(scene, mesh), uploaded, mesh); };
    const std::string message = test::messageOf(make, ErrorCode::Memory);
    EXPECT_TRUE(message.starts_with("a moving object needs")) << message;
    EXPECT_EQ(limited.device().memory().usedBytes(), used);
}

} // namespace
} // namespace zvo
