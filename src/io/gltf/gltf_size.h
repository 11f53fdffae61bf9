// SPDX-License-Identifier: MIT
#pragma once

#include "io/gltf/gltf_document.h"
#include "io/gltf/gltf_nodes.h"

#include <span>

namespace zvo
{

/// checkSceneSize() of what the nodes will show, before anything of it is read: a small file can name the same data any
/// number of times. Data that is packed must hold no more than its accessors announce.
void checkGltfSize(const GltfDocument& document, std::span<const GltfPlacedNode> nodes);

} // namespace zvo
