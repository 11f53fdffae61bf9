// SPDX-License-Identifier: MIT
#include "core/gltf_loader.h"

#include "core/gltf_document.h"
#include "core/gltf_geometry.h"
#include "core/gltf_materials.h"
#include "core/gltf_nodes.h"
#include "core/gltf_size.h"
#include "core/read_file.h"

#include <cmath>
#include <fmt/format.h>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

namespace zvo
{

namespace
{

class SceneLoader
{
public:
    explicit SceneLoader(const GltfDocument& document) : m_document(document) {}

    Scene load()
    {
        const std::vector<GltfPlacedNode> nodes = placeGltfNodes(m_document);
        checkGltfSize(m_document, nodes);
        for (const GltfPlacedNode& placed : nodes)
        {
            const tinygltf::Node& node = m_document.model.nodes[placed.node];
            const std::string where = fmt::format("nodes[{}]", placed.node);
            if (node.mesh >= 0)
            {
                addInstances(node.mesh, toSinglePrecision(m_document, placed));
            }
            if (node.mesh >= 0 && node.skin >= 0)
            {
                m_warnings.add("skins are not applied, the mesh stands as it was modelled", where);
            }
            if (node.camera >= 0)
            {
                addCamera(node, toSinglePrecision(m_document, placed));
            }
            if (node.extensions.contains("EXT_mesh_gpu_instancing"))
            {
                m_warnings.add("instances of EXT_mesh_gpu_instancing left out, the mesh is there once", where);
            }
        }
        m_scene.warnings = m_warnings.lines(m_document.path);
        return std::move(m_scene);
    }

private:
    void addInstances(int mesh, const glm::mat4& to_world)
    {
        auto known = m_mesh_primitives.find(mesh);
        if (known == m_mesh_primitives.end())
        {
            known = m_mesh_primitives.emplace(mesh, addPrimitives(mesh)).first;
        }
        for (const std::uint32_t primitive : known->second)
        {
            m_scene.instances.push_back({primitive, to_world});
        }
    }

    /// Indices into Scene::primitives.
    std::vector<std::uint32_t> addPrimitives(int mesh)
    {
        const std::vector<tinygltf::Primitive>& sources = m_document.model.meshes[mesh].primitives;
        std::vector<std::uint32_t> added;
        for (int i = 0; i < static_cast<int>(sources.size()); ++i)
        {
            const bool has_triangles = sources[i].mode >= TINYGLTF_MODE_TRIANGLES;
            const GltfMaterial material = has_triangles ? m_materials.get(sources[i].material) : GltfMaterial{};
            std::optional<Primitive> primitive = loadGltfPrimitive(m_document, mesh, i, material.uvs, m_warnings);
            if (primitive)
            {
                primitive->material = material.index;
                added.push_back(static_cast<std::uint32_t>(m_scene.primitives.size()));
                m_scene.primitives.push_back(*std::move(primitive));
            }
        }
        return added;
    }

    void addCamera(const tinygltf::Node& node, const glm::mat4& to_world)
    {
        const tinygltf::Camera& source = m_document.model.cameras[node.camera];
        const std::string where = fmt::format("cameras[{}]", node.camera);
        Camera camera;
        camera.name = source.name.empty() ? node.name : source.name;
        camera.transform = to_world;
        camera.orthographic = source.type == "orthographic";
        if (camera.orthographic)
        {
            // A negative magnification mirrors the picture, which no exporter means.
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
    GltfWarnings m_warnings;
    GltfMaterials m_materials{m_document, m_scene, m_warnings};
    std::map<int, std::vector<std::uint32_t>> m_mesh_primitives;
};

} // namespace

Scene loadGltf(const std::filesystem::path& path)
{
    return loadGltf(path, readFile(path));
}

Scene loadGltf(const std::filesystem::path& path, std::vector<std::uint8_t> content)
{
    const GltfDocument document = openGltf(path, std::move(content));
    return SceneLoader(document).load();
}

} // namespace zvo
