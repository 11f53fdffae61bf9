// SPDX-License-Identifier: MIT
// The axes u, v, w in which a triangle is rasterized (voxelize/raster.glsl).
#ifndef ZVO_SHADERS_VOXELIZE_AXES_GLSL
#define ZVO_SHADERS_VOXELIZE_AXES_GLSL

#include "shared/gpu.h"

// Which of x, y, z is w. A triangle without area has no major axis: w is the axis along which its box is thinnest, so
// that a column has few layers to try. low, high: touched voxels.
uint majorAxis(i64vec3 n, ivec3 low, ivec3 high)
{
    i64vec3 size = n == i64vec3(0) ? i64vec3(low - high) : abs(n);
    return size.x >= size.y && size.x >= size.z ? 0u : (size.y >= size.z ? 1u : 2u);
}

// -1 where u or v is mirrored, else 0. m: the normal in u, v, w.
ivec2 mirrorOf(i64vec3 m)
{
    return ivec2((m.x ^ m.z) < 0 ? 0 : -1, (m.y ^ m.z) < 0 ? 0 : -1);
}

// In u, v, w what is given in x, y, z.
ivec3 permuted(ivec3 a, uint axis)
{
    return axis == 0u ? a.yzx : (axis == 1u ? a.zxy : a);
}

i64vec3 permuted(i64vec3 a, uint axis)
{
    return axis == 0u ? a.yzx : (axis == 1u ? a.zxy : a);
}

// In x, y, z what is given in u, v, w.
ivec3 unpermuted(ivec3 a, uint axis)
{
    return axis == 0u ? a.zxy : (axis == 1u ? a.yzx : a);
}

// Voxels low to high along an axis that may be mirrored. mirror: -1 or 0.
ivec2 mirroredRange(ivec2 range, int mirror)
{
    return mirror < 0 ? ~range.yx : range;
}

// Cells low to high, both included, in u, v, w.
struct CellBox
{
    ivec3 low;
    ivec3 high;
};

// The box of cells that is given in x, y, z.
CellBox boxOf(uint axis, ivec2 mirror, ivec3 low, ivec3 high)
{
    CellBox box = CellBox(permuted(low, axis), permuted(high, axis));
    ivec2 range_u = mirroredRange(ivec2(box.low.x, box.high.x), mirror.x);
    ivec2 range_v = mirroredRange(ivec2(box.low.y, box.high.y), mirror.y);
    box.low.xy = ivec2(range_u.x, range_v.x);
    box.high.xy = ivec2(range_u.y, range_v.y);
    return box;
}

#endif
