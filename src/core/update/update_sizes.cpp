// SPDX-License-Identifier: MIT
#include "core/update/update_sizes.h"

#include "core/base/divide_up.h"
#include "core/base/with_slack.h"

#include <algorithm>
#include <bit>

namespace zvo
{

namespace
{

constexpr std::uint64_t kTooLarge = 4; // times what is needed

// The most that was needed, of late: what leaves the grid and comes back finds room at once.
std::uint64_t recentMost(std::uint64_t most, std::uint64_t needed)
{
    return std::max(needed, most - divideUp(most, 1024)); // half in 700 updates
}

} // namespace

void UpdateSizes::begin(std::uint64_t leaves, bool carves)
{
    m_carves = carves;
    const std::uint64_t added = leaves - std::min(leaves, m_leaves);
    m_leaves = leaves;
    m_most_leaves = recentMost(m_most_leaves, leaves);
    if (m_is_minimal)
    {
        m_likely_nodes = std::max<std::uint64_t>(m_likely_nodes, 1);
        m_likely_voxels = std::max<std::uint64_t>(m_likely_voxels, 1);
    }
    else if (added != 0)
    {
        m_likely_nodes += 3 * added + 64; // with copies of what stands beside them
        m_likely_voxels += 32 * added + 64;
    }
}

UpdateCapacities UpdateSizes::fitting(const UpdateCapacities& current) const
{
    const bool is_too_large = current.records > kTooLarge * withSlack(m_most_leaves) ||
                              current.overlay_nodes > kTooLarge * withSlack(m_likely_nodes);
    const UpdateCapacities base = is_too_large ? UpdateCapacities{} : current;
    const std::uint64_t table = std::max(m_is_minimal ? 1 : std::bit_ceil(2 * m_leaves), m_table_min);
    return {.touched = std::max(base.touched, table),
            .records = enough(base.records, m_leaves),
            .overlay_nodes = enough(base.overlay_nodes, m_likely_nodes),
            .carves = base.carves || m_carves};
}

void UpdateSizes::learn(const gpu::UpdateStatus& status, const OverlayRegion& region, std::uint64_t table_entries)
{
    if (status.failed == 0)
    {
        m_most_nodes = recentMost(m_most_nodes, status.node_count);
        m_most_voxels = recentMost(m_most_voxels, status.voxel_count);
        m_likely_nodes = withSlack(m_most_nodes);
        m_likely_voxels = withSlack(m_most_voxels);
        m_table_min = std::min(m_table_min, std::bit_ceil(4 * std::uint64_t{status.touched_count}));
        return;
    }
    // Levels that were not reached are not counted: twice as much, if that is more.
    if ((status.failed & gpu::kFailedNodes) != 0)
    {
        m_likely_nodes = std::max<std::uint64_t>(
            {m_likely_nodes, std::uint64_t{2} * region.node_capacity, withSlack(status.node_count)});
    }
    if ((status.failed & gpu::kFailedVoxels) != 0)
    {
        m_likely_voxels = std::max<std::uint64_t>(m_likely_voxels, withSlack(status.voxel_count));
    }
    if ((status.failed & gpu::kFailedTable) != 0)
    {
        m_table_min = std::max(m_table_min, 2 * table_entries);
    }
}

} // namespace zvo
