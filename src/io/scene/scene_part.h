// SPDX-License-Identifier: MIT
#pragma once

#include "core/scene/scene.h"

#include <vector>

namespace zvo
{

/// Those instances of scene for which keep [instances] is set, in order, with the primitives, materials, textures and
/// images that they need. Cameras, nodes, skins, animations and warnings are all there.
Scene partOf(const Scene& scene, const std::vector<bool>& keep);

/// The scene as it stands at rest, without anything that could move it: nodes, skins, animations, morph targets.
Scene atRest(Scene scene);

} // namespace zvo
