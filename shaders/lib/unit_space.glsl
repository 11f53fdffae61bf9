// SPDX-License-Identifier: MIT
// Cells of the octree in unit space (shared/trace.h): their coordinates are mantissa bits of floats in [1, 2).
#ifndef ZVO_SHADERS_LIB_UNIT_SPACE_GLSL
#define ZVO_SHADERS_LIB_UNIT_SPACE_GLSL

const uint kMantissaBits = 23u;
const uint kRootShift = kMantissaBits - 2u; // of the mantissa bits that number the root's cells

// Length in unit space of this many mantissa steps.
float edgeOf(uint size)
{
    return float(size) / float(1u << kMantissaBits);
}

// The bits of a cell's number in its block (lib/morton.glsl) that are inverted where these axes are mirrored.
uint mirrorBits(bvec3 mirrored)
{
    return (mirrored.x ? 9u : 0u) | (mirrored.y ? 18u : 0u) | (mirrored.z ? 36u : 0u);
}

#endif
