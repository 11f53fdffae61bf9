// SPDX-License-Identifier: MIT
#pragma once

#include "core/edit/brush.h"
#include "core/edit/edit.h"
#include "core/edit/edit_history.h"
#include "core/overlay/overlay_buffers.h"
#include "core/overlay/root_history.h"
#include "vk/deletion_queue.h"
#include "vk/device.h"
#include "vk/frame_list.h"

#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <vector>

namespace zvo
{

/// The edits of a static tree by brushes, and their history. Knows nothing of dynamic objects. Edits stand in one
/// region of an OverlayBuffers. When the region is full, what is still needed moves to another region. Frame numbers
/// are those of DynamicOctree, which owns this object.
class Edits final : public vk::FrameParticipant
{
public:
    /// bounds: of the strokes that are kept, and of the bytes that they hold, exceeded only where a single stroke needs
    /// more. Regions that frames in flight may still use are given back through `regions`, other objects are put into
    /// deletion_queue. All references must outlive this object.
    Edits(vk::Device& device, OverlayBuffers& overlays, RootHistory& regions, const HistoryBounds& bounds,
          std::uint32_t frames_in_flight, vk::DeletionQueue& deletion_queue);

    /// Records a dab of the stroke that is under way, or of a new one. Returns false, and records no dab, while it is
    /// not known how much room there is: try again in a later frame. Whatever it returns, root() may have changed.
    /// Throws Error{Usage} for a radius above kBrushRadiusMax and for more than kDabsPerFrameMax dabs in a frame,
    /// Error{Memory} when the device's budget does not suffice, and what making a kernel throws. After an exception
    /// there is no dab, whether or not the frame is submitted, and entries to redo may be gone.
    bool dab(vk::FrameGraph& graph, const Brush& brush, const vk::BufferOf<gpu::SceneView>& tables);

    void endStroke();
    bool undo();
    bool redo();

    /// Drops the strokes that could be redone.
    void dropRedo();

    /// As EditHistory has them.
    [[nodiscard]] std::uint64_t stroke() const { return m_now.history.stroke(); }
    [[nodiscard]] std::uint64_t nextStroke() const { return m_now.history.nextStroke(); }

    /// Drops the entries of finished strokes that have changed nothing, as far as the device has reported, and returns
    /// their number. Not between beginFrame() and the end of the frame's submission.
    std::size_t dropUnchanged();

    /// Number of the edited tree's root node: the static root where nothing has been edited.
    [[nodiscard]] std::uint32_t root() const;

    [[nodiscard]] std::size_t undoCount() const { return m_now.history.undoCount(); }
    [[nodiscard]] std::size_t redoCount() const { return m_now.history.redoCount(); }

    /// Grows with every dab, and whenever the edited tree moves to another region.
    [[nodiscard]] std::uint64_t changeCount() const { return m_change_count; }

    /// Bytes of device memory that edits hold.
    [[nodiscard]] std::uint64_t heldBytes() const;

    /// Bytes of heldBytes() below the top of the current slot. Until the frame that made the slot is done, an upper
    /// bound.
    [[nodiscard]] std::uint64_t shownBytes() const;

    /// Voxels of the edited tree, without dynamic objects, modulo 2^32. What a dab has changed counts once its frame is
    /// done.
    [[nodiscard]] std::uint32_t voxelCount() const;

    void frameSubmitted() override;
    void beginFrame(std::uint64_t /*frame*/) override { m_dab_count = 0; }
    void frameDone(std::uint64_t frame) override;

    /// Restores the edited tree from before the frame, even if the device has run the frame. A stroke under way ends,
    /// and entries to redo may be gone.
    void frameLost() override;

private:
    struct State
    {
        EditHistory history;
        std::optional<OverlayRegion> region = std::nullopt;
        std::shared_ptr<vk::BufferOf<gpu::EditState>> states = {}; // [slots] in region
        bool is_compact = false;                                   // no dab has been recorded since the last compaction
        std::vector<std::uint64_t> changes = {}; // [slots] m_change_count at the last change of the slot
    };
    // A state to which restore() goes back.
    struct Saved
    {
        State state;
        std::size_t left_count; // of m_left
    };
    // States of slots that the device copies to m_reports in a frame.
    struct Report
    {
        std::uint64_t frame;
        std::uint64_t ring_slot; // of m_reports
        std::uint32_t first_slot;
        std::uint32_t slot_count;
        OverlayRegion region;
        std::uint64_t change; // m_change_count when they were copied: older than that of a slot changed since then
    };

    [[nodiscard]] EditSite site();
    [[nodiscard]] std::uint32_t keptSlot() const;
    [[nodiscard]] Saved save() const { return {m_now, m_left.size()}; }
    void saveFrame();
    void restore(Saved saved);
    bool tryDab(vk::FrameGraph& graph, const Brush& brush, const DabExtent& extent,
                const vk::BufferOf<gpu::SceneView>& tables);
    OverlayRegion allocateRegion(vk::FrameGraph& graph, std::uint64_t nodes, std::uint64_t voxels);
    [[nodiscard]] std::shared_ptr<vk::BufferOf<gpu::EditState>> makeStates();
    void begin(vk::FrameGraph& graph, const DabExtent& extent);
    bool makeRoom(vk::FrameGraph& graph, const EditTop& needed);
    void compact(vk::FrameGraph& graph, const EditTop& capacity);
    void report(vk::FrameGraph& graph, std::uint32_t first_slot, std::uint32_t slot_count);
    void learn(const Report& report, State& state) const;

    vk::Device& m_device;
    OverlayBuffers& m_overlays;
    RootHistory& m_regions;
    vk::DeletionQueue& m_deletion_queue; // also knows the current frame
    std::uint64_t m_bytes_max;
    State m_now;
    std::optional<Saved> m_before;     // the state when the last frame began, if it has changed since then
    bool m_has_written = false;        // the last frame has recorded a dab
    std::vector<OverlayRegion> m_left; // regions that were left in the last frame
    // [ring slots][slots] host-visible; a ring slot for each frame in flight that has reports
    vk::BufferOf<gpu::EditState> m_reports;
    std::uint64_t m_ring_slot_count;
    std::uint64_t m_ring_slot = 0; // of the last frame that has reports
    std::optional<DabBuffers> m_buffers;
    std::deque<Report> m_pending;
    std::uint64_t m_change_count = 0;
    std::uint32_t m_dab_count = 0; // in the frame
};

} // namespace zvo
