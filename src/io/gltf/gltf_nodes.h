// SPDX-License-Identifier: MIT
#pragma once

#include "core/scene/rig.h"
#include "io/gltf/gltf_document.h"

#include <cstdint>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <map>
#include <string>
#include <vector>

namespace zvo
{

/// Three numbers of a document, or `missing` for each where there are none.
glm::dvec3 gltfVec3(const std::vector<double>& values, double missing);

/// x, y, z and w of a document, or no rotation where there are none.
glm::dquat gltfQuaternion(const std::vector<double>& values);

/// The transform of a node to its parent. Throws Error{Input} for a matrix that is not affine.
glm::dmat4 gltfLocalMatrix(const GltfDocument& document, int index);

/// A node of the default scene with its transform to the world: the product of its own and its ancestors' transforms,
/// in double precision.
struct GltfPlacedNode
{
    int node = 0;
    std::uint32_t parent = kNone; // index among the placed nodes, below its own; kNone: a root of the scene
    glm::dmat4 to_world{1.0};
    bool is_hidden = false; // by KHR_node_visibility, as are all nodes below it
};

/// The nodes of the default scene (the first one, or all nodes, where the file names none), parents before children,
/// children in the file's order. A node that is met again, as the child of a second parent or in a cycle, stays where
/// it was met first, with a warning. Throws Error{Input} for a matrix that is not affine.
std::vector<GltfPlacedNode> placeGltfNodes(const GltfDocument& document);

/// The accessors of EXT_mesh_gpu_instancing that place a node's mesh, by the names TRANSLATION, ROTATION and SCALE;
/// empty where the mesh is there once, as one with a skin is. Throws Error{Input} for a fault.
std::map<std::string, int> gltfInstancing(const GltfDocument& document, int node);

/// The transforms of a node's mesh to the node. Throws Error{Input}.
std::vector<glm::mat4> readGltfInstances(const GltfDocument& document, int node);

/// to_world, of a node, in single precision. Throws Error{Input} where it overflows.
glm::mat4 toSinglePrecision(const GltfDocument& document, int node, const glm::dmat4& to_world);

} // namespace zvo
