// SPDX-License-Identifier: MIT
#include "core/tree/device_tree.h"

namespace zvo
{

gpu::RankSource rankSource(const DeviceTree& dag)
{
    const std::uint64_t first_index = dag.packing().firstEntry();
    gpu::RankSource source{};
    source.pool = {dag.nodes.address()};
    source.before = {dag.lists.before.address() - first_index * sizeof(gpu::BeforeChild)};
    source.voxels_before_leaf = {dag.lists.voxels_before_leaf.address()};
    source.first_short_entry = static_cast<gpu::uint>(first_index + dag.lists.long_entry_count);
    return source;
}

gpu::RankSource rankSource(vk::AnyPass& pass, const DeviceTree& dag)
{
    pass.read(dag.nodes);
    pass.read(dag.lists.before);
    pass.read(dag.lists.voxels_before_leaf);
    return rankSource(dag);
}

} // namespace zvo
