// SPDX-License-Identifier: MIT
#include "baseline/slides_fixture.h"

#include "baseline/baseline_kernels.h"
#include "runtime/run_job.h"
#include "support/device.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <numeric>

namespace zvo::test
{

vk::HeadlessDevice& slidesDevice()
{
    return sharedDevice(baseline::allKernels());
}

std::vector<std::string> slidesScenes()
{
    // In this order, the shards of a run take about as long.
    return {"atrium.glb", "sponza.glb", "dragon.glb",      "buddha_113k.glb",
            "knot.glb",   "cube.glb",   "cornell_box.glb", "bunny_low.glb"};
}

baseline::SlidesResult buildSlides(const PosedGpuScene& scene, const Grid& grid, const baseline::SlidesOptions& options)
{
    baseline::SlidesResult result =
        runJob(slidesDevice(), baseline::SlidesBuilder(slidesDevice().device(), scene, grid, options));
    EXPECT_EQ(result.capped_voxels, 0U);
    return result;
}

std::vector<std::uint32_t> distinctSubtrees(std::span<const std::uint64_t> codes, std::uint32_t depth)
{
    using Children = std::array<std::uint32_t, 8>; // the classes of a node's children; 0: none
    std::vector<std::uint32_t> counts;
    std::vector<std::uint64_t> cells(codes.begin(), codes.end());
    std::vector<std::uint32_t> classes(cells.size(), 1);
    for (std::uint32_t level = 0; level < depth && !codes.empty(); ++level)
    {
        std::map<Children, std::uint32_t> numbers;
        std::vector<std::uint64_t> parents;
        std::vector<std::uint32_t> parent_classes;
        for (std::size_t i = 0; i < cells.size();)
        {
            Children children{};
            const std::uint64_t parent = cells[i] >> 3;
            for (; i < cells.size() && cells[i] >> 3 == parent; ++i)
            {
                children[cells[i] & 7] = classes[i];
            }
            const auto next = static_cast<std::uint32_t>(numbers.size() + 1);
            parents.push_back(parent);
            parent_classes.push_back(numbers.try_emplace(children, next).first->second);
        }
        counts.push_back(static_cast<std::uint32_t>(numbers.size()));
        cells = std::move(parents);
        classes = std::move(parent_classes);
    }
    return counts;
}

std::vector<std::uint32_t> nodeCounts(std::span<const std::uint64_t> codes, std::uint32_t depth)
{
    std::vector<std::uint32_t> counts;
    for (std::uint32_t level = 1; level <= depth && !codes.empty(); ++level)
    {
        std::uint32_t count = 1;
        for (std::size_t i = 1; i < codes.size(); ++i)
        {
            count += codes[i - 1] >> (3 * level) != codes[i] >> (3 * level) ? 1 : 0;
        }
        counts.push_back(count);
    }
    return counts;
}

void expectSlidesTree(const baseline::SlidesTree& tree, const std::vector<std::uint64_t>& codes,
                      const std::vector<std::uint32_t>& level_node_counts)
{
    EXPECT_EQ(tree.level_node_counts, level_node_counts);
    EXPECT_EQ(tree.node_count, std::accumulate(level_node_counts.begin(), level_node_counts.end(), 0U));
    EXPECT_EQ(tree.voxel_count, codes.size());
    EXPECT_EQ(tree.geometryBytes(), tree.nodes.bytes());
    const bool has_sums = tree.node_words == baseline::SlidesNodes::WithSums;
    const std::vector<baseline::SlidesVoxel> voxels = baseline::slidesVoxels(slidesDevice(), tree);
    ASSERT_EQ(voxels.size(), codes.size());
    std::size_t wrong = 0;
    for (std::size_t i = 0; i < codes.size(); ++i)
    {
        wrong += voxels[i].code != codes[i] || voxels[i].index != (has_sums ? i : 0) ? 1 : 0;
    }
    EXPECT_EQ(wrong, 0U) << "of " << codes.size() << " voxels";
}

void expectSlidesAttributes(const baseline::SlidesTree& tree, const DeviceTree& expected)
{
    constexpr std::uint32_t kColorMask = 0xFFFFFF; // without flags
    const auto attributes = slidesDevice().download(tree.attributes);
    const auto expected_attributes = slidesDevice().download(expected.voxel_attributes);
    ASSERT_EQ(attributes.size(), expected_attributes.size());
    std::size_t wrong = 0;
    for (std::size_t i = 0; i < attributes.size(); ++i)
    {
        wrong += attributes[i].color != (expected_attributes[i].color & kColorMask) ||
                         attributes[i].normal != expected_attributes[i].normal
                     ? 1
                     : 0;
    }
    EXPECT_EQ(wrong, 0U) << "of " << attributes.size() << " voxels";
}

} // namespace zvo::test
