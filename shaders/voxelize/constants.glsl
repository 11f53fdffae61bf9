// SPDX-License-Identifier: MIT
// Specialization constants of the raster kernels.
#include "voxelize/voxelize.h"

layout(constant_id = 0) const uint kCoverage = 0u;
layout(constant_id = 1) const uint kMode = 0u;
layout(constant_id = 2) const uint kMaterialClass = 0u;
layout(constant_id = 3) const bool kEmits = false;

layout(push_constant, scalar) uniform Push
{
    RasterParams params;
};
