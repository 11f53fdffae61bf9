// SPDX-License-Identifier: MIT
// Which levels of its textures a scene needs on a grid (docs/voxelization.md, "Texture lookup").
#pragma once

#include "core/base/grid.h"
#include "core/scene/scene.h"
#include "zvo/types.h"

#include <cstdint>
#include <vector>

namespace zvo
{

/// The number of levels of an image: halvings down to 1 x 1, and the image itself.
std::uint32_t levelCount(std::uint32_t width, std::uint32_t height);

/// For each image of scene the least level that a triangle samples where the scene is voxelized at rest: [images]. The
/// last level for images that no triangle samples. needed: [textures] those that materials use. In doubt, a level is
/// counted as sampled: devices may round an area of a triangle up or down. Cost: triangles with textures.
std::vector<std::uint32_t> leastLevels(const Scene& scene, const std::vector<bool>& needed, const Grid& grid,
                                       Coverage coverage);

} // namespace zvo
