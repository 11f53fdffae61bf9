// SPDX-License-Identifier: MIT
// Dynamic objects above a DAG look the same as above the octree that the DAG was made of.
#include "core/dynamic/dynamic_octree.h"
#include "oracle/dag.h"
#include "oracle/morton.h"
#include "runtime/trees.h"
#include "support/dynamic_updates.h"
#include "support/engine_device.h"
#include "support/octree_contents.h"
#include "support/scenes.h"
#include "support/trace_octrees.h"
#include "support/tree_comparison.h"
#include "trace/node_paths.h"

#include <glm/ext/matrix_transform.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <memory>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace zvo
{

namespace
{

constexpr float kBoxPart = 0.6F;                        // of the grid's edge, for the first box
constexpr float kBoxMax = 40.0F;                        // largest box, in voxels
constexpr glm::vec3 kBoxCorner = {0.13F, 0.21F, 0.09F}; // of the first box, as parts of the grid's edge

using test::device;

/// Moving boxes in an octree and in its DAG.
class Pair
{
public:
    // Voxels get arbitrary attributes, which distinguish them.
    Pair(const test::Codes& codes, std::uint32_t depth, MergeRule merge, bool attributes)
        : m_attributes(attributes), m_edge(static_cast<float>(1U << depth))
    {
        DynamicOptions options;
        options.merge = merge;
        options.attributes = attributes;
        options.history = {16, UINT64_MAX};
        options.emission_scale = 1.0F;
        options.minimal_capacities = depth % 2 == 0;
        m_octree = std::make_unique<DynamicOctree>(device(), fixed(codes, depth), options);
        m_dag = std::make_unique<DynamicOctree>(device(), compress(device(), fixed(codes, depth)).dag, options);
    }

    [[nodiscard]] const DynamicOctree& octree() const { return *m_octree; }
    [[nodiscard]] const DynamicOctree& dag() const { return *m_dag; }

    // Adds a box of this part of the grid, limited to kBoxMax voxels.
    void add(float part, const glm::vec3& color)
    {
        Scene box = test::boxScene(glm::vec3(0.0F), glm::vec3(std::min(part * m_edge, kBoxMax)));
        box.materials[0].base_color = {color, 1.0F};
        const std::shared_ptr<const DynamicMesh> mesh = uploadDynamicMesh(device(), box, m_attributes, 1.0F);
        m_objects.emplace_back(m_octree->add(mesh, poseAt({})), m_dag->add(mesh, poseAt({})));
    }

    // Moves the corner of a box to these parts of the grid.
    void setPose(std::size_t object, const glm::vec3& corner)
    {
        m_octree->setPose(m_objects.at(object).first, poseAt(corner));
        m_dag->setPose(m_objects.at(object).second, poseAt(corner));
    }

    void remove(std::size_t object)
    {
        m_octree->remove(m_objects.at(object).first);
        m_dag->remove(m_objects.at(object).second);
    }

    void update()
    {
        const UpdateReport expected = test::updateAll(device(), *m_octree);
        const UpdateReport report = test::updateAll(device(), *m_dag);
        EXPECT_EQ(report.failed, 0U);
        EXPECT_EQ(report.node_count, expected.node_count);
        EXPECT_EQ(report.voxel_count, expected.voxel_count);
        EXPECT_EQ(report.dynamic_count, expected.dynamic_count);
    }

    void undo()
    {
        EXPECT_TRUE(test::undo(device(), *m_octree));
        EXPECT_TRUE(test::undo(device(), *m_dag));
    }

    void expectSameCells() const
    {
        EXPECT_EQ(test::difference(test::cellsOf(device(), m_dag->tree()), test::cellsOf(device(), m_octree->tree())),
                  "");
    }

    [[nodiscard]] test::TreeComparison comparison() const { return {device(), m_octree->tree(), m_dag->tree()}; }

    // A view near the first position of the first box.
    [[nodiscard]] ViewCamera closeView() const
    {
        const double size = std::min(kBoxPart * m_edge, kBoxMax);
        const glm::dvec3 corner = m_edge * kBoxCorner;
        return ViewCamera::lookAt(corner + size * glm::dvec3(1.9, 1.5, 2.3), corner + 0.5 * size, 0.9);
    }

private:
    [[nodiscard]] DeviceTree fixed(const test::Codes& codes, std::uint32_t depth) const
    {
        DeviceTree octree = test::octreeOf(device(), codes, depth);
        if (m_attributes)
        {
            test::addAttributes(device(), octree);
        }
        return octree;
    }

    [[nodiscard]] Pose poseAt(const glm::vec3& corner) const
    {
        return {{glm::translate(glm::mat4(1.0F), m_edge * corner)}, {}, {}};
    }

    bool m_attributes;
    float m_edge;
    std::unique_ptr<DynamicOctree> m_octree;
    std::unique_ptr<DynamicOctree> m_dag;
    std::vector<std::pair<DynamicObjectId, DynamicObjectId>> m_objects; // ids in octree and DAG
};

// The voxels of waves through and around the first box.
test::Codes waves(std::uint32_t depth)
{
    const auto edge = static_cast<float>(1U << depth);
    test::Codes codes;
    for (std::uint32_t i = 0; i < 64 * 64; ++i)
    {
        const glm::vec3 place(static_cast<float>(i % 64), static_cast<float>(i / 64), 0.0F);
        const float height = 0.4F * kBoxMax + 6.0F * std::sin(0.2F * place.x) + 5.0F * std::cos(0.17F * place.y);
        codes.push_back(
            oracle::mortonEncode(glm::uvec3(edge * kBoxCorner + place + glm::vec3(-12.0F, -12.0F, height))));
    }
    std::ranges::sort(codes);
    return codes;
}

// Sets of voxels that share much or little, from one level of nodes to seven.
std::vector<std::pair<std::uint32_t, test::Codes>> codeSets()
{
    std::mt19937 random(41);
    const auto everywhere = [](const glm::uvec3&) { return true; };
    const auto checkered = [](const glm::uvec3& voxel) { return (voxel.x + voxel.y + voxel.z) % 2 == 0; };
    return {
        {1, {0, 5}},
        {2, test::randomCodes(2, 20, random)},
        {3, test::codesWhere(3, everywhere)},
        {4, {}},
        {5, test::codesWhere(5, everywhere)},
        {6, test::codesWhere(6, checkered)},
        {7, test::sphereShell(7, 50.0)},
        {8, test::spongeCodes(8)},
        {9, waves(9)},
        {11, waves(11)},
        {13, test::randomCodes(13, 3000, random)},
    };
}

// Moves boxes through all cases, and calls see() for each state to be compared.
template <typename See> void moveBoxes(Pair& pair, const See& see)
{
    see(); // as it was made
    pair.update();
    see(); // without dynamic objects
    pair.add(kBoxPart, {0.9F, 0.2F, 0.1F});
    pair.setPose(0, kBoxCorner); // over subtrees that occur several times
    pair.update();
    see();
    pair.add(0.3F, {0.1F, 0.8F, 0.3F});
    pair.setPose(1, {0.33F, 0.41F, 0.29F}); // overlaps the first
    pair.update();
    see();
    pair.setPose(0, {3.0F, 3.0F, 3.0F});
    pair.setPose(1, {3.0F, 3.0F, 3.0F}); // touches nothing
    pair.update();
    see();
    pair.setPose(0, {0.71F, 0.01F, 0.66F}); // across the grid's border
    pair.remove(1);
    pair.update();
    see();
    pair.undo();
    pair.undo();
    see();
    pair.remove(0);
    pair.update();
    see(); // without dynamic objects again
}

TEST(DynamicSvdag, HoldsWhatTheOctreeHolds)
{
    for (const auto& [depth, codes] : codeSets())
    {
        SCOPED_TRACE("depth " + std::to_string(depth));
        Pair pair(codes, depth, depth % 2 == 0 ? MergeRule::DynamicWins : MergeRule::StaticWins, true);
        moveBoxes(pair, [&] { pair.expectSameCells(); });
    }
}

TEST(DynamicSvdag, LooksLikeTheOctreeInEveryViewAndLevelOfDetail)
{
    for (const auto& [depth, codes] : codeSets())
    {
        SCOPED_TRACE("depth " + std::to_string(depth));
        Pair pair(codes, depth, MergeRule::DynamicWins, true);
        std::uint32_t step = 0;
        moveBoxes(pair,
                  [&]
                  {
                      SCOPED_TRACE("step " + std::to_string(step));
                      if (step == 3 || step == 4) // two dynamic objects, and none that covers anything
                      {
                          pair.comparison().pictures(pair.closeView());
                      }
                      ++step;
                  });
    }
}

TEST(DynamicSvdag, RaysHitWhatTheyHitInTheOctree)
{
    for (const auto& [depth, codes] : codeSets())
    {
        SCOPED_TRACE("depth " + std::to_string(depth));
        Pair pair(codes, depth, MergeRule::StaticWins, true);
        const test::Codes aims = codes.empty() ? test::Codes{0, 7, 100} : codes;
        moveBoxes(pair, [&] { pair.comparison().rays(aims); });
    }
}

TEST(DynamicSvdag, WithoutAttributesItLooksLikeTheOctree)
{
    for (const auto& [depth, codes] : codeSets())
    {
        SCOPED_TRACE("depth " + std::to_string(depth));
        const test::Codes targets = codes.empty() ? test::Codes{0, 7, 100} : codes;
        Pair pair(codes, depth, MergeRule::Average, false);
        EXPECT_EQ(pair.dag().tree().overlays.ranks.count(), 0U);
        std::uint32_t step = 0;
        moveBoxes(pair,
                  [&]
                  {
                      pair.expectSameCells();
                      if (++step == 4)
                      {
                          pair.comparison().pictures(pair.closeView());
                          pair.comparison().rays(targets);
                      }
                  });
    }
}

// The nodes of levels 1 to 3 around each of kPathCells^3 cells, found by descent from the root; 0 if there is none.
std::vector<std::array<std::uint32_t, gpu::kPathLevels>> pathsOf(const std::vector<gpu::Node>& nodes,
                                                                 std::uint32_t entries_per_word)
{
    const auto child = [&](const gpu::Node& node, std::uint32_t c) -> std::uint32_t
    {
        const std::uint32_t mask = c < 32 ? node.mask_lo : node.mask_hi;
        if ((mask >> (c % 32) & 1) == 0)
        {
            return 0;
        }
        const std::uint32_t place = (c < 32 ? node.base_lo : node.base_hi) +
                                    static_cast<std::uint32_t>(std::popcount(mask & ((1U << c % 32) - 1)));
        const bool listed = (place & gpu::kChildList) != 0;
        const std::uint32_t flags = listed ? place & gpu::kLeafWords : 0;
        return listed ? flags | oracle::entryAt(nodes, place & ~gpu::kListFlags, entries_per_word) : place;
    };
    std::vector<std::array<std::uint32_t, gpu::kPathLevels>> paths(gpu::kRankTableFirst);
    for (std::uint32_t i = 0; i < gpu::kRankTableFirst; ++i)
    {
        const std::uint64_t code = oracle::mortonEncode(
            {i % gpu::kPathCells, i / gpu::kPathCells % gpu::kPathCells, i / gpu::kPathCells / gpu::kPathCells});
        std::uint32_t node = 0;
        for (std::uint32_t level = 0; level < gpu::kPathLevels && (level == 0 || node != 0); ++level)
        {
            node = child(nodes.at(node), code >> (6 * (gpu::kPathLevels - 1 - level)) & 63);
            paths[i].at(level) = node;
        }
    }
    return paths;
}

TEST(DynamicSvdag, RaysBeginAtTheLowestNodesOfOverlaysAndOfTheDagBelow)
{
    std::mt19937 random(42);
    for (const std::uint32_t depth : {7U, 8U, 9U})
    {
        SCOPED_TRACE(depth);
        Pair pair(test::randomCodes(depth, 20000, random), depth, MergeRule::DynamicWins, true);
        std::array<std::uint32_t, 2> level3_counts{}; // in overlays, and in the DAG
        moveBoxes(pair,
                  [&]
                  {
                      const std::vector<gpu::Node> nodes = device().download(pair.dag().tree().nodes);
                      NodePaths table(device().device());
                      device().run([&](vk::FrameGraph& graph) { buildNodePaths(graph, pair.dag().tree(), table); });
                      const std::vector<std::uint64_t> words = device().download(table.cells);
                      const bool listed = (nodes[0].base_lo & gpu::kChildList) != 0;
                      const std::uint32_t before = listed ? 0 : nodes[0].base_lo - 1;
                      const auto paths = pathsOf(nodes, pair.dag().tree().entriesPerWord());
                      for (std::size_t i = 0; i < paths.size(); ++i)
                      {
                          const std::uint32_t node1 = words[i] & 255;
                          const std::uint32_t node2 = words[i] >> 8 & 65535;
                          ASSERT_EQ(paths[i][0], node1 != 0 ? before + node1 : 0) << i;
                          ASSERT_EQ(paths[i][1], (words[i] >> 24 & 1) != 0 ? before + node2 : node2) << i;
                          ASSERT_EQ(paths[i][2], words[i] >> 32) << i;
                          const bool of_dag =
                              (paths[i][2] & gpu::kLeafWords) != 0 || paths[i][2] <= pair.dag().staticRoot();
                          level3_counts.at(of_dag ? 1 : 0) += paths[i][2] != 0 ? 1 : 0;
                      }
                  });
        EXPECT_GT(level3_counts[0], 100U);
        EXPECT_GT(level3_counts[1], 100U);
    }
}

} // namespace
} // namespace zvo
