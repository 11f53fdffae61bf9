// SPDX-License-Identifier: MIT
// A scene that moves: what of it changes from frame to frame, and how that gets to the device without waiting.
#pragma once

#include "core/deform/deform_mesh.h"
#include "core/scene/scene.h"
#include "core/upload/gpu_scene.h"
#include "vk/device.h"
#include "vk/frame_graph.h"
#include "vk/uploader.h"

#include <span>
#include <vector>

namespace zvo
{

struct Pose;

/// What changes of an uploaded scene when it moves; everything else it shares with the GpuScene, which must outlive it.
/// The device writes these buffers in the order of the queue. So frames in flight may share them if each begins behind
/// a barrier that covers the reads of the one before; otherwise, each has its own.
struct DynamicObjectBuffers
{
    vk::BufferOf<gpu::Draw> draws;     // [instances]
    vk::BufferOf<gpu::vec3> positions; // [mesh.position_count] of rigid and of deforming instances; empty where
                                       // nothing deforms: then those of the GpuScene count
    vk::BufferOf<gpu::vec3> normals;   // [mesh.normal_count] likewise
    vk::BufferOf<gpu::SceneView> view; // [1] never changes
    PoseBuffers pose;
    std::vector<gpu::Draw> host_draws; // what draws is written from
};

/// What dynamic objects of a scene begin with, beside its GpuScene and DeformMesh.
struct DynamicObjectPlan
{
    /// A primitive of rigid instances, by numbers of vertices.
    struct VertexCopy
    {
        std::uint32_t first_position_from = 0; // in the GpuScene
        std::uint32_t first_position_to = 0;   // in the dynamic object
        std::uint32_t position_count = 0;
        std::uint32_t first_normal_from = 0;
        std::uint32_t first_normal_to = 0;
        std::uint32_t normal_count = 0;
    };
    std::vector<gpu::Draw> draws;         // [instances] at rest
    std::vector<VertexCopy> rigid_copies; // empty where nothing deforms
};

/// mesh: made of scene.
DynamicObjectPlan planDynamicObject(const Scene& scene, const DeformMesh& mesh);

/// The buffers of a dynamic object in its pose at rest; vertices that deform are undefined until setPose. plan,
/// uploaded and mesh: made of one scene. By way of device: done when that says (vk/uploader.h). Throws Error{Memory}
/// when the device's budget does not suffice.
DynamicObjectBuffers makeDynamicObject(vk::Uploader& device, const DynamicObjectPlan& plan, const GpuScene& uploaded,
                                       const DeformMesh& mesh);

/// Records what puts the dynamic object into pose: its draws and, where it deforms, its vertices. Values travel inside
/// the command buffer; nothing is allocated and nothing waits. Throws Error{Usage} when pose does not fit the dynamic
/// object's scene.
void setPose(vk::FrameGraph& graph, const DeformMesh& mesh, const Pose& pose, DynamicObjectBuffers& object);

/// The same for a dynamic object of which nothing deforms: transforms [instances], object to world.
void setPose(vk::FrameGraph& graph, std::span<const glm::mat4> transforms, DynamicObjectBuffers& object);

/// What a voxelization walks: a scene as it was uploaded, or in the pose of a dynamic object. Refers to both.
class PosedGpuScene
{
public:
    PosedGpuScene(const GpuScene& scene) : m_scene(scene) {} // implicit: a scene stands where it is
    PosedGpuScene(const GpuScene& scene, const DynamicObjectBuffers& object) : m_scene(scene), m_object(&object) {}

    /// Materials, textures, chunks and triangles, and what is known of them at rest.
    [[nodiscard]] const GpuScene& uploaded() const { return m_scene; }

    /// Declares that pass reads the scene, and everything of it that changes. Returns the address of the table.
    gpu::ConstPtr<gpu::SceneView> read(vk::AnyPass& pass) const;

private:
    const GpuScene& m_scene;
    const DynamicObjectBuffers* m_object = nullptr;
};

} // namespace zvo
