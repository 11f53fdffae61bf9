// SPDX-License-Identifier: MIT
// Limits of questions to a tree (lib/query.glsl).
#ifndef ZVO_SHADERS_SHARED_QUERY_H
#define ZVO_SHADERS_SHARED_QUERY_H

#include "shared/lattice.h"

GPU_NAMESPACE_BEGIN

const int kQueryReach = 1 << 27; // lattice units: positions are at most so far from the grid's corner, motions so long
const int kNearestReach = 1 << 29; // likewise: no distance is larger

GPU_NAMESPACE_END

#endif
