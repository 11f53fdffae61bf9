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

/// What a brush did to a static tree, and what of it can be undone. Knows nothing of dynamic objects. Edits stand in
/// one region of an OverlayBuffers; when that is full they move, without what nothing shows any more, to another one.
/// Frames are those of DynamicOctree, which owns this.
class Edits final : public vk::FrameParticipant
{
public:
    /// Regions that frames in flight may use go back by way of regions, what else they may use goes to deletion_queue.
    /// All must outlive this.
    Edits(vk::Device& device, OverlayBuffers& overlays, RootHistory& regions, const EditBounds& bounds,
          std::uint32_t frames_in_flight, vk::DeletionQueue& deletion_queue);

    /// Records a dab of the stroke that is under way, or of a new one. False, and no dab, while its room is not known:
    /// to be tried again in a later frame. The root that is shown may have moved in both cases. Throws Error{Usage} for
    /// a radius above kBrushRadiusMax and more than kDabsPerFrameMax dabs in a frame, Error{Memory} when the device's
    /// budget does not suffice, and what making a kernel throws: then there is no dab, whatever the frame does. Entries
    /// to redo may be gone.
    bool dab(vk::FrameGraph& graph, const Brush& brush, const vk::BufferOf<gpu::SceneView>& tables);

    void endStroke();
    bool undo();
    bool redo();

    /// Node of what is shown: the static root where nothing was edited.
    [[nodiscard]] std::uint32_t root() const;

    [[nodiscard]] std::size_t undoCount() const { return m_now.history.undoCount(); }
    [[nodiscard]] std::size_t redoCount() const { return m_now.history.redoCount(); }

    /// Grows with every dab, and whenever what is shown stands elsewhere.
    [[nodiscard]] std::uint64_t changeCount() const { return m_change_count; }

    /// Bytes of device memory that edits have.
    [[nodiscard]] std::uint64_t heldBytes() const;

    /// Those below the top of what is shown: at most, until the frame is done that made it.
    [[nodiscard]] std::uint64_t shownBytes() const;

    /// Voxels of what is shown, without dynamic objects. Of a dab, it is known when its frame is done.
    [[nodiscard]] std::uint32_t voxelCount() const;

    void frameSubmitted() override;
    void beginFrame(std::uint64_t /*frame*/) override { m_dab_count = 0; }
    void frameDone(std::uint64_t frame) override;

    /// A stroke under way ends, and entries to redo may be gone. What was shown before the frame is as it was, even if
    /// the device has run the frame.
    void frameLost() override;

private:
    struct State
    {
        EditHistory history;
        std::optional<OverlayRegion> region = std::nullopt;
        std::shared_ptr<vk::BufferOf<gpu::EditState>> states = {}; // [slots] in region
        bool is_compact = false;                 // nothing was forgotten since everything moved together
        std::vector<std::uint64_t> changes = {}; // of slots: number of the last one
    };
    // A state that may come back in the frame in which it was left.
    struct Saved
    {
        State state;
        std::size_t left_count; // of m_left
    };
    // Tops that the device tells with a frame.
    struct Report
    {
        std::uint64_t frame;
        std::uint64_t ring_slot; // of m_reports
        std::uint32_t first_slot;
        std::uint32_t slot_count;
        OverlayRegion region;
        std::uint64_t change; // that made them: later ones may have made others
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
    vk::DeletionQueue& m_deletion_queue; // knows the frame
    std::uint64_t m_bytes_max;
    State m_now;
    std::optional<Saved> m_before;          // of the last frame, if it has changed since that began
    bool m_has_written = false;             // the last frame, above the top of what was shown
    std::vector<OverlayRegion> m_left;      // in the last frame
    vk::BufferOf<gpu::EditState> m_reports; // [ring slots][slots] host-visible: of frames in flight that have any
    std::uint64_t m_ring_slot_count;
    std::uint64_t m_ring_slot = 0; // of the last frame that has any
    std::optional<DabBuffers> m_buffers;
    std::deque<Report> m_pending;
    std::uint64_t m_change_count = 0;
    std::uint32_t m_dab_count = 0; // in the frame
};

} // namespace zvo
