// SPDX-License-Identifier: MIT
#include "core/deform/dynamic_object.h"

#include "core/scene/animation.h"
#include "core/scene/deform.h"
#include "core/upload/draws.h"
#include "zvo/error.h"

#include <fmt/format.h>

#include <cstdint>

namespace zvo
{

namespace
{

// Primitives of rigid instances stand in the dynamic object's arrays once each.
std::vector<DynamicObjectPlan::VertexCopy> rigidCopies(const Scene& scene, const DeformMesh& mesh)
{
    const std::vector<PrimitiveOffsets> offsets = primitiveOffsets(scene);
    std::vector<bool> copied(scene.primitives.size(), false);
    std::vector<DynamicObjectPlan::VertexCopy> copies;
    for (std::size_t i = 0; i < scene.instances.size(); ++i)
    {
        const Instance& instance = scene.instances[i];
        const Primitive& primitive = scene.primitives[instance.primitive];
        if (isDeformed(primitive, instance) || copied[instance.primitive])
        {
            continue;
        }
        copied[instance.primitive] = true;
        const PrimitiveOffsets& from = offsets[instance.primitive];
        copies.push_back({from.first_vertex, mesh.offsets[i].first_position,
                          static_cast<std::uint32_t>(primitive.positions.size()), from.first_normal,
                          mesh.offsets[i].first_normal, static_cast<std::uint32_t>(primitive.normals.size())});
    }
    return copies;
}

void copyVertices(vk::FrameGraph& graph, const std::vector<DynamicObjectPlan::VertexCopy>& copies,
                  const GpuScene& uploaded, DynamicObjectBuffers& object)
{
    constexpr std::uint64_t kBytes = sizeof(gpu::vec3);
    for (const DynamicObjectPlan::VertexCopy& copy : copies)
    {
        graph.copy(uploaded.positions, copy.first_position_from * kBytes, object.positions,
                   copy.first_position_to * kBytes, copy.position_count * kBytes);
        if (copy.normal_count != 0)
        {
            graph.copy(uploaded.normals, copy.first_normal_from * kBytes, object.normals, copy.first_normal_to * kBytes,
                       copy.normal_count * kBytes);
        }
    }
}

} // namespace

DynamicObjectPlan planDynamicObject(const Scene& scene, const DeformMesh& mesh)
{
    DynamicObjectPlan plan;
    plan.draws = makeDraws(scene);
    for (std::size_t i = 0; i < mesh.offsets.size(); ++i)
    {
        plan.draws[i].first_vertex = mesh.offsets[i].first_position;
        plan.draws[i].first_normal = mesh.offsets[i].first_normal;
    }
    if (!mesh.empty())
    {
        plan.rigid_copies = rigidCopies(scene, mesh);
    }
    return plan;
}

DynamicObjectBuffers makeDynamicObject(vk::Uploader& device, const DynamicObjectPlan& plan, const GpuScene& uploaded,
                                       const DeformMesh& mesh)
{
    device.device().memory().require(plan.draws.size() * sizeof(gpu::Draw) +
                                         (std::uint64_t{mesh.position_count} + mesh.normal_count) * sizeof(gpu::vec3) +
                                         sizeof(gpu::SceneView) + PoseBuffers::bytesOf(mesh),
                                     "a moving object");
    DynamicObjectBuffers object;
    object.host_draws = plan.draws;
    object.draws = device.makeBuffer("mover/draws", std::span<const gpu::Draw>(object.host_draws));
    gpu::SceneView view = sceneView(uploaded);
    view.draws = {object.draws.address()};
    if (!mesh.empty())
    {
        object.positions = {device.device(), "mover/positions", mesh.position_count};
        object.normals = {device.device(), "mover/normals", mesh.normal_count};
        object.pose = {device.device(), mesh};
        view.positions = {object.positions.address()};
        view.normals = {object.normals.address()};
    }
    object.view = device.makeBuffer("mover/view", std::span<const gpu::SceneView>(&view, 1));
    if (!mesh.empty())
    {
        device.perform([&](vk::FrameGraph& graph, vk::DeletionQueue&)
                       { copyVertices(graph, plan.rigid_copies, uploaded, object); });
    }
    return object;
}

void setPose(vk::FrameGraph& graph, std::span<const glm::mat4> transforms, DynamicObjectBuffers& object)
{
    if (transforms.size() != object.host_draws.size())
    {
        throw Error(ErrorCode::Usage, fmt::format("{} transforms for a moving object of {} instances; give one each",
                                                  transforms.size(), object.host_draws.size()));
    }
    setTransforms(object.host_draws, transforms);
    graph.update(object.draws, 0, object.host_draws);
}

void setPose(vk::FrameGraph& graph, const DeformMesh& mesh, const Pose& pose, DynamicObjectBuffers& object)
{
    setPose(graph, pose.transforms, object);
    if (!mesh.empty())
    {
        updatePose(graph, mesh, pose, object.pose);
        deform(graph, mesh, object.pose, object.positions, object.normals);
    }
}

gpu::ConstPtr<gpu::SceneView> PosedGpuScene::read(vk::AnyPass& pass) const
{
    const bool deforms = m_object != nullptr && m_object->positions.count() != 0;
    pass.reach("draws", m_object != nullptr ? m_object->draws : m_scene.draws);
    pass.reach("positions", deforms ? m_object->positions : m_scene.positions);
    pass.reach("normals", deforms ? m_object->normals : m_scene.normals);
    pass.reach("triangles", m_scene.triangles);
    pass.reach("uvs", m_scene.uvs);
    pass.reach("colors", m_scene.colors);
    pass.reach("materials", m_scene.materials);
    pass.reach("textures", m_scene.textures);
    pass.reach("levels", m_scene.levels);
    pass.reach("texels", m_scene.texels);
    if (m_object == nullptr)
    {
        return pass.read(m_scene.view);
    }
    pass.read(m_object->draws);
    pass.read(m_object->positions);
    pass.read(m_object->normals);
    return pass.read(m_object->view);
}

} // namespace zvo
