// SPDX-License-Identifier: MIT
#pragma once

#include "options.h"

namespace zvo::cli
{

/// `zvo voxelize`: writes a scene's voxels. Throws Error.
void voxelize(const VoxelizeOptions& options);

} // namespace zvo::cli
