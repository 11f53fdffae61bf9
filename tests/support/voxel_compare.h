// SPDX-License-Identifier: MIT
#pragma once

#include "core/base/grid.h"
#include "core/scene/scene.h"
#include "runtime/trees.h"
#include "vk/headless.h"
#include "zvo/types.h"

#include <cstddef>

namespace zvo::test
{

/// Expects that the device makes the oracle's voxels of scene, in a well-formed octree, and drops as many triangles as
/// the oracle. Returns the number of voxels.
std::size_t expectEqualsOracle(vk::HeadlessDevice& device, const Scene& scene, const Grid& grid, Coverage coverage,
                               const BuildOptions& options = {});

} // namespace zvo::test
