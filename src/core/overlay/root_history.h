// SPDX-License-Identifier: MIT
#pragma once

#include "core/overlay/overlay_arena.h"
#include "vk/frame_list.h"

#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <vector>

namespace zvo
{

/// The state of one layer in a tree that is shown: which layer, and which version of its pose.
struct LayerState
{
    std::uint32_t layer = 0;
    std::uint64_t version = 0;
    std::shared_ptr<const void> kept = nullptr; // whatever it takes to show the state again

    bool operator==(const LayerState& other) const { return layer == other.layer && version == other.version; }
};

/// Bounds of what a history keeps.
struct HistoryBounds
{
    std::size_t entries_max = 1;          // entries besides the first one, at least 1
    std::uint64_t bytes_max = UINT64_MAX; // of device memory that the entries hold
};

/// An entry of a RootHistory: an octree or a DAG that can be traced.
struct RootEntry
{
    std::uint64_t id = 0;                // grows from push to push; 0: the first entry
    std::optional<OverlayRegion> region; // of its overlay; nothing: the static tree
    std::vector<LayerState> layers;      // as pushed
    bool pending = false;                // it is not known yet whether the entry's update succeeded
};

/// The trees that were shown and can be shown again: a line of entries with a cursor at the current one. The first
/// entry is the static octree or DAG, and is always there. Entries own the regions of their overlays. Host logic only:
/// to show an entry, the caller copies the entry's root into the tree's root slot.
///
///     static ── entry ── entry ── entry ── entry
///                          ▲        └────────┴─ redo, dropped by the next push()
///                       current
///
/// *Updates* run on the device, and whether one had enough memory is known only frames later. Until then its entry is
/// pending, and the entry that it followed is kept as its fallback, even if that is no longer in the line. A failed
/// update must leave the fallback's root in the root slot, and in the place from which undo() and redo() would copy its
/// root. So the device always shows a region that is kept. For every entry that was pushed with a region, complete() or
/// fail() must be called once, in the order of pushes, whether or not the entry is still in the line.
///
/// *Frames* in flight may use a region until all frames are done that began before the history dropped the region;
/// until then the region waits. If beginFrame() is never called, regions do not wait, and the caller has to wait for
/// the device. Changes of the line in a frame can be taken back by frameLost() until the next frame begins; until then
/// the entries from before the frame are kept.
///
/// *Bounds*: after push() there are at most entries_max entries besides the first one, and their regions have at most
/// bytes_max bytes, unless the pushed entry alone has more. The oldest entries are dropped for that. Regions that wait,
/// or are kept for pending entries, do not count towards bytes_max; waitingBytes() tells their size.
///
/// current() takes constant time, undo() and redo() that of the entry's layers, everything else at most n log n for n
/// entries.
///
/// Layer states, with what they keep, live as long as current(), undo() or redo() may return them, also after fail() or
/// frameLost(), and until their own update has ended.
class RootHistory final : public vk::FrameParticipant
{
public:
    /// arena: pushed regions come from it and are given back to it. It must outlive the history.
    RootHistory(OverlayArena& arena, const HistoryBounds& bounds);

    /// Gives all regions back at once. The device must be done with all frames.
    ~RootHistory();
    RootHistory(const RootHistory&) = delete;
    RootHistory& operator=(const RootHistory&) = delete;

    /// Returns a region for the next entry. Where the arena has none, the fewest entries that make room are dropped:
    /// first the last ones to redo, then the oldest, but never the first and the current one. Returns nothing, and
    /// drops nothing, where that does not help either; fitsLater() tells whether waiting will.
    std::optional<OverlayRegion> allocate(std::uint64_t nodes, std::uint64_t voxels);

    /// Whether such a region will fit once all frames that have begun are done and all updates have succeeded, with the
    /// present entries. After allocate() has returned nothing: true means that it is worth another try then, false that
    /// the arena is too small.
    [[nodiscard]] bool fitsLater(std::uint64_t nodes, std::uint64_t voxels) const;

    /// Gives back a region of allocate() that is not going to be pushed, once the device is done with it.
    void giveBack(const OverlayRegion& region);

    /// Adds an entry behind the current one, in place of the entries to redo, and makes it the current one. Call it in
    /// the frame that changes the root slot. An entry without a region shows the static tree, and is never pending.
    /// Returns the entry's id.
    std::uint64_t push(const std::optional<OverlayRegion>& region, std::vector<LayerState> layers);

    /// Tells that the update of an entry succeeded and needed so many nodes and voxels, at most what its region has.
    /// The rest of the region becomes free at once.
    void complete(std::uint64_t id, std::uint32_t nodes, std::uint32_t voxels);

    /// Tells that the update of an entry failed. The entry is replaced by its fallback, the entry that it followed:
    /// where that is still in the line, the failed entry is just removed; where it had been dropped, it comes back.
    void fail(std::uint64_t id);

    [[nodiscard]] const RootEntry& current() const { return *m_entries[m_current]; }

    /// Make the previous or next entry the current one and return it; nothing at the ends.
    std::optional<RootEntry> undo();
    std::optional<RootEntry> redo();
    [[nodiscard]] std::size_t undoCount() const { return m_current; }
    [[nodiscard]] std::size_t redoCount() const { return m_entries.size() - 1 - m_current; }

    /// Drops all entries but the first and makes it the current one. For changes of the tree that entries were merged
    /// with.
    void forget();

    void frameSubmitted() override;
    void beginFrame(std::uint64_t frame) override { m_frame = frame; }
    void frameDone(std::uint64_t frame) override;

    /// Restores the entries from before the frame, except that updates of earlier frames that have ended since then
    /// stay ended. complete() and fail() must not be called for the frame's updates; their regions wait for the frame.
    /// The caller sees to it that the root slot shows current() before such a region is used again.
    void frameLost() override;

    [[nodiscard]] std::uint64_t entryBytes() const;   // of the entries' regions
    [[nodiscard]] std::uint64_t waitingBytes() const; // of other regions that are held

private:
    // Shared by the line, by the update that makes the entry, and by updates whose fallback it is. With the entry its
    // region goes, which then waits for the frames in flight.
    using SharedEntry = std::shared_ptr<RootEntry>;
    using Entries = std::deque<SharedEntry>;
    struct Update
    {
        SharedEntry entry;
        SharedEntry fallback; // the entry that it followed
        std::uint64_t frame;
    };
    struct Waiting
    {
        std::uint64_t frame; // the last one that may use region
        OverlayRegion region;
    };

    [[nodiscard]] SharedEntry makeEntry(RootEntry&& entry);
    [[nodiscard]] OverlayArena arenaLater() const;
    static std::optional<std::size_t> removeFailed(Entries& entries, const Update& update);
    void keepEntries();
    Update endUpdate(std::uint64_t id);
    bool dropEntry();

    OverlayArena& m_arena;
    HistoryBounds m_bounds;
    std::uint64_t m_frame = 0; // the last frame that has begun
    std::uint64_t m_frame_done = 0;
    std::uint64_t m_last_id = 0;
    std::deque<Waiting> m_waiting; // in order of frames
    Entries m_entries;             // the line; [0]: the static tree
    std::size_t m_current = 0;     // index in m_entries
    std::deque<Update> m_updates;  // of pending entries, in order of pushes
    // The line when the last frame began, if it has changed since, else empty; and the index of the entry that was
    // current then.
    Entries m_entries_before;
    std::size_t m_current_before = 0;
};

} // namespace zvo
