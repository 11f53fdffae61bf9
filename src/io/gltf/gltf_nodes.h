// SPDX-License-Identifier: MIT
#pragma once

#include "core/scene/rig.h"
#include "io/gltf/gltf_document.h"

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace zvo
{

/// A node of the default scene with its transform to the world: the product of its own and its ancestors' transforms,
/// in double precision.
struct GltfPlacedNode
{
    int node = 0;
    std::uint32_t parent = kNone; // index among the placed nodes, below its own; kNone: a root of the scene
    glm::dmat4 to_world{1.0};
};

/// The nodes of the default scene (the first one, or all nodes, where the file names none), parents before children,
/// children in the file's order. A node that is met again, as the child of a second parent or in a cycle, stays where
/// it was met first, with a warning. Throws Error{Input} for a matrix that is not affine.
std::vector<GltfPlacedNode> placeGltfNodes(const GltfDocument& document);

/// matrix in single precision, with the exact last row (0, 0, 0, 1). Throws Error{Input} where it overflows.
glm::mat4 toSinglePrecision(const GltfDocument& document, const GltfPlacedNode& node);

} // namespace zvo
