// SPDX-License-Identifier: MIT
#include "core/deform/mover.h"

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

// Primitives of rigid instances stand in the mover's arrays once each.
std::vector<MoverPlan::VertexCopy> rigidCopies(const Scene& scene, const DeformMesh& mesh)
{
    const std::vector<PrimitivePlace> places = primitivePlaces(scene);
    std::vector<bool> copied(scene.primitives.size(), false);
    std::vector<MoverPlan::VertexCopy> copies;
    for (std::size_t i = 0; i < scene.instances.size(); ++i)
    {
        const Instance& instance = scene.instances[i];
        const Primitive& primitive = scene.primitives[instance.primitive];
        if (isDeformed(primitive, instance) || copied[instance.primitive])
        {
            continue;
        }
        copied[instance.primitive] = true;
        const PrimitivePlace& from = places[instance.primitive];
        copies.push_back({from.first_vertex, mesh.places[i].first_position,
                          static_cast<std::uint32_t>(primitive.positions.size()), from.first_normal,
                          mesh.places[i].first_normal, static_cast<std::uint32_t>(primitive.normals.size())});
    }
    return copies;
}

void copyVertices(vk::FrameGraph& graph, const std::vector<MoverPlan::VertexCopy>& copies, const GpuScene& uploaded,
                  MoverBuffers& mover)
{
    constexpr std::uint64_t kBytes = sizeof(gpu::vec3);
    for (const MoverPlan::VertexCopy& copy : copies)
    {
        graph.copy(uploaded.positions, copy.first_position_from * kBytes, mover.positions,
                   copy.first_position_to * kBytes, copy.position_count * kBytes);
        if (copy.normal_count != 0)
        {
            graph.copy(uploaded.normals, copy.first_normal_from * kBytes, mover.normals, copy.first_normal_to * kBytes,
                       copy.normal_count * kBytes);
        }
    }
}

} // namespace

MoverPlan planMover(const Scene& scene, const DeformMesh& mesh)
{
    MoverPlan plan;
    plan.draws = makeDraws(scene);
    for (std::size_t i = 0; i < mesh.places.size(); ++i)
    {
        plan.draws[i].first_vertex = mesh.places[i].first_position;
        plan.draws[i].first_normal = mesh.places[i].first_normal;
    }
    if (!mesh.empty())
    {
        plan.rigid_copies = rigidCopies(scene, mesh);
    }
    return plan;
}

MoverBuffers makeMover(vk::Uploader& device, const MoverPlan& plan, const GpuScene& uploaded, const DeformMesh& mesh)
{
    device.device().memory().require(plan.draws.size() * sizeof(gpu::Draw) +
                                         (std::uint64_t{mesh.position_count} + mesh.normal_count) * sizeof(gpu::vec3) +
                                         sizeof(gpu::SceneView) + PoseBuffers::bytesOf(mesh),
                                     "a moving object");
    MoverBuffers mover;
    mover.host_draws = plan.draws;
    mover.draws = device.makeBuffer("mover/draws", std::span<const gpu::Draw>(mover.host_draws));
    gpu::SceneView view = sceneView(uploaded);
    view.draws = {mover.draws.address()};
    if (!mesh.empty())
    {
        mover.positions = {device.device(), "mover/positions", mesh.position_count};
        mover.normals = {device.device(), "mover/normals", mesh.normal_count};
        mover.pose = {device.device(), mesh};
        view.positions = {mover.positions.address()};
        view.normals = {mover.normals.address()};
    }
    mover.view = device.makeBuffer("mover/view", std::span<const gpu::SceneView>(&view, 1));
    if (!mesh.empty())
    {
        device.perform([&](vk::FrameGraph& graph, vk::Retired&)
                       { copyVertices(graph, plan.rigid_copies, uploaded, mover); });
    }
    return mover;
}

void placeMover(vk::FrameGraph& graph, std::span<const glm::mat4> transforms, MoverBuffers& mover)
{
    if (transforms.size() != mover.host_draws.size())
    {
        throw Error(ErrorCode::Usage, fmt::format("{} transforms for a moving object of {} instances; give one each",
                                                  transforms.size(), mover.host_draws.size()));
    }
    placeDraws(mover.host_draws, transforms);
    graph.update(mover.draws, 0, mover.host_draws);
}

void placeMover(vk::FrameGraph& graph, const DeformMesh& mesh, const Pose& pose, MoverBuffers& mover)
{
    placeMover(graph, pose.transforms, mover);
    if (!mesh.empty())
    {
        updatePose(graph, mesh, pose, mover.pose);
        deform(graph, mesh, mover.pose, mover.positions, mover.normals);
    }
}

gpu::ConstPtr<gpu::SceneView> PlacedScene::read(vk::AnyPass& pass) const
{
    if (m_mover == nullptr)
    {
        return pass.read(m_scene.view);
    }
    pass.read(m_mover->draws);
    pass.read(m_mover->positions);
    pass.read(m_mover->normals);
    return pass.read(m_mover->view);
}

} // namespace zvo
