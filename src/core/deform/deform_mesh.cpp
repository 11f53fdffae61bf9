// SPDX-License-Identifier: MIT
#include "core/deform/deform_mesh.h"

#include "core/base/divide_up.h"
#include "core/scene/animation.h"
#include "core/scene/deform.h"
#include "zvo/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <limits>
#include <span>
#include <string>

namespace zvo
{

namespace
{

// Kernels index with signed 32-bit numbers.
std::uint32_t checkedIndex(std::uint64_t count, const char* what)
{
    if (count > std::numeric_limits<std::int32_t>::max())
    {
        throw Error(ErrorCode::Input, std::string("the scene has too many ") + what + " that deform; split it");
    }
    return static_cast<std::uint32_t>(count);
}

// Joints that all skins have on which instances of each primitive hang; kNone for those that hang on none.
std::vector<std::uint32_t> jointLimits(const Scene& scene)
{
    std::vector<std::uint32_t> limits(scene.primitives.size(), kNone);
    for (const Instance& instance : scene.instances)
    {
        if (instance.skin != kNone)
        {
            const std::size_t joint_count = scene.skins[instance.skin].joints.size();
            std::uint32_t& limit = limits[instance.primitive];
            limit = static_cast<std::uint32_t>(std::min<std::size_t>(limit, joint_count));
        }
    }
    return limits;
}

// Puts a DeformMesh together on the host.
class MeshStaging
{
public:
    explicit MeshStaging(const Scene& scene) : m_scene(scene), m_joint_limits(jointLimits(scene))
    {
        const auto deformed = [&](const Instance& instance)
        { return isDeformed(scene.primitives[instance.primitive], instance); };
        if (std::none_of(scene.instances.begin(), scene.instances.end(), deformed))
        {
            return;
        }
        m_mesh.offsets.resize(scene.instances.size());
        m_rest.resize(scene.primitives.size());
        std::vector<DeformMesh::Offsets> rigid(scene.primitives.size(), {gpu::kAbsent, gpu::kAbsent});
        for (std::size_t i = 0; i < scene.instances.size(); ++i)
        {
            const std::uint32_t number = scene.instances[i].primitive;
            const Primitive& primitive = scene.primitives[number];
            if (deformed(scene.instances[i]))
            {
                m_mesh.offsets[i] = takeOffsets(primitive, isSkinned(scene.instances[i]));
                addPart(static_cast<std::uint32_t>(i));
                continue;
            }
            if (rigid[number].first_position == gpu::kAbsent)
            {
                rigid[number] = takeOffsets(primitive, false);
            }
            m_mesh.offsets[i] = rigid[number];
        }
        for (std::uint32_t variant = 0; variant < gpu::kDeformVariants; ++variant)
        {
            const std::vector<gpu::DeformChunk>& chunks = m_variant_chunks[variant];
            m_mesh.variants[variant] = {checkedIndex(m_chunks.size(), "vertices"),
                                        static_cast<std::uint32_t>(chunks.size())};
            m_chunks.insert(m_chunks.end(), chunks.begin(), chunks.end());
        }
    }

    DeformMesh upload(vk::Uploader& device)
    {
        device.device().memory().require(
            std::as_bytes(std::span(m_positions)).size() + std::as_bytes(std::span(m_normals)).size() +
                std::as_bytes(std::span(m_bindings)).size() + std::as_bytes(std::span(m_deltas)).size() +
                std::as_bytes(std::span(m_items)).size() + std::as_bytes(std::span(m_chunks)).size(),
            "what deforms in the scene");
        m_mesh.positions = device.makeBuffer("deform/positions", std::span<const gpu::vec3>(m_positions));
        m_mesh.normals = device.makeBuffer("deform/normals", std::span<const gpu::vec3>(m_normals));
        m_mesh.bindings = device.makeBuffer("deform/bindings", std::span<const gpu::JointBinding>(m_bindings));
        m_mesh.deltas = device.makeBuffer("deform/deltas", std::span<const gpu::vec3>(m_deltas));
        m_mesh.items = device.makeBuffer("deform/items", std::span<const gpu::DeformItem>(m_items));
        m_mesh.chunks = device.makeBuffer("deform/chunks", std::span<const gpu::DeformChunk>(m_chunks));
        return std::move(m_mesh);
    }

private:
    // Where a deforming primitive is at rest; kAbsent: it has not been added.
    struct RestOffsets
    {
        std::uint32_t first_position = gpu::kAbsent;
        std::uint32_t first_normal = gpu::kAbsent;
        std::uint32_t first_binding = gpu::kAbsent;
        std::uint32_t first_target = gpu::kAbsent;
    };

    [[nodiscard]] bool isSkinned(const Instance& instance) const
    {
        return instance.skin != kNone && !m_scene.primitives[instance.primitive].joints.empty();
    }

    DeformMesh::Offsets takeOffsets(const Primitive& primitive, bool is_skinned)
    {
        const bool has_normals = is_skinned || !primitive.normals.empty();
        const DeformMesh::Offsets offsets = {m_mesh.position_count, has_normals ? m_mesh.normal_count : gpu::kAbsent};
        const auto grow = [](std::uint32_t count, std::size_t more)
        { return checkedIndex(std::uint64_t{count} + more, "vertices"); };
        m_mesh.position_count = grow(m_mesh.position_count, primitive.positions.size());
        m_mesh.normal_count = grow(m_mesh.normal_count, has_normals ? primitive.positions.size() : 0);
        return offsets;
    }

    static std::uint32_t addVectors(std::vector<gpu::vec3>& into, const std::vector<glm::vec3>& values,
                                    const char* what)
    {
        const auto first = static_cast<std::uint32_t>(into.size());
        checkedIndex(into.size() + values.size(), what);
        for (const glm::vec3& value : values)
        {
            into.push_back(withoutTiny(value));
        }
        return values.empty() ? gpu::kAbsent : first;
    }

    RestOffsets addRest(std::uint32_t number)
    {
        const Primitive& primitive = m_scene.primitives[number];
        RestOffsets offsets;
        offsets.first_position = static_cast<std::uint32_t>(m_positions.size());
        addVectors(m_positions, primitive.positions, "vertices");
        offsets.first_normal = addVectors(m_normals, primitive.normals, "normals");
        offsets.first_binding = static_cast<std::uint32_t>(m_bindings.size());
        if (m_joint_limits[number] != kNone)
        {
            if (primitive.normals.empty())
            {
                const std::vector<glm::vec3> none(primitive.positions.size(), glm::vec3(0.0F));
                offsets.first_normal = addVectors(m_normals, none, "normals");
            }
            for (std::size_t vertex = 0; vertex < primitive.joints.size(); ++vertex)
            {
                const auto [joints, weights] = bindingOf(primitive, vertex, m_joint_limits[number]);
                m_bindings.push_back({{joints.x | joints.y << 16, joints.z | joints.w << 16}, weights});
            }
        }
        if (primitive.morph_targets.size() > gpu::kMorphTargetsMax)
        {
            throw Error(ErrorCode::Input, fmt::format("a mesh has {} morph targets, more than {}; leave some out",
                                                      primitive.morph_targets.size(), gpu::kMorphTargetsMax));
        }
        offsets.first_target = static_cast<std::uint32_t>(m_mesh.targets.size());
        for (const MorphTarget& target : primitive.morph_targets)
        {
            assert(target.positions.empty() || target.positions.size() == primitive.positions.size());
            assert(target.normals.empty() || target.normals.size() == primitive.positions.size());
            const std::uint32_t first_position = addVectors(m_deltas, target.positions, "vertices of morph targets");
            const std::uint32_t first_normal = primitive.normals.empty()
                                                   ? gpu::kAbsent
                                                   : addVectors(m_deltas, target.normals, "normals of morph targets");
            m_mesh.targets.push_back({first_position, first_normal});
        }
        return offsets;
    }

    void addPart(std::uint32_t instance_number)
    {
        const Instance& instance = m_scene.instances[instance_number];
        const Primitive& primitive = m_scene.primitives[instance.primitive];
        RestOffsets& rest = m_rest[instance.primitive];
        if (rest.first_position == gpu::kAbsent)
        {
            rest = addRest(instance.primitive);
        }
        const bool skinned = isSkinned(instance);
        DeformMesh::Part part{};
        part.instance = instance_number;
        part.joint_count = skinned ? checkedIndex(m_scene.skins[instance.skin].joints.size(), "joints") : 0;
        part.first_joint = m_mesh.joint_count;
        part.target_count = static_cast<std::uint32_t>(primitive.morph_targets.size());
        part.first_target = rest.first_target;
        part.first_term = m_mesh.term_count;
        m_mesh.joint_count = checkedIndex(std::uint64_t{part.first_joint} + part.joint_count, "joints");
        m_mesh.term_count = checkedIndex(std::uint64_t{part.first_term} + 2 * part.target_count, "morph targets");

        gpu::DeformItem item{};
        item.vertex_count = static_cast<std::uint32_t>(primitive.positions.size());
        item.first_position = rest.first_position;
        item.first_normal = rest.first_normal;
        item.first_binding = rest.first_binding;
        item.first_joint = part.first_joint;
        item.first_term = part.first_term;
        item.first_normal_term = part.first_term + part.target_count;
        item.first_out_position = m_mesh.offsets[instance_number].first_position;
        item.first_out_normal = m_mesh.offsets[instance_number].first_normal;
        const std::uint32_t variant = (part.target_count != 0 ? gpu::kDeformMorphed : 0) |
                                      (skinned ? gpu::kDeformSkinned : 0) |
                                      (skinned || !primitive.normals.empty() ? gpu::kDeformNormals : 0);
        for (std::uint32_t first = 0; first < item.vertex_count; first += gpu::kDeformGroup)
        {
            m_variant_chunks[variant].push_back({static_cast<std::uint32_t>(m_items.size()), first});
        }
        m_items.push_back(item);
        m_mesh.parts.push_back(part);
    }

    const Scene& m_scene;
    std::vector<std::uint32_t> m_joint_limits; // [primitives]
    DeformMesh m_mesh;
    std::vector<RestOffsets> m_rest; // [primitives]
    std::vector<gpu::vec3> m_positions;
    std::vector<gpu::vec3> m_normals;
    std::vector<gpu::JointBinding> m_bindings;
    std::vector<gpu::vec3> m_deltas;
    std::vector<gpu::DeformItem> m_items;
    std::vector<gpu::DeformChunk> m_chunks;
    std::array<std::vector<gpu::DeformChunk>, gpu::kDeformVariants> m_variant_chunks;
};

[[noreturn]] void throwForeignPose(const DeformMesh::Part& part, const char* what, std::size_t count,
                                   std::uint32_t expected)
{
    throw Error(ErrorCode::Usage, fmt::format("the pose has {} {} for instance {}, which has {}; make it of the scene "
                                              "that was uploaded",
                                              count, what, part.instance, expected));
}

bool anyMorphed(const DeformMesh& mesh)
{
    return mesh.term_count != 0;
}

// Writes the terms of one array of a part; returns how many.
std::uint32_t writeTerms(std::span<const DeformMesh::Target> targets, std::span<const float> weights,
                         std::uint32_t DeformMesh::Target::*first_delta, gpu::MorphTerm* terms)
{
    std::uint32_t count = 0;
    for (std::size_t i = 0; i < targets.size(); ++i)
    {
        const float weight = withoutTiny(weights[i]);
        if (targets[i].*first_delta != gpu::kAbsent && weight != 0.0F)
        {
            terms[count] = {targets[i].*first_delta, weight};
            ++count;
        }
    }
    return count;
}

} // namespace

DeformMesh uploadDeformMesh(vk::Uploader& device, const Scene& scene)
{
    return MeshStaging(scene).upload(device);
}

std::uint64_t PoseBuffers::bytesOf(const DeformMesh& mesh)
{
    return mesh.joint_count * sizeof(gpu::mat4x3) + mesh.term_count * sizeof(gpu::MorphTerm) +
           (anyMorphed(mesh) ? mesh.parts.size() * sizeof(gpu::MorphCounts) : 0);
}

PoseBuffers::PoseBuffers(vk::Device& device, const DeformMesh& mesh)
    : joint_matrices(device, "deform/joint_matrices", mesh.joint_count),
      morph_terms(device, "deform/morph_terms", mesh.term_count),
      morph_counts(device, "deform/morph_counts", anyMorphed(mesh) ? mesh.parts.size() : 0),
      host_joint_matrices(joint_matrices.count()), host_morph_terms(morph_terms.count()),
      host_morph_counts(morph_counts.count())
{
}

void checkPose(const DeformMesh& mesh, const Pose& pose)
{
    for (const DeformMesh::Part& part : mesh.parts)
    {
        const bool has_joints = part.joint_count != 0 && part.instance < pose.joint_matrices.size();
        const std::size_t joint_count = has_joints ? pose.joint_matrices[part.instance].size() : 0;
        const std::size_t weight_count =
            part.instance < pose.morph_weights.size() ? pose.morph_weights[part.instance].size() : 0;
        if (joint_count != part.joint_count)
        {
            throwForeignPose(part, "joint matrices", joint_count, part.joint_count);
        }
        if (weight_count != part.target_count)
        {
            throwForeignPose(part, "morph weights", weight_count, part.target_count);
        }
    }
}

void updatePose(vk::FrameGraph& graph, const DeformMesh& mesh, const Pose& pose, PoseBuffers& buffers)
{
    checkPose(mesh, pose);
    for (std::size_t i = 0; i < mesh.parts.size(); ++i)
    {
        const DeformMesh::Part& part = mesh.parts[i];
        for (std::size_t joint = 0; joint < part.joint_count; ++joint)
        {
            buffers.host_joint_matrices[part.first_joint + joint] =
                withoutTiny(pose.joint_matrices[part.instance][joint]);
        }
        if (part.target_count != 0)
        {
            const std::span targets = std::span(mesh.targets).subspan(part.first_target, part.target_count);
            gpu::MorphTerm* const terms = buffers.host_morph_terms.data() + part.first_term;
            const std::vector<float>& weights = pose.morph_weights[part.instance];
            buffers.host_morph_counts[i] = {
                writeTerms(targets, weights, &DeformMesh::Target::first_position, terms),
                writeTerms(targets, weights, &DeformMesh::Target::first_normal, terms + part.target_count)};
        }
    }
    graph.update(buffers.joint_matrices, 0, buffers.host_joint_matrices);
    graph.update(buffers.morph_terms, 0, buffers.host_morph_terms);
    graph.update(buffers.morph_counts, 0, buffers.host_morph_counts);
}

void deform(vk::FrameGraph& graph, const DeformMesh& mesh, const PoseBuffers& pose, vk::BufferOf<gpu::vec3>& positions,
            vk::BufferOf<gpu::vec3>& normals)
{
    assert(positions.count() >= mesh.position_count && normals.count() >= mesh.normal_count);
    for (std::uint32_t variant = 0; variant < gpu::kDeformVariants; ++variant)
    {
        const auto [first_chunk, chunk_count] = mesh.variants[variant];
        if (chunk_count == 0)
        {
            continue;
        }
        const auto has = [variant](std::uint32_t bit) { return (variant & bit) != 0; };
        vk::Pass pass = graph.addPass(gpu::deform::Vertices{.morphed = has(gpu::kDeformMorphed),
                                                            .skinned = has(gpu::kDeformSkinned),
                                                            .normals = has(gpu::kDeformNormals)});
        gpu::DeformParams params{};
        params.chunks = pass.read(mesh.chunks);
        params.items = pass.read(mesh.items);
        params.positions = pass.read(mesh.positions);
        params.normals = pass.read(mesh.normals);
        params.bindings = pass.read(mesh.bindings);
        params.deltas = pass.read(mesh.deltas);
        params.joint_matrices = pass.read(pose.joint_matrices);
        params.morph_terms = pass.read(pose.morph_terms);
        params.morph_counts = pass.read(pose.morph_counts);
        params.out_positions = {pass.write(positions).address}; // floats, written as bits
        params.out_normals = {pass.write(normals).address};
        params.first_chunk = first_chunk;
        params.chunk_count = chunk_count;
        pass.dispatch(std::uint64_t{chunk_count} * gpu::kDeformGroup, params);
    }
}

} // namespace zvo
