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
    /// Unpacks primitive; nothing where it is not packed. where: its place. Throws Error{Input} for data that does not
    /// decode or is out of proportion. After: Google, Draco bitstream specification, version 2.2.
    static std::optional<GltfDracoMesh> unpack(const GltfDocument& document, const tinygltf::Primitive& primitive,
                                               const std::string& where);

    GltfDracoMesh(GltfDracoMesh&&) noexcept;
    GltfDracoMesh& operator=(GltfDracoMesh&&) noexcept;
    ~GltfDracoMesh();

    /// Whether the attribute is packed; otherwise its accessor holds it.
    [[nodiscard]] bool has(const std::string& attribute) const;

    /// A packed attribute as its accessor describes it. Throws Error{Input} where accessor and data do not go together.
    [[nodiscard]] GltfAccessor open(const GltfDocument& document, const std::string& attribute, int accessor,
                                    const std::string& use) const;

    /// Vertices of the triangles, a list whatever the primitive's mode.
    [[nodiscard]] std::vector<std::uint32_t> indices() const;

private:
    GltfDracoMesh() = default;

    std::unique_ptr<draco::Mesh> m_mesh;
    std::map<std::string, std::uint32_t> m_attribute_ids; // unique ids in the Draco data
};

} // namespace zvo
