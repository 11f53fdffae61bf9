// SPDX-License-Identifier: MIT
// Distances in a band against exact ones.
#include "core/base/morton.h"
#include "io/voxel/nvdb_distances.h"
#include "oracle/winding.h"
#include "runtime/distances.h"
#include "runtime/trees.h"
#include "support/distance_compare.h"
#include "support/engine_device.h"
#include "support/fill_compare.h"
#include "support/same_bytes.h"
#include "support/scenes.h"
#include "support/temp_dir.h"
#include "zvo/error.h"

#include <gtest/gtest.h>
#include <nanovdb/util/IO.h>

#include <array>
#include <cstdint>
#include <cstdlib>
#include <map>
#include <random>
#include <span>
#include <utility>
#include <vector>

namespace zvo
{
namespace
{

using test::device;

test::DistanceComparison expectExact(const Scene& scene, const Grid& grid, std::uint32_t band, Fill fill = Fill::Solid)
{
    const test::DistanceComparison found = test::compareDistances(device(), scene, grid, {.band = band, .fill = fill});
    EXPECT_EQ(found.wrong_values, 0U) << found.in_band << " in the band";
    EXPECT_EQ(found.wrong_signs, 0U);
    EXPECT_TRUE(found.in_order);
    return found;
}

TEST(Distance, ToSpheresIsExact)
{
    for (const std::uint32_t depth : {3U, 4U, 5U})
    {
        const Grid grid = {glm::vec3(0), 1.0F, depth};
        const float half = static_cast<float>(grid.resolution()) / 2;
        const test::DistanceComparison found =
            expectExact(test::sphereScene(glm::vec3(half), 0.8F * half, 8), grid, depth == 3 ? 15 : 2);
        EXPECT_TRUE(found.is_closed);
        EXPECT_GT(found.inside, 0U);
        EXPECT_GT(found.in_band, found.inside);
    }
}

TEST(Distance, ToTrianglesOfAnyShapeIsExact)
{
    for (std::uint32_t seed = 0; seed < 4; ++seed)
    {
        const Grid grid = {glm::vec3(0), 1.0F, 4};
        expectExact(test::randomTriangles(seed, 12, 16.0F), grid, 1 + 3 * seed);
    }
}

// Products of their lengths are as long as any: the farthest corners are at the lattice's ends.
TEST(Distance, ToTrianglesAsLargeAsTheLatticeIsExact)
{
    const float end = 2097152.0F;
    const Grid grid = {glm::vec3(0), 1.0F, 3};
    for (const std::vector<glm::vec3>& corners : {
             std::vector<glm::vec3>{{-end, -end, -end}, {end, end, end}, {-end, end, 3}},
             {{-end, 3.25F, -end}, {end, 2.5F, -end}, {2.125F, 4, end}},
             {{-end, 0, 5.5F}, {end, 0.00390625F, 5.5F}, {4, 4, 5.25F}},                // wide and low
             {{-end, -end, -end}, {end, end, end - 1}, {-end + 1, -end + 1, -end + 1}}, // a needle
         })
    {
        EXPECT_GT(expectExact(test::triangleSoup(corners), grid, 15).in_band, 0U);
    }
}

TEST(Distance, ToSegmentsPointsAndWhatIsBesideTheGridIsExact)
{
    const Grid grid = {glm::vec3(0), 1.0F, 3};
    for (const std::vector<glm::vec3>& corners : {
             std::vector<glm::vec3>{{1, 2, 3}, {6.5F, 5, 4.25F}, {1, 2, 3}},
             {{4.5F, 4.5F, 4.5F}, {4.5F, 4.5F, 4.5F}, {4.5F, 4.5F, 4.5F}},
             {{-2, -1, -3}, {-1.5F, 9, -2}, {9, -2.5F, -1}}, // beyond the lower faces
             {{9, 10, 2}, {10, 9, 9}, {2, 9.5F, 10}},        // and the upper ones
         })
    {
        EXPECT_GT(expectExact(test::triangleSoup(corners), grid, 4).in_band, 0U);
    }
}

TEST(Distance, HasTheSignOfTheWindingNumber)
{
    std::mt19937 random(1);
    std::uint64_t inside = 0;
    for (int round = 0; round < 12; ++round)
    {
        const Grid grid = {glm::vec3(0), 1.0F, 4};
        const Fill fill = std::array{Fill::Solid, Fill::Parity, Fill::Solid, Fill::None}.at(round % 4U);
        const test::DistanceComparison found = expectExact(test::tetrahedra(random, grid), grid, 2, fill);
        EXPECT_TRUE(found.is_closed);
        EXPECT_TRUE(fill != Fill::None || found.inside == 0);
        inside += found.inside;
    }
    EXPECT_GT(inside, 1000U);
}

DistanceData distancesOf(const Scene& scene, const Grid& grid, const DistanceOptions& options)
{
    const GpuScene uploaded = uploadScene(device(), scene, false);
    return downloadDistances(device(), findDistances(device(), uploaded, grid, options).distances);
}

void expectSame(const DistanceData& a, const DistanceData& b)
{
    EXPECT_GT(a.leaves.size(), 0U);
    EXPECT_EQ(a.squared, b.squared);
    EXPECT_TRUE(test::sameBytes(a.leaves, b.leaves));
}

TEST(Distance, IsTheSameInADeeperGridAndAfterRunsThatFoundNoRoom)
{
    const Scene scene = test::sphereScene(glm::vec3(14.0F), 8.0F, 8);
    const DistanceData expected = distancesOf(scene, {glm::vec3(0), 1.0F, 5}, {});
    expectSame(distancesOf(scene, {glm::vec3(0), 1.0F, 13}, {}), expected); // keys of two words
    VoxelizeCapacities small;
    small.table = small.bricks = small.setups = small.items = small.large = 1;
    expectSame(distancesOf(scene, {glm::vec3(0), 1.0F, 5}, {.capacities = small}), expected);
}

TEST(Distance, OfAnEmptySceneHasNoLeaves)
{
    EXPECT_TRUE(distancesOf({}, {glm::vec3(0), 1.0F, 4}, {}).leaves.empty());
}

TEST(Distance, RefusesBandsAndDepthsOutOfRange)
{
    const GpuScene scene = uploadScene(device(), test::sphereScene(glm::vec3(4.0F), 2.0F, 4), false);
    for (const auto& [depth, band] : {std::pair{4U, 0U}, {4U, 16U}, {2U, 3U}, {17U, 3U}})
    {
        EXPECT_THROW(findDistances(device(), scene, {glm::vec3(0), 1.0F, depth}, {.band = band}), Error);
    }
}

// Every cell of the file: active values are those of the band, others tell inside from outside.
TEST(Distance, FilesAreLevelSetsThatNanoVdbReads)
{
    const Grid grid = {glm::vec3(1, 2, 3), 0.25F, 6};
    const Scene scene = test::sphereScene(glm::vec3(9, 10, 11), 7.0F, 12);
    const DistanceData data = distancesOf(scene, grid, {});
    const GpuScene uploaded = uploadScene(device(), scene, false);
    const TreeData filled = downloadTree(
        device(), buildOctree(device(), uploaded, grid, {.attributes = false, .fill = Fill::Solid}).octree);
    std::vector<std::uint8_t> bytes;
    writeNvdbDistances(data, filled,
                       [&](std::span<const std::byte> more)
                       {
                           const auto* const first = reinterpret_cast<const std::uint8_t*>(more.data());
                           bytes.insert(bytes.end(), first, first + more.size());
                       });
    const test::TempDir dir;
    const auto path = dir.write("sphere.nvdb", bytes);
    const nanovdb::GridHandle<> handle = nanovdb::io::readGrid(path.string(), "distance");
    const auto* const level_set = handle.grid<float>();
    ASSERT_NE(level_set, nullptr);
    EXPECT_TRUE(level_set->gridClass() == nanovdb::GridClass::LevelSet);
    EXPECT_EQ(level_set->tree().background(), 0.75F);
    std::map<std::uint64_t, float> expected;
    for (std::size_t i = 0; i < data.leaves.size(); ++i)
    {
        for (std::uint32_t cell = 0; cell < 64; ++cell)
        {
            if (data.isInBand(i, cell))
            {
                expected[64 * codeOfCell(data.leaves[i].leaf) + cell] = data.distanceAt(i, cell);
            }
        }
    }
    EXPECT_EQ(level_set->activeVoxelCount(), expected.size());
    const std::vector<std::int16_t> winding =
        oracle::windingNumbers(test::latticeTriangles(scene, grid), grid.resolution());
    const auto values = level_set->getAccessor();
    std::uint64_t wrong = 0;
    for (std::uint32_t i = 0; i < winding.size(); ++i)
    {
        const glm::uvec3 cell(i % 64, i / 64 % 64, i / 64 / 64);
        const nanovdb::Coord at(static_cast<int>(cell.x), static_cast<int>(cell.y), static_cast<int>(cell.z));
        const auto found = expected.find(codeOfCell(cell));
        const float value = found != expected.end() ? found->second : winding[i] != 0 ? -0.75F : 0.75F;
        wrong += values.getValue(at) == value && values.isActive(at) == (found != expected.end()) ? 0 : 1;
    }
    EXPECT_EQ(wrong, 0U);
    if (std::system("nanovdb_validate --version > /dev/null 2>&1") != 0)
    {
        GTEST_SKIP() << "nanovdb_validate (libnanovdb-tools) is not installed";
    }
    EXPECT_EQ(std::system(("nanovdb_validate " + path.string()).c_str()), 0);
    EXPECT_EQ(std::system(("nanovdb_print " + path.string() + " > /dev/null").c_str()), 0);
}

} // namespace
} // namespace zvo
