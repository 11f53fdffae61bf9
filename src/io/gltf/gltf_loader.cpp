// SPDX-License-Identifier: MIT
#include "io/gltf/gltf_loader.h"

#include "core/base/read_file.h"
#include "io/gltf/gltf_document.h"
#include "io/gltf/gltf_geometry.h"
#include "io/gltf/gltf_materials.h"
#include "io/gltf/gltf_nodes.h"
#include "io/gltf/gltf_rig.h"
#include "io/gltf/gltf_size.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

namespace zvo
{

namespace
{

class SceneLoader
{
public:
    SceneLoader(const GltfDocument& document, ImageDecoding decoding)
        : m_document(document), m_materials(document, m_scene, m_warnings, decoding)
    {
    }

    Scene load()
    {
        const std::vector<GltfPlacedNode> nodes = placeGltfNodes(m_document);
        checkGltfSize(m_document, nodes);
        GltfRig rig(m_document, nodes, m_scene, m_warnings);
        std::size_t hidden_count = 0; // nodes
        for (std::uint32_t i = 0; i < nodes.size(); ++i)
        {
            const GltfPlacedNode& placed = nodes[i];
            const tinygltf::Node& node = m_document.model.nodes[placed.node];
            const std::string where = fmt::format("nodes[{}]", placed.node);
            if (node.mesh >= 0 && !placed.is_hidden)
            {
                Instance instance;
                instance.node = i;
                instance.skin = node.skin >= 0 ? rig.skin(node.skin) : kNone;
                for (const glm::mat4& in_node : readGltfInstances(m_document, placed.node))
                {
                    instance.in_node = in_node;
                    instance.transform =
                        toSinglePrecision(m_document, placed.node, placed.to_world * glm::dmat4(in_node));
                    addInstances(node.mesh, instance, where);
                }
            }
            if (node.camera >= 0)
            {
                addCamera(node, toSinglePrecision(m_document, placed.node, placed.to_world));
            }
            if (node.skin >= 0 && node.extensions.contains("EXT_mesh_gpu_instancing"))
            {
                m_warnings.add("instances of a mesh with a skin left out, the mesh is there once", where);
            }
            hidden_count += node.mesh >= 0 && placed.is_hidden ? 1 : 0;
        }
        if (m_scene.instances.empty() && hidden_count != 0)
        {
            m_warnings.add("nothing is shown, as KHR_node_visibility hides all meshes",
                           fmt::format("{} nodes", hidden_count));
        }
        rig.addAnimations();
        m_document.warnOfUnusedFaults();
        m_scene.warnings = m_warnings.lines(m_document.path);
        return std::move(m_scene);
    }

private:
    /// Adds instances of all primitives of mesh. common: the members that they share; where: the node.
    void addInstances(int mesh, const Instance& common, const std::string& where)
    {
        auto known = m_mesh_primitives.find(mesh);
        if (known == m_mesh_primitives.end())
        {
            known = m_mesh_primitives.emplace(mesh, addPrimitives(mesh)).first;
        }
        for (const std::uint32_t index : known->second)
        {
            Instance instance = common;
            instance.primitive = index;
            instance.skin = fits(common.skin, index, where) ? common.skin : kNone;
            m_scene.instances.push_back(instance);
        }
    }

    /// Whether a primitive of the scene can use a skin.
    bool fits(std::uint32_t skin, std::uint32_t primitive, const std::string& where)
    {
        if (skin == kNone)
        {
            return false;
        }
        if (m_joint_counts[primitive] == 0)
        {
            m_warnings.add("mesh without joints is not moved by its skin", where);
            return false;
        }
        if (m_joint_counts[primitive] > m_scene.skins[skin].joints.size())
        {
            m_warnings.add("mesh whose vertices name joints that its skin does not have is not moved by it", where);
            return false;
        }
        return true;
    }

    /// Indices into Scene::primitives.
    std::vector<std::uint32_t> addPrimitives(int mesh)
    {
        m_document.use(fmt::format("meshes[{}]", mesh));
        const std::vector<tinygltf::Primitive>& sources = m_document.model.meshes[mesh].primitives;
        std::vector<std::uint32_t> added;
        for (int i = 0; i < static_cast<int>(sources.size()); ++i)
        {
            const bool is_shown = sources[i].mode == TINYGLTF_MODE_POINTS || sources[i].mode >= TINYGLTF_MODE_TRIANGLES;
            const GltfMaterial material = is_shown ? m_materials.get(sources[i].material) : GltfMaterial{};
            std::optional<Primitive> primitive = loadGltfPrimitive(m_document, mesh, i, material, m_warnings);
            if (primitive)
            {
                m_joint_counts.push_back(jointCount(*primitive));
                added.push_back(static_cast<std::uint32_t>(m_scene.primitives.size()));
                m_scene.primitives.push_back(*std::move(primitive));
            }
        }
        return added;
    }

    /// The least number of joints of a skin: one more than the largest index.
    static std::size_t jointCount(const Primitive& primitive)
    {
        std::size_t count = 0;
        for (const glm::u16vec4& joints : primitive.joints)
        {
            count = std::max(count, std::size_t{1} + std::max({joints.x, joints.y, joints.z, joints.w}));
        }
        return count;
    }

    void addCamera(const tinygltf::Node& node, const glm::mat4& to_world)
    {
        const tinygltf::Camera& source = m_document.model.cameras[node.camera];
        const std::string where = fmt::format("cameras[{}]", node.camera);
        m_document.use(where);
        Camera camera;
        camera.name = source.name.empty() ? node.name : source.name;
        camera.transform = to_world;
        camera.orthographic = source.type == "orthographic";
        if (camera.orthographic)
        {
            // Exporters do not mean the mirroring that a negative magnification gives.
            camera.half_height = static_cast<float>(std::abs(source.orthographic.ymag));
        }
        else
        {
            camera.vertical_fov = static_cast<float>(source.perspective.yfov);
        }
        const bool valid = camera.orthographic
                               ? camera.half_height > 0.0F && std::isfinite(camera.half_height)
                               : camera.vertical_fov > 0.0F && camera.vertical_fov < std::numbers::pi_v<float>;
        if (!valid)
        {
            m_warnings.add("camera left out, as its field of view is not possible", where);
            return;
        }
        m_scene.cameras.push_back(camera);
    }

    const GltfDocument& m_document;
    Scene m_scene;
    GltfWarnings& m_warnings = m_document.warnings;
    GltfMaterials m_materials;
    std::map<int, std::vector<std::uint32_t>> m_mesh_primitives;
    std::vector<std::size_t> m_joint_counts; // [primitives of the scene]
};

} // namespace

Scene loadGltf(const std::filesystem::path& path)
{
    return loadGltf(path, readFile(path));
}

Scene loadGltf(const std::filesystem::path& path, std::vector<std::uint8_t> content, ImageDecoding decoding)
{
    const GltfDocument document = openGltf(path, std::move(content));
    return SceneLoader(document, decoding).load();
}

} // namespace zvo
