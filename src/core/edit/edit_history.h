// SPDX-License-Identifier: MIT
#pragma once

#include "zvo/dynamic_tree.h"

#include <cstddef>
#include <cstdint>
#include <deque>
#include <vector>

namespace zvo
{

/// How much edits keep.
struct EditBounds
{
    std::size_t entries_max = DynamicTreeInfo().strokes;    // at least 1
    std::uint64_t bytes_max = DynamicTreeInfo().edit_bytes; // more only where a single entry needs it
};

/// Dabs that may be recorded in a frame: so many slots are kept free for them.
inline constexpr std::uint32_t kDabsPerFrameMax = 32;

/// How far up the copies reach that a slot of edits is made of (gpu::EditState), counted from the region's start.
struct EditTop
{
    std::uint64_t nodes = 0;       // at most, until is_exact
    std::uint64_t voxels = 0;      // likewise
    std::uint32_t voxel_count = 0; // of the whole tree; of the slot that the dab began at, until is_exact
    bool is_exact = true;
};

/// The strokes of a brush that can be undone and redone: a line of entries with a cursor, each a slot of edits
/// (shaders/edit/edit.h). Host logic only, a value: a copy is what it was. A stroke is one entry, however many dabs it
/// has. undo(), redo() and what tells of a slot take constant time, everything else at most as long as the line.
///
/// What a slot is made of stands below its top, and reaches down into what earlier entries have. So tops grow along
/// the line, and a dab may write above the top of the slot that it begins at: what is there belongs to entries that
/// the push drops. Where these may come back, as the frame is not sure to reach the device, it goes above their tops. A
/// slot that is freed is used again kDabsPerFrameMax pushes later at the earliest.
class EditHistory
{
public:
    explicit EditHistory(std::size_t entries_max);

    /// Slots for entries, dabs in a frame and what nothing was done to.
    [[nodiscard]] std::uint32_t slotCount() const { return static_cast<std::uint32_t>(m_tops.size()); }

    /// The slot that is shown.
    [[nodiscard]] std::uint32_t slot() const { return m_line[m_current]; }
    [[nodiscard]] const EditTop& top(std::uint32_t slot) const { return m_tops[slot]; }

    /// Where a dab begins that takes no room of what is shown, nor of another slot, whether an entry has that or not.
    [[nodiscard]] EditTop topAbove(std::uint32_t kept) const;

    /// A dab that begins at topAbove(kept) and takes at most so many nodes and voxels: returns its slot. It begins a
    /// entry, or goes on with the stroke that is under way, whose slot it replaces. Entries to redo are dropped, and
    /// the oldest one if there are too many.
    std::uint32_t push(std::uint64_t node_bound, std::uint64_t voxel_bound, std::uint32_t kept);
    std::uint32_t push(std::uint64_t node_bound, std::uint64_t voxel_bound)
    {
        return push(node_bound, voxel_bound, slot());
    }

    /// The next dab begins an entry.
    void endStroke() { m_is_stroke = false; }

    /// Goes to the entry before, or behind; ends the stroke. False at the ends.
    bool undo();
    bool redo();
    [[nodiscard]] std::size_t undoCount() const { return m_current; }
    [[nodiscard]] std::size_t redoCount() const { return m_line.size() - 1 - m_current; }

    /// Drops the older half of the entries that can be undone, at least one. False if there is none.
    bool dropOldest();

    /// Drops the entries to redo.
    void dropRedo();

    /// For each slot whether an entry has it.
    [[nodiscard]] std::vector<bool> used() const;

    /// Tops of a slot as the device found them.
    void learn(std::uint32_t slot, const EditTop& top) { m_tops[slot] = top; }

    /// Whether all entries' tops are exact.
    [[nodiscard]] bool isExact() const;

    /// What is below the entries' tops has moved together: they are no longer exact.
    void forgetTops();

private:
    void freeSlots(std::size_t first, std::size_t end);

    std::size_t m_entries_max;
    std::deque<std::uint32_t> m_line{0}; // slots
    std::size_t m_current = 0;
    bool m_is_stroke = false;
    std::deque<std::uint32_t> m_free; // in the order in which they were freed
    std::vector<EditTop> m_tops;      // of slots
};

} // namespace zvo
