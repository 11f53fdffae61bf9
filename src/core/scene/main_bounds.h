// SPDX-License-Identifier: MIT
#pragma once

#include "core/scene/scene.h"

namespace zvo
{

/// The box around a scene at rest without its far outliers: for pictures that should show what there is to see. An
/// outlier lies beyond a gap along an axis. The gap is longer than the rest of the scene, and the outlier has less
/// than a hundredth of the surface. Without outliers this is Scene::bounds(). Cost: triangles of instances, up to 33
/// times.
Bounds mainBounds(const Scene& scene);

} // namespace zvo
