// SPDX-License-Identifier: MIT
#include "core/dynamic/dynamic_objects.h"

#include "zvo/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <utility>

namespace zvo
{

namespace
{

// Throws Error{Usage} for a pose that does not fit.
void checkPose(const DynamicMesh& mesh, const Pose& pose)
{
    if (pose.transforms.size() != mesh.scene.instances.size())
    {
        throw Error(ErrorCode::Usage, fmt::format("a dynamic object of {} instances was given {} transforms",
                                                  mesh.scene.instances.size(), pose.transforms.size()));
    }
    checkPose(mesh.deform, pose);
}

// Throws Error{Usage} for an info that no object can have.
void checkInfo(const DynamicObjectInfo& info)
{
    if (info.fill == Fill::Robust)
    {
        throw Error(ErrorCode::Usage, "dynamic objects are filled by Fill::Solid or Fill::Parity");
    }
    if (info.fill != Fill::None && !info.carves)
    {
        throw Error(ErrorCode::Usage, "only dynamic objects that carve can be filled");
    }
}

template <typename T> bool isSame(const std::vector<T>& a, const std::vector<T>& b)
{
    return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

// Compares bits, so that NaN equals itself.
bool isSame(const Pose& a, const Pose& b)
{
    const auto same = [](const auto& x, const auto& y) { return isSame(x, y); };
    return isSame(a.transforms, b.transforms) && std::ranges::equal(a.joint_matrices, b.joint_matrices, same) &&
           std::ranges::equal(a.morph_weights, b.morph_weights, same);
}

// Drops everything of a scene that a pose does not need.
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

std::shared_ptr<const DynamicMesh> uploadDynamicMesh(vk::Uploader& device, Scene scene, bool attributes,
                                                     float emission_scale)
{
    auto mesh = std::make_shared<DynamicMesh>();
    mesh->uploaded = uploadScene(device, scene, attributes, emission_scale);
    mesh->deform = uploadDeformMesh(device, scene);
    mesh->emits = brightestEmission(scene) > 0;
    mesh->plan = planDynamicObject(scene, mesh->deform);
    dropContents(scene);
    mesh->scene = std::move(scene);
    return mesh;
}

DynamicObjects::DynamicObjects(vk::Uploader& device, const Grid& grid, const DynamicObjectOptions& options,
                               vk::DeletionQueue& deletion_queue)
    : m_device(device), m_grid(grid), m_options(options), m_deletion_queue(deletion_queue),
      m_reports(device.device(), "update/layer_reports", (std::uint64_t{options.updates_max} + 1) * gpu::kLayersMax,
                vk::MemoryKind::Readback)
{
}

DynamicObjectId DynamicObjects::add(std::shared_ptr<const DynamicMesh> mesh, Pose pose, const DynamicObjectInfo& info)
{
    checkInfo(info);
    if (m_objects.size() == gpu::kLayersMax)
    {
        throw Error(ErrorCode::Usage, fmt::format("an octree takes {} dynamic objects at most", gpu::kLayersMax));
    }
    if (mesh->uploaded.emission_scale != 0 && mesh->uploaded.emission_scale != m_options.emission_scale)
    {
        throw Error(ErrorCode::Usage, "dynamic objects and the static scene need one emission scale");
    }
    if (m_options.contents.attributes && !info.carves && !mesh->uploaded.has_attributes)
    {
        throw Error(ErrorCode::Usage,
                    "the dynamic object was uploaded without attributes, the static octree or DAG has them");
    }
    checkPose(*mesh, pose);
    // Frames in flight may still use what nothing keeps any more. The queue needs host memory for that; without any,
    // the program ends.
    const auto drop = [&queue = m_deletion_queue](Object* dropped) { queue.keep(std::unique_ptr<Object>(dropped)); };
    const std::shared_ptr<Object> object(new Object(), drop);
    object->buffers = makeDynamicObject(m_device, mesh->plan, mesh->uploaded, mesh->deform);
    object->capacities = m_options.minimal_capacities
                             ? LayerCapacities{{1, 1, 1, 1, 1}, 1, 1}
                             : LayerCapacities::estimate(mesh->uploaded, m_grid, m_options.coverage);
    object->mesh = std::move(mesh);
    object->info = info;
    put(*object, std::move(pose));
    m_objects.emplace(m_next_object, object);
    return m_next_object++;
}

void DynamicObjects::setPose(DynamicObjectId object, Pose pose)
{
    Object& m = presentObject(object);
    checkPose(*m.mesh, pose);
    if (!isSame(pose, *m.pose))
    {
        put(m, std::move(pose));
    }
}

void DynamicObjects::remove(DynamicObjectId object)
{
    dropLayer(presentObject(object));
    m_objects.erase(object);
}

void DynamicObjects::bringBack(std::span<const LayerState> states)
{
    const auto shownBy = [](const LayerState& state) -> const Shown&
    { return *static_cast<const Shown*>(state.kept.get()); };
    decltype(m_objects) objects; // made first: without memory for it, what is shown stays
    for (const LayerState& state : states)
    {
        objects[state.layer] = shownBy(state).object;
    }
    for (const LayerState& state : states)
    {
        shownBy(state).object->pose = shownBy(state).pose;
        shownBy(state).object->version = state.version;
    }
    m_objects.swap(objects);
    for (const auto& [id, object] : objects)
    {
        if (!m_objects.contains(id))
        {
            dropLayer(*object);
        }
    }
}

std::vector<LayerState> DynamicObjects::states() const
{
    std::vector<LayerState> states;
    for (const auto& [id, object] : m_objects)
    {
        states.push_back({id, object->version, std::make_shared<const Shown>(Shown{object, object->pose})});
    }
    return states;
}

std::vector<const LayerBuffers*> DynamicObjects::layers()
{
    std::vector<const LayerBuffers*> layers;
    for (const auto& [id, object] : m_objects)
    {
        layers.push_back(object->layer.get());
    }
    return layers;
}

std::uint64_t DynamicObjects::leafCapacity()
{
    std::uint64_t leaves = 0;
    for (const auto& [id, object] : m_objects)
    {
        leaves += object->capacities.leaves;
    }
    return leaves;
}

bool DynamicObjects::carve() const
{
    return std::ranges::any_of(m_objects, [](const auto& entry) { return entry.second->info.carves; });
}

LayerContents DynamicObjects::contentsOf(const Object& object) const
{
    return {.attributes = m_options.contents.attributes && !object.info.carves,
            .emission = m_options.contents.emission && object.mesh->emits && !object.info.carves,
            .carves = object.info.carves,
            .fill = object.info.fill};
}

DynamicObjects::Object& DynamicObjects::presentObject(DynamicObjectId id)
{
    const auto found = m_objects.find(id);
    if (found == m_objects.end())
    {
        throw Error(ErrorCode::Usage, fmt::format("there is no dynamic object {}", id));
    }
    return *found->second;
}

// Drops the layer, which is made anew when it is needed again.
void DynamicObjects::dropLayer(Object& object)
{
    object.voxelized = 0;
    if (object.layer != nullptr)
    {
        m_deletion_queue.keep(std::move(object.layer));
    }
}

// Puts the object into another pose.
void DynamicObjects::put(Object& object, Pose&& pose)
{
    object.pose = std::make_shared<const Pose>(std::move(pose));
    object.version = ++m_last_version;
}

void DynamicObjects::makeLayers()
{
    if (std::ranges::any_of(m_objects, [](const auto& entry) { return entry.second->is_hopeless; }))
    {
        throw Error(ErrorCode::Memory,
                    "a dynamic object makes more pieces than 32-bit numbers count; lower the resolution");
    }
    std::uint64_t voxelized_count = 0;
    for (const auto& [id, object] : m_objects)
    {
        voxelized_count += object->voxelized != object->version ? 1 : 0;
        if (object->voxelized != object->version && object->layer == nullptr)
        {
            const GpuScene& scene = object->mesh->uploaded;
            const LayerContents contents = contentsOf(*object);
            m_device.device().memory().require(
                LayerBuffers::bytes(object->capacities, scene, m_options.coverage, contents),
                "the voxels of a dynamic object");
            object->layer = std::make_unique<LayerBuffers>(m_device.device(), object->capacities, scene,
                                                           m_options.coverage, contents);
        }
    }
    const std::uint64_t awaited = m_pending.empty() ? 0 : m_report_count - m_pending.front().report;
    if (awaited + voxelized_count > m_reports.count())
    {
        throw Error(ErrorCode::Usage, "more updates are under way than frames in flight were announced");
    }
}

std::vector<DynamicObjectId> DynamicObjects::addStages(std::uint32_t sum_shift, UpdateStages& stages)
{
    std::vector<DynamicObjectId> voxelized;
    for (const auto& [id, each] : m_objects)
    {
        const std::shared_ptr<Object> object = each;
        if (object->voxelized == object->version)
        {
            continue;
        }
        const GpuScene& scene = object->mesh->uploaded;
        const std::uint64_t report = m_report_count++;
        stages.push_back(wholeStage("pose a dynamic object", scene.triangle_count,
                                    [object, pose = object->pose](vk::FrameGraph& graph)
                                    { zvo::setPose(graph, object->mesh->deform, *pose, object->buffers); }));
        addLayerStages({.scene = {scene, object->buffers},
                        .grid = m_grid,
                        .sum_shift = sum_shift,
                        .layer = *object->layer,
                        .reports = m_reports,
                        .report = static_cast<std::uint32_t>(report % m_reports.count())},
                       stages);
        // In the frame that writes the report, or one after it.
        stages.push_back(
            wholeStage("await a report", 1,
                       [this, object, report](vk::FrameGraph&) {
                           m_pending.push_back({m_deletion_queue.frame(), object, report, object->capacities});
                       }));
        object->voxelized = object->version;
        voxelized.push_back(id);
    }
    return voxelized;
}

void DynamicObjects::forgetLayers(std::span<const DynamicObjectId> objects)
{
    for (const DynamicObjectId id : objects)
    {
        if (const auto found = m_objects.find(id); found != m_objects.end())
        {
            found->second->voxelized = 0;
        }
    }
}

void DynamicObjects::forgetLayers()
{
    for (const auto& [id, object] : m_objects)
    {
        object->voxelized = 0;
    }
}

// Reads the report of a layer. A layer that failed is dropped, and its capacities grow. Returns whether that happened.
bool DynamicObjects::learn(const PendingLayer& pending)
{
    Object& object = *pending.object;
    if (object.capacities != pending.capacities)
    {
        return false; // larger already
    }
    const gpu::LayerCounters counters = m_reports.mappedData()[pending.report % m_reports.count()];
    object.bins = counters.bins;
    if (counters.failed == 0)
    {
        return false;
    }
    object.is_hopeless = pending.capacities.voxelize.uncountable(counters.bins) != nullptr;
    if (!object.is_hopeless)
    {
        object.capacities = pending.capacities.grownFor(counters);
    }
    dropLayer(object);
    return true;
}

void DynamicObjects::frameDone(std::uint64_t frame)
{
    while (!m_pending.empty() && m_pending.front().frame <= frame)
    {
        m_has_failed = learn(m_pending.front()) || m_has_failed;
        m_pending.pop_front();
    }
}

void DynamicObjects::frameLost()
{
    std::erase_if(m_pending, [&](const PendingLayer& pending) { return pending.frame == m_deletion_queue.frame(); });
    if (!m_pending.empty())
    {
        m_report_count = m_pending.back().report + 1; // the lost ones are not awaited
    }
    forgetLayers();
}

std::map<std::string, std::uint64_t> DynamicObjects::droppedTriangles()
{
    std::map<std::string, std::uint64_t> dropped;
    for (const auto& [id, object] : m_objects)
    {
        for (const auto& [reason, count] : zvo::droppedTriangles(object->bins))
        {
            dropped[reason] += count;
        }
    }
    return dropped;
}

} // namespace zvo
