// SPDX-License-Identifier: MIT
// Scenes of many draws.
#include "runtime/octree_sha256.h"
#include "runtime/trees.h"
#include "support/engine_device.h"
#include "support/scenes.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <random>
#include <vector>

namespace zvo
{
namespace
{

using test::device;

DeviceTree octreeOf(const Scene& scene, const Grid& grid, Coverage coverage)
{
    return buildOctree(device(), uploadScene(device(), scene, true), grid, {coverage, true, {}}).octree;
}

// Draws of few triangles share workgroups, larger ones do not.
TEST(DrawsThatShareWorkgroups, GiveTheOctreeOfOneDraw)
{
    constexpr std::uint32_t kBoxes = 137;
    Scene apart = test::boxScene(glm::vec3(0.0F), glm::vec3(2.5F, 1.25F, 3.0F));
    const std::vector<glm::vec3> box = apart.primitives[0].positions;
    const std::vector<glm::uvec3> box_triangles = apart.primitives[0].triangles;
    ASSERT_LT(box_triangles.size(), gpu::kSingleTriangles);
    Scene together = apart;
    together.primitives[0].positions.clear();
    together.primitives[0].triangles.clear();
    apart.instances.clear();
    std::mt19937 random(5);
    for (std::uint32_t i = 0; i < kBoxes; ++i)
    {
        const auto offset = glm::vec3(random() % 60, random() % 60, random() % 60);
        Instance instance;
        instance.transform[3] = glm::vec4(offset, 1.0F);
        apart.instances.push_back(instance);
        const auto first = static_cast<std::uint32_t>(together.primitives[0].positions.size());
        for (const glm::vec3& position : box)
        {
            together.primitives[0].positions.push_back(position + offset);
        }
        for (const glm::uvec3& triangle : box_triangles)
        {
            together.primitives[0].triangles.push_back(triangle + first);
        }
    }
    const GpuScene uploaded = uploadScene(device(), apart, true);
    EXPECT_EQ(uploaded.chunksOf(MaterialClass::Plain).whole.count(), 0U);
    EXPECT_EQ(uploaded.chunksOf(MaterialClass::Plain).single.count(), kBoxes * box_triangles.size());
    for (const float voxel_size : {1.0F, 0.0625F}) // small triangles, and big ones
    {
        const Grid grid = {glm::vec3(0.0F), voxel_size, voxel_size == 1.0F ? 6U : 10U};
        for (const Coverage coverage : {Coverage::Thin, Coverage::Conservative})
        {
            const DeviceTree many = octreeOf(apart, grid, coverage);
            EXPECT_GT(many.voxel_count, 1000U);
            EXPECT_EQ(octreeSha256(device(), many), octreeSha256(device(), octreeOf(together, grid, coverage)));
        }
    }
    // Both kinds of chunks at once.
    apart.primitives.push_back(together.primitives[0]);
    apart.instances.push_back({.primitive = 1});
    const Grid grid = {glm::vec3(0.0F), 0.5F, 7};
    EXPECT_EQ(octreeSha256(device(), octreeOf(apart, grid, Coverage::Thin)),
              octreeSha256(device(), octreeOf(together, grid, Coverage::Thin)));
}

} // namespace
} // namespace zvo
