// SPDX-License-Identifier: MIT
#include "io/gltf/gltf_size.h"

#include "core/scene/scene.h"
#include "core/scene/scene_size.h"
#include "io/gltf/gltf_rig.h"

#include <algorithm>
#include <map>
#include <string>

namespace zvo
{

namespace
{

/// Elements of an accessor. 0 if there is none, or if its buffer view cannot hold that many; that is refused later.
double elementCount(const tinygltf::Model& model, int index)
{
    if (index < 0)
    {
        return 0;
    }
    const tinygltf::Accessor& accessor = model.accessors[index];
    const bool fits = accessor.bufferView < 0 || accessor.count <= model.bufferViews[accessor.bufferView].byteLength;
    return fits ? static_cast<double>(accessor.count) : 0;
}

SceneSize measureMesh(const tinygltf::Model& model, const tinygltf::Mesh& mesh)
{
    SceneSize size;
    size.instance_count = static_cast<double>(mesh.primitives.size());
    for (const tinygltf::Primitive& primitive : mesh.primitives)
    {
        const auto attribute_bytes = [&](const std::string& name, std::size_t element_bytes)
        {
            const auto attribute = primitive.attributes.find(name);
            const int accessor = attribute == primitive.attributes.end() ? -1 : attribute->second;
            return elementCount(model, accessor) * static_cast<double>(element_bytes);
        };
        const double vertex_count = attribute_bytes("POSITION", 1);
        const double corner_count = primitive.indices < 0 ? vertex_count : elementCount(model, primitive.indices);
        const bool is_list = primitive.mode <= TINYGLTF_MODE_TRIANGLES && primitive.mode != TINYGLTF_MODE_POINTS;
        const double triangle_count = is_list ? corner_count / 3 : corner_count;
        size.vertex_count = std::max(size.vertex_count, vertex_count);
        size.triangle_count += triangle_count;
        size.bytes += vertex_count * sizeof(glm::vec3) + triangle_count * sizeof(glm::uvec3) +
                      attribute_bytes("NORMAL", sizeof(glm::vec3)) +
                      2 * vertex_count * sizeof(glm::vec2) + // coordinates of the base colour and of the emission
                      attribute_bytes("COLOR_0", sizeof(glm::vec4)) +
                      attribute_bytes("JOINTS_0", sizeof(glm::u16vec4)) +
                      attribute_bytes("WEIGHTS_0", sizeof(glm::vec4));
        for (const std::map<std::string, int>& target : primitive.targets)
        {
            size.bytes += sizeof(MorphTarget);
            for (const auto& [attribute, accessor] : target)
            {
                const bool is_read = attribute == "POSITION" || attribute == "NORMAL";
                size.bytes += is_read ? elementCount(model, accessor) * sizeof(glm::vec3) : 0;
            }
        }
    }
    return size;
}

/// How often a node shows its mesh.
double meshCount(const GltfDocument& document, const GltfPlacedNode& placed)
{
    if (document.model.nodes[placed.node].mesh < 0 || placed.is_hidden)
    {
        return 0;
    }
    const std::map<std::string, int> accessors = gltfInstancing(document, placed.node);
    return accessors.empty() ? 1 : elementCount(document.model, accessors.begin()->second);
}

/// Bytes of a node, and of the pose (core/scene/animation.h) of its instances.
double nodeBytes(const GltfDocument& document, const tinygltf::Node& node, double mesh_count)
{
    double bytes = sizeof(Node);
    if (node.mesh >= 0)
    {
        const tinygltf::Mesh& mesh = document.model.meshes[node.mesh];
        const double instance_count = mesh_count * static_cast<double>(mesh.primitives.size());
        const double target_count = static_cast<double>(gltfTargetCount(mesh));
        const double joint_count = node.skin < 0 ? 0 : static_cast<double>(document.skins[node.skin].joints.size());
        bytes += (instance_count + 1) * target_count * sizeof(float) + instance_count * joint_count * sizeof(glm::mat4);
    }
    return bytes;
}

double skinBytes(const GltfDocument& document)
{
    double bytes = 0;
    for (const GltfSkinSource& skin : document.skins)
    {
        bytes += static_cast<double>(skin.joints.size()) * (sizeof(std::uint32_t) + sizeof(glm::mat4));
    }
    return bytes;
}

/// Each channel has its own key frames, even if the file shares them.
double animationBytes(const GltfDocument& document)
{
    double bytes = 0;
    for (const GltfAnimationSource& animation : document.animations)
    {
        for (const GltfChannelSource& channel : animation.channels)
        {
            const double numbers = channel.path == "rotation" ? 4 : channel.path == "weights" ? 1 : 3;
            bytes += sizeof(Channel) + elementCount(document.model, channel.input) * sizeof(float) +
                     elementCount(document.model, channel.output) * numbers * sizeof(float);
        }
    }
    return bytes;
}

} // namespace

void checkGltfSize(const GltfDocument& document, std::span<const GltfPlacedNode> nodes)
{
    const tinygltf::Model& model = document.model;
    std::map<int, SceneSize> meshes;
    SceneSize total;
    total.bytes = skinBytes(document) + animationBytes(document);
    for (const GltfPlacedNode& placed : nodes)
    {
        const double mesh_count = meshCount(document, placed);
        total.bytes += nodeBytes(document, model.nodes[placed.node], mesh_count);
        const int mesh = model.nodes[placed.node].mesh;
        if (mesh_count == 0)
        {
            continue;
        }
        const auto [known, is_new] = meshes.emplace(mesh, SceneSize{});
        if (is_new)
        {
            known->second = measureMesh(model, model.meshes[mesh]);
            total.vertex_count = std::max(total.vertex_count, known->second.vertex_count);
            total.bytes += known->second.bytes;
        }
        total.instance_count += mesh_count * known->second.instance_count;
        total.triangle_count += mesh_count * known->second.triangle_count;
    }
    checkSceneSize(document.path, total);
}

} // namespace zvo
