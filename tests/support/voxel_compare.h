// SPDX-License-Identifier: MIT
#pragma once

#include "core/base/grid.h"
#include "core/headless/pipeline.h"
#include "core/scene/scene.h"
#include "vk/headless.h"
#include "zvo/types.h"

#include <cstddef>

namespace zvo::test
{

/// Expects that device makes of scene exactly the oracle's voxels, a well-formed octree of them, and drops as many
/// triangles. Returns the number of voxels.
std::size_t expectEqualsOracle(vk::HeadlessDevice& device, const Scene& scene, const Grid& grid, Coverage coverage,
                               const BuildOptions& options = {});

} // namespace zvo::test
