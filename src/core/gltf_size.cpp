// SPDX-License-Identifier: MIT
#include "core/gltf_size.h"

#include "core/scene.h"

#include <algorithm>
#include <fmt/format.h>
#include <limits>
#include <map>
#include <string>
#include <unistd.h>

namespace zvo
{

namespace
{

// What a mesh comes down to. Floating point, as a file may announce any 64-bit number.
struct MeshSize
{
    double bytes = 0;
    double triangle_count = 0;
};

/// Elements of an accessor; 0 where it is not given, or its buffer view cannot hold that many, which is refused later.
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

MeshSize measureMesh(const tinygltf::Model& model, const tinygltf::Mesh& mesh)
{
    MeshSize size;
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
        const bool is_list = primitive.mode <= TINYGLTF_MODE_TRIANGLES;
        const double triangle_count = is_list ? corner_count / 3 : corner_count;
        size.triangle_count += triangle_count;
        size.bytes += vertex_count * sizeof(glm::vec3) + triangle_count * sizeof(glm::uvec3) +
                      attribute_bytes("NORMAL", sizeof(glm::vec3)) + attribute_bytes("TEXCOORD_0", sizeof(glm::vec2)) +
                      attribute_bytes("COLOR_0", sizeof(glm::vec4));
    }
    return size;
}

} // namespace

std::uint64_t sceneBytesMax()
{
    const auto page_count = static_cast<std::uint64_t>(std::max(sysconf(_SC_PHYS_PAGES), 0L));
    const auto page_bytes = static_cast<std::uint64_t>(std::max(sysconf(_SC_PAGESIZE), 0L));
    return page_count * page_bytes / 2;
}

void checkGltfSize(const GltfDocument& document, std::span<const GltfPlacedNode> nodes)
{
    const tinygltf::Model& model = document.model;
    std::map<int, MeshSize> meshes;
    std::uint64_t instance_count = 0;
    double triangle_count = 0;
    double bytes = 0;
    for (const GltfPlacedNode& placed : nodes)
    {
        const int mesh = model.nodes[placed.node].mesh;
        if (mesh < 0)
        {
            continue;
        }
        const auto [known, is_new] = meshes.emplace(mesh, MeshSize{});
        if (is_new)
        {
            known->second = measureMesh(model, model.meshes[mesh]);
            bytes += known->second.bytes;
        }
        instance_count += model.meshes[mesh].primitives.size();
        triangle_count += known->second.triangle_count;
    }
    if (instance_count > kGltfInstancesMax)
    {
        throw document.error(fmt::format("its nodes show {} primitives, more than {}; join the meshes, or split the "
                                         "file",
                                         instance_count, kGltfInstancesMax));
    }
    if (triangle_count > std::numeric_limits<std::uint32_t>::max())
    {
        throw document.error(fmt::format("its nodes show {:.3g} triangles, more than 32-bit numbers count; split the "
                                         "file",
                                         triangle_count));
    }
    if (const std::uint64_t bytes_max = sceneBytesMax(); bytes > static_cast<double>(bytes_max))
    {
        throw document.error(fmt::format("its meshes take {:.3g} bytes, more than the {} that half of this machine's "
                                         "memory has; let them share less data, or split the file",
                                         bytes, bytes_max));
    }
}

} // namespace zvo
