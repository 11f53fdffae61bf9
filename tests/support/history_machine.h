// SPDX-License-Identifier: MIT
#pragma once

#include "core/overlay/root_history.h"
#include "support/history_line.h"

#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <vector>

namespace zvo::test
{

/// A model of the device and its user: the memory that frames in flight use, the tree in the root slot, and the entries
/// that the history should have. It is kept independently of the history's own state. The property fails where the two
/// differ.
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

    /// An update in the frame that is being recorded. used: what it uses of its region, if it succeeds.
    void update(std::uint32_t nodes, std::uint32_t voxels, std::uint32_t used, bool succeeds);

    /// Adds an entry that shows the static octree.
    void showStatic();

    /// Undo, or redo.
    void move(bool back);

    /// Begins an update and gives it up in the same frame.
    void giveUp(std::uint32_t nodes, std::uint32_t voxels);

    void nextFrame();

    /// Loses the frame that is being recorded. It has no effect, though its regions may have been written.
    void loseFrame();

    /// The device completes the oldest frame, unless that is being recorded.
    void finishFrame();

    /// The host reads the status of the oldest update whose frame is done.
    void endUpdate();

    /// Checks what must hold at any time.
    void check();

    /// Lets the device complete everything, then checks what must hold.
    void checkEnd();

private:
    static constexpr std::uint32_t kStatic = 3;

    // An octree in the device's memory.
    struct Root
    {
        int writer = 0;       // number of the update that made it; 0: the static octree
        OverlayRegion region; // its nodes and voxels
        std::vector<LayerState> layers;

        bool operator==(const Root&) const = default;
    };
    struct Entry
    {
        Root truth; // what it shows on the device
        int writer = 0;
        std::vector<LayerState> layers; // as pushed
    };
    using Line = HistoryLine<Entry>;
    struct Update
    {
        std::uint64_t id;
        std::uint64_t frame;
        int writer;
        bool succeeds;
        OverlayRegion used;
    };
    struct Frame
    {
        std::uint64_t number;
        std::map<int, OverlayRegion> regions; // regions that the frame reads or writes, by writer
    };

    void beginFrame();
    void mark(const OverlayRegion& region, int writer);
    [[nodiscard]] bool isIntact(int writer, const OverlayRegion& region) const;

    [[nodiscard]] static std::set<int> writersOf(const Line& line);
    [[nodiscard]] std::uint64_t bytesOfEntries();
    bool fitsBeside(const Line& line, std::uint32_t nodes, std::uint32_t voxels);
    std::optional<OverlayRegion> allocate(std::uint32_t nodes, std::uint32_t voxels);
    void push(std::uint64_t id, const Entry& entry);
    void checkCurrent();
    void checkLayers();

    HistoryBounds m_bounds;
    OverlayArena m_arena;
    RootHistory m_history;
    vk::FrameList m_frame_list{{&m_history}};
    std::vector<int> m_node_writers; // last writer of each node
    std::vector<int> m_block_writers;
    std::vector<Root> m_root_slots; // [node] octrees of the regions that start there
    Root m_shown;
    int m_writer_count = 0;
    std::deque<Frame> m_frames; // the last frame is being recorded
    std::uint64_t m_frame_done = 0;
    std::deque<Update> m_updates;
    Line m_line;                                    // the entries that the history should have
    Line m_before;                                  // the line when the frame began
    bool m_line_changed = false;                    // since the frame began
    std::map<int, std::weak_ptr<const int>> m_kept; // what the layers keep, by writer
    std::map<int, OverlayRegion> m_owned;           // regions held by entries, by writer
};

} // namespace zvo::test
