// SPDX-License-Identifier: MIT
// What moves is voxelized from buffers that change in place: the bytes are those of a scene uploaded anew.
#include "core/mover.h"

#include "core/animation.h"
#include "core/kernels.h"
#include "core/octree_build.h"
#include "core/pipeline.h"
#include "oracle/morton.h"
#include "support/deforming_scenes.h"
#include "support/device.h"
#include "support/materials_scene.h"
#include "support/octree_access.h"
#include "support/scenes.h"
#include "support/voxel_compare.h"
#include "zvo/error.h"

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <numbers>
#include <optional>
#include <regex>
#include <set>
#include <string>
#include <utility>

namespace zvo
{
namespace
{

vk::HeadlessDevice& device()
{
    return test::sharedDevice(zvoKernels());
}

/// An octree, as far as it can be compared.
struct Made
{
    std::string sha;
    std::map<std::string, std::uint64_t> dropped;
    std::uint32_t voxel_count = 0;
};

Made make(vk::HeadlessDevice& device, const PlacedScene& scene, const Grid& grid, Coverage coverage)
{
    const BuildResult result = buildOctree(device, scene, grid, {coverage, true, {}});
    return {octreeSha256(device, result.octree), result.dropped, result.octree.voxel_count};
}

/// A scene on the device with the buffers that move it.
class Mover
{
public:
    Mover(vk::HeadlessDevice& device, const Scene& scene)
        : m_device(device), m_uploaded(uploadScene(device, scene, true)), m_mesh(uploadDeformMesh(device, scene)),
          m_buffers(makeMover(device, scene, m_uploaded, m_mesh))
    {
    }

    void place(const Pose& pose)
    {
        m_device.run([&](vk::FrameGraph& graph) { placeMover(graph, m_mesh, pose, m_buffers); });
    }

    Made make(const Grid& grid, Coverage coverage)
    {
        return zvo::make(m_device, {m_uploaded, m_buffers}, grid, coverage);
    }

    [[nodiscard]] const GpuScene& uploaded() const { return m_uploaded; }
    [[nodiscard]] const DeformMesh& mesh() const { return m_mesh; }
    [[nodiscard]] MoverBuffers& buffers() { return m_buffers; }

private:
    vk::HeadlessDevice& m_device;
    GpuScene m_uploaded;
    DeformMesh m_mesh;
    MoverBuffers m_buffers;
};

Made makeAnew(const Scene& scene, const Grid& grid, Coverage coverage)
{
    const GpuScene uploaded = uploadScene(device(), scene, true);
    return make(device(), uploaded, grid, coverage);
}

constexpr Grid kGrid{.origin = glm::vec3(-4.0F), .voxel_size = 0.125F, .depth = 6};

/// Expects that mover in pose has the bytes of the posed scene uploaded anew, with both coverages; returns the number
/// of voxels.
std::uint32_t expectEqualsPosed(Mover& mover, const Scene& scene, const Pose& pose)
{
    mover.place(pose);
    const Scene posed = posedScene(scene, pose);
    std::uint32_t voxel_count = 0;
    for (const Coverage coverage : {Coverage::Thin, Coverage::Conservative})
    {
        const Made moved = mover.make(kGrid, coverage);
        const Made expected = makeAnew(posed, kGrid, coverage);
        EXPECT_EQ(moved.sha, expected.sha);
        EXPECT_EQ(moved.dropped, expected.dropped);
        voxel_count = moved.voxel_count;
    }
    return voxel_count;
}

/// A scene of instances of all sorts, rigid ones among them, and its pose.
std::pair<Scene, Pose> mixedScene(std::mt19937& random)
{
    Scene scene;
    Pose pose;
    for (int i = 0; i < 4; ++i)
    {
        scene.materials.emplace_back().base_color = glm::vec4(0.2F * static_cast<float>(i), 0.5F, 1.0F, 1.0F);
    }
    scene.materials[2].emission = {3.0F, 1.0F, 0.25F};
    const test::DeformingParts parts[] = {{true, 5, 3}, {true, 0, 0}, {false, 9, 0}, {true, 0, 2}, {false, 0, 0}};
    for (const test::DeformingParts& part : parts)
    {
        scene.primitives.push_back(test::deformingPrimitive(random, 60, part));
        scene.primitives.back().material = static_cast<std::uint32_t>(scene.primitives.size() % 4);
        for (glm::vec3& position : scene.primitives.back().positions)
        {
            position *= 0.3F;
        }
    }
    for (const auto& [primitive, joint_count] : std::vector<std::pair<std::uint32_t, std::size_t>>{
             {1, 0}, {0, 5}, {3, 0}, {2, 9}, {0, 5}, {2, 0}, {0, 0}, {4, 0}, {3, 0}, {1, 0}})
    {
        test::addDeforming(random, scene, pose, primitive, joint_count);
    }
    return {std::move(scene), std::move(pose)};
}

TEST(Mover, OfAllSortsOfInstancesEqualsAnUploadInEveryPose)
{
    std::mt19937 random(21);
    auto [scene, pose] = mixedScene(random);
    Mover mover(device(), scene);
    EXPECT_EQ(mover.mesh().parts.size(), 6U);
    for (int round = 0; round < 3; ++round)
    {
        EXPECT_GT(expectEqualsPosed(mover, scene, pose), 5000U);
        test::changePose(random, pose);
    }
}

/// A column of rings on a chain of joints that bends and twists, beside a bump that grows out of a plate on a carrier.
Scene bendingScene()
{
    constexpr std::uint32_t kRings = 24;
    constexpr std::uint32_t kSegments = 16;
    constexpr std::uint32_t kJoints = 4;
    Scene scene;
    scene.materials.emplace_back();
    Primitive column;
    for (std::uint32_t ring = 0; ring <= kRings; ++ring)
    {
        const float height = 3.0F * static_cast<float>(ring) / kRings; // a joint every 1
        const auto joint = std::min(static_cast<std::uint32_t>(height), kJoints - 2);
        const float share = height - static_cast<float>(joint);
        for (std::uint32_t segment = 0; segment < kSegments; ++segment)
        {
            const float angle = 2.0F * std::numbers::pi_v<float> * static_cast<float>(segment) / kSegments;
            const glm::vec3 normal(std::cos(angle), 0.0F, std::sin(angle));
            column.positions.push_back(0.4F * normal + glm::vec3(0.0F, height, 0.0F));
            column.normals.push_back(normal);
            column.joints.emplace_back(joint, joint + 1, 0, 0);
            column.weights.emplace_back(1.0F - share, share, 0.0F, 0.0F);
            const std::uint32_t a = ring * kSegments + segment;
            const std::uint32_t b = ring * kSegments + (segment + 1) % kSegments;
            if (ring != kRings)
            {
                column.triangles.emplace_back(a, b, a + kSegments);
                column.triangles.emplace_back(b, b + kSegments, a + kSegments);
            }
        }
    }
    Primitive plate;
    MorphTarget bump;
    for (std::uint32_t i = 0; i < 81; ++i)
    {
        const glm::vec3 place(static_cast<float>(i % 9) / 4.0F - 1.0F, 0.0F, static_cast<float>(i / 9) / 4.0F - 1.0F);
        plate.positions.push_back(place);
        bump.positions.emplace_back(0.0F, std::exp(-3.0F * glm::dot(place, place)), 0.0F);
        if (i % 9 != 8 && i / 9 != 8)
        {
            plate.triangles.emplace_back(i, i + 9, i + 1);
            plate.triangles.emplace_back(i + 1, i + 9, i + 10);
        }
    }
    plate.morph_targets = {bump};
    scene.primitives = {column, plate};

    Animation animation{"bend", {}, 2.0};
    Skin skin;
    for (std::uint32_t joint = 0; joint < kJoints; ++joint)
    {
        Node node;
        node.parent = joint == 0 ? kNone : joint - 1;
        node.translation = joint == 0 ? glm::vec3(-1.5F, -2.0F, 0.0F) : glm::vec3(0.0F, 1.0F, 0.0F);
        scene.nodes.push_back(node);
        skin.joints.push_back(joint);
        skin.inverse_bind.push_back(glm::translate(glm::mat4(1.0F), glm::vec3(0.0F, -static_cast<float>(joint), 0.0F)));
        Channel bend;
        bend.node = joint;
        bend.path = ChannelPath::Rotation;
        bend.times = {0.0F, 1.0F, 2.0F};
        bend.values = {0, 0, 0, 1, 0.2F, 0.3F, 0.1F, 0.9F, 0, 0, 0, 1};
        animation.channels.push_back(bend);
    }
    Node carrier;
    carrier.translation = {1.5F, -1.0F, 0.5F};
    carrier.scale = {1.0F, 1.0F, -1.0F}; // mirrored
    carrier.morph_weights = {0.0F};
    scene.nodes.push_back(carrier);
    Channel grow;
    grow.node = kJoints;
    grow.path = ChannelPath::Weights;
    grow.times = {0.0F, 0.5F, 2.0F};
    grow.values = {0.0F, 2.0F, -1.0F};
    Channel turn;
    turn.node = kJoints;
    turn.path = ChannelPath::Rotation;
    turn.times = {0.0F, 2.0F};
    turn.values = {0, 0, 0, 1, 1, 0, 0, 0};
    animation.channels.push_back(grow);
    animation.channels.push_back(turn);
    scene.animations.push_back(animation);
    scene.skins.push_back(skin);
    scene.instances.push_back({0, glm::mat4(1.0F), kNone, 0});
    scene.instances.push_back({1, glm::mat4(1.0F), kJoints, kNone});
    return scene;
}

TEST(Mover, FollowsAnimationsThroughTheirTime)
{
    const Scene scene = bendingScene();
    Mover mover(device(), scene);
    EXPECT_EQ(mover.mesh().parts.size(), 2U);
    std::set<std::string> shas;
    for (const double seconds : {0.0, 0.3, 0.5, 1.0, 1.7})
    {
        const Pose pose = poseAt(scene, seconds);
        EXPECT_GT(expectEqualsPosed(mover, scene, pose), 1000U);
        shas.insert(mover.make(kGrid, Coverage::Thin).sha);
    }
    EXPECT_EQ(shas.size(), 5U);
    mover.place(poseAt(scene, 2.0)); // where it began
    EXPECT_EQ(mover.make(kGrid, Coverage::Thin).sha,
              makeAnew(posedScene(scene, poseAt(scene, 0.0)), kGrid, Coverage::Thin).sha);
}

/// A ball without normals around the origin, of radius 1, whose vertices hang on one joint each: those above y = 0 on
/// the first, others on the second.
Scene flatBall()
{
    Scene scene = test::sphereScene(glm::vec3(0.0F), 1.0F, 24);
    Primitive& ball = scene.primitives.at(0);
    for (const glm::vec3& position : ball.positions)
    {
        ball.joints.emplace_back(position.y > 0.0F ? 0 : 1, 0, 0, 0);
        ball.weights.emplace_back(1.0F, 0.0F, 0.0F, 0.0F);
    }
    scene.nodes.resize(2);
    scene.skins.push_back({{0, 1}, {glm::mat4(1.0F), glm::mat4(1.0F)}});
    scene.instances.at(0).skin = 0;
    return scene;
}

TEST(Mover, WithoutNormalsOnJointsThatMirrorEqualsARigidInstance)
{
    const Scene scene = flatBall();
    Mover mover(device(), scene);
    Scene rigid = test::sphereScene(glm::vec3(0.0F), 1.0F, 24);
    std::set<std::string> shas;
    for (const glm::vec3& scale : {glm::vec3(2, 1, 1.5F), glm::vec3(-2, 1, 1.5F), glm::vec3(-2, -1, 1.5F),
                                   glm::vec3(-2, -1, -1.5F), glm::vec3(2, 1, -1.5F)})
    {
        const glm::mat4 transform = glm::scale(glm::rotate(glm::mat4(1.0F), 0.4F, glm::vec3(0.0F, 0.6F, 0.8F)), scale);
        rigid.instances[0].transform = transform;
        const Pose pose{{glm::mat4(1.0F)}, {{transform, transform}}, {{}}};
        EXPECT_GT(expectEqualsPosed(mover, scene, pose), 1000U);
        const std::string sha = makeAnew(rigid, kGrid, Coverage::Thin).sha;
        EXPECT_EQ(mover.make(kGrid, Coverage::Thin).sha, sha) << scale.x << " " << scale.y << " " << scale.z;
        shas.insert(sha);
    }
    EXPECT_GT(shas.size(), 1U);
}

TEST(Mover, WithoutNormalsEachVertexFollowsTheSideOfItsJoints)
{
    // The upper half is mirrored, the lower one turned: the ball is the same, but its upper half inside out.
    const Scene scene = flatBall();
    Mover mover(device(), scene);
    const glm::mat4 mirrored = glm::scale(glm::mat4(1.0F), glm::vec3(-2, 2, 2));
    const glm::mat4 turned = glm::scale(glm::mat4(1.0F), glm::vec3(-2, 2, -2));
    const Pose pose{{glm::mat4(1.0F)}, {{mirrored, turned}}, {{}}};
    EXPECT_GT(expectEqualsPosed(mover, scene, pose), 1000U);
    const Octree octree =
        buildOctree(device(), {mover.uploaded(), mover.buffers()}, kGrid, {Coverage::Thin, true, {}}).octree;
    const std::vector<std::uint64_t> codes = voxelCodes(device(), octree);
    const std::vector<gpu::Attribute> attributes = device().download(octree.voxel_attributes);
    int outward[2] = {};
    int inward[2] = {};
    for (std::size_t i = 0; i < codes.size(); ++i)
    {
        const glm::dvec3 centre = glm::dvec3(kGrid.origin) + (glm::dvec3(oracle::mortonDecode(codes[i])) + 0.5) *
                                                                 static_cast<double>(kGrid.voxel_size);
        if (std::abs(centre.y) > 0.5) // beyond the triangles that hang on both
        {
            const double along = glm::dot(test::normalOf(attributes[i]), glm::normalize(centre));
            EXPECT_GT(std::abs(along), 0.8);
            ++(along > 0 ? outward : inward)[centre.y > 0 ? 1 : 0];
        }
    }
    const int* const right = outward[0] > 0 ? outward : inward; // as the ball's own winding has it
    const int* const wrong = outward[0] > 0 ? inward : outward;
    EXPECT_GT(right[0], 500);
    EXPECT_GT(right[1], 500);
    EXPECT_EQ(wrong[0] + wrong[1], 0);
}

TEST(Mover, RigidWithAllMaterialsEqualsAnUpload)
{
    std::mt19937 random(22);
    const Scene scene = test::materialsScene(3.0F);
    Mover mover(device(), scene);
    EXPECT_TRUE(mover.mesh().empty());
    EXPECT_EQ(mover.buffers().positions.bytes(), 0U) << "it shares the vertices of the scene";
    for (int round = 0; round < 3; ++round)
    {
        std::vector<glm::mat4> transforms;
        for (std::size_t i = 0; i < scene.instances.size(); ++i)
        {
            transforms.push_back(test::randomAffine(random, 2.0F)); // half of them mirror
        }
        Scene moved = scene;
        for (std::size_t i = 0; i < scene.instances.size(); ++i)
        {
            moved.instances[i].transform = transforms[i];
        }
        device().run([&](vk::FrameGraph& graph) { placeMover(graph, transforms, mover.buffers()); });
        const Made expected = makeAnew(moved, kGrid, Coverage::Thin);
        EXPECT_EQ(mover.make(kGrid, Coverage::Thin).sha, expected.sha);
        EXPECT_GT(expected.voxel_count, 5000U);
    }
}

TEST(Mover, HasTheVoxelsOfTheOracle)
{
    std::mt19937 random(23);
    const auto [scene, pose] = mixedScene(random);
    Mover mover(device(), scene);
    mover.place(pose);
    const Scene posed = posedScene(scene, pose);
    EXPECT_EQ(test::expectEqualsOracle(device(), posed, kGrid, Coverage::Thin),
              mover.make(kGrid, Coverage::Thin).voxel_count);
}

TEST(Mover, AsItWasUploadedEqualsTheUpload)
{
    const Scene scene = test::materialsScene(3.0F);
    Mover mover(device(), scene);
    EXPECT_EQ(mover.make(kGrid, Coverage::Thin).sha, makeAnew(scene, kGrid, Coverage::Thin).sha);
}

TEST(Mover, WithoutWeightsStandsAsAtRest)
{
    std::mt19937 random(24);
    Scene scene;
    Pose pose;
    scene.materials.emplace_back();
    scene.primitives.push_back(test::deformingPrimitive(random, 300, {true, 0, 4}));
    test::addDeforming(random, scene, pose, 0, 0);
    scene.instances[0].transform = pose.transforms[0];
    const Made rest = makeAnew(scene, kGrid, Coverage::Thin);
    Mover mover(device(), scene);
    pose.morph_weights[0].assign(4, 0.0F);
    mover.place(pose);
    EXPECT_EQ(mover.make(kGrid, Coverage::Thin).sha, rest.sha);
    pose.morph_weights[0][0] = 0.5F;
    mover.place(pose);
    EXPECT_NE(mover.make(kGrid, Coverage::Thin).sha, rest.sha);
}

TEST(Mover, PlacesAndVoxelizesInOneCommandBuffer)
{
    std::mt19937 random(25);
    const std::pair<Scene, Pose> made = mixedScene(random);
    const Scene& scene = made.first;
    const Pose& pose = made.second;
    const GpuScene posed = uploadScene(device(), posedScene(scene, pose), true);
    Mover mover(device(), scene);
    const VoxelizeCapacities capacities{1 << 15, 1 << 12, 1 << 16};
    const auto cover =
        [&](vk::FrameGraph& graph, const PlacedScene& placed, VoxelizeBuffers& voxelize, OctreeBuildBuffers& work)
    {
        voxelizeCoverage(graph, placed, kGrid, Coverage::Thin, voxelize);
        listNodes(graph, kGrid, voxelize, work);
    };
    std::vector<gpu::BrickCounters> counters;
    std::string dump;
    for (const bool moves : {false, true})
    {
        VoxelizeBuffers voxelize(device().device(), capacities, posed);
        OctreeBuildBuffers work(device().device(), capacities.bricks);
        device().run(
            [&](vk::FrameGraph& graph)
            {
                if (moves)
                {
                    Pose other = pose; // overwritten before anything reads it
                    test::changePose(random, other);
                    placeMover(graph, mover.mesh(), other, mover.buffers());
                    placeMover(graph, mover.mesh(), pose, mover.buffers());
                    cover(graph, {mover.uploaded(), mover.buffers()}, voxelize, work);
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
    EXPECT_EQ(counters[1].node_count, counters[0].node_count);
    // Between the last deformation and the first triangle stands a barrier from kernels to kernels.
    const std::size_t deformed = dump.rfind("pass deform/vertices");
    const std::size_t walked = dump.find("pass voxelize/triangles");
    ASSERT_LT(deformed, walked);
    const std::string between = dump.substr(deformed, walked - deformed);
    EXPECT_TRUE(std::regex_search(between, std::regex("\\nbarrier compute(\\|transfer)? -> compute\\n"))) << dump;
    EXPECT_NE(dump.find("reads mover/positions"), std::string::npos);
}

TEST(Mover, PassesThatWalkItWaitForItsDraws)
{
    const Scene scene = test::boxScene(glm::vec3(-1.0F), glm::vec3(1.0F));
    Mover mover(device(), scene);
    std::string dump;
    VoxelizeBuffers voxelize(device().device(), {1 << 12, 1 << 10, 1 << 12}, mover.uploaded());
    device().run(
        [&](vk::FrameGraph& graph)
        {
            placeMover(graph, std::vector{glm::mat4(1.0F)}, mover.buffers());
            voxelizeCoverage(graph, {mover.uploaded(), mover.buffers()}, kGrid, Coverage::Thin, voxelize);
            dump = graph.dump();
        });
    const std::size_t updated = dump.find("pass update mover/draws");
    const std::size_t barrier = dump.find("barrier transfer -> compute");
    const std::size_t walked = dump.find("pass voxelize/triangles");
    EXPECT_LT(updated, barrier);
    EXPECT_LT(barrier, walked);
    EXPECT_NE(dump.find("reads mover/draws", walked), std::string::npos) << dump;
}

TEST(Mover, WhatIsNotFiniteIsCountedAndTheRestIsThere)
{
    std::mt19937 random(26);
    auto [scene, pose] = mixedScene(random);
    Mover mover(device(), scene);
    const float nan = std::numeric_limits<float>::quiet_NaN();
    pose.joint_matrices[1][2][3].x = std::numeric_limits<float>::infinity();
    pose.transforms[0][1][1] = nan;
    pose.morph_weights[8][0] = nan;
    EXPECT_GT(expectEqualsPosed(mover, scene, pose), 3000U);
    // The instances of numbers 0 and 8 are gone, that of 1 in part.
    EXPECT_GT(mover.make(kGrid, Coverage::Thin).dropped["nonfinite"], 2U * 58);
    EXPECT_LT(mover.make(kGrid, Coverage::Thin).dropped["nonfinite"], 3U * 58);
}

TEST(Mover, ComesBackToTheSameBytesInConstantMemory)
{
    std::mt19937 random(27);
    auto [scene, first] = mixedScene(random);
    Pose second = first;
    test::changePose(random, second);
    Mover mover(device(), scene);
    const std::string shas[2] = {makeAnew(posedScene(scene, first), kGrid, Coverage::Thin).sha,
                                 makeAnew(posedScene(scene, second), kGrid, Coverage::Thin).sha};
    mover.place(first);
    vk::MemoryAllocator& memory = device().device().memory();
    const std::uint64_t used = memory.usedBytes();
    memory.resetPeak();
    const auto* const draws = mover.buffers().host_draws.data();
    const auto* const joints = mover.buffers().pose.host_joint_matrices.data();
    const auto* const terms = mover.buffers().pose.host_morph_terms.data();
    for (int frame = 0; frame < 500; ++frame)
    {
        mover.place(frame % 2 == 0 ? second : first);
    }
    EXPECT_EQ(memory.usedBytes(), used);
    EXPECT_EQ(memory.peakBytes(), used) << "a frame allocates nothing on the device";
    EXPECT_EQ(mover.buffers().host_draws.data(), draws);
    EXPECT_EQ(mover.buffers().pose.host_joint_matrices.data(), joints);
    EXPECT_EQ(mover.buffers().pose.host_morph_terms.data(), terms);
    EXPECT_EQ(mover.make(kGrid, Coverage::Thin).sha, shas[0]);
    mover.place(second);
    EXPECT_EQ(mover.make(kGrid, Coverage::Thin).sha, shas[1]);
}

TEST(Mover, TwoSetsOfBuffersOfOneSceneAreIndependent)
{
    std::mt19937 random(28);
    const std::pair<Scene, Pose> made = mixedScene(random);
    const Scene& scene = made.first;
    const Pose& pose = made.second;
    Pose other = pose;
    test::changePose(random, other);
    Mover mover(device(), scene);
    MoverBuffers second = makeMover(device(), scene, mover.uploaded(), mover.mesh());
    device().run(
        [&](vk::FrameGraph& graph)
        {
            placeMover(graph, mover.mesh(), pose, mover.buffers());
            placeMover(graph, mover.mesh(), other, second);
        });
    EXPECT_EQ(mover.make(kGrid, Coverage::Thin).sha, makeAnew(posedScene(scene, pose), kGrid, Coverage::Thin).sha);
    EXPECT_EQ(make(device(), {mover.uploaded(), second}, kGrid, Coverage::Thin).sha,
              makeAnew(posedScene(scene, other), kGrid, Coverage::Thin).sha);
}

TEST(Mover, SplitOverSubmissionsItHasTheSameBytes)
{
    std::mt19937 random(29);
    const auto [scene, pose] = mixedScene(random);
    vk::HeadlessOptions options = test::deviceOptions();
    options.slices.most_units = 2;
    vk::HeadlessDevice sliced(options, zvoKernels());
    Mover mover(sliced, scene);
    mover.place(pose);
    EXPECT_EQ(mover.make(kGrid, Coverage::Thin).sha, makeAnew(posedScene(scene, pose), kGrid, Coverage::Thin).sha);
}

TEST(Mover, TransformsOfAnotherSceneAreRefused)
{
    std::mt19937 random(30);
    auto [scene, pose] = mixedScene(random);
    Mover mover(device(), scene);
    Pose other = pose;
    other.transforms.pop_back();
    EXPECT_THROW(mover.place(other), Error);
    EXPECT_THROW(mover.place({}), Error);
    EXPECT_GT(expectEqualsPosed(mover, scene, pose), 5000U) << "and it goes on";
}

TEST(Mover, NeedsAreNamedBeforeMemoryIsTaken)
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
    try
    {
        const MoverBuffers mover = makeMover(limited, scene, uploaded, mesh);
        FAIL() << "400 instances of 1000 vertices, 24 bytes each";
    }
    catch (const Error& error)
    {
        EXPECT_EQ(error.code(), ErrorCode::Memory);
        EXPECT_EQ(std::string(error.what()).rfind("a moving object needs", 0), 0U) << error.what();
    }
    EXPECT_EQ(limited.device().memory().usedBytes(), used);
}

/// Emission of every emissive voxel, by Morton code.
std::map<std::uint64_t, gpu::uint> emissionOf(const Octree& octree)
{
    std::map<std::uint64_t, gpu::uint> result;
    const std::vector<std::uint64_t> codes = voxelCodes(device(), octree);
    const std::vector<gpu::uvec2> words = device().download(octree.emission_words);
    const std::vector<gpu::uint> emission = device().download(octree.emission);
    std::size_t next = 0;
    for (std::size_t voxel = 0; voxel < codes.size() && !words.empty(); ++voxel)
    {
        if (((words[voxel / 32].x >> (voxel % 32)) & 1U) != 0)
        {
            result[codes[voxel]] = emission.at(next);
            ++next;
        }
    }
    return result;
}

TEST(EmissionScale, OfSeveralScenesGivesTheBytesOfTheirUnion)
{
    Scene dim = test::boxScene(glm::vec3(-3.0F), glm::vec3(-1.0F));
    dim.materials[0].emission = {0.5F, 0.25F, 0.1F};
    Scene bright = test::boxScene(glm::vec3(1.0F), glm::vec3(3.0F));
    bright.materials[0].emission = {7.0F, 30.0F, 11.0F};
    Scene both = dim;
    both.append(Scene(bright));
    EXPECT_EQ(brightestEmission(dim), 0.5F);
    EXPECT_EQ(brightestEmission(both), 30.0F);
    EXPECT_EQ(brightestEmission(test::boxScene(glm::vec3(0), glm::vec3(1))), 0.0F);

    const auto build = [](const Scene& scene, std::optional<float> scale)
    {
        const GpuScene uploaded = uploadScene(device(), scene, true, scale);
        return buildOctree(device(), uploaded, kGrid, {Coverage::Thin, true, {}}).octree;
    };
    const Octree whole = build(both, std::nullopt);
    const Octree part = build(dim, brightestEmission(both));
    EXPECT_EQ(part.emission_scale, whole.emission_scale);
    const std::map<std::uint64_t, gpu::uint> expected = emissionOf(whole);
    const std::map<std::uint64_t, gpu::uint> seen = emissionOf(part);
    EXPECT_GT(seen.size(), 500U);
    for (const auto& [code, emission] : seen)
    {
        ASSERT_EQ(emission, expected.at(code));
    }
    EXPECT_NE(emissionOf(build(dim, std::nullopt)), seen);

    // A scene that does not emit is the same bytes but for the scale that it names.
    const Scene dark = test::boxScene(glm::vec3(-3.0F), glm::vec3(-1.0F));
    EXPECT_TRUE(emissionOf(build(dark, 30.0F)).empty());
    EXPECT_EQ(device().download(build(dark, 30.0F).nodes).size(), device().download(build(dark, {}).nodes).size());
}

TEST(MakeDraws, AreTheDrawsOfAnUploadWithThoseTransforms)
{
    std::mt19937 random(32);
    auto [scene, pose] = mixedScene(random);
    const std::vector<gpu::Draw> draws = makeDraws(scene, pose.transforms);
    for (std::size_t i = 0; i < scene.instances.size(); ++i)
    {
        scene.instances[i].transform = pose.transforms[i];
    }
    const GpuScene uploaded = uploadScene(device(), scene, true);
    const std::vector<gpu::Draw> expected = device().download(uploaded.draws);
    ASSERT_EQ(draws.size(), expected.size());
    EXPECT_EQ(std::memcmp(draws.data(), expected.data(), draws.size() * sizeof(gpu::Draw)), 0);
    std::size_t mirrored = 0;
    for (const gpu::Draw& draw : draws)
    {
        mirrored += draw.mirrored;
    }
    EXPECT_GT(mirrored, 0U);
    EXPECT_LT(mirrored, draws.size());
}

} // namespace
} // namespace zvo
