// SPDX-License-Identifier: MIT
#include "io/gltf/gltf_nodes.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <optional>

namespace zvo
{

namespace
{

glm::dvec3 toVec3(const std::vector<double>& values, double missing)
{
    return values.empty() ? glm::dvec3(missing) : glm::dvec3(values[0], values[1], values[2]);
}

/// values: x, y, z, w.
glm::dquat toQuaternion(const std::vector<double>& values)
{
    return values.empty() ? glm::dquat(1.0, 0.0, 0.0, 0.0) : glm::dquat(values[3], values[0], values[1], values[2]);
}

glm::dmat4 localMatrix(const GltfDocument& document, int index)
{
    const tinygltf::Node& node = document.model.nodes[index];
    if (node.matrix.empty())
    {
        return composeTransform(toVec3(node.translation, 0.0), toQuaternion(node.rotation), toVec3(node.scale, 1.0));
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

/// The parent of each node. Throws if a node has two, or is part of a cycle.
std::vector<std::optional<int>> findParents(const GltfDocument& document)
{
    const std::vector<tinygltf::Node>& nodes = document.model.nodes;
    std::vector<std::optional<int>> parents(nodes.size());
    for (int node = 0; node < static_cast<int>(nodes.size()); ++node)
    {
        for (const int child : nodes[node].children)
        {
            if (parents[child])
            {
                throw document.error(fmt::format("nodes[{}] is a child of nodes[{}] and of nodes[{}]; {}", child,
                                                 *parents[child], node, kExportAgain));
            }
            parents[child] = node;
        }
    }
    // Since nodes have at most one parent, a node that cannot be reached from a root belongs to a cycle.
    std::vector<int> reached;
    for (int node = 0; node < static_cast<int>(nodes.size()); ++node)
    {
        if (!parents[node])
        {
            reached.push_back(node);
        }
    }
    std::vector<bool> is_reached(nodes.size(), false);
    for (std::size_t i = 0; i < reached.size(); ++i)
    {
        is_reached[reached[i]] = true;
        const std::vector<int>& children = nodes[reached[i]].children;
        reached.insert(reached.end(), children.begin(), children.end());
    }
    const auto lost = std::find(is_reached.begin(), is_reached.end(), false);
    if (lost != is_reached.end())
    {
        throw document.error(
            fmt::format("nodes[{}] is in or below a cycle of nodes; {}", lost - is_reached.begin(), kExportAgain));
    }
    return parents;
}

std::vector<int> findRoots(const GltfDocument& document, const std::vector<std::optional<int>>& parents)
{
    const tinygltf::Model& model = document.model;
    if (!model.scenes.empty())
    {
        return model.scenes[std::max(model.defaultScene, 0)].nodes;
    }
    std::vector<int> roots;
    for (int node = 0; node < static_cast<int>(parents.size()); ++node)
    {
        if (!parents[node])
        {
            roots.push_back(node);
        }
    }
    return roots;
}

} // namespace

std::vector<GltfPlacedNode> placeGltfNodes(const GltfDocument& document)
{
    const std::vector<tinygltf::Node>& nodes = document.model.nodes;
    const std::vector<int> roots = findRoots(document, findParents(document));
    std::vector<GltfPlacedNode> placed;
    std::vector<GltfPlacedNode> open; // the last one is visited next; to_world is its parent's
    for (auto root = roots.rbegin(); root != roots.rend(); ++root)
    {
        open.push_back({*root, kNone, glm::dmat4(1.0)});
    }
    std::vector<bool> is_placed(nodes.size(), false);
    while (!open.empty())
    {
        GltfPlacedNode node = open.back();
        open.pop_back();
        if (is_placed[node.node])
        {
            throw document.error(fmt::format("nodes[{}] is in the scene twice; {}", node.node, kExportAgain));
        }
        is_placed[node.node] = true;
        node.to_world = node.to_world * localMatrix(document, node.node);
        const auto index = static_cast<std::uint32_t>(placed.size());
        placed.push_back(node);
        const std::vector<int>& children = nodes[node.node].children;
        for (auto child = children.rbegin(); child != children.rend(); ++child)
        {
            open.push_back({*child, index, node.to_world});
        }
    }
    return placed;
}

glm::mat4 toSinglePrecision(const GltfDocument& document, const GltfPlacedNode& node)
{
    const glm::mat4 matrix(node.to_world);
    for (int i = 0; i < 16; ++i)
    {
        if (!std::isfinite(matrix[i / 4][i % 4]))
        {
            throw document.error(
                fmt::format("the transform of nodes[{}] overflows single precision; make it smaller", node.node));
        }
    }
    return matrix;
}

} // namespace zvo
