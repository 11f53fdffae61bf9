// SPDX-License-Identifier: MIT
#include "baseline/slides_tree.h"

#include <stdexcept>

namespace zvo::baseline
{

namespace
{

constexpr std::uint32_t kChildren = 8;

class VoxelWalk
{
public:
    VoxelWalk(std::span<const gpu::uint> nodes, SlidesNodes node_words, std::uint32_t depth)
        : m_nodes(nodes), m_has_sums(node_words == SlidesNodes::WithSums),
          m_node_words(static_cast<std::uint32_t>(node_words)), m_depth(depth)
    {
    }

    std::vector<SlidesVoxel> list()
    {
        if (!m_nodes.empty())
        {
            visit(m_nodes.size() / m_node_words - 1, 0, 0, 0);
        }
        return std::move(m_voxels);
    }

private:
    void visit(std::uint64_t node, std::uint32_t level, std::uint64_t code, std::uint32_t index)
    {
        if ((node + 1) * m_node_words > m_nodes.size())
        {
            throw std::out_of_range("a child that is not there");
        }
        const auto words = m_nodes.subspan(node * m_node_words, m_node_words);
        for (std::uint32_t child = 0; child < kChildren; ++child)
        {
            if ((words[0] >> child & 1) == 0)
            {
                continue;
            }
            const std::uint64_t child_code = code << 3 | child;
            const std::uint32_t child_index = m_has_sums ? index + words[1 + kChildren + child] : 0;
            if (level + 1 == m_depth)
            {
                m_voxels.push_back({child_code, child_index});
            }
            else
            {
                visit(words[1 + child], level + 1, child_code, child_index);
            }
        }
    }

    std::span<const gpu::uint> m_nodes;
    bool m_has_sums;
    std::uint32_t m_node_words;
    std::uint32_t m_depth;
    std::vector<SlidesVoxel> m_voxels;
};

} // namespace

std::vector<SlidesVoxel> slidesVoxels(std::span<const gpu::uint> nodes, SlidesNodes node_words, std::uint32_t depth)
{
    return VoxelWalk(nodes, node_words, depth).list();
}

std::vector<SlidesVoxel> slidesVoxels(vk::HeadlessDevice& device, const SlidesTree& tree)
{
    return slidesVoxels(device.download(tree.nodes), tree.node_words, tree.grid.depth);
}

} // namespace zvo::baseline
