// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

namespace zvo
{

/// Dabs that may be recorded in a frame. As many slots are kept free for them.
inline constexpr std::uint32_t kDabsPerFrameMax = 32;

/// The end of the nodes and voxels that a slot of edits is made of (gpu::EditState), counted from the start of the
/// region.
struct EditTop
{
    std::uint64_t nodes = 0;       // an upper bound while is_exact is false
    std::uint64_t voxels = 0;      // likewise
    std::uint32_t voxel_count = 0; // of the whole tree; while is_exact is false, of the slot that the dab began at
    bool is_exact = true;
};

/// The strokes of a brush that can be undone and redone: a line of entries with a cursor. Each entry is a slot of edits
/// (shaders/edit/edit.h). A stroke is one entry, however many dabs it has. Host logic only. The class is a value: a
/// copy restores the earlier state. undo(), redo() and queries of a slot take constant time, everything else at most
/// time proportional to the number of entries.
///
/// The nodes and voxels of a slot stand below its top, and some of them belong to earlier entries as well. So tops grow
/// along the line, and a dab may write above the top of the slot that it begins at: whatever stands there belongs to
/// entries to redo, which push() drops. These entries come back if the frame is lost, so until the frame is submitted
/// dabs write above the top of the slot that was shown before it. A slot that is freed is used again after at least
/// kDabsPerFrameMax more pushes.
class EditHistory
{
public:
    explicit EditHistory(std::size_t entries_max);

    /// Number of slots: one for each entry, one for each dab in a frame, and those of the unedited tree and of a new
    /// entry.
    [[nodiscard]] std::uint32_t slotCount() const { return static_cast<std::uint32_t>(m_tops.size()); }

    /// The slot of the current entry.
    [[nodiscard]] std::uint32_t slot() const { return m_line[m_current]; }
    [[nodiscard]] const EditTop& top(std::uint32_t slot) const { return m_tops[slot]; }

    /// The top at which a dab begins that overwrites nothing of the current slot, nor of the slot `kept`, which need
    /// not belong to an entry.
    [[nodiscard]] EditTop topAbove(std::uint32_t kept) const;

    /// Adds a dab that begins at topAbove(kept) and takes at most node_bound nodes and voxel_bound voxels; returns its
    /// slot. The first dab of a stroke adds an entry, and drops the oldest one if there are too many. A later dab
    /// replaces the slot of the stroke's entry. Entries to redo are dropped.
    std::uint32_t push(std::uint64_t node_bound, std::uint64_t voxel_bound, std::uint32_t kept);
    std::uint32_t push(std::uint64_t node_bound, std::uint64_t voxel_bound)
    {
        return push(node_bound, voxel_bound, slot());
    }

    /// Ends the stroke: the next dab adds an entry.
    void endStroke() { m_is_stroke = false; }

    /// Go to the previous or next entry and end the stroke. Return false if there is none.
    bool undo();
    bool redo();
    [[nodiscard]] std::size_t undoCount() const { return m_current; }
    [[nodiscard]] std::size_t redoCount() const { return m_line.size() - 1 - m_current; }

    /// Numbers of strokes grow in the order in which strokes began. That of the current entry's stroke, or 0; and of
    /// the one that redo() goes to, or the largest number.
    [[nodiscard]] std::uint64_t stroke() const { return m_strokes[slot()]; }
    [[nodiscard]] std::uint64_t nextStroke() const
    {
        return redoCount() != 0 ? m_strokes[m_line[m_current + 1]] : UINT64_MAX;
    }

    /// Drops the older half of the entries that can be undone, at least one. False if there is none.
    bool dropOldest();

    /// Drops the entries to redo.
    void dropRedo();

    /// Drops the entries of finished strokes that are known to have changed nothing, and returns their number. The
    /// slots of such an entry and of the one before it show the same, so it does not matter which of them is shown.
    /// Strokes of which an earlier one was dropped, or that have moved, before they were known, are kept.
    std::size_t dropUnchanged();

    /// For each slot, whether it belongs to an entry.
    [[nodiscard]] std::vector<bool> used() const;

    /// Sets the top of a slot to what the device has reported.
    void learn(std::uint32_t slot, const EditTop& top);

    /// Whether all entries' tops are exact.
    [[nodiscard]] bool isExact() const;

    /// Tells that the contents of all entries have moved: their tops are no longer exact.
    void forgetTops();

private:
    // How the dab of a slot was pushed.
    struct Dab
    {
        std::uint32_t from = 0; // slots
        std::uint32_t kept = 0;
        bool begins_stroke = true;
    };

    void freeSlots(std::size_t first, std::size_t end);

    std::size_t m_entries_max;
    std::deque<std::uint32_t> m_line{0}; // slots
    std::size_t m_current = 0;
    bool m_is_stroke = false;
    std::deque<std::uint32_t> m_free;       // in the order in which they were freed
    std::vector<EditTop> m_tops;            // of slots
    std::vector<std::optional<Dab>> m_dabs; // of slots; nothing: the device has reported, or the slot has moved
    std::vector<bool> m_is_unchanged;       // of slots: known to show what was there before the stroke
    std::vector<std::uint64_t> m_strokes;   // of slots: numbers
    std::uint64_t m_stroke_count = 0;
};

} // namespace zvo
