// SPDX-License-Identifier: MIT
#include "core/upload/gpu_scene.h"

#include "core/upload/draws.h"
#include "runtime/trees.h"
#include "support/engine_device.h"
#include "support/moved_scene.h"
#include "support/octree_access.h"
#include "support/scenes.h"

#include <gtest/gtest.h>

#include <cstring>
#include <map>
#include <optional>
#include <random>
#include <utility>
#include <vector>

namespace zvo
{
namespace
{

using test::kGrid;
using test::mixedScene;

using test::device;

/// The emission of every emissive voxel, by Morton code.
std::map<std::uint64_t, gpu::uint> emissionOf(const DeviceTree& octree)
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
    const DeviceTree whole = build(both, std::nullopt);
    const DeviceTree part = build(dim, brightestEmission(both));
    EXPECT_EQ(part.emission_scale, whole.emission_scale);
    const std::map<std::uint64_t, gpu::uint> expected = emissionOf(whole);
    const std::map<std::uint64_t, gpu::uint> seen = emissionOf(part);
    EXPECT_GT(seen.size(), 500U);
    for (const auto& [code, emission] : seen)
    {
        ASSERT_EQ(emission, expected.at(code));
    }
    EXPECT_NE(emissionOf(build(dim, std::nullopt)), seen);

    // A scene without emission has the same bytes, except for its scale.
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
