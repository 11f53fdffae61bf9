// SPDX-License-Identifier: MIT
#pragma once

#include "core/overlay/root_history.h"

#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <set>
#include <vector>

namespace zvo::test
{

/// The device and its user: which memory frames in flight use, what the root slot shows, and what should be in the
/// history, all kept without a look at how the history does it. Properties fail
/// where they differ.
class HistoryMachine
{
public:
    struct Setup
    {
        std::uint32_t nodes;
        std::uint32_t blocks;
        HistoryBounds bounds;
    };

    explicit HistoryMachine(const Setup& setup);

    /// An update in the frame that is being recorded. used: of its region, if it succeeds.
    void update(std::uint32_t nodes, std::uint32_t voxels, std::uint32_t used, bool succeeds);

    /// An entry that shows the static octree.
    void showStatic();

    /// Undo, or redo.
    void move(bool back);

    /// An update that is begun and then given up, in this frame.
    void giveUp(std::uint32_t nodes, std::uint32_t voxels);

    void nextFrame();

    /// The frame that is being recorded is lost: it did nothing, though its regions may be written.
    void loseFrame();

    /// The device is done with the oldest frame but the one being recorded.
    void finishFrame();

    /// The host reads the status of the oldest update whose frame is done.
    void endUpdate();

    /// What must hold at any time.
    void check();

    /// What must hold when the device is done with everything; goes there.
    void checkEnd();

private:
    static constexpr std::uint32_t kStatic = 3;

    // An octree in the device's memory.
    struct Root
    {
        int writer = 0;       // number of the update that made it; 0: the static one
        OverlayRegion region; // what it consists of
        std::vector<LayerState> layers;

        bool operator==(const Root&) const = default;
    };
    struct Told // what the history should say of an entry
    {
        int writer = 0;
        std::vector<LayerState> layers;
    };
    struct Update
    {
        std::uint64_t id;
        std::uint64_t frame;
        int writer;
        std::uint64_t before; // entry
        bool succeeds;
        OverlayRegion used;
    };
    struct Frame
    {
        std::uint64_t number;
        std::map<int, OverlayRegion> regions; // that it reads or writes, by writer
    };

    void beginFrame();
    void mark(const OverlayRegion& region, int writer);
    [[nodiscard]] bool isIntact(int writer, const OverlayRegion& region) const;

    [[nodiscard]] std::set<int> writersOfEntries();
    static void removeFailed(std::vector<std::uint64_t>& entries, std::size_t& current, const Update& update);
    [[nodiscard]] std::uint64_t bytesOfEntries();
    bool fitsBesideEntries(std::uint32_t nodes, std::uint32_t voxels);
    bool dropEntry();
    std::optional<OverlayRegion> allocate(std::uint32_t nodes, std::uint32_t voxels);
    void pushed(std::uint64_t id);
    void checkCurrent();
    void checkLayers();

    HistoryBounds m_bounds;
    OverlayArena m_arena;
    RootHistory m_history;
    vk::FrameList m_frame_list{{&m_history}};
    std::vector<int> m_node_writers; // whose each node is, or was
    std::vector<int> m_block_writers;
    std::vector<Root> m_root_slots; // [node]: of regions that start there
    Root m_shown;
    int m_writer_count = 0;
    std::deque<Frame> m_frames; // the last one is being recorded
    std::uint64_t m_frame_done = 0;
    std::deque<Update> m_updates;
    std::vector<std::uint64_t> m_entries{0}; // ids
    std::size_t m_current = 0;
    struct
    {
        std::vector<std::uint64_t> entries;
        std::size_t current = 0;
    } m_before;                            // the line when the frame began
    bool m_line_changed = false;           // since
    std::map<std::uint64_t, Root> m_truth; // of each entry, on the device
    std::map<std::uint64_t, Told> m_told;
    std::map<int, OverlayRegion> m_owned; // by writer
};

} // namespace zvo::test
