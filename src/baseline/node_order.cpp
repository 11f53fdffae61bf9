// SPDX-License-Identifier: MIT
#include "baseline/node_order.h"

#include "core/base/morton.h"
#include "zvo/error.h"

#include <algorithm>
#include <bit>
#include <random>
#include <utility>
#include <vector>

namespace zvo::baseline
{

namespace
{

// The children of half a node.
struct Siblings
{
    std::uint64_t place = 0; // by which they are sorted
    std::uint32_t parent = 0;
    bool is_upper = false;
};

// The Morton code of each node among the cells of its level. Parents come before their children.
std::vector<std::uint64_t> mortonCodes(const TreeData& tree)
{
    std::vector<std::uint64_t> codes(tree.nodes.size());
    const std::uint32_t parent_count = tree.levels.empty() ? 0 : tree.levels.back().first_node;
    for (std::uint32_t i = 0; i < parent_count; ++i)
    {
        const gpu::Node& node = tree.nodes[i];
        std::uint32_t child[2] = {node.base_lo, node.base_hi};
        for (std::uint64_t cells = cellMask(node); cells != 0; cells &= cells - 1)
        {
            const auto cell = static_cast<unsigned>(std::countr_zero(cells));
            codes[child[cell / 32]++] = codes[i] << kCellBits | cell;
        }
    }
    return codes;
}

} // namespace

std::uint64_t hilbertCode(const glm::uvec3& cell, std::uint32_t depth)
{
    std::uint32_t x[3] = {cell.x, cell.y, cell.z};
    for (std::uint32_t bit = 1U << (depth - 1); bit > 1; bit >>= 1) // undo the turns of the larger cubes
    {
        const std::uint32_t below = bit - 1;
        for (std::uint32_t& axis : x)
        {
            if ((axis & bit) != 0)
            {
                x[0] ^= below;
            }
            else
            {
                const std::uint32_t exchanged = (x[0] ^ axis) & below;
                x[0] ^= exchanged;
                axis ^= exchanged;
            }
        }
    }
    x[1] ^= x[0];
    x[2] ^= x[1];
    std::uint32_t flip = 0;
    for (std::uint32_t bit = 1U << (depth - 1); bit > 1; bit >>= 1)
    {
        flip ^= (x[2] & bit) != 0 ? bit - 1 : 0;
    }
    return codeOfCell({x[2] ^ flip, x[1] ^ flip, x[0] ^ flip});
}

TreeData inOrder(TreeData tree, NodeOrder order)
{
    if (tree.structure != TreeStructure::Svo || (tree.levels.empty() && tree.nodes.size() > 1) ||
        !tree.node_attributes.empty() || isPacked(tree.attributeFormat()))
    {
        throw Error(ErrorCode::Usage,
                    "only an octree in zvo's order without attributes of inner nodes can be reordered");
    }
    if (order == NodeOrder::Morton || tree.levels.empty())
    {
        return tree;
    }
    const std::vector<std::uint64_t> codes = mortonCodes(tree);
    std::mt19937_64 random(1); // NOLINT(cert-msc51-cpp): the same in every run
    const std::vector<gpu::Node> old_nodes = tree.nodes;
    std::vector<std::uint32_t> new_number(old_nodes.size());
    for (std::uint32_t level = 0; level + 1 < tree.levels.size(); ++level)
    {
        const DeviceTree::Level& parents = tree.levels[level];
        std::vector<Siblings> all;
        for (std::uint32_t i = parents.first_node; i < parents.first_node + parents.node_count; ++i)
        {
            for (const bool is_upper : {false, true})
            {
                // A half has 2x2x1 octants. It stands where the lowest of them stands on the curve.
                const glm::uvec3 half = 2U * cellOfCode(codes[i]) + glm::uvec3(0U, 0U, is_upper ? 1U : 0U);
                const std::uint64_t place = order == NodeOrder::Hilbert ? hilbertCode(half, 2 * level + 1) : random();
                all.push_back({place, i, is_upper});
            }
        }
        std::ranges::stable_sort(all, {}, &Siblings::place);
        std::uint32_t next = tree.levels[level + 1].first_node;
        for (const Siblings& siblings : all)
        {
            const gpu::Node& old_parent = old_nodes[siblings.parent];
            const std::uint32_t first = siblings.is_upper ? old_parent.base_hi : old_parent.base_lo;
            const auto count =
                static_cast<std::uint32_t>(std::popcount(siblings.is_upper ? old_parent.mask_hi : old_parent.mask_lo));
            for (std::uint32_t k = 0; k < count; ++k)
            {
                new_number[first + k] = next + k;
                tree.nodes[next + k] = old_nodes[first + k];
            }
            gpu::Node& parent = tree.nodes[new_number[siblings.parent]];
            (siblings.is_upper ? parent.base_hi : parent.base_lo) = next;
            next += count;
        }
    }
    return tree;
}

} // namespace zvo::baseline
