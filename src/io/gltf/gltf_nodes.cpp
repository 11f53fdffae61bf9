// SPDX-License-Identifier: MIT
#include "io/gltf/gltf_nodes.h"

#include "io/gltf/gltf_accessor.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <optional>
#include <utility>

namespace zvo
{

namespace
{

/// The nodes to begin with: those of the scene, or else all without a parent, and then, as only cycles are left, all.
std::vector<int> findRoots(const GltfDocument& document)
{
    const tinygltf::Model& model = document.model;
    if (!model.scenes.empty())
    {
        return model.scenes[std::max(model.defaultScene, 0)].nodes;
    }
    const int node_count = static_cast<int>(model.nodes.size());
    std::vector<bool> is_child(model.nodes.size(), false);
    for (const tinygltf::Node& node : model.nodes)
    {
        for (const int child : node.children)
        {
            is_child[child] = true;
        }
    }
    std::vector<int> roots;
    for (const bool wanted : {false, true})
    {
        for (int node = 0; node < node_count; ++node)
        {
            if (is_child[node] == wanted)
            {
                roots.push_back(node);
            }
        }
    }
    return roots;
}

bool isHidden(const tinygltf::Node& node)
{
    const auto visibility = node.extensions.find("KHR_node_visibility");
    return visibility != node.extensions.end() && visibility->second.Has("visible") &&
           !visibility->second.Get("visible").Get<bool>();
}

/// Places nodes depth first, each once.
class NodePlacer
{
public:
    explicit NodePlacer(const GltfDocument& document)
        : m_document(document), m_is_placed(document.model.nodes.size(), false)
    {
    }

    [[nodiscard]] bool isPlaced(int node) const { return m_is_placed[node]; }

    /// Places a root and all below it.
    void place(int root)
    {
        struct Visit
        {
            int node;
            std::uint32_t parent;
        };
        std::vector<Visit> open = {{root, kNone}}; // the last one is next
        while (!open.empty())
        {
            const Visit visit = open.back();
            open.pop_back();
            if (m_is_placed[visit.node])
            {
                m_document.warnings.add("nodes that are met again, by another parent or in a cycle, stay where they "
                                        "were met first",
                                        fmt::format("nodes[{}]", visit.node));
                continue;
            }
            m_is_placed[visit.node] = true;
            const GltfPlacedNode above = visit.parent == kNone ? GltfPlacedNode{} : m_placed[visit.parent];
            const auto index = static_cast<std::uint32_t>(m_placed.size());
            m_placed.push_back({visit.node, visit.parent, above.to_world * gltfLocalMatrix(m_document, visit.node),
                                above.is_hidden || isHidden(m_document.model.nodes[visit.node])});
            const std::vector<int>& children = m_document.model.nodes[visit.node].children;
            for (auto child = children.rbegin(); child != children.rend(); ++child)
            {
                open.push_back({*child, index});
            }
        }
    }

    std::vector<GltfPlacedNode> take() { return std::move(m_placed); }

private:
    const GltfDocument& m_document;
    std::vector<bool> m_is_placed;
    std::vector<GltfPlacedNode> m_placed;
};

} // namespace

glm::dvec3 gltfVec3(const std::vector<double>& values, double missing)
{
    return values.empty() ? glm::dvec3(missing) : glm::dvec3(values[0], values[1], values[2]);
}

glm::dquat gltfQuaternion(const std::vector<double>& values)
{
    return values.empty() ? glm::dquat(1.0, 0.0, 0.0, 0.0) : glm::dquat(values[3], values[0], values[1], values[2]);
}

glm::dmat4 gltfLocalMatrix(const GltfDocument& document, int index)
{
    const tinygltf::Node& node = document.model.nodes[index];
    if (node.matrix.empty())
    {
        return composeTransform(gltfVec3(node.translation, 0.0), gltfQuaternion(node.rotation),
                                gltfVec3(node.scale, 1.0));
    }
    glm::dmat4 matrix;
    for (int i = 0; i < 16; ++i)
    {
        matrix[i / 4][i % 4] = node.matrix[i];
    }
    if (!isAffine(matrix))
    {
        throw document.error(
            fmt::format("the last row of nodes[{}].matrix is not (0, 0, 0, 1); {}", index, kExportAgain));
    }
    return withAffineRow(matrix);
}

std::vector<GltfPlacedNode> placeGltfNodes(const GltfDocument& document)
{
    NodePlacer placer(document);
    const bool has_scenes = !document.model.scenes.empty();
    for (const int root : findRoots(document))
    {
        if (has_scenes || !placer.isPlaced(root)) // without scenes every node is a root if no other one leads to it
        {
            placer.place(root);
        }
    }
    return placer.take();
}

std::map<std::string, int> gltfInstancing(const GltfDocument& document, int node)
{
    constexpr const char* kName = "EXT_mesh_gpu_instancing";
    document.use(fmt::format("nodes[{}].extensions.{}", node, kName));
    const tinygltf::Node& source = document.model.nodes[node];
    std::map<std::string, int> accessors;
    if (const auto extension = source.extensions.find(kName); source.skin < 0 && extension != source.extensions.end())
    {
        const tinygltf::Value& attributes = extension->second.Get("attributes");
        for (const char* attribute : {"TRANSLATION", "ROTATION", "SCALE"})
        {
            if (attributes.Has(attribute))
            {
                accessors[attribute] = attributes.Get(attribute).GetNumberAsInt();
            }
        }
    }
    return accessors;
}

std::vector<glm::mat4> readGltfInstances(const GltfDocument& document, int node)
{
    std::map<std::string, std::vector<float>> numbers;
    std::optional<std::size_t> count;
    for (const auto& [attribute, index] : gltfInstancing(document, node))
    {
        GltfAccessor accessor = openAccessor(document, index, fmt::format("instances of nodes[{}]", node));
        const bool turns = attribute == "ROTATION";
        if (accessor.component_count != (turns ? 4 : 3) || count.value_or(accessor.count) != accessor.count ||
            (!turns && accessor.component_type != TINYGLTF_COMPONENT_TYPE_FLOAT))
        {
            throw document.error(fmt::format("{} has a type or count that EXT_mesh_gpu_instancing does not allow; {}",
                                             accessor.where, kExportAgain));
        }
        accessor.normalized = true; // integers are normalized even if the file does not say so
        count = accessor.count;
        numbers[attribute] = readNumbers(accessor);
    }
    const auto read = [&numbers](const char* attribute, std::size_t instance, std::size_t size)
    {
        const std::vector<float>& all = numbers[attribute];
        return all.empty() ? std::vector<double>()
                           : std::vector<double>(all.data() + instance * size, all.data() + (instance + 1) * size);
    };
    std::vector<glm::mat4> transforms;
    for (std::size_t i = 0; i < count.value_or(1); ++i)
    {
        transforms.emplace_back(composeTransform(gltfVec3(read("TRANSLATION", i, 3), 0.0),
                                                 gltfQuaternion(read("ROTATION", i, 4)),
                                                 gltfVec3(read("SCALE", i, 3), 1.0)));
    }
    return transforms;
}

glm::mat4 toSinglePrecision(const GltfDocument& document, int node, const glm::dmat4& to_world)
{
    const glm::mat4 matrix(to_world);
    for (int i = 0; i < 16; ++i)
    {
        if (!std::isfinite(matrix[i / 4][i % 4]))
        {
            throw document.error(
                fmt::format("the transform of nodes[{}] overflows single precision; make it smaller", node));
        }
    }
    return matrix;
}

} // namespace zvo
