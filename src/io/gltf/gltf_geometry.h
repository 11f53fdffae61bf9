// SPDX-License-Identifier: MIT
#pragma once

#include "core/scene/scene.h"
#include "io/gltf/gltf_document.h"
#include "io/gltf/gltf_materials.h"

#include <optional>

namespace zvo
{

/// The triangles of meshes[mesh].primitives[primitive] with the coordinates that its material needs: lists as they are;
/// strips and fans unrolled with their winding, less the triangles that use a vertex twice, which only join parts.
/// Nothing, with a warning, for points, lines and what has no positions. Throws Error{Input} for contents that break
/// the specification.
std::optional<Primitive> loadGltfPrimitive(const GltfDocument& document, int mesh, int primitive,
                                           const GltfMaterial& material, GltfWarnings& warnings);

} // namespace zvo
