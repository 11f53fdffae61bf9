// SPDX-License-Identifier: MIT
#pragma once

#include "core/scene/scene.h"

#include <vector>

namespace zvo
{

/// The instances of scene for which keep [instances] is set, in order, with the primitives, materials, textures and
/// images that they need. Cameras, nodes, skins, animations and warnings are all kept.
Scene partOf(const Scene& scene, const std::vector<bool>& keep);

/// The scene at rest, without anything that could move it: no nodes, skins, animations and morph targets.
Scene atRest(Scene scene);

} // namespace zvo
