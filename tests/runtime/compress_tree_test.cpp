// SPDX-License-Identifier: MIT
// DAGs of octrees in the host's memory.
#include "core/file/tree_check.h"
#include "runtime/trees.h"
#include "support/engine_device.h"
#include "support/tree_samples.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <optional>
#include <utility>
#include <variant>

namespace zvo
{
namespace
{

using test::device;

TEST(CompressTree, GivesTheBytesOfCompressingTheWholeTreeOnTheDevice)
{
    for (const test::TreeSample& sample : test::treeSamples())
    {
        if (sample.tree.structure != TreeStructure::Svo)
        {
            continue;
        }
        const TreeData dag = compressTree(device(), sample.tree);
        EXPECT_EQ(checkTree(dag), std::nullopt) << sample.name;
        DeviceTree octree = uploadTree(device(), sample.tree);
        const TreeData expected = downloadTree(device(), compress(device(), std::move(octree)).dag);
        EXPECT_EQ(test::treeDifference(dag, expected), "") << sample.name;
    }
}

TEST(CompressTree, LeavesWhatVoxelsLookLikeWithTheHost)
{
    std::size_t looked_at = 0;
    for (const test::TreeSample& sample : test::treeSamples())
    {
        const TreeData& octree = sample.tree;
        if (octree.structure != TreeStructure::Svo || octree.voxel_attributes.size() < 4096)
        {
            continue;
        }
        ++looked_at;
        vk::HeadlessDevice with({}, zvoKernels());
        vk::HeadlessDevice without({}, zvoKernels());
        (void)compress(with, uploadTree(with, octree));
        (void)compressTree(without, octree);
        const std::uint64_t left = octree.voxel_attributes.size() * sizeof(gpu::Attribute);
        EXPECT_LE(without.device().memory().peakBytes() + left, with.device().memory().peakBytes()) << sample.name;
    }
    EXPECT_GT(looked_at, 0U);
}

} // namespace
} // namespace zvo
