// SPDX-License-Identifier: MIT
#pragma once

#include "core/dynamic/dynamic_objects.h"
#include "core/edit/edits.h"
#include "core/overlay/overlay_buffers.h"
#include "core/overlay/root_history.h"
#include "core/tree/device_tree.h"
#include "core/update/update.h"
#include "core/update/update_sizes.h"
#include "vk/deletion_queue.h"
#include "vk/device.h"
#include "vk/frame_list.h"
#include "vk/uploader.h"
#include "zvo/dynamic_tree.h"
#include "zvo/types.h"

#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace zvo
{

/// Options of a DynamicOctree. Those that a host can choose have the names and defaults of DynamicTreeInfo
/// (zvo/dynamic_tree.h).
struct DynamicOptions
{
    Coverage coverage = DynamicTreeInfo().coverage; // of the dynamic objects; should be the static tree's
    MergeRule merge = DynamicTreeInfo().merge;
    /// Frames that may be recorded before frameDone() of the first one.
    std::uint32_t frames_in_flight = DynamicTreeInfo().frames_in_flight;
    HistoryBounds history = {DynamicTreeInfo().history_entries, DynamicTreeInfo().history_bytes};
    HistoryBounds edits = {DynamicTreeInfo().strokes, DynamicTreeInfo().edit_bytes}; // of strokes
    float emission_scale = DynamicTreeInfo().emission_scale;
    bool attributes = true;          // whether dynamic objects get attributes; used where the static tree is empty
    bool minimal_capacities = false; // for tests: every buffer starts with room for one element
};

/// The result of an update, known once the device is done with the update's frame.
struct UpdateReport
{
    std::uint64_t entry = 0;         // of the history
    std::uint32_t failed = 0;        // bits gpu::kFailed*; 0: the update succeeded and its root is shown
    std::uint32_t node_count = 0;    // of the overlay
    std::uint32_t voxel_count = 0;   // with attributes of their own in the overlay
    std::uint32_t touched_count = 0; // nodes of the overlay that are not mere copies
    std::uint32_t dynamic_count = 0; // voxels that dynamic objects cover
    std::map<std::string, std::uint64_t> dropped = {}; // dynamic objects' triangles that were left out, by reason
};

/// A static octree or DAG that brushes edit and into which moving meshes are merged, frame by frame. The static tree
/// never changes. An update writes copies of the paths that dynamic objects touch behind the static tree, and shows the
/// copy; undo() shows an older copy. A brush works in the same way, and dynamic objects are merged with the edited
/// tree. Brushes have a history of their own.
///
/// Every frame: beginFrame(); then the calls for the brush; then at most four of update(), undo() and redo(); then the
/// tracing of tree() into the same command buffer; and frameDone() once the device is done with the frame. Frames share
/// buffers: a command buffer must be submitted after those of earlier frames, and begin behind a full memory barrier.
/// Nothing waits for the device. Each of these calls gives the tree another version, and what was made from the last
/// one (a NodePaths, addresses of its buffers) is out of date. The device must outlive a DynamicOctree, and be done
/// with all its frames when it is destroyed.
///
/// An update that has too little memory says so in its report. The frame then shows the last complete root, and a later
/// update gets more memory. Where recording or submitting a frame fails for any reason, frameLost() takes the frame
/// back, and the octree can be used on.
class DynamicOctree
{
public:
    /// Takes over a static tree. MergeRule::Average needs the sums that the tree's attributes were made of
    /// (BuildOptions::keep_sums); without them the constructor throws Error{Usage} and takes nothing. Throws
    /// Error{Memory} when the device's budget does not suffice.
    DynamicOctree(vk::Uploader& device, DeviceTree&& fixed, const DynamicOptions& options);
    DynamicOctree(const DynamicOctree&) = delete;
    DynamicOctree& operator=(const DynamicOctree&) = delete;

    /// Adds a dynamic object in a pose of its mesh's scene. Its buffers are filled through the constructor's device,
    /// whose uploads take effect as vk/uploader.h says. Like all changes, it is shown from the next update() on. Those
    /// that carve take voxels from the edited tree; then the others are merged with what is left. Throws Error{Usage}
    /// for more than kLayersMax dynamic objects, a mesh with another emission scale, a pose that does not fit the mesh
    /// or an info that no object can have, and Error{Memory}.
    DynamicObjectId add(std::shared_ptr<const DynamicMesh> mesh, Pose pose, const DynamicObjectInfo& info = {});

    /// Puts the dynamic object into another pose. A pose that is equal to the last one, bit for bit, changes nothing.
    /// Triangles with vertices that are not finite are left out and counted. Throws as add().
    void setPose(DynamicObjectId object, Pose pose);

    /// Takes the dynamic object away and gives up an update that is under way. Throws Error{Usage} for an object that
    /// does not exist.
    void remove(DynamicObjectId object);

    /// The mesh of the dynamic object. Throws Error{Usage} for an object that does not exist.
    [[nodiscard]] const DynamicMesh& mesh(DynamicObjectId object) { return m_objects.mesh(object); }

    /// Begins the next frame and returns its number.
    std::uint64_t beginFrame()
    {
        m_has_recorded = false;
        return m_frames.begin();
    }

    /// Records an update: dynamic objects that have changed are voxelized, all are merged with the edited tree, and the
    /// result is shown and becomes an entry of the history. Returns whether the update is complete.
    ///
    /// budget_ms: GPU time for this call; 0: no bound. Under a budget, as much of the update is recorded as is expected
    /// to fit (UpdateBudget), and the rest by the next calls. Until the update is complete the last root stays in view,
    /// and changes of dynamic objects wait for the update after this one.
    ///
    /// Where memory is short only because frames in flight still use it, nothing is recorded, and needsUpdate() returns
    /// true. Throws Error{Usage} for more updates than frames_in_flight allows, Error{Memory} when the device's budget
    /// or memory does not suffice, and what making a kernel throws. After an exception the update is given up,
    /// needsUpdate() returns true, and the frame shows what was shown before; it may still be submitted, and if it is
    /// not, frameLost() must be called.
    bool update(vk::FrameGraph& graph, double budget_ms = 0);

    /// Whether an update is under way that the next update() resumes.
    [[nodiscard]] bool isUpdating() const { return m_job != nullptr; }

    /// Record that the previous or the next entry of the history is shown. Dynamic objects get the poses of that entry,
    /// and an update under way is given up. Return false if there is no such entry. Throw what making a kernel throws;
    /// then nothing changes.
    bool undo(vk::FrameGraph& graph);
    bool redo(vk::FrameGraph& graph);

    /// Records a dab of a brush on the edited tree. Dabs up to endStroke() are one stroke, which is undone as a whole.
    /// Returns false, and records no dab, while the device has yet to report how much room there is: try again in a
    /// later frame.
    ///
    /// The frame shows no dynamic objects until the next update(); needsUpdate() returns true if there are any. Their
    /// history ends here. In a leaf that a brush has changed, MergeRule::Average no longer averages: dynamic objects
    /// win.
    ///
    /// Throws Error{Usage} for a radius above kBrushRadiusMax or for more than kDabsPerFrameMax dabs in a frame,
    /// Error{Memory}, and what making a kernel throws. After an exception there is no dab, or there is one that is not
    /// shown yet and needsUpdate() returns true. Cost: the volume of the brush; and where edits need more room, now and
    /// then, all that they hold.
    bool edit(vk::FrameGraph& graph, const Brush& brush);

    /// Ends the stroke: the next dab begins another one.
    void endStroke() { m_edits.endStroke(); }

    /// Record that the previous or the next stroke's state is shown. Dynamic objects are treated as in edit(). Return
    /// false if there is no such stroke. Throw what making a kernel throws; then needsUpdate() returns true. Constant
    /// time.
    bool undoEdit(vk::FrameGraph& graph);
    bool redoEdit(vk::FrameGraph& graph);

    /// Drops the strokes that could be redone.
    void dropRedoneStrokes() { m_edits.dropRedo(); }

    /// Drops strokes that have changed nothing from the history (Edits::dropUnchanged()). What is shown stays the same.
    std::size_t dropUnchangedStrokes() { return m_edits.dropUnchanged(); }

    /// The edited tree: which strokes can be undone, and how much memory they hold.
    [[nodiscard]] const Edits& edits() const { return m_edits; }

    /// Tells that the device is done with `frame` and all frames before it. Returns the reports of their updates.
    /// passes: the times of all passes of the frame, from which update() learns how much fits a budget.
    std::vector<UpdateReport> frameDone(std::uint64_t frame, std::span<const vk::PassTime> passes = {});

    /// Tells that the frame that began last does not reach the device, or not all of it: something threw between
    /// beginFrame() and the end of its submission. For frames that were submitted, call frameDone(), however they
    /// ended.
    ///
    /// The frame is taken back: the history and tree() are those from before it, and can be traced and updated. Dynamic
    /// objects keep the poses that were set in the frame, also by undo() and redo(), so needsUpdate() returns true. A
    /// stroke under way ends, and strokes that could be redone may be gone. Earlier frames are not affected. If the
    /// device did run a part of the frame, tree() may show what the frame was to show until the next update(), undo()
    /// or redo().
    void frameLost();

    /// Whether another update() is needed to show the current state: one has failed, was given up, was lost or had to
    /// wait, or a stroke has taken dynamic objects out of view; and since then neither an update was recorded nor
    /// undo() or redo().
    [[nodiscard]] bool needsUpdate() const { return m_needs_update; }

    /// The tree to trace. Its node_count and voxel_count are those of the static tree (1 node for an empty one). It has
    /// no levels, so functions that walk levels (octreeSha256, voxelCodes) do not apply to it.
    [[nodiscard]] const DeviceTree& tree() const { return m_overlays.tree(); }

    [[nodiscard]] const RootHistory& history() const { return m_history; }

    /// Number of the static tree's root. It stands behind the static nodes and lists, whatever is shown.
    [[nodiscard]] std::uint32_t staticRoot() const { return m_overlays.tree().overlays.static_root; }

    /// Number of the node that dynamic objects are merged with: the root of the edited tree.
    [[nodiscard]] std::uint32_t editedRoot() const { return m_edits.root(); }

private:
    struct PendingUpdate
    {
        std::uint64_t frame;
        std::uint64_t entry;  // of the history
        std::uint32_t result; // element of m_results
        OverlayRegion region;
        std::uint64_t touched; // capacity of its table of touched nodes, in entries
    };
    // An update under way.
    struct Job
    {
        UpdateJob merge;
        std::vector<LayerState> states;         // of the dynamic objects that the update shows
        std::vector<DynamicObjectId> voxelized; // by this update
        UpdateStages stages;
        UpdateProgress progress;
    };
    struct PendingSlices
    {
        std::uint64_t frame;
        std::vector<UpdateSlice> slices;
    };

    using HistoryMove = std::optional<RootEntry> (RootHistory::*)();

    void beginChange();
    bool updateOrWait(vk::FrameGraph& graph, double budget_ms);
    bool beginJob(vk::FrameGraph& graph);
    void prepareBuffers();
    void showOwedRoot(vk::FrameGraph& graph);
    std::optional<OverlayRegion> allocateRegion(vk::FrameGraph& graph);
    void recordJob(vk::FrameGraph& graph, double budget_ms);
    void finishJob(vk::FrameGraph& graph);
    void dropJob();
    void giveUpJob();
    bool show(vk::FrameGraph& graph, HistoryMove move, HistoryMove back);
    void showEdited(vk::FrameGraph& graph);
    UpdateReport learnUpdate(const PendingUpdate& pending);
    void setShift(std::uint32_t fragments);
    [[nodiscard]] RootSlot rootOf(const RootEntry& entry) const;

    vk::Uploader& m_device;
    DynamicOptions m_options;
    vk::DeletionQueue m_deletion_queue;
    OverlayBuffers m_overlays;
    DynamicObjects m_objects;
    RootHistory m_history;
    Edits m_edits;
    vk::FrameList m_frames;
    GpuScene m_tables; // of sRGB codes
    vk::BufferOf<gpu::MergeView> m_merge_view;
    std::uint32_t m_sum_shift; // of the layers

    std::unique_ptr<UpdateBuffers> m_update;
    UpdateCapacities m_capacities; // of m_update
    UpdateSizes m_sizes;

    vk::BufferOf<gpu::uint> m_roots;
    vk::BufferOf<gpu::UpdateStatus> m_results; // host-visible, a ring
    std::uint64_t m_result_count = 0;
    std::deque<PendingUpdate> m_pending_updates;
    std::deque<PendingSlices> m_pending_slices;
    std::unique_ptr<Job> m_job;
    UpdateBudget m_budget;
    bool m_needs_update = false;
    bool m_has_recorded = false; // the last frame has recorded a change: it matters whether it is lost
    bool m_owes_root = false;    // the current root has to be shown again: a lost frame may have shown another one
};

} // namespace zvo
