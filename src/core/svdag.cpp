// SPDX-License-Identifier: MIT
#include "core/svdag.h"

namespace zvo
{

gpu::RankSource rankSource(vk::Pass& pass, const Svdag& dag)
{
    const std::uint64_t first_place = dag.packing().firstPlace();
    gpu::RankSource source{};
    source.pool = pass.read(dag.tree.nodes);
    source.before = {pass.read(dag.before).address - first_place * sizeof(gpu::BeforeChild)};
    source.voxels_before_leaf = pass.read(dag.voxels_before_leaf);
    source.first_short_place = static_cast<gpu::uint>(first_place + dag.long_entry_count);
    return source;
}

} // namespace zvo
