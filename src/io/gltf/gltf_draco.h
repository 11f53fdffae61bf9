// SPDX-License-Identifier: MIT
#pragma once

#include "io/gltf/gltf_accessor.h"
#include "io/gltf/gltf_document.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace draco
{
class Mesh;
}

namespace zvo
{

/// The geometry that KHR_draco_mesh_compression packs for a primitive.
class GltfDracoMesh
{
public:
    /// Unpacks primitive; returns nothing if it is not packed. where: the primitive, for messages. Throws Error{Input}
    /// for data that does not decode or is out of proportion. After: Google, Draco bitstream specification, version
    /// 2.2.
    static std::optional<GltfDracoMesh> unpack(const GltfDocument& document, const tinygltf::Primitive& primitive,
                                               const std::string& where);

    GltfDracoMesh(GltfDracoMesh&&) noexcept;
    GltfDracoMesh& operator=(GltfDracoMesh&&) noexcept;
    ~GltfDracoMesh();

    /// Whether the attribute is packed; otherwise its values are those of its accessor.
    [[nodiscard]] bool has(const std::string& attribute) const;

    /// A packed attribute in the form that its accessor describes. Throws Error{Input} if accessor and data contradict
    /// each other.
    [[nodiscard]] GltfAccessor open(const GltfDocument& document, const std::string& attribute, int accessor,
                                    const std::string& use) const;

    /// Vertex indices of the triangles: a triangle list, whatever the primitive's mode is.
    [[nodiscard]] std::vector<std::uint32_t> indices() const;

private:
    GltfDracoMesh() = default;

    std::unique_ptr<draco::Mesh> m_mesh;
    std::map<std::string, std::uint32_t> m_attribute_ids; // unique ids in the Draco data
};

} // namespace zvo
