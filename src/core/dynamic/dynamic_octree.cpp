// SPDX-License-Identifier: MIT
#include "core/dynamic/dynamic_octree.h"

#include "core/tree/tree_limits.h"
#include "zvo/error.h"

#include <algorithm>
#include <utility>

namespace zvo
{

namespace
{

constexpr std::uint32_t kUpdatesPerFrame = 4;
constexpr std::uint64_t kRoomMin = 1024; // nodes, and voxels, that overlays have at first

// Returns the static tree if it can be merged as options say. Otherwise throws Error{Usage}.
DeviceTree& checked(DeviceTree& fixed, const DynamicOptions& options)
{
    if (options.frames_in_flight == 0 || options.history.entries_max == 0)
    {
        throw Error(ErrorCode::Usage, "dynamic updates need a frame in flight and an entry of the history at least");
    }
    if (isPacked(fixed.attributeFormat()))
    {
        throw Error(ErrorCode::Usage,
                    "dynamic objects can be merged only with attributes of 8 bytes: build the octree with them");
    }
    if (fixed.filled && fixed.isDag())
    {
        throw Error(ErrorCode::Usage, "a filled DAG cannot be changed: do not compress what is filled");
    }
    const bool averages = fixed.hasAttributes() && options.merge == MergeRule::Average;
    if (averages && fixed.sums.sums.count() != fixed.voxel_count)
    {
        throw Error(ErrorCode::Usage,
                    "dynamic objects can be averaged with a static octree or DAG only if its sums were kept");
    }
    if (fixed.emission.count() != 0 && fixed.emission_scale != options.emission_scale)
    {
        throw Error(ErrorCode::Usage, "dynamic objects and the static scene need one emission scale");
    }
    return fixed;
}

} // namespace

DynamicOctree::DynamicOctree(vk::Uploader& device, DeviceTree&& fixed, const DynamicOptions& options)
    : m_device(device), m_options(options), m_overlays(device, std::move(checked(fixed, options)),
                                                       {options.attributes, options.emission_scale}, m_deletion_queue),
      m_objects(device, m_overlays.tree().grid,
                {options.coverage,
                 {m_overlays.hasAttributes(), m_overlays.emits()},
                 options.emission_scale,
                 options.frames_in_flight * kUpdatesPerFrame,
                 options.minimal_capacities},
                m_deletion_queue),
      m_history(m_overlays.arena(), options.history),
      m_edits(device.device(), m_overlays, m_history, options.edits, options.frames_in_flight, m_deletion_queue),
      m_frames({&m_objects, &m_edits, &m_history, &m_overlays, &m_deletion_queue}), m_tables(uploadColorTables(device)),
      m_sum_shift(m_overlays.tree().sums.sum_shift), m_sizes(options.minimal_capacities)
{
    vk::Device& d = device.device();
    m_merge_view = {d, "update/merge_view", 1};
    const std::uint64_t pending = std::uint64_t{options.frames_in_flight} * kUpdatesPerFrame;
    m_roots = {d, "update/roots", pending + 1};
    m_results = {d, "update/results", pending + 1, vk::MemoryKind::Readback};
    m_overlays.reserve(options.minimal_capacities ? 1 : kRoomMin);
    // Last: what is recorded must not go.
    device.perform([&](vk::FrameGraph& graph, vk::DeletionQueue& deletion_queue)
                   { m_overlays.settle(graph, deletion_queue); });
}

DynamicObjectId DynamicOctree::add(std::shared_ptr<const DynamicMesh> mesh, Pose pose, const DynamicObjectInfo& info)
{
    return m_objects.add(std::move(mesh), std::move(pose), info);
}

void DynamicOctree::setPose(DynamicObjectId object, Pose pose)
{
    m_objects.setPose(object, std::move(pose));
}

void DynamicOctree::remove(DynamicObjectId object)
{
    m_objects.remove(object);
    dropJob();
}

// Begins a change, recorded in the current frame, of the tree that is shown.
void DynamicOctree::beginChange()
{
    m_has_recorded = true;
    m_overlays.renewVersion();
}

RootSlot DynamicOctree::rootOf(const RootEntry& entry) const
{
    if (entry.pending)
    {
        const auto pending =
            std::ranges::find(m_pending_updates, entry.id, [](const PendingUpdate& update) { return update.entry; });
        return {gpu::kNoNode, pending->result};
    }
    return {entry.region ? entry.region->first_node : editedRoot(), 0};
}

void DynamicOctree::showOwedRoot(vk::FrameGraph& graph)
{
    if (m_owes_root)
    {
        showRoot(graph, m_overlays.tree(), m_roots, rootOf(m_history.current()));
        m_owes_root = false;
    }
}

// Makes the buffers of the update as large as its layers and its overlay ask for.
void DynamicOctree::prepareBuffers()
{
    const UpdateCapacities needed = m_sizes.fitting(m_capacities);
    if (m_update != nullptr && needed == m_capacities)
    {
        return;
    }
    if (needed.touched > VoxelizeCapacities::kTableMax || needed.records > kIndicesMax)
    {
        throw Error(ErrorCode::Memory,
                    "dynamic objects touch more nodes than 32-bit numbers count; lower the resolution");
    }
    m_device.device().memory().require(UpdateBuffers::bytes(needed, m_overlays.tree().grid), "merging dynamic objects");
    if (m_update != nullptr)
    {
        m_deletion_queue.keep(std::move(m_update));
    }
    m_update = std::make_unique<UpdateBuffers>(m_device.device(), needed, m_overlays.tree().grid);
    m_capacities = needed;
}

// Returns nothing while frames in flight hold the memory that is needed.
std::optional<OverlayRegion> DynamicOctree::allocateRegion(vk::FrameGraph& graph)
{
    const std::uint64_t nodes = m_sizes.likelyNodes();
    const std::uint64_t voxels = m_sizes.likelyVoxels();
    m_overlays.catchUp(graph);
    if (const std::optional<OverlayRegion> region = m_overlays.arena().allocate(nodes, voxels))
    {
        return region;
    }
    try
    {
        m_overlays.grow(graph, nodes, voxels);
    }
    catch (const Error& error) // then entries of the history have to make room, if there are any
    {
        if (error.code() != ErrorCode::Memory)
        {
            throw;
        }
        if (const std::optional<OverlayRegion> region = m_history.allocate(nodes, voxels))
        {
            return region;
        }
        if (m_history.fitsLater(nodes, voxels))
        {
            return std::nullopt;
        }
        throw;
    }
    return m_overlays.arena().allocate(nodes, voxels).value();
}

bool DynamicOctree::update(vk::FrameGraph& graph, double budget_ms)
{
    if (m_pending_updates.size() + 1 >= m_results.count())
    {
        throw Error(ErrorCode::Usage, "more updates are under way than frames in flight were announced");
    }
    beginChange();
    try
    {
        return updateOrWait(graph, budget_ms);
    }
    catch (...)
    {
        dropJob();
        m_needs_update = true;
        throw;
    }
}

bool DynamicOctree::updateOrWait(vk::FrameGraph& graph, double budget_ms)
{
    if (m_job == nullptr && m_objects.isEmpty())
    {
        showRoot(graph, m_overlays.tree(), m_roots, {editedRoot(), 0});
        m_owes_root = false;
        m_history.push(std::nullopt, {});
    }
    else if (m_job != nullptr || beginJob(graph))
    {
        recordJob(graph, budget_ms);
    }
    else
    {
        m_needs_update = true;
        return false;
    }
    m_needs_update = false;
    return m_job == nullptr;
}

// Records the stages that fit the budget and, if these are all that is left, the end of the update.
void DynamicOctree::recordJob(vk::FrameGraph& graph, double budget_ms)
{
    std::vector<UpdateSlice> slices = m_budget.plan(m_job->stages, m_job->progress, budget_ms);
    for (UpdateSlice& slice : slices)
    {
        slice.first_pass = graph.passCount();
        m_job->stages[slice.stage].record(graph, slice.first_unit, slice.unit_count);
        slice.pass_end = graph.passCount();
    }
    m_pending_slices.push_back({m_frames.current(), std::move(slices)});
    if (m_job->progress.stage == m_job->stages.size())
    {
        finishJob(graph);
    }
    graph.releaseToHost(); // what frameDone() reads
}

// What can fail comes before the region is taken, which nobody else would give back. False if the update has to wait
// for frames.
bool DynamicOctree::beginJob(vk::FrameGraph& graph)
{
    showOwedRoot(graph);
    m_objects.makeLayers();
    m_sizes.begin(m_objects.leafCapacity(), m_objects.carve());
    prepareBuffers();
    const FragmentSums& sums = m_overlays.tree().sums;
    const gpu::MergeView view = {{m_tables.view.address()},
                                 {sums.sums.address()},
                                 {sums.emission_sums.address()},
                                 m_sum_shift - sums.sum_shift,
                                 static_cast<gpu::uint>(sums.sums.count())};
    graph.update(m_merge_view, 0, std::span(&view, 1));
    const std::optional<OverlayRegion> region = allocateRegion(graph);
    if (!region)
    {
        return false;
    }
    UpdateStages stages;
    std::vector<DynamicObjectId> voxelized = m_objects.addStages(m_sum_shift, stages);
    const auto result = static_cast<std::uint32_t>(m_result_count++ % m_results.count());
    m_job = std::make_unique<Job>(Job{
        .merge = {.tree = m_overlays.tree(),
                  .layers = m_objects.layers(),
                  .region = *region,
                  .base_root = editedRoot(),
                  .merge = m_options.merge,
                  .sum_shift = m_sum_shift,
                  .emission_offset = m_overlays.emissionOffset(),
                  .view = m_merge_view,
                  .tables = m_tables.view,
                  .slot = result,
                  .roots = m_roots,
                  .results = m_results},
        .states = m_objects.states(),
        .voxelized = std::move(voxelized),
        .stages = std::move(stages),
        .progress = {},
    });
    addMergeStages(m_job->merge, *m_update, m_job->stages);
    return true;
}

void DynamicOctree::finishJob(vk::FrameGraph& graph)
{
    const RootSlot last = rootOf(m_history.current());
    showOverlay(graph, m_job->merge, *m_update, last);
    const std::uint64_t entry = m_history.push(m_job->merge.region, std::move(m_job->states));
    m_pending_updates.push_back(
        {m_frames.current(), entry, m_job->merge.slot, m_job->merge.region, m_capacities.touched});
    m_job.reset();
}

// Gives an update up. The dynamic objects that it has voxelized are voxelized again.
void DynamicOctree::dropJob()
{
    if (m_job == nullptr)
    {
        return;
    }
    m_history.giveBack(m_job->merge.region);
    m_objects.forgetLayers(m_job->voxelized);
    m_job.reset();
    --m_result_count; // its result was not written
}

bool DynamicOctree::undo(vk::FrameGraph& graph)
{
    return show(graph, &RootHistory::undo, &RootHistory::redo);
}

bool DynamicOctree::redo(vk::FrameGraph& graph)
{
    return show(graph, &RootHistory::redo, &RootHistory::undo);
}

// Shows the entry to which `move` leads. If that fails, `back` restores the current entry.
bool DynamicOctree::show(vk::FrameGraph& graph, HistoryMove move, HistoryMove back)
{
    const std::optional<RootEntry> entry = (m_history.*move)();
    if (!entry)
    {
        return false;
    }
    m_overlays.renewVersion();
    try
    {
        showRoot(graph, m_overlays.tree(), m_roots, rootOf(*entry));
    }
    catch (...)
    {
        (m_history.*back)();
        throw;
    }
    m_has_recorded = true;
    m_owes_root = false;
    dropJob();
    m_needs_update = false;
    m_objects.bringBack(entry->layers);
    return true;
}

bool DynamicOctree::edit(vk::FrameGraph& graph, const Brush& brush)
{
    beginChange();
    showOwedRoot(graph); // before anything is written where a lost frame wrote
    const std::uint64_t before = m_edits.changeCount();
    const bool is_done = m_edits.dab(graph, brush, m_tables.view);
    if (m_edits.changeCount() != before)
    {
        showEdited(graph);
    }
    return is_done;
}

bool DynamicOctree::undoEdit(vk::FrameGraph& graph)
{
    if (!m_edits.undo())
    {
        return false;
    }
    showEdited(graph);
    return true;
}

bool DynamicOctree::redoEdit(vk::FrameGraph& graph)
{
    if (!m_edits.redo())
    {
        return false;
    }
    showEdited(graph);
    return true;
}

// Shows the edited tree without dynamic objects. These were merged with another tree, or with one that has moved.
void DynamicOctree::showEdited(vk::FrameGraph& graph)
{
    beginChange();
    dropJob();
    m_history.forget();
    m_needs_update = true; // even without dynamic objects, should this fail
    m_owes_root = true;
    showRoot(graph, m_overlays.tree(), m_roots, {editedRoot(), 0});
    m_owes_root = false;
    m_needs_update = !m_objects.isEmpty();
}

// Gives up the update under way, if there is one; then another update is needed.
void DynamicOctree::giveUpJob()
{
    m_needs_update = m_needs_update || m_job != nullptr;
    dropJob();
}

} // namespace zvo
