// SPDX-License-Identifier: MIT
#pragma once

#include "core/scene/scene.h"
#include "io/gltf/gltf_document.h"
#include "io/image/image_io.h"

#include <cstdint>
#include <glm/glm.hpp>
#include <map>
#include <optional>
#include <string>

namespace zvo
{

/// Which texture coordinates a material takes, and the affine map that KHR_texture_transform sends them through:
/// u * along_u + v * along_v + offset.
struct GltfUvSource
{
    int set = 0; // TEXCOORD_<set>
    glm::dvec2 along_u{1.0, 0.0};
    glm::dvec2 along_v{0.0, 1.0};
    glm::dvec2 offset{0.0};

    bool operator==(const GltfUvSource&) const = default;
};

/// A material that was put into the scene.
struct GltfMaterial
{
    std::uint32_t index = 0;                  // into Scene::materials
    std::optional<GltfUvSource> uvs;          // where it has a texture
    std::optional<GltfUvSource> emission_uvs; // where its emission has a texture with other coordinates
};

/// Puts a document's materials, with their textures and images, into a scene when they are first asked for. All
/// references must outlive it.
class GltfMaterials
{
public:
    GltfMaterials(const GltfDocument& document, Scene& scene, GltfWarnings& warnings, ImageDecoding decoding);

    /// The material with that index in the document; -1: the default material. Textures whose image cannot be used are
    /// left out with a warning. Throws Error{Input}.
    const GltfMaterial& get(int material);

private:
    GltfMaterial load(int material);
    std::optional<std::uint32_t> texture(int texture, const std::string& where);
    std::uint32_t image(int image);
    std::optional<std::uint32_t> usableImage(int image, const std::string& where);

    const GltfDocument& m_document;
    Scene& m_scene;
    GltfWarnings& m_warnings;
    ImageDecoding m_decoding;
    std::map<int, GltfMaterial> m_materials;
    std::map<int, std::uint32_t> m_textures;      // indices into Scene::textures
    std::map<int, std::uint32_t> m_images;        // indices into Scene::images
    std::map<int, std::string> m_unusable_images; // why
    std::uint64_t m_image_bytes_left;             // of images that are decoded when they are loaded
};

} // namespace zvo
