// SPDX-License-Identifier: MIT
// Morph targets and skins on the device: the deforming parts of a scene, a pose of them, and the pass that makes the
// deformed vertices of both.
#pragma once

#include "core/scene/scene.h"
#include "deform/deform.h"
#include "vk/device.h"
#include "vk/frame_graph.h"
#include "vk/uploader.h"

#include <array>
#include <cstdint>
#include <vector>

namespace zvo
{

struct Pose;

/// What the deforming instances of a scene need on the device and no pose changes. Instances of one primitive share its
/// data at rest, but each instance has vertices of its own in the output. Everything is empty for a scene without
/// deforming instances.
struct DeformMesh
{
    /// Where a vertex array starts in the outputs.
    struct Offsets
    {
        std::uint32_t first_position;
        std::uint32_t first_normal; // gpu::kAbsent where the primitive has none and no joints move it
    };

    /// An instance that deforms, and its offsets in the buffers of a pose.
    struct Part
    {
        std::uint32_t instance;     // in Scene::instances
        std::uint32_t joint_count;  // 0: no skin
        std::uint32_t first_joint;  // in PoseBuffers::joint_matrices
        std::uint32_t target_count; // 0: no morph targets
        std::uint32_t first_target; // in targets
        std::uint32_t first_term;   // in PoseBuffers::morph_terms: target_count of positions, as many of normals
    };

    /// Where the deltas of a morph target start; gpu::kAbsent where it has none.
    struct Target
    {
        std::uint32_t first_position;
        std::uint32_t first_normal;
    };

    /// The chunks of all items of one variant (gpu::kDeformMorphed and so on).
    struct ChunkRange
    {
        std::uint32_t first = 0;
        std::uint32_t count = 0;
    };

    vk::BufferOf<gpu::vec3> positions;                     // [vertices of deforming primitives] at rest
    vk::BufferOf<gpu::vec3> normals;                       // [those that have them or are skinned]; 0: there is none
    vk::BufferOf<gpu::JointBinding> bindings;              // [vertices of skinned primitives]
    vk::BufferOf<gpu::vec3> deltas;                        // of positions and normals, a target after the other
    vk::BufferOf<gpu::DeformItem> items;                   // [parts]
    vk::BufferOf<gpu::DeformChunk> chunks;                 // [vertices of each item / kDeformGroup, rounded up]
    std::array<ChunkRange, gpu::kDeformVariants> variants; // of chunks

    std::vector<Offsets>
        offsets; // [instances of the scene] where the outputs have their vertices, those that are rigid too
    std::vector<Part> parts;
    std::vector<Target> targets;      // of each deforming primitive
    std::uint32_t position_count = 0; // of the outputs
    std::uint32_t normal_count = 0;   // likewise
    std::uint32_t joint_count = 0;    // of a pose
    std::uint32_t term_count = 0;     // likewise

    [[nodiscard]] bool empty() const { return parts.empty(); }
};

/// Uploads the deforming parts of scene through `device`, whose uploads take effect as vk/uploader.h says. Throws
/// Error{Memory} when the device's budget does not suffice, and Error{Input} for a joint that does not exist or for
/// more of anything than 32-bit numbers count.
DeformMesh uploadDeformMesh(vk::Uploader& device, const Scene& scene);

/// A pose on the device, and the host's copies from which it is written.
struct PoseBuffers
{
    PoseBuffers() = default;

    /// Throws Error{Memory} when the device's budget does not suffice.
    PoseBuffers(vk::Device& device, const DeformMesh& mesh);

    vk::BufferOf<gpu::mat4x3> joint_matrices;    // [mesh.joint_count]
    vk::BufferOf<gpu::MorphTerm> morph_terms;    // [mesh.term_count]
    vk::BufferOf<gpu::MorphCounts> morph_counts; // [parts] where any part has morph targets

    std::vector<gpu::mat4x3> host_joint_matrices;
    std::vector<gpu::MorphTerm> host_morph_terms;
    std::vector<gpu::MorphCounts> host_morph_counts;

    /// Bytes on the device that a pose of mesh takes.
    static std::uint64_t bytesOf(const DeformMesh& mesh);
};

/// Throws Error{Usage} when the numbers of joint matrices and morph weights in pose differ from those of mesh's scene.
void checkPose(const DeformMesh& mesh, const Pose& pose);

/// Records the writing of pose to buffers. The values travel inside the command buffer: nothing is allocated and
/// nothing waits. Throws Error{Usage} when pose does not fit the scene of mesh.
void updatePose(vk::FrameGraph& graph, const DeformMesh& mesh, const Pose& pose, PoseBuffers& buffers);

/// Records the pass that writes the vertices of all deforming instances to positions [mesh.position_count] and normals
/// [mesh.normal_count]. Vertices of other instances stay as they are. Cost: vertices times the morph targets whose
/// weights are not 0.
void deform(vk::FrameGraph& graph, const DeformMesh& mesh, const PoseBuffers& pose, vk::BufferOf<gpu::vec3>& positions,
            vk::BufferOf<gpu::vec3>& normals);

} // namespace zvo
