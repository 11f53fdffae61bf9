// SPDX-License-Identifier: MIT
// The lattice on which positions in a grid are integers, from the grid's minimum corner on.
#ifndef ZVO_SHADERS_SHARED_LATTICE_H
#define ZVO_SHADERS_SHARED_LATTICE_H

#include "shared/gpu.h"

GPU_NAMESPACE_BEGIN

const int kVoxelLattice = 256; // lattice units a voxel
const int kVoxelLatticeLog2 = 8;

GPU_NAMESPACE_END

#endif
