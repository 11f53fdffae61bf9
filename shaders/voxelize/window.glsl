// SPDX-License-Identifier: MIT
// The part of the grid that is voxelized: a cube of it, or the whole grid.
// Needs params.window.
#ifndef ZVO_SHADERS_VOXELIZE_WINDOW_GLSL
#define ZVO_SHADERS_VOXELIZE_WINDOW_GLSL

#include "voxelize/window.h"

int gridDepth()
{
    return int(windowGridDepth(params.window));
}

// Level of the bricks of 16^3 cells among the nodes' levels. Grids of up to 4^3 are a part of one brick.
uint brickLevel()
{
    return max(uint(gridDepth() - 1) / 2u, 1u) - 1u;
}

int gridResolution()
{
    return 1 << gridDepth();
}

// Clips the voxels low to high that a triangle touches to the window; low > high if it touches none of it.
void clipToWindow(inout ivec3 low, inout ivec3 high)
{
    int depth = int(windowCubeDepth(params.window));
    ivec3 first = ivec3(windowIndex(params.window)) << depth;
    low = max(low, first);
    high = min(high, first + ((1 << depth) - 1));
}

#endif
