// SPDX-License-Identifier: MIT
// Counts of kept elements (nodes, or words of voxels) in blocks of kScanBlock.
#include "edit/compact.h"
#include "lib/dispatch.glsl"
#define SCAN_GROUP kScanGroup
#include "lib/scan.glsl"

layout(constant_id = 0) const bool kVoxels = false;

layout(local_size_x = kScanGroup) in;
layout(push_constant, scalar) uniform Push
{
    EditSumParams params;
};

uint keptIn(uint element)
{
    uint mark = params.marks.data[element];
    return kVoxels ? bitCount(mark) : mark != 0u ? 1u : 0u;
}
