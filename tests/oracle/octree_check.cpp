// SPDX-License-Identifier: MIT
#include "oracle/octree_check.h"

#include <algorithm>
#include <bit>

namespace zvo::oracle
{
namespace
{

std::uint32_t nodeLevels(std::uint32_t depth)
{
    return (depth + 1) / 2;
}

std::uint64_t cellsOf(const gpu::Node& node)
{
    return node.mask_lo | std::uint64_t{node.mask_hi} << 32;
}

class Checker
{
public:
    explicit Checker(OctreeContents& contents) : m_contents(contents) {}

    void expect(bool condition, const std::string& violation)
    {
        if (!condition && m_contents.violations.size() < kViolationsMax)
            m_contents.violations.push_back(violation);
    }

    void expectEqual(std::uint64_t actual, std::uint64_t expected, const std::string& what)
    {
        if (actual != expected)
            expect(false, what + " is " + std::to_string(actual) + ", not " + std::to_string(expected));
    }

private:
    OctreeContents& m_contents;
};

/// Whether the levels cover the nodes without gaps. If not, expanding is pointless.
bool checkLevels(std::size_t node_count, std::span<const NodeRange> levels, std::uint32_t depth, Checker& checker)
{
    if (node_count == 0 && levels.empty())
        return true;
    checker.expectEqual(levels.size(), nodeLevels(depth), "number of levels");
    std::uint64_t first = 0;
    bool tiled = levels.size() == nodeLevels(depth);
    for (std::size_t level = 0; level < levels.size(); ++level)
    {
        const std::string name = "level " + std::to_string(level);
        checker.expectEqual(levels[level].first_node, first, name + ": first_node");
        tiled = tiled && levels[level].first_node == first;
        first += levels[level].node_count;
    }
    checker.expectEqual(first, node_count, "number of nodes in all levels");
    if (!levels.empty())
        checker.expectEqual(levels[0].node_count, 1, "number of roots");
    return tiled && first == node_count;
}

} // namespace

OctreeContents checkOctree(std::span<const gpu::Node> nodes, std::span<const NodeRange> levels, std::uint32_t depth)
{
    OctreeContents contents;
    Checker checker(contents);
    if (!checkLevels(nodes.size(), levels, depth, checker))
        return contents;

    // Codes of one level's nodes in order. Their masks give the codes of the next level.
    std::vector<std::uint64_t> codes;
    if (!levels.empty())
        codes.push_back(0);
    for (std::size_t level = 0; level < levels.size(); ++level)
    {
        const bool leaf = level + 1 == levels.size();
        const std::string level_name = "level " + std::to_string(level);
        checker.expectEqual(levels[level].node_count, codes.size(), level_name + ": number of nodes");
        if (levels[level].node_count != codes.size())
            return contents;

        std::uint64_t next = leaf ? 0 : levels[level + 1].first_node; // expected value of the next base
        std::vector<std::uint64_t> children;
        for (std::uint32_t i = 0; i < levels[level].node_count; ++i)
        {
            const std::uint32_t index = levels[level].first_node + i;
            const gpu::Node& node = nodes[index];
            const std::string name = "node " + std::to_string(index) + " (" + level_name + ")";
            checker.expect(cellsOf(node) != 0, name + " is empty");
            checker.expectEqual(node.base_lo, next, name + ": base_lo");
            next += static_cast<std::uint64_t>(std::popcount(node.mask_lo));
            checker.expectEqual(node.base_hi, next, name + ": base_hi");
            next += static_cast<std::uint64_t>(std::popcount(node.mask_hi));
            for (std::uint64_t cell = 0; cell < 64; ++cell)
                if ((cellsOf(node) >> cell & 1) != 0)
                    children.push_back(codes[i] << 6 | cell);
        }
        codes = std::move(children);
    }

    // Correct bases already imply Morton order, which is checked all the same.
    const auto unsorted = std::adjacent_find(codes.begin(), codes.end(), std::greater_equal<>());
    checker.expect(unsorted == codes.end(), "voxels are not in Morton order");
    if (!codes.empty())
        checker.expect(codes.back() >> (3 * depth) == 0, "a voxel lies outside of the grid");
    contents.codes = std::move(codes);
    return contents;
}

ReferenceOctree referenceOctree(std::span<const std::uint64_t> codes, std::uint32_t depth)
{
    ReferenceOctree octree;
    if (codes.empty())
        return octree;
    for (std::uint32_t level = 0; level < nodeLevels(depth); ++level)
    {
        const bool leaf = level + 1 == nodeLevels(depth);
        const std::uint32_t shift = 6 * (nodeLevels(depth) - 1 - level); // from a voxel's code to its cell's
        std::vector<gpu::Node> nodes;
        std::uint64_t previous_cell = 0;
        std::uint64_t previous_node = 0;
        std::uint32_t cell_count = 0;
        for (const std::uint64_t code : codes)
        {
            const std::uint64_t cell = code >> shift;
            if (cell_count != 0 && cell == previous_cell)
                continue;
            if (nodes.empty() || cell >> 6 != previous_node)
                nodes.push_back({0, cell_count, 0, cell_count});
            gpu::Node& node = nodes.back();
            if ((cell & 32) == 0)
            {
                node.mask_lo |= 1U << (cell & 31);
                ++node.base_hi;
            }
            else
                node.mask_hi |= 1U << (cell & 31);
            previous_cell = cell;
            previous_node = cell >> 6;
            ++cell_count;
        }
        const auto first = static_cast<std::uint32_t>(octree.nodes.size());
        octree.levels.push_back({first, static_cast<std::uint32_t>(nodes.size())});
        for (gpu::Node& node : nodes)
        {
            const std::uint32_t children = leaf ? 0 : first + static_cast<std::uint32_t>(nodes.size());
            node.base_lo += children;
            node.base_hi += children;
        }
        octree.nodes.insert(octree.nodes.end(), nodes.begin(), nodes.end());
    }
    return octree;
}

} // namespace zvo::oracle
