// SPDX-License-Identifier: MIT
// Clouds of points, as primitives whose triangles are points.
#pragma once

#include "core/scene/scene.h"

#include <cstdint>

namespace zvo
{

/// The largest edge of a point, in voxels.
inline constexpr std::uint32_t kPointSizeMax = 16;

/// Makes each of a primitive's vertices a point, in place of its triangles.
void makePoints(Primitive& primitive);

/// Makes the points of a scene cubes of size^3 voxels, by as many instances of each primitive of points. Size: 1 to
/// kPointSizeMax.
void widenPoints(Scene& scene, std::uint32_t size);

} // namespace zvo
