// SPDX-License-Identifier: MIT
#include "support/voxel_compare.h"

#include "oracle/voxelizer.h"
#include "support/octree_access.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>

namespace zvo::test
{

std::size_t expectEqualsOracle(vk::HeadlessDevice& device, const Scene& scene, const Grid& grid, Coverage coverage,
                               const BuildOptions& options)
{
    const GpuScene gpu_scene = uploadScene(device, scene, false);
    const BuildResult result = buildOctree(device, gpu_scene, grid, {coverage, false, options.capacities});
    const oracle::OracleVoxels expected = oracle::voxelize(scene, grid, coverage);
    const oracle::OctreeContents contents = contentsOf(device, result.octree);
    EXPECT_TRUE(contents.violations.empty()) << contents.violations.front();
    EXPECT_EQ(contents.codes.size(), result.octree.voxel_count);
    std::vector<std::uint64_t> missing;
    std::vector<std::uint64_t> extra;
    std::set_difference(expected.codes.begin(), expected.codes.end(), contents.codes.begin(), contents.codes.end(),
                        std::back_inserter(missing));
    std::set_difference(contents.codes.begin(), contents.codes.end(), expected.codes.begin(), expected.codes.end(),
                        std::back_inserter(extra));
    EXPECT_EQ(missing.size(), 0U) << "of " << expected.codes.size() << " voxels, first " << missing.front();
    EXPECT_EQ(extra.size(), 0U) << "beside " << expected.codes.size() << " voxels, first " << extra.front();
    EXPECT_EQ(result.dropped, expected.dropped);
    return expected.codes.size();
}

} // namespace zvo::test
