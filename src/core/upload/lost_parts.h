// SPDX-License-Identifier: MIT
#pragma once

#include "core/base/grid.h"
#include "core/scene/scene.h"

#include <cstdint>

namespace zvo
{

/// The connected parts of a scene's instances that touch a grid.
struct PartCount
{
    std::uint64_t parts = 0;
    std::uint64_t lost = 0; // those that thin coverage gives no voxel
};

/// Counts parts. Materials do not matter. Parts are counted as welded only where some are lost; otherwise there may be
/// fewer than are counted. Cost: triangles; where parts are lost, a sort of the vertices.
PartCount countParts(const Scene& scene, const Grid& grid);

} // namespace zvo
