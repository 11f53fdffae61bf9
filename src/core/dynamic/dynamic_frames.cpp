// SPDX-License-Identifier: MIT
// DynamicOctree: the end of frames, and what is learnt from them.
#include "core/dynamic/dynamic_octree.h"

#include <algorithm>
#include <bit>

namespace zvo
{

void DynamicOctree::frameLost()
{
    m_edits.endStroke();
    if (!m_has_recorded)
    {
        return;
    }
    dropJob();
    m_overlays.renewVersion();
    const auto isLost = [&](const auto& pending) { return pending.frame == m_frames.current(); };
    m_result_count -= std::erase_if(m_pending_updates, isLost);
    std::erase_if(m_pending_slices, isLost);
    m_frames.lost();
    m_needs_update = true;
    m_owes_root = true;
    m_has_recorded = false;
}

UpdateReport DynamicOctree::learnUpdate(const PendingUpdate& pending)
{
    const gpu::UpdateStatus status = m_results.mappedData()[pending.result];
    m_sizes.learn(status, pending.region, pending.touched);
    if (status.failed == 0)
    {
        m_history.complete(pending.entry, status.node_count, status.voxel_count);
    }
    else
    {
        m_needs_update = m_needs_update || m_history.current().id == pending.entry;
        m_history.fail(pending.entry);
    }
    if ((status.failed & ~gpu::kFailedFragments) == 0) // it came as far as to count them
    {
        setShift(status.max_fragments);
    }
    return {pending.entry,        status.failed,        status.node_count,           status.voxel_count,
            status.touched_count, status.dynamic_count, m_objects.droppedTriangles()};
}

// Drops as many value bits of the layers' sums as it takes for so many fragments, and no more: where that changes, all
// layers are made again. One update is merged with too few bits after the fragments have become fewer.
void DynamicOctree::setShift(std::uint32_t fragments)
{
    const std::uint32_t shift =
        std::max(m_overlays.tree().sums.sum_shift,
                 static_cast<std::uint32_t>(std::bit_width(fragments / (gpu::kFragmentsMax + 1))));
    if (shift == m_sum_shift)
    {
        return;
    }
    m_sum_shift = shift;
    giveUpJob();
    m_objects.forgetLayers();
}

std::vector<UpdateReport> DynamicOctree::frameDone(std::uint64_t frame, std::span<const vk::PassTime> passes)
{
    while (!m_pending_slices.empty() && m_pending_slices.front().frame <= frame)
    {
        if (m_pending_slices.front().frame == frame)
        {
            m_budget.learn(m_pending_slices.front().slices, passes);
        }
        m_pending_slices.pop_front();
    }
    m_frames.done(frame);
    m_has_recorded = m_has_recorded && frame != m_frames.current();
    if (m_objects.takeFailure())
    {
        giveUpJob();
    }
    std::vector<UpdateReport> reports;
    while (!m_pending_updates.empty() && m_pending_updates.front().frame <= frame)
    {
        const PendingUpdate pending = m_pending_updates.front();
        m_pending_updates.pop_front();
        reports.push_back(learnUpdate(pending));
    }
    return reports;
}

} // namespace zvo
