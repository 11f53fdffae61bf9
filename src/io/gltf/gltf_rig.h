// SPDX-License-Identifier: MIT
#pragma once

#include "core/scene/scene.h"
#include "io/gltf/gltf_document.h"
#include "io/gltf/gltf_nodes.h"

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace zvo
{

/// The number of morph targets of a mesh: the largest number among its primitives.
std::size_t gltfTargetCount(const tinygltf::Mesh& mesh);

/// Puts the placed nodes of a document into a scene, Scene::nodes[i] being nodes[i], with what moves them: skins when
/// they are first asked for, and animations. Unusable parts are left out with a warning. All references must outlive
/// it.
class GltfRig
{
public:
    GltfRig(const GltfDocument& document, std::span<const GltfPlacedNode> nodes, Scene& scene, GltfWarnings& warnings);

    /// Index into Scene::skins of the document's skin; kNone where it cannot be used. Throws Error{Input}.
    std::uint32_t skin(int skin);

    /// Puts the animations into the scene, with all channels that move its nodes. Throws Error{Input} for data that
    /// leaves its buffer.
    void addAnimations();

private:
    void addNode(const GltfPlacedNode& placed);
    std::uint32_t loadSkin(int skin);
    std::vector<glm::mat4> readInverseBind(const GltfSkinSource& source, const std::string& where);
    std::vector<Channel> readChannels(const GltfAnimationSource& source, const std::string& where);

    const GltfDocument& m_document;
    Scene& m_scene;
    GltfWarnings& m_warnings;
    std::vector<std::uint32_t> m_nodes;   // [nodes of the document] indices into Scene::nodes, or kNone
    std::map<int, std::uint32_t> m_skins; // indices into Scene::skins, or kNone
};

} // namespace zvo
