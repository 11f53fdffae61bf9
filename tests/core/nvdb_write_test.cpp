// SPDX-License-Identifier: MIT
// NanoVDB files, read with NanoVDB's own reader.
#include "core/nvdb_write.h"

#include "core/tree_build.h"
#include "support/temp_dir.h"
#include "support/tree_samples.h"

#include <iostream> // which GridValidator.h lacks

#include <nanovdb/util/GridValidator.h>
#include <nanovdb/util/IO.h>

#include <gtest/gtest.h>

#include <cstdint>
#include <string>

namespace zvo::test
{
namespace
{

std::string nvdbOf(const TreeData& tree)
{
    std::string bytes;
    writeNvdb(tree, [&bytes](std::span<const std::byte> more)
              { bytes.append(reinterpret_cast<const char*>(more.data()), more.size()); });
    return bytes;
}

std::uint64_t activeCount(const nanovdb::NanoGrid<nanovdb::Rgba8>& grid)
{
    std::uint64_t count = 0;
    const auto* const leaves = grid.tree().getFirstNode<0>();
    for (std::uint32_t i = 0; i < grid.tree().nodeCount(0); ++i)
    {
        count += leaves[i].valueMask().countOn();
    }
    return count;
}

TEST(NvdbWrite, ActiveValuesAreTheVoxelsInTheirColours)
{
    const TempDir dir;
    for (const TreeSample& sample : treeSamples())
    {
        const TreeData& tree = sample.tree;
        const auto path = dir.write(sample.name + ".nvdb", nvdbOf(tree));
        const nanovdb::GridHandle<> handle = nanovdb::io::readGrid(path.string(), "zvo");
        const auto* const grid = handle.grid<nanovdb::Rgba8>();
        ASSERT_NE(grid, nullptr) << sample.name;
        EXPECT_TRUE(nanovdb::isValid(*grid, true)) << sample.name;
        EXPECT_TRUE(grid->gridClass() == nanovdb::GridClass::VoxelVolume);
        EXPECT_EQ(grid->activeVoxelCount(), tree.voxel_count) << sample.name;
        EXPECT_EQ(activeCount(*grid), tree.voxel_count) << sample.name;
        const auto values = grid->getAccessor();
        std::uint64_t voxel = 0;
        forEachVoxel(tree,
                     [&](std::uint64_t code)
                     {
                         const glm::uvec3 cell = cellOfCode(code);
                         const nanovdb::Coord place(static_cast<int>(cell.x), static_cast<int>(cell.y),
                                                    static_cast<int>(cell.z));
                         const std::uint32_t color =
                             tree.hasAttributes() ? tree.voxelAttribute(voxel).color & 0xffffffU : 0xcbcbcbU;
                         ASSERT_TRUE(values.isActive(place)) << sample.name;
                         ASSERT_EQ(values.getValue(place).packed(), color | 0xff000000U) << sample.name;
                         ++voxel;
                     });
        EXPECT_EQ(grid->tree().background().packed(), 0U);
    }
}

TEST(NvdbWrite, PlacesAreThoseOfTheCentresOfVoxels)
{
    TreeData tree = treeSamples().back().tree;
    tree.grid.origin = {-3.5F, 2.0F, 0.125F};
    tree.grid.voxel_size = 0.25F;
    const TempDir dir;
    const auto path = dir.write("a.nvdb", nvdbOf(tree));
    const nanovdb::GridHandle<> handle = nanovdb::io::readGrid(path.string());
    const nanovdb::Vec3d world = handle.gridMetaData()->map().applyMap(nanovdb::Vec3d(4.0, 0.0, 2.0));
    EXPECT_EQ(world[0], -3.5 + 0.25 * 4.5);
    EXPECT_EQ(world[1], 2.0 + 0.25 * 0.5);
    EXPECT_EQ(world[2], 0.125 + 0.25 * 2.5);
}

TEST(NvdbWrite, GivesTheSameBytesForEqualVoxels)
{
    const std::vector<TreeSample> samples = treeSamples();
    int dag_count = 0;
    for (std::size_t i = 1; i < samples.size(); ++i)
    {
        if (samples[i].name == samples[i - 1].name + "_dag")
        {
            EXPECT_EQ(nvdbOf(samples[i].tree), nvdbOf(samples[i - 1].tree)) << samples[i].name;
            ++dag_count;
        }
    }
    EXPECT_GT(dag_count, 3);
}

} // namespace
} // namespace zvo::test
