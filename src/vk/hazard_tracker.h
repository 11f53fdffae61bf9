// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <span>
#include <string_view>

namespace zvo::vk
{

/// How a pass uses a buffer.
enum class Access
{
    KernelRead,
    KernelWrite,
    KernelReadWrite,
    KernelAccumulate, // reads and writes, in any order with those of other passes that accumulate
    IndirectRead,
    CopyRead,
    CopyWrite,
    HostRead
};

/// One declared use of a buffer by a pass.
struct BufferAccess
{
    std::uint64_t resource = 0; // identity of the buffer: its handle
    Access access = Access::KernelRead;
    std::string_view name; // for the dump
};

/// Stages and accesses of one memory barrier, as bits of VkPipelineStageFlagBits2 and VkAccessFlagBits2.
struct Barrier
{
    std::uint64_t source_stages = 0;
    std::uint64_t source_accesses = 0;
    std::uint64_t destination_stages = 0;
    std::uint64_t destination_accesses = 0;

    [[nodiscard]] bool needed() const { return destination_stages != 0; }
};

/// Decides which barrier must stand before a pass. Needs no device: buffers are only numbers here.
///
/// The cost of a barrier is its wait, not its access bits. So a barrier waits only for stages that have a hazard, but
/// it covers all writes of these stages and makes them visible to all accesses of the stages it leads to; later passes
/// then need fewer barriers.
class HazardTracker
{
public:
    /// The barrier that the next pass needs before it, for all its accesses together; its needed() is false if there is
    /// none. Several accesses of one pass to one buffer count as one use.
    Barrier next(std::span<const BufferAccess> accesses);

    /// The barrier after which the host sees everything that was written so far, once the work is complete.
    Barrier releaseToHost();

private:
    using StageMask = std::uint8_t;
    static constexpr int kStageCount = 4;

    // The uses of a buffer in one stage, and for each the stages that later barriers make wait for it.
    struct Uses
    {
        StageMask stages = 0;
        std::array<StageMask, kStageCount> before{}; // [stage of the use]: which stages wait for it
    };

    struct State
    {
        Uses writes;              // the last write
        Uses reads;               // the reads since then
        bool accumulates = false; // kernels only accumulate in the last write
    };

    static StageMask coveredByReads(const State& state, int stage);
    Barrier record(StageMask from, StageMask to);

    std::map<std::uint64_t, State> m_states;
};

} // namespace zvo::vk
