// SPDX-License-Identifier: MIT
#include "core/dynamic/mover_set.h"

#include "core/base/with_slack.h"
#include "zvo/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <set>
#include <utility>

namespace zvo
{

namespace
{

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

// Leaves of a scene what tells how it can be posed.
void dropContents(Scene& scene)
{
    scene.images.clear();
    for (Primitive& primitive : scene.primitives)
    {
        const std::size_t target_count = primitive.morph_targets.size();
        primitive = Primitive();
        primitive.morph_targets.resize(target_count);
    }
}

} // namespace

std::shared_ptr<const MoverMesh> uploadMover(vk::Uploader& device, Scene scene, bool attributes, float emission_scale)
{
    auto mesh = std::make_shared<MoverMesh>();
    mesh->uploaded = uploadScene(device, scene, attributes, emission_scale);
    mesh->deform = uploadDeformMesh(device, scene);
    mesh->emits = brightestEmission(scene) > 0;
    mesh->plan = planMover(scene, mesh->deform);
    dropContents(scene);
    mesh->scene = std::move(scene);
    return mesh;
}

MoverSet::MoverSet(vk::Uploader& device, const Grid& grid, const MoverOptions& options, vk::Retired& retired)
    : m_device(device), m_grid(grid), m_options(options), m_retired(retired),
      m_reports(device.device(), "update/layer_reports", (std::uint64_t{options.updates_max} + 1) * gpu::kLayersMax,
                vk::MemoryKind::Readback)
{
}

MoverId MoverSet::add(std::shared_ptr<const MoverMesh> mesh, Pose pose)
{
    if (presentMovers().size() == gpu::kLayersMax)
    {
        throw Error(ErrorCode::Usage, fmt::format("an octree takes {} movers at most", gpu::kLayersMax));
    }
    if (mesh->uploaded.emission_scale != 0 && mesh->uploaded.emission_scale != m_options.emission_scale)
    {
        throw Error(ErrorCode::Usage, "movers and the static scene need one emission scale");
    }
    if (m_options.contents.attributes && !mesh->uploaded.has_attributes)
    {
        throw Error(ErrorCode::Usage, "the mover was uploaded without attributes, the static octree or DAG has them");
    }
    checkPose(*mesh, pose);
    Mover mover;
    mover.buffers = makeMover(m_device, mesh->plan, mesh->uploaded, mesh->deform);
    mover.capacities = m_options.minimal_capacities ? LayerCapacities{{1, 0, 0}, 1, 1}
                                                    : LayerCapacities::estimate(mesh->uploaded, m_grid);
    mover.mesh = std::move(mesh);
    mover.version = addPose(std::move(pose));
    m_movers.emplace(m_next_mover, std::move(mover));
    return m_next_mover++;
}

void MoverSet::place(MoverId mover, Pose pose)
{
    Mover& m = presentMover(mover);
    checkPose(*m.mesh, pose);
    if (!isSame(pose, *m_poses.at(m.version)))
    {
        m.version = addPose(std::move(pose));
    }
}

void MoverSet::remove(MoverId mover)
{
    Mover& m = presentMover(mover);
    m.present = false;
    dropLayer(m);
}

void MoverSet::bringBack(std::span<const LayerState> states)
{
    for (auto& [id, mover] : m_movers)
    {
        const auto state = std::ranges::find(states, id, &LayerState::layer);
        mover.present = state != states.end();
        if (mover.present)
        {
            mover.version = state->version;
        }
        else
        {
            dropLayer(mover);
        }
    }
}

bool MoverSet::isEmpty() const
{
    return std::ranges::none_of(m_movers, [](const auto& entry) { return entry.second.present; });
}

std::vector<LayerState> MoverSet::states() const
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

std::vector<const LayerBuffers*> MoverSet::layers()
{
    std::vector<const LayerBuffers*> layers;
    for (const Mover* mover : presentMovers())
    {
        layers.push_back(mover->layer.get());
    }
    return layers;
}

std::uint64_t MoverSet::leafCapacity()
{
    std::uint64_t leaves = 0;
    for (const Mover* mover : presentMovers())
    {
        leaves += mover->capacities.leaves;
    }
    return leaves;
}

MoverSet::Mover& MoverSet::presentMover(MoverId id)
{
    const auto found = m_movers.find(id);
    if (found == m_movers.end() || !found->second.present)
    {
        throw Error(ErrorCode::Usage, fmt::format("there is no mover {}", id));
    }
    return found->second;
}

std::vector<MoverSet::Mover*> MoverSet::presentMovers()
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
void MoverSet::dropLayer(Mover& mover)
{
    mover.voxelized = 0;
    if (mover.layer != nullptr)
    {
        m_retired.keep(std::move(mover.layer));
    }
}

std::uint64_t MoverSet::addPose(Pose pose)
{
    m_poses.emplace(m_next_version, std::make_shared<const Pose>(std::move(pose)));
    return m_next_version++;
}

void MoverSet::forgetPoses(std::span<const LayerState> states)
{
    std::set<std::uint64_t> versions;
    std::set<MoverId> shown;
    for (const LayerState& state : states)
    {
        versions.insert(state.version);
        shown.insert(state.layer);
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
            m_retired.keep(std::move(it->second));
            it = m_movers.erase(it);
        }
    }
    std::erase_if(m_poses, [&](const auto& entry) { return !versions.contains(entry.first); });
    m_poses_max = 2 * m_poses.size() + 1024;
}

void MoverSet::makeLayers()
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
            const LayerContents contents = {m_options.contents.attributes,
                                            m_options.contents.emission && mover->mesh->emits};
            m_device.device().memory().require(LayerBuffers::bytes(mover->capacities, scene, contents),
                                               "the voxels of a mover");
            mover->layer = std::make_unique<LayerBuffers>(m_device.device(), mover->capacities, scene, contents);
        }
    }
    const std::uint64_t awaited = m_pending.empty() ? 0 : m_report_count - m_pending.front().report;
    if (awaited + voxelized_count > m_reports.count())
    {
        throw Error(ErrorCode::Usage, "more updates are under way than frames in flight were announced");
    }
}

std::vector<MoverId> MoverSet::addSteps(std::uint32_t sum_shift, RecordedSteps& steps)
{
    std::vector<MoverId> voxelized;
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
                       .grid = m_grid,
                       .coverage = m_options.coverage,
                       .sum_shift = sum_shift,
                       .layer = *mover.layer,
                       .reports = m_reports,
                       .report = static_cast<std::uint32_t>(report % m_reports.count())},
                      steps);
        // In the frame that writes the report, or one after it.
        addStep(steps, {"await a report", 1},
                [this, &mover, id, report](vk::FrameGraph&, std::uint64_t, std::uint64_t) {
                    m_pending.push_back({m_retired.frame(), id, report, mover.capacities});
                });
        mover.voxelized = mover.version;
        voxelized.push_back(id);
    }
    return voxelized;
}

void MoverSet::forgetLayers(std::span<const MoverId> movers)
{
    for (const MoverId id : movers)
    {
        m_movers.at(id).voxelized = 0;
    }
}

void MoverSet::forgetLayers()
{
    for (auto& [id, mover] : m_movers)
    {
        mover.voxelized = 0;
    }
}

// Gives a layer that failed more room. False if there is nothing to do.
bool MoverSet::learn(const PendingLayer& pending)
{
    const auto found = m_movers.find(pending.mover);
    if (found == m_movers.end() || found->second.capacities != pending.capacities)
    {
        return false; // gone, or larger already
    }
    const gpu::LayerCounters counters = m_reports.mappedData()[pending.report % m_reports.count()];
    Mover& mover = found->second;
    mover.dropped = counters;
    if (counters.failed == 0)
    {
        return false;
    }
    mover.is_hopeless =
        counters.blocks_exceeded != 0 ||
        (counters.overflow_count != 0 && pending.capacities.voxelize.bricks >= VoxelizeCapacities::kBricksMax);
    mover.capacities = grown(pending.capacities, counters);
    dropLayer(mover);
    return true;
}

void MoverSet::frameDone(std::uint64_t frame)
{
    while (!m_pending.empty() && m_pending.front().frame <= frame)
    {
        m_has_failed = learn(m_pending.front()) || m_has_failed;
        m_pending.pop_front();
    }
}

void MoverSet::frameLost()
{
    std::erase_if(m_pending, [&](const PendingLayer& pending) { return pending.frame == m_retired.frame(); });
    if (!m_pending.empty())
    {
        m_report_count = m_pending.back().report + 1; // the lost ones are not awaited
    }
    forgetLayers();
}

std::map<std::string, std::uint64_t> MoverSet::droppedTriangles()
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

} // namespace zvo
