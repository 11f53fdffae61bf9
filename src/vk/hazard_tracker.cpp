// SPDX-License-Identifier: MIT
#include "vk/hazard_tracker.h"

#include "vk/functions.h"

namespace zvo::vk
{

namespace
{

struct Stage
{
    VkPipelineStageFlags2 stage;
    VkAccessFlags2 writes;
    VkAccessFlags2 reads;
};

enum StageIndex
{
    kCompute,
    kIndirect,
    kTransfer,
    kHost
};

// [StageIndex]. Fills and copies are one stage here, because fills have no stage bit. Kernels read addresses and, in
// bound forms, texel buffers.
constexpr Stage kStages[] = {
    {VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT,
     VK_ACCESS_2_SHADER_STORAGE_READ_BIT | VK_ACCESS_2_SHADER_SAMPLED_READ_BIT},
    {VK_PIPELINE_STAGE_2_DRAW_INDIRECT_BIT, 0, VK_ACCESS_2_INDIRECT_COMMAND_READ_BIT},
    {VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT, VK_ACCESS_2_TRANSFER_READ_BIT},
    {VK_PIPELINE_STAGE_2_HOST_BIT, 0, VK_ACCESS_2_HOST_READ_BIT},
};

using Mask = std::uint8_t;

constexpr Mask bit(int stage)
{
    return static_cast<Mask>(1 << stage);
}

struct PassUse
{
    Mask reads = 0;
    Mask writes = 0;
    bool accumulates = false; // in kernels
    bool is_ordered = false;  // kernels read or write in another way, too

    [[nodiscard]] bool onlyAccumulates() const { return accumulates && !is_ordered; }
};

void add(PassUse& use, Access access)
{
    use.accumulates |= access == Access::KernelAccumulate;
    use.is_ordered |=
        access == Access::KernelRead || access == Access::KernelWrite || access == Access::KernelReadWrite;
    switch (access)
    {
    case Access::KernelRead:
        use.reads |= bit(kCompute);
        break;
    case Access::KernelWrite:
        use.writes |= bit(kCompute);
        break;
    case Access::KernelReadWrite:
    case Access::KernelAccumulate:
        use.reads |= bit(kCompute);
        use.writes |= bit(kCompute);
        break;
    case Access::IndirectRead:
        use.reads |= bit(kIndirect);
        break;
    case Access::CopyRead:
        use.reads |= bit(kTransfer);
        break;
    case Access::CopyWrite:
        use.writes |= bit(kTransfer);
        break;
    case Access::HostRead:
        use.reads |= bit(kHost);
        break;
    }
}

} // namespace

Barrier HazardTracker::next(std::span<const BufferAccess> accesses)
{
    std::map<std::uint64_t, PassUse> pass;
    for (const BufferAccess& access : accesses)
    {
        add(pass[access.resource], access.access);
    }

    StageMask from = 0;
    StageMask to = 0;
    const auto require = [&](int stage, Mask users)
    {
        from |= users != 0 ? bit(stage) : Mask{0};
        to |= users;
    };
    for (const auto& [resource, use] : pass)
    {
        const auto found = m_states.find(resource);
        if (found == m_states.end())
        {
            continue;
        }
        const auto& [writes, reads, accumulated] = found->second;
        for (const int stage : {kCompute, kIndirect, kTransfer, kHost})
        {
            if ((reads.stages & bit(stage)) != 0) // write after read
            {
                require(stage, use.writes & ~reads.before[stage]);
            }
            if ((writes.stages & bit(stage)) != 0) // read after write, write after write
            {
                const Mask overwrites = use.writes & ~coveredByReads(found->second, stage);
                const bool any_order = stage == kCompute && accumulated && use.onlyAccumulates();
                const Mask users = (use.reads | overwrites) & ~(any_order ? bit(kCompute) : Mask{0});
                require(stage, users & ~writes.before[stage]);
            }
        }
    }
    const Barrier barrier = record(from, to);

    for (const auto& [resource, use] : pass)
    {
        State& state = m_states[resource];
        // The host reads after the device is done, so no pass of this graph waits for that.
        Mask reads = use.reads & ~bit(kHost);
        if (use.writes != 0)
        {
            state = {};
            state.writes.stages = use.writes;
            state.accumulates = use.onlyAccumulates();
            reads &= ~use.writes; // who waits for the write also waits for the same stage's read
        }
        state.reads.stages |= reads;
        for (int stage = 0; stage < kStageCount; ++stage)
        {
            state.reads.before[stage] &= (reads & bit(stage)) != 0 ? Mask{0} : Mask{UINT8_MAX};
        }
    }
    return barrier;
}

// Stages whose write will wait for a read that already waited for the write in `stage`. They need not wait for that
// write.
HazardTracker::StageMask HazardTracker::coveredByReads(const State& state, int stage)
{
    StageMask covered = 0;
    for (int read = 0; read < kStageCount; ++read)
    {
        if ((state.reads.stages & state.writes.before[stage] & bit(read)) != 0)
        {
            covered |= static_cast<StageMask>(~state.reads.before[read]);
        }
    }
    return covered;
}

Barrier HazardTracker::releaseToHost()
{
    StageMask from = 0;
    for (const auto& [resource, state] : m_states)
    {
        for (int stage = 0; stage < kStageCount; ++stage)
        {
            if ((state.writes.stages & bit(stage)) != 0 && (state.writes.before[stage] & bit(kHost)) == 0)
            {
                from |= bit(stage);
            }
        }
    }
    return record(from, from != 0 ? bit(kHost) : Mask{0});
}

Barrier HazardTracker::record(StageMask from, StageMask to)
{
    if (to == 0)
    {
        return {};
    }
    for (auto& [resource, state] : m_states)
    {
        for (Uses* uses : {&state.writes, &state.reads})
        {
            for (int stage = 0; stage < kStageCount; ++stage)
            {
                // Barriers chain: a stage that waits for the use makes those that wait for it wait, too.
                if (((bit(stage) | uses->before[stage]) & from) != 0)
                {
                    uses->before[stage] |= to;
                }
            }
        }
    }

    Barrier barrier;
    for (int stage = 0; stage < kStageCount; ++stage)
    {
        if ((from & bit(stage)) != 0)
        {
            barrier.source_stages |= kStages[stage].stage;
            barrier.source_accesses |= kStages[stage].writes;
        }
        if ((to & bit(stage)) != 0)
        {
            barrier.destination_stages |= kStages[stage].stage;
            barrier.destination_accesses |= kStages[stage].reads | kStages[stage].writes;
        }
    }
    return barrier;
}

} // namespace zvo::vk
