// SPDX-License-Identifier: MIT
#pragma once

#include "core/overlay/overlay_arena.h"
#include "core/update/update.h"

#include <cstdint>

namespace zvo
{

/// How much room the next update is given: what updates of late have needed, or a guess for dynamic objects that none
/// has measured. Host logic only.
class UpdateSizes
{
public:
    /// minimal: everything starts with room for one.
    explicit UpdateSizes(bool minimal) : m_is_minimal(minimal) {}

    /// An update begins, of layers that have room for that many leaves together.
    void begin(std::uint64_t leaves);

    /// Of the next overlay, as far as is known.
    [[nodiscard]] std::uint64_t likelyNodes() const { return m_likely_nodes; }
    [[nodiscard]] std::uint64_t likelyVoxels() const { return m_likely_voxels; }

    /// What buffers should have that have these capacities: the same where it suffices. Less where it has been several
    /// times too much for hundreds of updates.
    [[nodiscard]] UpdateCapacities fitting(const UpdateCapacities& current) const;

    /// What an update came to, that had this region and a table of so many entries.
    void learn(const gpu::UpdateStatus& status, const OverlayRegion& region, std::uint64_t table_entries);

private:
    bool m_is_minimal;
    std::uint64_t m_leaves = 0; // of the last begin()
    std::uint64_t m_table_min = 0;
    std::uint64_t m_likely_nodes = 0;
    std::uint64_t m_likely_voxels = 0;
    std::uint64_t m_most_leaves = 0; // of updates of late, as the next two
    std::uint64_t m_most_nodes = 0;
    std::uint64_t m_most_voxels = 0;
};

} // namespace zvo
