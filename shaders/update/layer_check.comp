#version 460
// SPDX-License-Identifier: MIT
// Checks whether there was room for everything that a layer's coverage has listed.
#extension GL_GOOGLE_include_directive : require
#include "update/update.h"

layout(local_size_x = kArgsGroup) in;
layout(push_constant, scalar) uniform Push
{
    LayerCheckParams params;
};

void main()
{
    if (gl_LocalInvocationIndex != 0u)
        return;
    LayerCounters counters = params.counters.data[0];
    counters.overflow_count = params.brick_counters.data[0].overflow_count;
    for (uint i = 0u; i < kClassCount; ++i)
        if (uint64_t(params.rasters[i]) != 0ul)
        {
            RasterCounters raster = params.rasters[i].data[0];
            counters.big_count = max(counters.big_count, raster.big_count);
            counters.block_count = max(counters.block_count, raster.block_count);
            counters.blocks_exceeded |= raster.blocks_exceeded;
            counters.nonfinite += raster.nonfinite;
            counters.out_of_range += raster.out_of_range;
            counters.outside += raster.outside;
            counters.zero_area += raster.zero_area;
        }
    bool failed = counters.overflow_count != 0u || counters.blocks_exceeded != 0u ||
                  counters.leaf_count > params.leaf_capacity || counters.voxel_count > params.voxel_capacity ||
                  counters.big_count > params.big_capacity || counters.block_count > params.block_capacity;
    counters.failed = failed ? 1u : 0u;
    params.counters.data[0] = counters;
    params.reports.data[params.report] = counters;
}
