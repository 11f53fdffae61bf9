// SPDX-License-Identifier: MIT
// The window of a voxelization: the cube of the grid that is voxelized, or the whole grid. BinParams::window holds it
// in a word:
//
//     | depth of the grid 5 | depth of the cube 5 | x 7 | y 7 | z 7 | unused 1 |    from the lowest bit on
//
// x, y and z number the cube among the cubes of its size.
#ifndef ZVO_SHADERS_VOXELIZE_WINDOW_H
#define ZVO_SHADERS_VOXELIZE_WINDOW_H

#include "shared/gpu.h"

GPU_NAMESPACE_BEGIN

const uint kWindowDepthBits = 5u;
const uint kWindowIndexBits = 7u;
const uint kWindowCubeDepthShift = 5u;
const uint kWindowXShift = 10u;
const uint kWindowYShift = 17u;
const uint kWindowZShift = 24u;

/// Depths must be below 1 << kWindowDepthBits, components of the index below 1 << kWindowIndexBits.
GPU_FUNCTION uint packWindow(uint grid_depth, uint cube_depth, uvec3 index)
{
    return grid_depth | (cube_depth << kWindowCubeDepthShift) | (index.x << kWindowXShift) |
           (index.y << kWindowYShift) | (index.z << kWindowZShift);
}

GPU_FUNCTION uint windowGridDepth(uint window)
{
    return window & ((1u << kWindowDepthBits) - 1u);
}

GPU_FUNCTION uint windowCubeDepth(uint window)
{
    return (window >> kWindowCubeDepthShift) & ((1u << kWindowDepthBits) - 1u);
}

GPU_FUNCTION uvec3 windowIndex(uint window)
{
    uint mask = (1u << kWindowIndexBits) - 1u;
    return uvec3((window >> kWindowXShift) & mask, (window >> kWindowYShift) & mask, (window >> kWindowZShift) & mask);
}

GPU_NAMESPACE_END

#endif
