// SPDX-License-Identifier: MIT
#include "core/tree/device_tree.h"

namespace zvo
{

gpu::RankSource rankSource(const DeviceTree& tree)
{
    gpu::RankSource source{};
    source.pool = {tree.nodes.address()};
    source.before = {tree.leaf_groups.address()};
    if (tree.isDag())
    {
        const std::uint64_t first_index = tree.packing().firstEntry();
        source.before = {tree.lists.before.address() - first_index * sizeof(gpu::BeforeChild)};
        source.voxels_before_leaf = {tree.lists.voxels_before_leaf.address()};
        source.first_short_entry = static_cast<gpu::uint>(first_index + tree.lists.long_entry_count);
    }
    return source;
}

gpu::RankSource rankSource(vk::AnyPass& pass, const DeviceTree& tree)
{
    pass.read(tree.nodes);
    pass.read(tree.leaf_groups);
    pass.read(tree.lists.before);
    pass.read(tree.lists.voxels_before_leaf);
    return rankSource(tree);
}

} // namespace zvo
