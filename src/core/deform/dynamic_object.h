// SPDX-License-Identifier: MIT
// A scene that moves: which of its data change from frame to frame, and how they get to the device without waiting.
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

/// The data of an uploaded scene that change when it moves. The rest is shared with the GpuScene, which must outlive
/// this struct. The device writes these buffers in the order of the queue. So frames in flight may share them if each
/// frame begins behind a barrier that covers the reads of the frame before; otherwise each frame needs buffers of its
/// own.
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

/// What is known beforehand of the buffers of a dynamic object, beside its GpuScene and DeformMesh.
struct DynamicObjectPlan
{
    /// Vertices of a rigid primitive that are copied once from the GpuScene; all numbers count vertices.
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

/// mesh: the DeformMesh of the same scene.
DynamicObjectPlan planDynamicObject(const Scene& scene, const DeformMesh& mesh);

/// Makes the buffers of a dynamic object in its pose at rest. Vertices that deform are undefined until setPose(). plan,
/// uploaded and mesh must belong to one scene. Data are uploaded through `device`, whose uploads take effect as
/// vk/uploader.h says. Throws Error{Memory} when the device's budget does not suffice.
DynamicObjectBuffers makeDynamicObject(vk::Uploader& device, const DynamicObjectPlan& plan, const GpuScene& uploaded,
                                       const DeformMesh& mesh);

/// Records what puts the dynamic object into pose: it writes the draws and, where the object deforms, the vertices. The
/// values travel inside the command buffer: nothing is allocated and nothing waits. Throws Error{Usage} when pose does
/// not fit the dynamic object's scene.
void setPose(vk::FrameGraph& graph, const DeformMesh& mesh, const Pose& pose, DynamicObjectBuffers& object);

/// The same for a dynamic object without deforming instances. transforms: [instances], object to world.
void setPose(vk::FrameGraph& graph, std::span<const glm::mat4> transforms, DynamicObjectBuffers& object);

/// The scene that a voxelization walks: a GpuScene as it was uploaded, or as setPose() has posed it with the buffers of
/// a dynamic object. Keeps references to both.
class PosedGpuScene
{
public:
    PosedGpuScene(const GpuScene& scene) : m_scene(scene) {} // implicit conversion: the scene as it was uploaded
    PosedGpuScene(const GpuScene& scene, const DynamicObjectBuffers& object) : m_scene(scene), m_object(&object) {}

    /// The uploaded scene: materials, textures, chunks, triangles, and what is known of the pose at rest.
    [[nodiscard]] const GpuScene& uploaded() const { return m_scene; }

    /// Declares that pass reads the scene and the buffers that change. Returns the address of the scene's table of
    /// buffers.
    gpu::ConstPtr<gpu::SceneView> read(vk::AnyPass& pass) const;

private:
    const GpuScene& m_scene;
    const DynamicObjectBuffers* m_object = nullptr;
};

} // namespace zvo
