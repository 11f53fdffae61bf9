// SPDX-License-Identifier: MIT
// NanoVDB files, read with NanoVDB's own reader.
#include "io/voxel/nvdb_write.h"

#include "core/base/morton.h"
#include "core/base/read_file.h"
#include "support/temp_dir.h"
#include "support/tree_samples.h"
#include "written_bytes.h"
#include "zvo/error.h"

#include <iostream> // GridValidator.h does not include it

#include <nanovdb/util/GridValidator.h>
#include <nanovdb/util/IO.h>

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <sched.h>
#include <string>
#include <sys/resource.h>
#include <unistd.h>
#include <vector>

#ifdef __has_feature // clang
#define ZVO_HAS_FEATURE(feature) __has_feature(feature)
#else
#define ZVO_HAS_FEATURE(feature) 0
#endif

namespace zvo::test
{
namespace
{

template <typename Value> void expectVoxels(const nanovdb::NanoGrid<Value>* grid, const TreeData& tree)
{
    ASSERT_NE(grid, nullptr);
    EXPECT_TRUE(nanovdb::isValid(*grid, true));
    EXPECT_EQ(grid->activeVoxelCount(), tree.voxel_count);
    std::uint64_t count = 0;
    const auto* const leaves = grid->tree().template getFirstNode<0>();
    for (std::uint32_t i = 0; i < grid->tree().nodeCount(0); ++i)
    {
        count += leaves[i].valueMask().countOn();
    }
    EXPECT_EQ(count, tree.voxel_count);
    EXPECT_TRUE(grid->tree().background() == Value(0.0F));
}

float linear(std::uint32_t code)
{
    const double encoded = (code & 255U) / 255.0;
    return static_cast<float>(encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4));
}

TEST(NvdbWrite, ActiveValuesAreTheVoxelsInTheirColors)
{
    const TempDir dir;
    for (const TreeSample& sample : treeSamples())
    {
        SCOPED_TRACE(sample.name);
        const TreeData& tree = sample.tree;
        const auto path = dir.write(sample.name + ".nvdb", writtenBytes(writeNvdb, tree));
        EXPECT_EQ(nanovdb::io::readGrids(path.string()).size(), 2U);
        const nanovdb::GridHandle<> densities = nanovdb::io::readGrid(path.string(), "density");
        const nanovdb::GridHandle<> colors = nanovdb::io::readGrid(path.string(), "color");
        const auto* const density = densities.grid<float>();
        const auto* const color = colors.grid<nanovdb::Vec3f>();
        expectVoxels(density, tree);
        expectVoxels(color, tree);
        EXPECT_TRUE(density->gridClass() == nanovdb::GridClass::FogVolume);
        const auto density_values = density->getAccessor();
        const auto color_values = color->getAccessor();
        std::uint64_t voxel = 0;
        forEachVoxel(tree,
                     [&](std::uint64_t code)
                     {
                         const glm::uvec3 cell = cellOfCode(code);
                         const nanovdb::Coord place(static_cast<int>(cell.x), static_cast<int>(cell.y),
                                                    static_cast<int>(cell.z));
                         const std::uint32_t own =
                             tree.hasAttributes() ? tree.voxelAttribute(voxel).color & 0xffffffU : 0xcbcbcbU;
                         ASSERT_TRUE(density_values.isActive(place) && color_values.isActive(place));
                         ASSERT_EQ(density_values.getValue(place), 1.0F);
                         ASSERT_EQ(color_values.getValue(place),
                                   nanovdb::Vec3f(linear(own), linear(own >> 8U), linear(own >> 16U)));
                         ++voxel;
                     });
    }
}

// The program of NanoVDB that makes files of OpenVDB.
TEST(NvdbWrite, DebiansProgramMakesItAnOpenVdbFile)
{
    if (std::system("nanovdb_convert --version > /dev/null 2>&1") != 0)
    {
        GTEST_SKIP() << "nanovdb_convert (libnanovdb-tools) is not installed";
    }
    const TempDir dir;
    const auto path = dir.write("a.nvdb", writtenBytes(writeNvdb, treeSamples().back().tree));
    const auto vdb = dir.path() / "a.vdb";
    EXPECT_EQ(std::system(("nanovdb_convert -f " + path.string() + " " + vdb.string()).c_str()), 0);
    const std::vector<std::uint8_t> bytes = readFile(vdb);
    const std::string content(bytes.begin(), bytes.end());
    EXPECT_NE(content.find("Tree_float_5_4_3"), std::string::npos);
    EXPECT_NE(content.find("Tree_vec3s_5_4_3"), std::string::npos);
}

TEST(NvdbWrite, PlacesAreThoseOfTheCentersOfVoxels)
{
    TreeData tree = treeSamples().back().tree;
    tree.grid.origin = {-3.5F, 2.0F, 0.125F};
    tree.grid.voxel_size = 0.25F;
    const TempDir dir;
    const auto path = dir.write("a.nvdb", writtenBytes(writeNvdb, tree));
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
            EXPECT_EQ(writtenBytes(writeNvdb, samples[i].tree), writtenBytes(writeNvdb, samples[i - 1].tree))
                << samples[i].name;
            ++dag_count;
        }
    }
    EXPECT_GT(dag_count, 3);
}

// Limits the memory that this process can allocate.
class MemoryLimit
{
public:
    explicit MemoryLimit(std::uint64_t bytes)
    {
        std::ifstream statm("/proc/self/statm");
        std::uint64_t pages = 0;
        statm >> pages;
        getrlimit(RLIMIT_AS, &m_before);
        const struct rlimit limit = {pages * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE)) + bytes,
                                     m_before.rlim_max};
        setrlimit(RLIMIT_AS, &limit);
    }
    ~MemoryLimit() { setrlimit(RLIMIT_AS, &m_before); }
    MemoryLimit(const MemoryLimit&) = delete;
    MemoryLimit& operator=(const MemoryLimit&) = delete;

private:
    struct rlimit m_before = {};
};

// Limits the process to one processor, on which NanoVDB starts no threads.
class OneProcessor
{
public:
    OneProcessor()
    {
        sched_getaffinity(0, sizeof(m_before), &m_before);
        cpu_set_t one;
        CPU_ZERO(&one);
        CPU_SET(sched_getcpu(), &one);
        sched_setaffinity(0, sizeof(one), &one);
    }
    ~OneProcessor() { sched_setaffinity(0, sizeof(m_before), &m_before); }
    OneProcessor(const OneProcessor&) = delete;
    OneProcessor& operator=(const OneProcessor&) = delete;

private:
    cpu_set_t m_before{};
};

TEST(NvdbWrite, TooLittleMemoryIsSaidBeforeAnythingIsWritten)
{
#if defined(__SANITIZE_ADDRESS__) || ZVO_HAS_FEATURE(address_sanitizer)
    GTEST_SKIP() << "AddressSanitizer's own memory exceeds any limit";
#endif
    std::vector<std::uint64_t> codes;
    for (std::uint64_t block = 0; block < 1U << 13; ++block)
    {
        codes.push_back(block << 9); // 6 KiB of colours each, first in nodes and then in the grid
    }
    const TreeData tree = octreeOf(codes, 8);
    const OneProcessor processor;
    constexpr std::uint64_t kMiB = 1 << 20;
    std::uint32_t failed_count = 0;
    std::uint64_t written_bytes = 0;
    for (std::uint64_t bytes = 0; written_bytes == 0 && bytes < 256 * kMiB; bytes += 8 * kMiB)
    {
        try
        {
            const MemoryLimit limit(bytes);
            writeNvdb(tree, [&](std::span<const std::byte> more) { written_bytes += more.size(); });
        }
        catch (const Error& error)
        {
            EXPECT_EQ(error.code(), ErrorCode::Memory);
            EXPECT_NE(std::string(error.what()).find("of 8192 voxels"), std::string::npos) << error.what();
            ASSERT_EQ(written_bytes, 0U);
            ++failed_count;
        }
    }
    EXPECT_GE(failed_count, 3U) << "there was no room for the grid";
    EXPECT_EQ(written_bytes, writtenBytes(writeNvdb, tree).size());
}

} // namespace
} // namespace zvo::test
