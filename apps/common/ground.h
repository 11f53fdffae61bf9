// SPDX-License-Identifier: MIT
#pragma once

#include "common/scene_options.h"
#include "io/scene/animated_scene.h"

namespace zvo::cli
{

/// The grid of a scene that stands on a ground: twice as wide as the one that placeGrid() would make, with voxels of
/// the same size. Its lowest layer is below bounds. Throws Error{Usage} where there is no such grid.
Grid gridWithGround(const Grid& grid, const Bounds& bounds);

/// Adds a grey disc to what stands still: the layer of voxels below bounds, as far as grid reaches to all sides of
/// their middle. bounds: of the scene at all times; empty: nothing is added.
void addGround(AnimatedScene& animated, const Bounds& bounds, const Grid& grid);

} // namespace zvo::cli
