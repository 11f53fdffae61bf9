// SPDX-License-Identifier: MIT
// Compression against the oracle, byte for byte. So the result does not depend on threads, subgroups or tables.
#include "core/tree/device_tree.h"

#include "core/base/kernels.h"
#include "io/gltf/gltf_loader.h"
#include "runtime/trees.h"
#include "support/dag_compare.h"
#include "support/dags.h"
#include "support/device.h"
#include "support/engine_device.h"
#include "support/errors.h"
#include "support/octree_access.h"
#include "support/param_names.h"
#include "support/scenes.h"
#include "support/trace_octrees.h"
#include "zvo/error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <map>
#include <optional>
#include <random>
#include <regex>
#include <span>
#include <string>

namespace zvo
{

namespace
{

using test::Codes;

using test::device;

/// Compresses octree, and compares the result with the oracle's.
CompressResult compressedAsExpected(DeviceTree octree, const CompressOptions& options = {})
{
    const DeviceTree expected = test::svdagOf(device(), octree, options.entries_per_word);
    std::vector<std::uint32_t> candidate_counts;
    for (const DeviceTree::Level& level : octree.levels)
    {
        candidate_counts.push_back(level.node_count);
    }
    CompressResult result = compress(device(), std::move(octree), options);
    EXPECT_EQ(test::difference(device(), result.dag, expected), "");
    EXPECT_EQ(result.candidate_counts, candidate_counts);
    return result;
}

/// Compares the same without attributes and with arbitrary ones. Returns the DAG with attributes.
DeviceTree compressedAsExpected(const Codes& codes, std::uint32_t depth)
{
    compressedAsExpected(test::octreeOf(device(), codes, depth));
    DeviceTree octree = test::octreeOf(device(), codes, depth);
    test::addAttributes(device(), octree);
    return std::move(compressedAsExpected(std::move(octree)).dag);
}

/// Expects that dag has the voxels of octree, in the same ranks, and all nodes.
void expectExpandsTo(const DeviceTree& dag, const std::vector<std::uint64_t>& codes)
{
    const oracle::DagContents contents = test::dagContentsOf(device(), dag);
    EXPECT_EQ(contents.violations, std::vector<std::string>{});
    ASSERT_EQ(contents.voxels.size(), codes.size());
    ASSERT_EQ(contents.nodes.size(), dag.octreeNodeCount());
    std::size_t wrong = 0;
    for (std::size_t i = 0; i < codes.size(); ++i)
    {
        const std::uint64_t rank =
            dag.lists.before.count() + dag.lists.voxels_before_leaf.count() != 0 ? i : contents.voxels[i].rank;
        wrong += contents.voxels[i].code != codes[i] || contents.voxels[i].rank != rank ? 1 : 0;
    }
    EXPECT_EQ(wrong, 0U) << "of " << codes.size() << " voxels";
}

TEST(Svdag, OfRandomVoxelsIsTheOracles)
{
    std::mt19937 random(1);
    for (std::uint32_t depth = 1; depth <= Grid::kDepthMax; ++depth)
    {
        for (const std::uint32_t count : {1U, 27U, 2049U})
        {
            SCOPED_TRACE(testing::Message() << count << " voxels at depth " << depth);
            compressedAsExpected(test::randomCodes(depth, count, random), depth);
        }
    }
}

TEST(Svdag, OfNothingHasNoNodes)
{
    for (const std::uint32_t depth : {1U, 4U, 17U})
    {
        DeviceTree octree;
        octree.grid.depth = depth;
        const CompressResult result = compress(device(), std::move(octree));
        EXPECT_EQ(result.dag.grid.depth, depth);
        EXPECT_EQ(result.dag.node_count, 0U);
        EXPECT_EQ(result.dag.octreeNodeCount(), 0U);
        EXPECT_EQ(result.dag.geometryBytes(), 0U);
        EXPECT_TRUE(result.dag.levels.empty());
        EXPECT_TRUE(result.passes.empty());
    }
}

TEST(Svdag, OfOneVoxelIsAPath)
{
    std::mt19937 random(2);
    for (std::uint32_t depth = 1; depth <= Grid::kDepthMax; ++depth)
    {
        SCOPED_TRACE(depth);
        const std::uint64_t last = (std::uint64_t{1} << (3 * depth)) - 1;
        for (const std::uint64_t code : {std::uint64_t{0}, last, last & (std::uint64_t{random()} << 20 | random())})
        {
            compressedAsExpected({code}, depth);
        }
    }
}

TEST(Svdag, OfAFullGridOrACheckerboardHasANodeALevel)
{
    for (std::uint32_t depth = 1; depth <= 7; ++depth)
    {
        SCOPED_TRACE(depth);
        const DeviceTree full =
            compressedAsExpected(test::codesWhere(depth, [](const glm::uvec3&) { return true; }), depth);
        EXPECT_EQ(full.node_count, full.grid.nodeLevels());
        const DeviceTree checkered = compressedAsExpected(
            test::codesWhere(depth, [](const glm::uvec3& v) { return ((v.x + v.y + v.z) & 1U) != 0; }), depth);
        EXPECT_EQ(checkered.node_count, checkered.grid.nodeLevels());
    }
}

TEST(Svdag, OfNoiseIsTheOctree)
{
    for (const std::uint32_t depth : {5U, 6U, 7U})
    {
        SCOPED_TRACE(depth);
        std::mt19937 random(depth);
        const Codes codes = test::codesWhere(depth, [&](const glm::uvec3&) { return (random() >> 7 & 1U) != 0; });
        const DeviceTree dag = compressedAsExpected(codes, depth);
        EXPECT_EQ(dag.node_count, dag.octreeNodeCount());
    }
}

TEST(Svdag, OfMoreThan65536NodesHasThreeEntriesAWord)
{
    for (const std::uint64_t leaf_count : {65536, 70000})
    {
        // The voxels of each leaf are the leaf's number, so that all leaves differ.
        Codes codes;
        for (std::uint64_t leaf = 0; leaf < leaf_count; ++leaf)
        {
            for (std::uint64_t voxel = 0; voxel < 18; ++voxel)
            {
                if (((leaf + 1) >> voxel & 1) != 0)
                {
                    codes.push_back(leaf << 6 | voxel);
                }
            }
        }
        DeviceTree octree = test::octreeOf(device(), codes, 8);
        EXPECT_GT(octree.node_count, 65536U);
        const CompressResult result = compressedAsExpected(std::move(octree));
        EXPECT_EQ(result.dag.lists.entries_per_word, 3U);
    }
}

TEST(Svdag, OfAnyEntriesAWordIsTheOracles)
{
    std::mt19937 random(9);
    for (const std::uint32_t depth : {3U, 4U, 8U})
    {
        const Codes codes = test::randomCodes(depth, 700, random);
        for (const std::uint32_t entries : {2U, 3U, 4U})
        {
            SCOPED_TRACE(testing::Message() << entries << " entries a word at depth " << depth);
            DeviceTree octree = test::octreeOf(device(), codes, depth);
            test::addAttributes(device(), octree);
            CompressOptions options;
            options.entries_per_word = entries;
            CompressResult result = compressedAsExpected(std::move(octree), options);
            EXPECT_EQ(result.dag.lists.entries_per_word, entries);
            expectExpandsTo(result.dag, codes);
            // A DAG made of the DAG has four again.
            const DeviceTree again = compress(device(), std::move(result.dag)).dag;
            EXPECT_EQ(again.lists.entries_per_word, 4U);
            expectExpandsTo(again, codes);
        }
    }
}

TEST(Svdag, OfLeavesThatDifferInOneVoxelKeepsThemApart)
{
    // Each leaf lacks one of 64 voxels, and the leaves come in all orders: masks and children differ as little as
    // possible.
    const std::uint32_t depth = 6;
    std::mt19937 random(3);
    Codes codes;
    for (std::uint64_t leaf = 0; leaf < std::uint64_t{1} << (3 * depth - 6); ++leaf)
    {
        const std::uint64_t missing = random() % 64;
        for (std::uint64_t voxel = 0; voxel < 64; ++voxel)
        {
            if (voxel != missing)
            {
                codes.push_back(leaf << 6 | voxel);
            }
        }
    }
    const DeviceTree dag = compressedAsExpected(codes, depth);
    EXPECT_EQ(dag.levels.back().node_count, 64U);
}

TEST(Svdag, OfEqualBlocksIsOneOfThem)
{
    // The same block of 16^3 voxels everywhere, filled with noise, so that nothing in it is equal.
    std::mt19937 random(4);
    std::vector<bool> block(16 * 16 * 16);
    std::generate(block.begin(), block.end(), [&] { return (random() >> 9 & 1U) != 0; });
    const std::uint32_t depth = 7;
    Codes codes;
    for (std::uint64_t code = 0; code < std::uint64_t{1} << (3 * depth); ++code)
    {
        if (block[code % block.size()])
        {
            codes.push_back(code);
        }
    }
    const DeviceTree dag = compressedAsExpected(codes, depth);
    EXPECT_EQ(dag.node_count, 1U + 1 + 1 + 64); // the root, a node of blocks, the block, its leaves
}

TEST(Svdag, OfShapesIsTheOracles)
{
    compressedAsExpected(test::spongeCodes(6), 6);
    compressedAsExpected(test::sphereShell(7, 60.0), 7);
    compressedAsExpected(test::sphereShell(6, 20.0), 6);
}

TEST(Svdag, TablesOfOneSlotGrowAndGiveTheSameBytes)
{
    for (const std::uint64_t slots : {1U, 2U, 100U})
    {
        SCOPED_TRACE(slots);
        DeviceTree octree = test::octreeOf(device(), test::sphereShell(7, 50.0), 7);
        test::addAttributes(device(), octree);
        EXPECT_GT(compressedAsExpected(std::move(octree), {.table_slots = slots}).retry_count, 0U);
    }
    EXPECT_EQ(compressedAsExpected(test::octreeOf(device(), test::sphereShell(7, 50.0), 7)).retry_count, 0U);
}

TEST(Svdag, NodesWhoseHashesCollideAreToldApart)
{
    // Blocks of 16^3 voxels with full leaves. In all but the first block, one leaf lacks a voxel, at a different
    // position in each; some blocks differ from the first one only in their last leaf.
    const std::uint32_t depth = 6;
    Codes codes;
    for (std::uint64_t code = 0; code < std::uint64_t{1} << (3 * depth); ++code)
    {
        const std::uint64_t block = code >> 12;
        const std::uint64_t leaf = code >> 6 & 63;
        if (block == 0 || leaf != block || (code & 63) != 17)
        {
            codes.push_back(code);
        }
    }
    for (const std::uint32_t hash_mask : {0U, 1U, UINT32_MAX})
    {
        const CompressResult result =
            compressedAsExpected(test::octreeOf(device(), codes, depth), {.hash_mask = hash_mask});
        EXPECT_EQ(result.dag.node_count, 1U + 64 + 2);
        compressedAsExpected(test::octreeOf(device(), test::spongeCodes(6), 6), {.hash_mask = hash_mask});
        compressedAsExpected(test::octreeOf(device(), test::sphereShell(6, 25.0), 6), {.hash_mask = hash_mask});
    }
}

TEST(Svdag, NodesOfWhichMoreCollideThanAreProbedAreGivenUp)
{
    // For any size of the table, a hash without bits leaves a single slot.
    const Codes codes = test::sphereShell(8, 120.0);
    test::messageOf([&] { compress(device(), test::octreeOf(device(), codes, 8), {.hash_mask = 0}); },
                    ErrorCode::Other);
}

/// The DAG of octree's nodes without sharing, in which every node has a list of its own children.
DeviceTree listedOctree(const DeviceTree& octree)
{
    std::vector<gpu::Node> pool = test::octreeNodes(device(), octree);
    std::vector<gpu::uint> words;
    for (std::size_t i = 0; i < pool.size(); ++i)
    {
        gpu::Node& node = pool[i];
        if (i >= octree.levels.back().first_node)
        {
            node.base_lo = 0;
            node.base_hi = static_cast<gpu::uint>(std::popcount(node.mask_lo));
            continue;
        }
        const auto count = static_cast<std::uint32_t>(std::popcount(node.mask_lo) + std::popcount(node.mask_hi));
        const auto word = static_cast<std::uint32_t>(4 * pool.size() + words.size());
        for (std::uint32_t child = 0; child < count; ++child)
        {
            words.push_back(node.base_lo + child);
        }
        if (i % 3 != 0) // the others stay direct, so that one DAG has both
        {
            node.base_lo = gpu::kChildList | word;
            node.base_hi = node.base_lo + static_cast<gpu::uint>(std::popcount(node.mask_lo));
        }
    }
    DeviceTree dag;
    dag.structure = TreeStructure::Svdag;
    dag.lists.octree_node_count = octree.node_count;
    dag.lists.entry_count = words.size();
    dag.grid = octree.grid;
    dag.node_count = octree.node_count;
    dag.voxel_count = octree.voxel_count;
    dag.levels = octree.levels;
    for (std::size_t i = 0; i < words.size(); i += 4)
    {
        gpu::Node four{};
        std::memcpy(&four, &words[i], std::min<std::size_t>(words.size() - i, 4) * sizeof(gpu::uint));
        pool.push_back(four);
    }
    dag.nodes = device().makeBuffer("pool", std::span<const gpu::Node>(pool));
    return dag;
}

TEST(Svdag, OfADagWithEqualNodesSharesThem)
{
    std::mt19937 random(5);
    struct Case
    {
        Codes codes;
        std::uint32_t depth;
    };
    const Case cases[] = {{test::spongeCodes(6), 6},
                          {test::sphereShell(7, 60.0), 7},
                          {test::randomCodes(17, 500, random), 17},
                          {test::randomCodes(2, 20, random), 2},
                          {test::randomCodes(3, 100, random), 3}};
    for (const Case& c : cases)
    {
        SCOPED_TRACE(c.depth);
        DeviceTree octree = test::octreeOf(device(), c.codes, c.depth);
        test::addAttributes(device(), octree);
        const DeviceTree expected = test::svdagOf(device(), octree);
        DeviceTree listed = listedOctree(octree);
        DeviceTree again = compress(device(), std::move(octree)).dag;
        listed.voxel_attributes =
            device().makeBuffer<gpu::Attribute>("a", device().download(expected.voxel_attributes));
        listed.node_attributes = device().makeBuffer<gpu::Attribute>("a", device().download(expected.node_attributes));
        listed.emission_words = device().makeBuffer<gpu::uvec2>("w", device().download(expected.emission_words));
        listed.emission = device().makeBuffer<gpu::uint>("e", device().download(expected.emission));
        EXPECT_EQ(test::difference(device(), compress(device(), std::move(listed)).dag, expected), "");
        EXPECT_EQ(test::difference(device(), compress(device(), std::move(again)).dag, expected), "");
    }
}

TEST(Svdag, DoesNotDependOnTheOrderOfTriangles)
{
    const Scene scene = test::randomTriangles(11, 300, 64.0F);
    Scene shuffled = scene;
    for (Primitive& primitive : shuffled.primitives)
    {
        std::shuffle(primitive.triangles.begin(), primitive.triangles.end(), std::mt19937(1));
    }
    const Grid grid{.origin = glm::vec3(0.0F), .voxel_size = 0.5F, .depth = 7};
    std::vector<DeviceTree> dags;
    for (const Scene* each : std::array<const Scene*, 2>{&scene, &shuffled})
    {
        const GpuScene gpu_scene = uploadScene(device(), *each, true);
        dags.push_back(compressedAsExpected(buildOctree(device(), gpu_scene, grid, {}).octree).dag);
    }
    EXPECT_EQ(test::difference(device(), dags[0], dags[1]), "");
}

TEST(Svdag, DoesNotDependOnHowWorkIsSplit)
{
    vk::HeadlessOptions options = test::deviceOptions();
    options.slices.most_units = 3;
    vk::HeadlessDevice sliced(options, zvoKernels());
    DeviceTree octree = test::octreeOf(sliced, test::sphereShell(7, 50.0), 7);
    test::addAttributes(sliced, octree);
    const DeviceTree expected = test::svdagOf(sliced, octree);
    const DeviceTree dag = compress(sliced, std::move(octree)).dag;
    EXPECT_GT(sliced.submissionCount(), 1U);
    EXPECT_EQ(test::difference(sliced, dag, expected), "");
}

TEST(Svdag, OfAnOctreeWithoutLevelsIsRefused)
{
    DeviceTree octree = test::octreeOf(device(), Codes{1, 2, 3}, 4);
    octree.levels.clear();
    EXPECT_THROW(compress(device(), std::move(octree)), Error);
}

/// Compresses the octree of codes with attributes under a memory limit. Returns whether that succeeded. Otherwise the
/// error has exit code 6 and names a size beyond the limit; failures counts the steps of compression in which it
/// occurred.
bool compressesUnder(std::uint64_t limit, const Codes& codes, std::uint32_t depth, const DeviceTree& expected,
                     std::map<std::string, int>& failures)
{
    vk::HeadlessOptions options = test::deviceOptions();
    options.memory_budget_bytes = limit;
    vk::HeadlessDevice limited(options, zvoKernels());
    try
    {
        DeviceTree octree = test::octreeOf(limited, codes, depth);
        test::addAttributes(limited, octree);
        const DeviceTree dag = compress(limited, std::move(octree)).dag;
        EXPECT_LE(limited.device().memory().peakHeldBytes(), limit);
        EXPECT_EQ(dag.geometryBytes(), expected.geometryBytes());
        EXPECT_EQ(test::dagContentsOf(limited, dag).violations, std::vector<std::string>{});
        return true;
    }
    catch (const Error& error)
    {
        EXPECT_EQ(error.code(), ErrorCode::Memory) << error.what();
        std::smatch words;
        const std::string message = error.what();
        EXPECT_TRUE(std::regex_search(message, words, std::regex("^(.*) needs ([0-9]+) bytes in all"))) << message;
        EXPECT_TRUE(words.empty() || std::stoull(words[2]) > limit) << message;
        failures[words.empty() ? message : words[1].str()] += 1;
        return false;
    }
}

TEST(Svdag, MemoryLimitIsKeptAndEitherSufficesOrNamesASize)
{
    const std::uint32_t depth = 7;
    std::mt19937 random(6);
    const Codes codes = test::randomCodes(depth, 200000, random);
    DeviceTree octree = test::octreeOf(device(), codes, depth);
    test::addAttributes(device(), octree);
    const DeviceTree expected = test::svdagOf(device(), octree);
    std::map<std::string, int> failures;
    constexpr std::uint64_t kBlock = 1 << 20; // of memory under a limit; a larger limit may fill them in another order
    std::optional<std::uint64_t> least;
    for (std::uint64_t limit = kBlock; limit < 16 * kBlock; limit += limit / 8)
    {
        const bool compressed = compressesUnder(limit, codes, depth, expected, failures);
        EXPECT_TRUE(compressed || !least || limit < *least + kBlock) << limit << " do not suffice";
        least = compressed ? std::min(limit, least.value_or(limit)) : least;
    }
    EXPECT_TRUE(least);
    EXPECT_TRUE(failures.contains("finding equal nodes"));
    EXPECT_TRUE(failures.contains("writing the DAG"));
}

struct SceneCase
{
    const char* scene;
    std::uint32_t depth;
};

using SvdagOfScenes = testing::TestWithParam<SceneCase>;

std::string sceneCaseName(const testing::TestParamInfo<SceneCase>& info)
{
    return test::nameOf(std::string(info.param.scene)) + "_" + std::to_string(1U << info.param.depth);
}

INSTANTIATE_TEST_SUITE_P(Scenes, SvdagOfScenes,
                         testing::Values(SceneCase{"atrium.glb", 8}, SceneCase{"cornell_box.glb", 7},
                                         SceneCase{"knot.glb", 9}, SceneCase{"bunny.glb", 9},
                                         SceneCase{"dragon.glb", 9}, SceneCase{"sponza.glb", 9}),
                         sceneCaseName);
// Takes long; run by scripts/check-svdag.
INSTANTIATE_TEST_SUITE_P(DISABLED_Scenes, SvdagOfScenes,
                         testing::Values(SceneCase{"bunny.glb", 10}, SceneCase{"dragon.glb", 10},
                                         SceneCase{"sponza.glb", 10}),
                         sceneCaseName);

TEST_P(SvdagOfScenes, IsTheOctree)
{
    const auto [name, depth] = GetParam();
    const auto path = test::findScene(name);
    if (!path)
    {
        GTEST_SKIP() << name << " is not there";
    }
    const Scene scene = loadGltf(*path);
    const GpuScene gpu_scene = uploadScene(device(), scene, true);
    DeviceTree octree = buildOctree(device(), gpu_scene, Grid::around(scene.bounds(), depth), {}).octree;
    const std::vector<std::uint64_t> codes = voxelCodes(device(), octree);
    const CompressResult result = compressedAsExpected(std::move(octree));
    EXPECT_EQ(result.retry_count, 0U);
    expectExpandsTo(result.dag, codes);
}

} // namespace
} // namespace zvo
