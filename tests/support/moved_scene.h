// SPDX-License-Identifier: MIT
// Moving scenes on the device, and the octrees that are built of them.
#pragma once

#include "core/base/grid.h"
#include "core/deform/deform_mesh.h"
#include "core/deform/dynamic_object.h"
#include "core/scene/animation.h"
#include "core/scene/scene.h"
#include "core/upload/gpu_scene.h"
#include "vk/headless.h"
#include "zvo/types.h"

#include <cstdint>
#include <map>
#include <random>
#include <string>
#include <utility>

namespace zvo::test
{

/// The contents of an octree, for comparisons.
struct Made
{
    std::string sha;
    std::map<std::string, std::uint64_t> dropped;
    std::uint32_t voxel_count = 0;
};

/// A grid around mixedScene().
constexpr Grid kGrid{.origin = glm::vec3(-4.0F), .voxel_size = 0.125F, .depth = 6};

/// The octree of scene in kGrid.
Made makeOctree(vk::HeadlessDevice& device, const PosedGpuScene& scene, Coverage coverage = Coverage::Thin);

/// A scene on the device with the buffers that move it.
class MovedScene
{
public:
    MovedScene(vk::HeadlessDevice& device, const Scene& scene)
        : m_device(device), m_uploaded(uploadScene(device, scene, true)), m_mesh(uploadDeformMesh(device, scene)),
          m_buffers(makeDynamicObject(device, planDynamicObject(scene, m_mesh), m_uploaded, m_mesh))
    {
    }

    void setPose(const Pose& pose)
    {
        m_device.run([&](vk::FrameGraph& graph) { zvo::setPose(graph, m_mesh, pose, m_buffers); });
    }

    Made make(Coverage coverage = Coverage::Thin)
    {
        return test::makeOctree(m_device, {m_uploaded, m_buffers}, coverage);
    }

    [[nodiscard]] const GpuScene& uploaded() const { return m_uploaded; }
    [[nodiscard]] const DeformMesh& mesh() const { return m_mesh; }
    [[nodiscard]] DynamicObjectBuffers& buffers() { return m_buffers; }

private:
    vk::HeadlessDevice& m_device;
    GpuScene m_uploaded;
    DeformMesh m_mesh;
    DynamicObjectBuffers m_buffers;
};

/// Uploads scene anew to the device that tests share, and builds an octree of it.
Made makeAnew(const Scene& scene, Coverage coverage = Coverage::Thin);

/// Expects, with both coverages, that object in pose gives the same bytes as the posed scene uploaded anew. Returns the
/// number of voxels.
std::uint32_t expectEqualsPosed(MovedScene& object, const Scene& scene, const Pose& pose);

/// A scene with instances of all kinds, rigid ones among them, and a pose of it.
std::pair<Scene, Pose> mixedScene(std::mt19937& random);

} // namespace zvo::test
