// SPDX-License-Identifier: MIT
#include "core/tree/svdag.h"

namespace zvo
{

gpu::RankSource rankSource(const Svdag& dag)
{
    const std::uint64_t first_place = dag.packing().firstPlace();
    gpu::RankSource source{};
    source.pool = {dag.tree.nodes.address()};
    source.before = {dag.before.address() - first_place * sizeof(gpu::BeforeChild)};
    source.voxels_before_leaf = {dag.voxels_before_leaf.address()};
    source.first_short_place = static_cast<gpu::uint>(first_place + dag.long_entry_count);
    return source;
}

gpu::RankSource rankSource(vk::AnyPass& pass, const Svdag& dag)
{
    pass.read(dag.tree.nodes);
    pass.read(dag.before);
    pass.read(dag.voxels_before_leaf);
    return rankSource(dag);
}

} // namespace zvo
