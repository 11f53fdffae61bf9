// SPDX-License-Identifier: MIT
#include "core/mover.h"

#include "core/animation.h"
#include "core/deform.h"
#include "core/draws.h"
#include "zvo/error.h"

#include <fmt/format.h>

#include <cstdint>

namespace zvo
{

namespace
{

// The primitives of rigid instances, out of the GpuScene to where the mover has them.
void copyRigidVertices(vk::FrameGraph& graph, const Scene& scene, const GpuScene& uploaded, const DeformMesh& mesh,
                       MoverBuffers& mover)
{
    const std::vector<PrimitivePlace> places = primitivePlaces(scene);
    std::vector<bool> copied(scene.primitives.size(), false);
    for (std::size_t i = 0; i < scene.instances.size(); ++i)
    {
        const Instance& instance = scene.instances[i];
        const Primitive& primitive = scene.primitives[instance.primitive];
        const auto [first_position, first_normal] = mesh.places[i];
        if (isDeformed(primitive, instance) || copied[instance.primitive])
        {
            continue;
        }
        copied[instance.primitive] = true;
        constexpr std::uint64_t kBytes = sizeof(gpu::vec3);
        const PrimitivePlace& from = places[instance.primitive];
        graph.copy(uploaded.positions, from.first_vertex * kBytes, mover.positions, first_position * kBytes,
                   primitive.positions.size() * kBytes);
        if (!primitive.normals.empty())
        {
            graph.copy(uploaded.normals, from.first_normal * kBytes, mover.normals, first_normal * kBytes,
                       primitive.normals.size() * kBytes);
        }
    }
}

} // namespace

MoverBuffers makeMover(vk::Uploader& device, const Scene& scene, const GpuScene& uploaded, const DeformMesh& mesh)
{
    MoverBuffers mover;
    mover.host_draws = makeDraws(scene);
    for (std::size_t i = 0; i < mesh.places.size(); ++i)
    {
        mover.host_draws[i].first_vertex = mesh.places[i].first_position;
        mover.host_draws[i].first_normal = mesh.places[i].first_normal;
    }
    device.device().memory().require(mover.host_draws.size() * sizeof(gpu::Draw) +
                                         (std::uint64_t{mesh.position_count} + mesh.normal_count) * sizeof(gpu::vec3) +
                                         sizeof(gpu::SceneView) + PoseBuffers::bytesOf(mesh),
                                     "a moving object");
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
                       { copyRigidVertices(graph, scene, uploaded, mesh, mover); });
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

gpu::ConstPtr<gpu::SceneView> PlacedScene::read(vk::Pass& pass) const
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
