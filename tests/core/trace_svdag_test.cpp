// SPDX-License-Identifier: MIT
// A DAG looks like the octree that it was made from.
#include "core/kernels.h"
#include "support/dags.h"
#include "support/device.h"
#include "support/trace_octrees.h"

#include <gtest/gtest.h>

namespace zvo
{
namespace
{

vk::HeadlessDevice& device()
{
    return test::sharedDevice(zvoKernels());
}

TEST(TraceSvdag, UploadedDagIsTheOctree)
{
    const test::Codes codes = test::spongeCodes(5);
    Octree octree = test::octreeOf(device(), codes, 5);
    test::addAttributes(device(), octree);
    const Svdag dag = test::svdagOf(device(), octree);
    EXPECT_LT(dag.tree.node_count, octree.node_count);
    const oracle::DagContents contents = test::contentsOf(device(), dag);
    EXPECT_EQ(contents.violations, std::vector<std::string>{});
    ASSERT_EQ(contents.voxels.size(), codes.size());
    for (std::size_t i = 0; i < codes.size(); ++i)
    {
        ASSERT_EQ(contents.voxels[i].code, codes[i]);
        ASSERT_EQ(contents.voxels[i].rank, i);
    }
}

} // namespace
} // namespace zvo
