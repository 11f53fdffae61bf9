// SPDX-License-Identifier: MIT
#pragma once

namespace zvo
{

/// Which voxels a triangle covers; docs/voxelization.md defines both.
enum class Coverage
{
    Conservative, ///< every voxel whose closed box has a point in common with the triangle
    Thin          ///< 6-separating: no path along the voxels' faces leads through the surface
};

} // namespace zvo
