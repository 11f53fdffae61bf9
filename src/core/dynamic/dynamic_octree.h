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

/// How a DynamicOctree works. What a host can choose is what DynamicTreeInfo says (zvo/dynamic_tree.h), with the same
/// defaults.
struct DynamicOptions
{
    Coverage coverage = DynamicTreeInfo().coverage; // of the dynamic objects; as the static tree's
    MergeRule merge = DynamicTreeInfo().merge;
    std::uint32_t frames_in_flight = DynamicTreeInfo().frames_in_flight; // recorded before frameDone() of the first
    HistoryBounds history = {};
    EditBounds edits = {};
    float emission_scale = DynamicTreeInfo().emission_scale;
    bool attributes = true;          // of an empty static tree, which does not say
    bool minimal_capacities = false; // everything starts with room for one: for tests
};

/// What an update came to, known once the device is done with its frame.
struct UpdateReport
{
    std::uint64_t entry = 0;                           // of the history
    std::uint32_t failed = 0;                          // bits kFailed*; 0: its root is shown
    std::uint32_t node_count = 0;                      // of the overlay
    std::uint32_t voxel_count = 0;                     // with attributes of their own in the overlay
    std::uint32_t touched_count = 0;                   // nodes of the overlay that are not mere copies
    std::uint32_t dynamic_count = 0;                   // voxels that dynamic objects cover
    std::map<std::string, std::uint64_t> dropped = {}; // dynamic objects' triangles that were left out, by reason
};

/// A static octree or DAG that a brush edits and into which moving meshes are merged, frame by frame. The static tree
/// never changes: an update copies the paths that dynamic objects touch behind it, and shows the copy; undo shows an
/// older one. A brush does the same, and dynamic objects are merged with what it leaves. What it does has a history of
/// its own.
///
/// Every frame: beginFrame(), then the brush's calls, then at most four of update(), undo() and redo(), and the tracing
/// of tree() into a command buffer, then, once the device is done with it, frameDone(). Frames share buffers: a command
/// buffer is submitted after those of earlier frames and begins behind a full memory barrier. Nothing waits for the
/// device. Each of these calls gives the tree another version: what was made of it before (a BeamGrid, addresses of its
/// buffers) is out of date. The device must be done with all frames when a DynamicOctree goes, and outlive it. What an
/// update needs beyond the memory there is, it reports; the frame then shows the last root that is complete, and a
/// later update has more memory. Where recording a frame or submitting it fails, whatever it was, frameLost() takes the
/// frame back, and the octree goes on.
class DynamicOctree
{
public:
    /// Takes over a static tree (for MergeRule::Average with the sums it was made of: BuildOptions::keep_sums). Throws
    /// Error{Usage} where those are missing, and takes nothing; Error{Memory} when the device's budget does not
    /// suffice.
    DynamicOctree(vk::Uploader& device, DeviceTree&& fixed, const DynamicOptions& options);
    DynamicOctree(const DynamicOctree&) = delete;
    DynamicOctree& operator=(const DynamicOctree&) = delete;

    /// Adds a dynamic object in a pose of its mesh's scene, by way of the constructor's device: done when that says
    /// (vk/uploader.h). Shown from the next update() on, as all changes are. Throws Error{Usage} for more than
    /// kLayersMax dynamic objects, a mesh with another emission scale or a pose that does not fit the mesh, and
    /// Error{Memory}.
    DynamicObjectId add(std::shared_ptr<const DynamicMesh> mesh, Pose pose);

    /// Puts the dynamic object into another pose: nothing changes where it is the same, bit for bit. Where it is not
    /// finite, triangles are left out and counted. Throws as add().
    void setPose(DynamicObjectId object, Pose pose);

    /// Takes the dynamic object away; gives up an update that is under way. Throws Error{Usage} for one that is not
    /// there, as setPose() does.
    void remove(DynamicObjectId object);

    /// What the dynamic object is made of. Throws Error{Usage} for one that is not there.
    [[nodiscard]] const DynamicMesh& mesh(DynamicObjectId object) { return m_objects.mesh(object); }

    /// Numbers the frame that is to be recorded.
    std::uint64_t beginFrame()
    {
        m_has_recorded = false;
        return m_frames.begin();
    }

    /// Records an update: dynamic objects that changed are voxelized, all are merged with the static tree, and the
    /// result is shown. It becomes an entry of the history. Under a budget of GPU time, as much of it as is thought to
    /// fit (UpdateBudget), and the rest in the next calls: until then the last root is shown, and changes of dynamic
    /// objects count for the update after this one. 0: no bound. Returns whether the update is complete. While memory
    /// is short and frames in flight hold what it takes, records nothing: needsUpdate() says so. Throws Error{Usage}
    /// for more updates than frames_in_flight allow, Error{Memory} when the device's budget or the device's memory does
    /// not suffice, and what making a kernel throws. Then the update is given up, needsUpdate() says so, and the frame
    /// shows what it showed before. It may be submitted all the same; if not: frameLost().
    bool update(vk::FrameGraph& graph, double budget_ms = 0);

    /// Whether an update is under way that the next update() resumes.
    [[nodiscard]] bool isUpdating() const { return m_job != nullptr; }

    /// Records that the entry before, or behind, the one that is shown is shown again. Dynamic objects are where they
    /// were then; an update under way is given up. False if there is none. Throws what making a kernel throws: then
    /// nothing changes.
    bool undo(vk::FrameGraph& graph);
    bool redo(vk::FrameGraph& graph);

    /// Records a dab of a brush on what does not move. Dabs up to endStroke() are one stroke, an entry to be undone. Of
    /// dynamic objects the frame shows nothing until update(), which needsUpdate() asks for where there are any; their
    /// history ends here. A voxel that lies in a leaf which a brush has changed no longer counts in a mean with dynamic
    /// objects: these win. False, and no dab, while the device has to tell first how much room there is: to be tried
    /// again in a later frame. Throws Error{Usage} for a radius above kBrushRadiusMax or more than kDabsPerFrameMax
    /// dabs in a frame, Error{Memory}, and what making a kernel throws: then there is no dab, or needsUpdate() asks for
    /// showing it. Cost: the brush's volume; where edits need more room, now and then, what they hold.
    bool edit(vk::FrameGraph& graph, const Brush& brush);

    /// The next dab begins a stroke.
    void endStroke() { m_edits.endStroke(); }

    /// Records that the strokes before, or behind, are shown again; dynamic objects as after edit(). Constant time.
    /// False if there is none. Throws what making a kernel throws: then needsUpdate() asks for showing them.
    bool undoEdit(vk::FrameGraph& graph);
    bool redoEdit(vk::FrameGraph& graph);

    /// What can be undone, and what it holds.
    [[nodiscard]] const Edits& edits() const { return m_edits; }

    /// The device is done with a frame and all before it: learns what its updates came to and, from the times of all
    /// its passes, how much goes into a budget.
    std::vector<UpdateReport> frameDone(std::uint64_t frame, std::span<const vk::PassTime> passes = {});

    /// The frame that began last does not reach the device, or not all of it: something threw between beginFrame() and
    /// the end of its submission. What it has recorded was not: the history and tree() are those from before it,
    /// which can be traced and updated. Dynamic objects stay where they were put, by undo() and redo() as well:
    /// needsUpdate(). A stroke under way ends, and strokes that could be redone may be gone. Frames before it count as
    /// ever. Where the device came as far as that, tree() shows what the frame was to show, until the next update(),
    /// undo() or redo(). Not for frames that were submitted: frameDone(), however they ended.
    void frameLost();

    /// Whether what is missing has to be shown by another update(): one failed, was given up, was lost or had to wait,
    /// and none was recorded since, nor undo() or redo().
    [[nodiscard]] bool needsUpdate() const { return m_needs_update; }

    /// What to trace. node_count and voxel_count are those of the static tree (1 node for an empty one). It has no
    /// levels: what goes through those (octreeSha256, voxelCodes) tells nothing of it.
    [[nodiscard]] const DeviceTree& tree() const { return m_overlays.tree(); }

    [[nodiscard]] const RootHistory& history() const { return m_history; }

    /// Number of the node behind the static nodes and lists: the static root, untouched by what is shown.
    [[nodiscard]] std::uint32_t staticRoot() const { return m_overlays.tree().overlays.static_root; }

    /// Number of the node that dynamic objects are merged with: the root of what strokes have left.
    [[nodiscard]] std::uint32_t editedRoot() const { return m_edits.root(); }

private:
    struct PendingUpdate
    {
        std::uint64_t frame;
        std::uint64_t entry;  // of the history
        std::uint32_t result; // element of m_results
        OverlayRegion region;
        std::uint64_t touched; // entries that its table had
    };
    // An update under way.
    struct Job
    {
        UpdateJob merge;
        std::vector<LayerState> states;         // of the dynamic objects that it shows
        std::vector<DynamicObjectId> voxelized; // by it
        RecordedStages stages;
        std::vector<UpdateStage> plan; // the same, as UpdateBudget takes them
        UpdateProgress progress;
    };
    struct PendingSlices
    {
        std::uint64_t frame;
        std::vector<UpdateSlice> slices;
    };

    using HistoryMove = std::optional<RootEntry> (RootHistory::*)();

    void beginChange();
    void forgetPoses();
    bool updateOrWait(vk::FrameGraph& graph, double budget_ms);
    bool beginJob(vk::FrameGraph& graph);
    void prepareBuffers();
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
    GpuScene m_tables; // a scene of nothing: the tables of sRGB codes
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
    bool m_has_recorded = false; // the last frame: it matters whether it is lost
    bool m_owes_root = false;    // a lost frame may have shown another root than the current one
};

} // namespace zvo
