// SPDX-License-Identifier: MIT
#pragma once

#include "core/overlay/overlay_arena.h"
#include "vk/frame_list.h"
#include "zvo/dynamic_tree.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace zvo
{

/// Which state of a layer an octree shows.
struct LayerState
{
    std::uint32_t layer = 0;
    std::uint64_t version = 0;

    bool operator==(const LayerState&) const = default;
};

/// How much a RootHistory keeps.
struct HistoryBounds
{
    std::size_t entries_max = DynamicTreeInfo().history_entries; // beside the first one, at least 1
    std::uint64_t bytes_max = DynamicTreeInfo().history_bytes;   // of the entries' regions
};

/// One entry of a RootHistory: an octree or a DAG that can be traced.
struct RootEntry
{
    std::uint64_t id = 0;                // grows from push to push; 0: the first one
    std::optional<OverlayRegion> region; // of its overlay; nothing: the static tree
    std::span<const LayerState> layers;  // as pushed; valid until the history changes
    bool pending = false;                // nobody has said yet whether its update succeeded
};

/// The trees that were shown and can be shown again: a line of entries with a cursor, the current entry. The first
/// entry is the static octree or DAG; it is always there. Entries own their overlays' regions. Host logic only: showing
/// an entry is the caller's copy of the entry's root into the tree's root slot.
///
///     static ── entry ── entry ── entry ── entry
///                          ▲        └────────┴─ redo, dropped by the next push()
///                       current
///
/// *Updates* run on the device, and whether one had enough memory is known only frames later. Until then its entry is
/// pending, and the entry that it followed is kept, even where it fell off. An update that fails must leave in the root
/// slot, and in what undo() and redo() would copy there for its entry, the root before it; so whatever the device shows
/// is a region that is kept. complete() or fail() must be called for every entry that was pushed with a region, once,
/// in the order of pushes, whether or not the entry is still in the line.
///
/// *Frames* in flight: the device may use a region as long as a frame is not done that began before the history dropped
/// it. Such regions wait. Without beginFrame(), they do not: the caller then waits for the device himself. What
/// happened to the line in a frame can be taken back until the next one begins (frameLost()); until then its entries
/// are kept.
///
/// *Bounds*: after push() there are at most entries_max entries beside the first one, and their regions have at most
/// bytes_max bytes, or there is only the pushed one. The oldest fall off for that. Regions that wait, or are kept for a
/// pending entry, are held beyond that: waitingBytes().
///
/// undo(), redo() and current() take constant time, everything else at most n log n for n entries.
class RootHistory final : public vk::FrameParticipant
{
public:
    /// arena must outlive the history. Pushed regions come from it and go back to it.
    RootHistory(OverlayArena& arena, const HistoryBounds& bounds);

    /// Gives everything back at once: the device must be done with all frames.
    ~RootHistory();
    RootHistory(const RootHistory&) = delete;
    RootHistory& operator=(const RootHistory&) = delete;

    /// A region for the next entry. Where the arena has none, drops as many entries as it takes and no more, first from
    /// the end of redo, then the oldest; never the first and the current one, and none at all where that would not
    /// help. Nothing when there is no room, or not yet: see fitsLater().
    std::optional<OverlayRegion> allocate(std::uint64_t nodes, std::uint64_t voxels);

    /// Whether there is room for such a region once all frames that have begun are done and all updates succeeded, with
    /// the entries that there are now. After allocate() returned nothing: whether to try again then; if not, the arena
    /// is too small.
    [[nodiscard]] bool fitsLater(std::uint64_t nodes, std::uint64_t voxels) const;

    /// Gives back, once the device is done with it, a region of allocate() that is not going to be pushed.
    void giveBack(const OverlayRegion& region);

    /// Puts an entry in the place of those of redo and makes it the current one. Call it in the frame that changes the
    /// root slot. Without a region the entry shows the static tree, and is complete. Returns its id.
    std::uint64_t push(const std::optional<OverlayRegion>& region, std::vector<LayerState> layers);

    /// The update of an entry succeeded and needed this many nodes and voxels, at most what its region has: the rest of
    /// the region is free at once.
    void complete(std::uint64_t id, std::uint32_t nodes, std::uint32_t voxels);

    /// The update of an entry failed: where it stands now stands the entry that it followed. So if that is still in the
    /// line, the failed entry is just gone, and if it had fallen off, it is back.
    void fail(std::uint64_t id);

    [[nodiscard]] RootEntry current() const { return describe(m_current); }

    /// The entry before or behind the current one, which becomes the current one; nothing at the ends.
    std::optional<RootEntry> undo();
    std::optional<RootEntry> redo();
    [[nodiscard]] std::size_t undoCount() const { return m_current; }
    [[nodiscard]] std::size_t redoCount() const { return m_entries.size() - 1 - m_current; }

    /// The first entry becomes the current one and the only one: what others show has become something else.
    void forget();

    void frameSubmitted() override;
    void beginFrame(std::uint64_t frame) override { m_frame = frame; }
    void frameDone(std::uint64_t frame) override;

    /// The entries are those there were when the frame began, but for updates of earlier frames that have ended since.
    /// Its updates must not be ended; their regions wait for a frame. The caller sees to it that the root slot shows
    /// current() before those are used again.
    void frameLost() override;

    /// Calls see with every layer state that current(), undo() and redo() may still return, in any order, some of them
    /// twice: those of the entries, and of entries that are kept for a pending one or for frameLost().
    template <typename See> void forEachLayer(const See& see) const
    {
        for (const auto& entry : m_entries)
        {
            std::ranges::for_each(entry->layers, see);
        }
        for (const Update& update : m_updates)
        {
            std::ranges::for_each(update.fallback->layers, see);
        }
        for (const auto& entry : m_entries_before)
        {
            std::ranges::for_each(entry->layers, see);
        }
    }

    [[nodiscard]] std::uint64_t entryBytes() const;   // of the entries' regions
    [[nodiscard]] std::uint64_t waitingBytes() const; // of other regions that are held

private:
    // Has a region until it is destroyed, which leaves the region to the frames in flight.
    struct Lease
    {
        Lease(RootHistory& h, const OverlayRegion& r) : history(h), region(r) {}
        ~Lease() { history.giveBack(region); }
        Lease(const Lease&) = delete;
        Lease& operator=(const Lease&) = delete;

        RootHistory& history;
        OverlayRegion region;
    };
    // Shared by the line, the update that makes the entry and those that fall back to it.
    struct Entry
    {
        std::uint64_t id = 0;
        std::optional<Lease> lease; // nothing: the static tree
        std::vector<LayerState> layers;
        bool pending = false;
    };
    using Entries = std::deque<std::shared_ptr<Entry>>;
    struct Update
    {
        std::shared_ptr<Entry> entry;
        std::shared_ptr<Entry> fallback; // what it followed
        std::uint64_t frame;
    };
    struct Waiting
    {
        std::uint64_t frame; // the last one that may use region
        OverlayRegion region;
    };

    [[nodiscard]] RootEntry describe(std::size_t index) const;
    [[nodiscard]] OverlayArena arenaLater() const;
    static std::optional<std::size_t> removeFailed(Entries& entries, const Update& update);
    void keepEntries();
    Update endUpdate(std::uint64_t id);
    bool dropEntry();

    OverlayArena& m_arena;
    HistoryBounds m_bounds;
    std::uint64_t m_frame = 0; // the last one that has begun
    std::uint64_t m_frame_done = 0;
    std::uint64_t m_last_id = 0;
    std::deque<Waiting> m_waiting; // in order of frames
    Entries m_entries;             // the line; [0]: the static tree
    std::size_t m_current = 0;     // index in m_entries
    std::deque<Update> m_updates;  // of pending entries, in order of pushes
    // When the last frame began: the line, if it has changed since, or nothing, and the index of what was current in
    // it.
    Entries m_entries_before;
    std::size_t m_current_before = 0;
};

} // namespace zvo
