// SPDX-License-Identifier: MIT
#pragma once

#include "core/overlay/overlay_arena.h"
#include "core/update/update.h"

#include <cstdint>

namespace zvo
{

/// Decides how much room the next update gets: as much as recent updates have needed, or a guess for dynamic objects
/// that were not measured yet. Host logic only.
class UpdateSizes
{
public:
    /// minimal: every capacity starts at one.
    explicit UpdateSizes(bool minimal) : m_is_minimal(minimal) {}

    /// Begins an update of layers whose leaf capacities have this sum. carves: some of them do.
    void begin(std::uint64_t leaves, bool carves = false);

    /// The expected size of the next overlay.
    [[nodiscard]] std::uint64_t likelyNodes() const { return m_likely_nodes; }
    [[nodiscard]] std::uint64_t likelyVoxels() const { return m_likely_voxels; }

    /// The capacities that buffers should have which have `current` now: the same if they suffice, and smaller ones if
    /// they have been several times too large for hundreds of updates.
    [[nodiscard]] UpdateCapacities fitting(const UpdateCapacities& current) const;

    /// Learns from an update that has ended. table_entries: the capacity of its table of touched nodes.
    void learn(const gpu::UpdateStatus& status, const OverlayRegion& region, std::uint64_t table_entries);

private:
    bool m_is_minimal;
    std::uint64_t m_leaves = 0; // of the last begin()
    bool m_carves = false;
    std::uint64_t m_table_min = 0;
    std::uint64_t m_likely_nodes = 0;
    std::uint64_t m_likely_voxels = 0;
    std::uint64_t m_most_leaves = 0; // the most of recent updates; likewise the next two
    std::uint64_t m_most_nodes = 0;
    std::uint64_t m_most_voxels = 0;
};

} // namespace zvo
