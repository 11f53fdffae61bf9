// SPDX-License-Identifier: MIT
// The part of the grid that is voxelized: a cube of it, or the whole grid.

int gridDepth()
{
    return int(params.window & ((1u << kWindowDepthBits) - 1u));
}

int gridResolution()
{
    return 1 << gridDepth();
}

// Clips the voxels low to high that a triangle touches to the window; low > high if it touches none of it.
void clipToWindow(inout ivec3 low, inout ivec3 high)
{
    int depth = int(bitfieldExtract(params.window, int(kWindowDepthBits), int(kWindowDepthBits)));
    uvec3 indices = uvec3(params.window) >> (2u * kWindowDepthBits + kWindowIndexBits * uvec3(0u, 1u, 2u));
    ivec3 first = ivec3(indices & ((1u << kWindowIndexBits) - 1u)) << depth;
    low = max(low, first);
    high = min(high, first + ((1 << depth) - 1));
}
