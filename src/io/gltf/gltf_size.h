// SPDX-License-Identifier: MIT
#pragma once

#include "io/gltf/gltf_document.h"
#include "io/gltf/gltf_nodes.h"

#include <span>

namespace zvo
{

/// Applies checkSceneSize() to everything that the nodes show, before any of it is read, because a small file can name
/// the same data any number of times. Packed data must hold no more than its accessors announce.
void checkGltfSize(const GltfDocument& document, std::span<const GltfPlacedNode> nodes);

} // namespace zvo
