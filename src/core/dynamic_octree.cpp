// SPDX-License-Identifier: MIT
#include "core/dynamic_octree.h"

#include "core/divide_up.h"
#include "zvo/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cassert>
#include <cstring>
#include <set>
#include <utility>

namespace zvo
{

namespace
{

constexpr std::uint64_t kCountMax = UINT32_MAX; // kernels count in 32 bits
constexpr std::uint32_t kUpdatesPerFrame = 4;
constexpr std::uint64_t kSpaceMin = 1024; // nodes, and voxels, that there is room for at first

std::uint64_t roundUp(std::uint64_t value, std::uint64_t multiple)
{
    return divideUp(value, multiple) * multiple;
}

// A quarter more than was needed: what moves needs a little more or less in every frame.
std::uint64_t withSlack(std::uint64_t needed)
{
    return needed + needed / 4 + 64;
}

// The most that was needed, of late: what leaves the grid and comes back finds room at once.
std::uint64_t recentMost(std::uint64_t most, std::uint64_t needed)
{
    return std::max(needed, most - divideUp(most, 1024)); // half in 700 updates
}

// What a layer that failed needs, as far as it tells: counts past a capacity are exact unless the table was full.
LayerCapacities grown(const LayerCapacities& tried, const gpu::LayerCounters& counters)
{
    LayerCapacities result = tried;
    if (counters.overflow_count != 0)
    {
        result.voxelize.bricks = std::min(4 * tried.voxelize.bricks, VoxelizeCapacities::kBricksMax);
    }
    result.voxelize.big_triangles = std::max<std::uint64_t>(tried.voxelize.big_triangles, counters.big_count);
    result.voxelize.row_blocks = std::max<std::uint64_t>(tried.voxelize.row_blocks, counters.block_count);
    if (counters.leaf_count > tried.leaves)
    {
        result.leaves = withSlack(counters.leaf_count);
    }
    if (counters.voxel_count > tried.voxels)
    {
        result.voxels = withSlack(counters.voxel_count);
    }
    return result;
}

// Throws Error{Usage} for a pose that does not fit.
void checkPose(const MoverMesh& mesh, const Pose& pose)
{
    if (pose.transforms.size() != mesh.scene.instances.size())
    {
        throw Error(ErrorCode::Usage, fmt::format("a mover of {} instances was given {} transforms",
                                                  mesh.scene.instances.size(), pose.transforms.size()));
    }
    checkPose(mesh.deform, pose);
}

template <typename T> bool isSame(const std::vector<T>& a, const std::vector<T>& b)
{
    return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

// By their bits: what is not a number equals itself.
bool isSame(const Pose& a, const Pose& b)
{
    const auto same = [](const auto& x, const auto& y) { return isSame(x, y); };
    return isSame(a.transforms, b.transforms) && std::ranges::equal(a.joint_matrices, b.joint_matrices, same) &&
           std::ranges::equal(a.morph_weights, b.morph_weights, same);
}

} // namespace

std::shared_ptr<const MoverMesh> uploadMover(vk::HeadlessDevice& device, Scene scene, bool attributes,
                                             float emission_scale)
{
    auto mesh = std::make_shared<MoverMesh>();
    mesh->uploaded = uploadScene(device, scene, attributes, emission_scale);
    mesh->deform = uploadDeformMesh(device, scene);
    mesh->emits = brightestEmission(scene) > 0;
    scene.images.clear();
    mesh->scene = std::move(scene);
    return mesh;
}

DynamicOctree::DynamicOctree(vk::HeadlessDevice& device, BuildResult built, const DynamicOptions& options)
    : m_device(device), m_options(options), m_tables(uploadScene(device, Scene{}, true))
{
    if (options.frames_in_flight == 0 || options.history.steps_max == 0)
    {
        throw Error(ErrorCode::Usage, "dynamic updates need a frame in flight and a step of history at least");
    }
    const bool averages = built.octree.hasAttributes() && options.merge == MergeRule::Average;
    if (averages && built.sums.sums.count() != built.octree.voxel_count)
    {
        throw Error(ErrorCode::Usage, "movers can be averaged with a static octree only if its sums were kept");
    }
    if (built.octree.emission.count() != 0 && built.octree.emission_scale != options.emission_scale)
    {
        throw Error(ErrorCode::Usage, "movers and the static scene need one emission scale");
    }
    takeOver(built);
    vk::Device& d = device.device();
    m_merge_view = {d, "update/merge_view", 1};
    const std::uint64_t pending = std::uint64_t{options.frames_in_flight} * kUpdatesPerFrame;
    m_roots = {d, "update/roots", pending + 1};
    m_results = {d, "update/results", pending + 1, vk::MemoryKind::Readback};
    m_reports = {d, "update/layer_reports", (pending + 1) * gpu::kLayersMax, vk::MemoryKind::Readback};
}

// Copies the static octree to buffers with room behind it, which begin with the slot of the root that is shown. The
// node behind the static ones keeps the static root.
void DynamicOctree::takeOver(BuildResult& built)
{
    Octree& from = built.octree;
    const bool is_empty = from.node_count == 0; // here it is a root without children
    m_static_nodes = is_empty ? 1 : from.node_count;
    m_static_voxels = from.voxel_count;
    m_static_emissive = from.emission.count();
    m_has_attributes = is_empty ? m_options.attributes : from.hasAttributes();
    m_octree.grid = from.grid;
    m_octree.node_count = m_static_nodes;
    m_octree.voxel_count = m_static_voxels;
    m_octree.emission_scale = emits() ? m_options.emission_scale : 1.0F;
    m_static_sums = std::move(built.sums);
    m_sum_shift = m_static_sums.sum_shift;
    m_octree.nodes = std::move(from.nodes);
    m_octree.voxel_attributes = std::move(from.voxel_attributes);
    m_octree.node_attributes = std::move(from.node_attributes);
    m_octree.emission_words = std::move(from.emission_words);
    m_octree.emission = std::move(from.emission);

    const std::uint64_t first = m_options.minimal_capacities ? 1 : kSpaceMin;
    m_arena = std::make_unique<OverlayArena>(OverlaySpace{
        .static_nodes = m_static_nodes + 1,
        .node_capacity = m_static_nodes + 1,
        .static_voxels = m_static_voxels,
        .voxel_capacity = m_static_voxels,
        .node_bytes = static_cast<std::uint32_t>(sizeof(gpu::Node) + (m_has_attributes ? sizeof(gpu::Attribute) : 0)),
        .voxel_block_bytes = voxelBlockBytes(),
    });
    m_history = std::make_unique<RootHistory>(*m_arena, m_options.history);
    m_device.run(
        [&](vk::FrameGraph& graph)
        {
            growSpace(graph, first, first);
            if (is_empty)
            {
                graph.fill(m_octree.nodes, 0);
                graph.fill(m_octree.node_attributes, 0);
            }
            graph.copy(m_octree.nodes, 0, m_octree.nodes, m_static_nodes * sizeof(gpu::Node), sizeof(gpu::Node));
            if (m_has_attributes)
            {
                graph.copy(m_octree.node_attributes, 0, m_octree.node_attributes,
                           m_static_nodes * sizeof(gpu::Attribute), sizeof(gpu::Attribute));
            }
        });
    m_retired.clear();
}

std::uint32_t DynamicOctree::voxelBlockBytes() const
{
    std::size_t bytes = m_has_attributes ? kVoxelBlock * sizeof(gpu::Attribute) : 0;
    bytes += emits() ? kVoxelBlock * sizeof(gpu::uint) + sizeof(gpu::uvec2) : 0;
    return static_cast<std::uint32_t>(bytes);
}

std::uint32_t DynamicOctree::firstOverlayVoxel() const
{
    return static_cast<std::uint32_t>(roundUp(m_static_voxels, kVoxelBlock));
}

template <typename T> void DynamicOctree::retire(T&& what)
{
    m_retired.push_back({m_frame, std::make_shared<std::decay_t<T>>(std::forward<T>(what))});
}

template <typename T>
void DynamicOctree::replace(vk::FrameGraph& graph, vk::BufferOf<T>& buffer, vk::BufferOf<T>&& longer)
{
    if (buffer.count() != 0)
    {
        graph.copy(buffer, 0, longer, 0, buffer.bytes());
    }
    retire(std::exchange(buffer, std::move(longer)));
}

// Room for a region of that many nodes and voxels, whatever else is held: longer buffers with the same contents. All of
// them, or none and nothing is recorded.
void DynamicOctree::growSpace(vk::FrameGraph& graph, std::uint64_t nodes, std::uint64_t voxels)
{
    const OverlaySpace& space = m_arena->space();
    const std::uint64_t room = std::uint64_t{space.node_capacity} - space.static_nodes;
    const std::uint64_t voxel_room = space.voxel_capacity - std::min(space.voxel_capacity, firstOverlayVoxel());
    const std::uint64_t node_capacity = space.static_nodes + std::max(room + room / 2, room + nodes);
    const std::uint64_t voxel_capacity =
        firstOverlayVoxel() + roundUp(std::max(voxel_room + voxel_room / 2, voxel_room + voxels), kVoxelBlock);
    if (node_capacity > kCountMax || voxel_capacity > kCountMax)
    {
        throw Error(ErrorCode::Memory, "overlays need more nodes or voxels than 32-bit numbers count: keep fewer steps "
                                       "of history, or lower the resolution");
    }
    const std::uint64_t emission = emits() ? m_static_emissive + voxel_capacity - firstOverlayVoxel() : 0;
    m_device.device().memory().require(
        node_capacity * sizeof(gpu::Node) +
            (m_has_attributes ? (node_capacity + voxel_capacity) * sizeof(gpu::Attribute) : 0) +
            (emits() ? voxel_capacity / kVoxelBlock * sizeof(gpu::uvec2) + emission * sizeof(gpu::uint) : 0),
        "room for overlays");
    vk::Device& d = m_device.device();
    const std::uint64_t attribute_nodes = m_has_attributes ? node_capacity : 0;
    const std::uint64_t attribute_voxels = m_has_attributes ? voxel_capacity : 0;
    const std::uint64_t emission_words = emits() ? voxel_capacity / kVoxelBlock : 0;
    vk::BufferOf<gpu::Node> longer_nodes(d, m_octree.nodes.name(), node_capacity);
    vk::BufferOf<gpu::Attribute> averages(d, m_octree.node_attributes.name(), attribute_nodes);
    vk::BufferOf<gpu::Attribute> attributes(d, m_octree.voxel_attributes.name(), attribute_voxels);
    vk::BufferOf<gpu::uvec2> words(d, m_octree.emission_words.name(), emission_words);
    vk::BufferOf<gpu::uint> emission_values(d, m_octree.emission.name(), emission);
    replace(graph, m_octree.nodes, std::move(longer_nodes));
    if (m_has_attributes)
    {
        replace(graph, m_octree.node_attributes, std::move(averages));
        replace(graph, m_octree.voxel_attributes, std::move(attributes));
    }
    if (emits())
    {
        const bool had_words = m_octree.emission_words.count() != 0;
        replace(graph, m_octree.emission_words, std::move(words));
        replace(graph, m_octree.emission, std::move(emission_values));
        if (!had_words) // nothing of the static octree emits
        {
            graph.fill(m_octree.emission_words, 0);
        }
    }
    m_arena->grow(static_cast<std::uint32_t>(node_capacity), static_cast<std::uint32_t>(voxel_capacity));
}

MoverId DynamicOctree::add(std::shared_ptr<const MoverMesh> mesh, Pose pose)
{
    if (presentMovers().size() == gpu::kLayersMax)
    {
        throw Error(ErrorCode::Usage, fmt::format("an octree takes {} movers at most", gpu::kLayersMax));
    }
    if (mesh->uploaded.emission_scale != 0 && mesh->uploaded.emission_scale != m_options.emission_scale)
    {
        throw Error(ErrorCode::Usage, "movers and the static scene need one emission scale");
    }
    if (m_has_attributes && !mesh->uploaded.has_attributes)
    {
        throw Error(ErrorCode::Usage, "the mover was uploaded without attributes, the static octree has them");
    }
    Mover mover;
    checkPose(*mesh, pose);
    mover.version = addPose(std::move(pose));
    mover.buffers = makeMover(m_device, mesh->scene, mesh->uploaded, mesh->deform);
    mover.capacities = m_options.minimal_capacities ? LayerCapacities{{1, 0, 0}, 1, 1}
                                                    : LayerCapacities::estimate(mesh->uploaded, m_octree.grid);
    mover.mesh = std::move(mesh);
    m_movers.emplace(m_next_mover, std::move(mover));
    return m_next_mover++;
}

void DynamicOctree::place(MoverId mover, Pose pose)
{
    Mover& m = presentMover(mover);
    checkPose(*m.mesh, pose);
    if (!isSame(pose, *m_poses.at(m.version)))
    {
        m.version = addPose(std::move(pose));
    }
}

void DynamicOctree::remove(MoverId mover)
{
    Mover& m = presentMover(mover);
    dropJob();
    m.present = false;
    dropLayer(m);
}

DynamicOctree::Mover& DynamicOctree::presentMover(MoverId id)
{
    const auto found = m_movers.find(id);
    if (found == m_movers.end() || !found->second.present)
    {
        throw Error(ErrorCode::Usage, fmt::format("there is no mover {}", id));
    }
    return found->second;
}

std::vector<DynamicOctree::Mover*> DynamicOctree::presentMovers()
{
    std::vector<Mover*> movers;
    for (auto& [id, mover] : m_movers)
    {
        if (mover.present)
        {
            movers.push_back(&mover);
        }
    }
    return movers;
}

// The layer is made anew when it is needed again.
void DynamicOctree::dropLayer(Mover& mover)
{
    mover.voxelized = 0;
    if (mover.layer != nullptr)
    {
        retire(std::move(mover.layer));
    }
}

std::uint64_t DynamicOctree::addPose(Pose pose)
{
    forgetPoses();
    m_poses.emplace(m_next_version, std::make_shared<const Pose>(std::move(pose)));
    return m_next_version++;
}

// Drops the poses, and the movers, that nothing shows and no step brings back, every now and then.
void DynamicOctree::forgetPoses()
{
    if (m_poses.size() < m_poses_max)
    {
        return;
    }
    std::set<std::uint64_t> versions;
    std::set<MoverId> shown;
    const auto see = [&](const LayerState& state)
    {
        versions.insert(state.version);
        shown.insert(state.layer);
    };
    m_history->forEachLayer(see);
    if (m_job != nullptr)
    {
        std::ranges::for_each(m_job->states, see);
    }
    for (auto it = m_movers.begin(); it != m_movers.end();)
    {
        if (it->second.present || shown.contains(it->first))
        {
            versions.insert(it->second.version);
            ++it;
        }
        else
        {
            retire(std::move(it->second));
            it = m_movers.erase(it);
        }
    }
    std::erase_if(m_poses, [&](const auto& entry) { return !versions.contains(entry.first); });
    m_poses_max = 2 * m_poses.size() + 1024;
}

std::uint64_t DynamicOctree::beginFrame()
{
    m_frame = m_history->beginFrame();
    return m_frame;
}

std::vector<LayerState> DynamicOctree::layerStates() const
{
    std::vector<LayerState> states;
    for (const auto& [id, mover] : m_movers)
    {
        if (mover.present)
        {
            states.push_back({id, mover.version});
        }
    }
    return states;
}

RootPlace DynamicOctree::rootOf(const RootStep& step) const
{
    if (step.pending)
    {
        const auto pending =
            std::ranges::find(m_pending_updates, step.id, [](const PendingUpdate& update) { return update.step; });
        return {gpu::kNoNode, pending->result};
    }
    return {step.region ? step.region->first_node : staticRoot(), 0};
}

// Gives movers that changed and have no layer one.
void DynamicOctree::makeLayers()
{
    if (std::ranges::any_of(presentMovers(), &Mover::is_hopeless))
    {
        throw Error(ErrorCode::Memory, "a mover makes more pieces than 32-bit numbers count; lower the resolution");
    }
    std::uint64_t voxelized_count = 0;
    for (Mover* mover : presentMovers())
    {
        voxelized_count += mover->voxelized != mover->version ? 1 : 0;
        if (mover->voxelized != mover->version && mover->layer == nullptr)
        {
            const GpuScene& scene = mover->mesh->uploaded;
            const LayerContents contents = {m_has_attributes, emits() && mover->mesh->emits};
            m_device.device().memory().require(LayerBuffers::bytes(mover->capacities, scene, contents),
                                               "the voxels of a mover");
            mover->layer = std::make_unique<LayerBuffers>(m_device.device(), mover->capacities, scene, contents);
        }
    }
    const std::uint64_t awaited = m_pending_layers.empty() ? 0 : m_report_count - m_pending_layers.front().report;
    if (awaited + voxelized_count > m_reports.count())
    {
        throw Error(ErrorCode::Usage, "more updates are under way than frames in flight were announced");
    }
}

// Everything that voxelizes the movers which changed. They count as voxelized from now on: the job is recorded, or
// dropped.
void DynamicOctree::addMoverSteps(RecordedSteps& steps, std::vector<Mover*>& voxelized)
{
    for (auto& entry : m_movers)
    {
        const MoverId id = entry.first;
        Mover& mover = entry.second;
        if (!mover.present || mover.voxelized == mover.version)
        {
            continue;
        }
        const GpuScene& scene = mover.mesh->uploaded;
        const std::uint64_t report = m_report_count++;
        addStep(steps, {"place a mover", scene.triangle_count},
                [&mover, pose = m_poses.at(mover.version)](vk::FrameGraph& graph, std::uint64_t, std::uint64_t)
                { placeMover(graph, mover.mesh->deform, *pose, mover.buffers); });
        addLayerSteps({.scene = {scene, mover.buffers},
                       .grid = m_octree.grid,
                       .coverage = m_options.coverage,
                       .sum_shift = m_sum_shift,
                       .layer = *mover.layer,
                       .reports = m_reports,
                       .report = static_cast<std::uint32_t>(report % m_reports.count())},
                      steps);
        // In the frame that writes the report, or one after it.
        addStep(steps, {"await a report", 1},
                [this, &mover, id, report](vk::FrameGraph&, std::uint64_t, std::uint64_t) {
                    m_pending_layers.push_back({m_frame, id, report, mover.capacities});
                });
        mover.voxelized = mover.version;
        voxelized.push_back(&mover);
    }
}

// Makes the buffers of the update as large as its layers and its overlay ask for.
void DynamicOctree::prepareBuffers()
{
    UpdateCapacities needed = m_capacities;
    std::uint64_t records = 0;
    for (const Mover* mover : presentMovers())
    {
        records += mover->capacities.leaves;
    }
    if (records > m_capacities.records)
    {
        needed.records = withSlack(records);
    }
    if (m_likely_nodes > m_capacities.overlay_nodes)
    {
        needed.overlay_nodes = withSlack(m_likely_nodes);
    }
    needed.touched =
        std::max({needed.touched, m_touched_min, m_options.minimal_capacities ? 1 : std::bit_ceil(2 * records)});
    if (m_update == nullptr || needed != m_capacities)
    {
        if (needed.touched > VoxelizeCapacities::kBricksMax || needed.records > kCountMax)
        {
            throw Error(ErrorCode::Memory, "movers touch more nodes than 32-bit numbers count; lower the resolution");
        }
        m_device.device().memory().require(UpdateBuffers::bytes(needed), "merging movers");
        if (m_update != nullptr)
        {
            retire(std::move(m_update));
        }
        m_update = std::make_unique<UpdateBuffers>(m_device.device(), needed, m_octree.grid);
        m_capacities = needed;
    }
}

// How large the next overlay is thought to be, where none was measured.
void DynamicOctree::guessOverlay()
{
    if (m_likely_nodes != 0)
    {
        return;
    }
    std::uint64_t leaves = 0;
    for (const Mover* mover : presentMovers())
    {
        leaves += mover->capacities.leaves;
    }
    m_likely_nodes = m_options.minimal_capacities ? 1 : 3 * leaves + 64; // with copies of what stands beside them
    m_likely_voxels = m_options.minimal_capacities ? 1 : 32 * leaves + 64;
}

// Nothing while frames in flight hold what is needed.
std::optional<OverlayRegion> DynamicOctree::allocateRegion(vk::FrameGraph& graph)
{
    if (const std::optional<OverlayRegion> region = m_arena->allocate(m_likely_nodes, m_likely_voxels))
    {
        return region;
    }
    try
    {
        growSpace(graph, m_likely_nodes, m_likely_voxels);
    }
    catch (const Error& error) // then steps of the history have to make room, if there are any
    {
        if (error.code() != ErrorCode::Memory)
        {
            throw;
        }
        if (const std::optional<OverlayRegion> region = m_history->allocate(m_likely_nodes, m_likely_voxels))
        {
            return region;
        }
        if (m_history->fitsLater(m_likely_nodes, m_likely_voxels))
        {
            return std::nullopt;
        }
        throw;
    }
    return m_arena->allocate(m_likely_nodes, m_likely_voxels).value();
}

bool DynamicOctree::update(vk::FrameGraph& graph, double budget_ms)
{
    if (m_pending_updates.size() + 1 >= m_results.count())
    {
        throw Error(ErrorCode::Usage, "more updates are under way than frames in flight were announced");
    }
    if (m_job == nullptr)
    {
        if (presentMovers().empty())
        {
            m_history->push(std::nullopt, {});
            showRoot(graph, m_octree, m_roots, {staticRoot(), 0});
            m_needs_update = false;
            return true;
        }
        if (!beginJob(graph))
        {
            m_needs_update = true;
            return false;
        }
    }
    try
    {
        recordJob(graph, budget_ms);
    }
    catch (...)
    {
        dropJob();
        throw;
    }
    m_needs_update = false;
    return m_job == nullptr;
}

// Records what fits the budget, and what ends the update if that is all.
void DynamicOctree::recordJob(vk::FrameGraph& graph, double budget_ms)
{
    std::vector<UpdateSlice> slices = m_budget.plan(m_job->plan, m_job->progress, budget_ms);
    for (UpdateSlice& slice : slices)
    {
        slice.first_pass = graph.passCount();
        m_job->steps[slice.step].record(graph, slice.first_unit, slice.unit_count);
        slice.pass_end = graph.passCount();
    }
    m_pending_slices.push_back({m_frame, std::move(slices)});
    if (m_job->progress.step == m_job->steps.size())
    {
        finishJob(graph);
    }
    graph.releaseToHost(); // what frameDone() reads
}

// What can fail for want of memory comes first, and changes nothing. False if the update has to wait for frames.
bool DynamicOctree::beginJob(vk::FrameGraph& graph)
{
    makeLayers();
    guessOverlay();
    prepareBuffers();
    const std::optional<OverlayRegion> region = allocateRegion(graph);
    if (!region)
    {
        return false;
    }
    RecordedSteps steps;
    std::vector<Mover*> voxelized;
    addMoverSteps(steps, voxelized);
    const gpu::MergeView view = {{m_tables.view.address()},
                                 {m_static_sums.sums.address()},
                                 {m_static_sums.emission_sums.address()},
                                 m_sum_shift - m_static_sums.sum_shift};
    graph.update(m_merge_view, 0, std::span(&view, 1));
    std::vector<const LayerBuffers*> layers;
    for (const Mover* mover : presentMovers())
    {
        layers.push_back(mover->layer.get());
    }
    const auto result = static_cast<std::uint32_t>(m_result_count++ % m_results.count());
    m_job = std::make_unique<Job>(Job{
        .merge = {.octree = m_octree,
                  .base_root = staticRoot(),
                  .layers = std::move(layers),
                  .region = *region,
                  .merge = m_options.merge,
                  .sum_shift = m_sum_shift,
                  .emission_offset = static_cast<std::uint32_t>(m_static_emissive - firstOverlayVoxel()),
                  .view = m_merge_view,
                  .tables = m_tables.view,
                  .static_sums = m_static_sums,
                  .place = result,
                  .roots = m_roots,
                  .results = m_results},
        .states = layerStates(),
        .voxelized = std::move(voxelized),
        .steps = std::move(steps),
        .plan = {},
        .progress = {},
    });
    addMergeSteps(m_job->merge, *m_update, m_job->steps);
    for (const RecordedStep& step : m_job->steps)
    {
        m_job->plan.push_back(step.step);
    }
    return true;
}

void DynamicOctree::finishJob(vk::FrameGraph& graph)
{
    const RootPlace last = rootOf(m_history->current());
    showOverlay(graph, m_job->merge, *m_update, last);
    const std::uint64_t step = m_history->push(m_job->merge.region, std::move(m_job->states));
    m_pending_updates.push_back({m_frame, step, m_job->merge.place, m_job->merge.region, m_capacities.touched});
    m_job.reset();
}

// Gives an update up: what it has voxelized is made again.
void DynamicOctree::dropJob()
{
    if (m_job == nullptr)
    {
        return;
    }
    m_history->giveBack(m_job->merge.region);
    for (Mover* mover : m_job->voxelized)
    {
        mover->voxelized = 0;
    }
    m_job.reset();
    --m_result_count; // its result was not written
}

bool DynamicOctree::show(vk::FrameGraph& graph, const std::optional<RootStep>& step)
{
    if (!step)
    {
        return false;
    }
    dropJob();
    showRoot(graph, m_octree, m_roots, rootOf(*step));
    m_needs_update = false;
    for (auto& [id, mover] : m_movers)
    {
        const auto state = std::ranges::find(step->layers, id, &LayerState::layer);
        mover.present = state != step->layers.end();
        if (mover.present)
        {
            mover.version = state->version;
        }
        else
        {
            dropLayer(mover);
        }
    }
    return true;
}

bool DynamicOctree::undo(vk::FrameGraph& graph)
{
    return show(graph, m_history->undo());
}

bool DynamicOctree::redo(vk::FrameGraph& graph)
{
    return show(graph, m_history->redo());
}

// Drops the job for reasons of its own: another update has to begin.
void DynamicOctree::giveUpJob()
{
    m_needs_update = m_needs_update || m_job != nullptr;
    dropJob();
}

// Gives a layer that failed more room, and has it made again.
void DynamicOctree::learnLayer(const PendingLayer& pending)
{
    const auto found = m_movers.find(pending.mover);
    if (found == m_movers.end() || found->second.capacities != pending.capacities)
    {
        return; // gone, or larger already
    }
    const gpu::LayerCounters counters = m_reports.mappedData()[pending.report % m_reports.count()];
    Mover& mover = found->second;
    mover.dropped = counters;
    if (counters.failed == 0)
    {
        return;
    }
    mover.is_hopeless =
        counters.blocks_exceeded != 0 ||
        (counters.overflow_count != 0 && pending.capacities.voxelize.bricks >= VoxelizeCapacities::kBricksMax);
    giveUpJob();
    mover.capacities = grown(pending.capacities, counters);
    dropLayer(mover);
}

UpdateReport DynamicOctree::learnUpdate(const PendingUpdate& pending)
{
    const gpu::UpdateStatus status = m_results.mappedData()[pending.result];
    if (status.failed == 0)
    {
        m_history->complete(pending.step, status.node_count, status.voxel_count);
        m_most_nodes = recentMost(m_most_nodes, status.node_count);
        m_most_voxels = recentMost(m_most_voxels, status.voxel_count);
        m_likely_nodes = withSlack(m_most_nodes);
        m_likely_voxels = withSlack(m_most_voxels);
    }
    else
    {
        m_needs_update = m_needs_update || m_history->current().id == pending.step;
        m_history->fail(pending.step);
        // Levels that were not reached are not counted: twice as much, if that is more.
        if ((status.failed & gpu::kFailedNodes) != 0)
        {
            m_likely_nodes = std::max<std::uint64_t>(
                {m_likely_nodes, std::uint64_t{2} * pending.region.node_capacity, withSlack(status.node_count)});
        }
        if ((status.failed & gpu::kFailedVoxels) != 0)
        {
            m_likely_voxels = std::max<std::uint64_t>(m_likely_voxels, withSlack(status.voxel_count));
        }
        if ((status.failed & gpu::kFailedTable) != 0)
        {
            m_touched_min = std::max(m_touched_min, 2 * pending.touched);
        }
    }
    if ((status.failed & ~gpu::kFailedFragments) == 0) // it came as far as to count them
    {
        setShift(status.max_fragments);
    }
    return {pending.step,         status.failed,        status.node_count, status.voxel_count,
            status.touched_count, status.dynamic_count, droppedTriangles()};
}

// Of all movers, as they were voxelized last.
std::map<std::string, std::uint64_t> DynamicOctree::droppedTriangles()
{
    std::map<std::string, std::uint64_t> dropped;
    for (const Mover* mover : presentMovers())
    {
        dropped["nonfinite"] += mover->dropped.nonfinite;
        dropped["out_of_range"] += mover->dropped.out_of_range;
        dropped["outside"] += mover->dropped.outside;
        dropped["zero_area"] += mover->dropped.zero_area;
    }
    std::erase_if(dropped, [](const auto& entry) { return entry.second == 0; });
    return dropped;
}

// Drops as many value bits of the layers' sums as it takes for so many fragments, and no more: where that changes, all
// layers are made again. One update is merged with too few bits after the fragments have become fewer.
void DynamicOctree::setShift(std::uint32_t fragments)
{
    const std::uint32_t shift = std::max(
        m_static_sums.sum_shift, static_cast<std::uint32_t>(std::bit_width(fragments / (gpu::kFragmentsMax + 1))));
    if (shift == m_sum_shift)
    {
        return;
    }
    m_sum_shift = shift;
    giveUpJob();
    for (auto& [id, mover] : m_movers)
    {
        mover.voxelized = 0;
    }
}

std::vector<UpdateReport> DynamicOctree::frameDone(std::uint64_t frame, std::span<const vk::PassTime> passes)
{
    while (!m_pending_slices.empty() && m_pending_slices.front().frame <= frame)
    {
        if (m_pending_slices.front().frame == frame)
        {
            m_budget.learn(m_pending_slices.front().slices, passes);
        }
        m_pending_slices.pop_front();
    }
    std::vector<UpdateReport> reports;
    while (!m_pending_layers.empty() && m_pending_layers.front().frame <= frame)
    {
        const PendingLayer pending = m_pending_layers.front();
        m_pending_layers.pop_front();
        learnLayer(pending);
    }
    while (!m_pending_updates.empty() && m_pending_updates.front().frame <= frame)
    {
        const PendingUpdate pending = m_pending_updates.front();
        m_pending_updates.pop_front();
        reports.push_back(learnUpdate(pending));
    }
    m_history->frameDone(frame);
    while (!m_retired.empty() && m_retired.front().frame <= frame)
    {
        m_retired.pop_front();
    }
    return reports;
}

} // namespace zvo
