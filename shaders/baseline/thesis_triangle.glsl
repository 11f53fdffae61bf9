// SPDX-License-Identifier: MIT
// Between a triangle that is set up and what is kept of it from pass to pass.
// Needs the constants kCoverage and kThin, and params.window.
#ifndef ZVO_SHADERS_BASELINE_THESIS_TRIANGLE_GLSL
#define ZVO_SHADERS_BASELINE_THESIS_TRIANGLE_GLSL

#define EDGE_WIDE
#define EDGE_INT int64_t
#define EDGE_IVEC3 i64vec3
#include "baseline/thesis.h"
#include "voxelize/raster.glsl"

ThesisTriangle packTriangle(RasterTriangle t, i64vec3 normal, uint draw, uint triangle)
{
    bvec3 negative = lessThan(permuted(normal, t.axis), i64vec3(0));
    uint bits = t.axis | uint(-t.mirror.x) << kThesisMirrorShift | uint(-t.mirror.y) << (kThesisMirrorShift + 1u) |
                (t.exchanged ? 1u : 0u) << kThesisExchangedShift | (negative.x ? 1u : 0u) << kThesisSignShift |
                (negative.y ? 1u : 0u) << (kThesisSignShift + 1u) | (negative.z ? 1u : 0u) << (kThesisSignShift + 2u);
    return ThesisTriangle(t.u, t.v, t.w, unpackInt2x32(t.rise_u), unpackInt2x32(t.rise_v), unpackInt2x32(t.n_w), t.low,
                          t.high, bits, draw, triangle);
}

RasterTriangle unpackTriangle(ThesisTriangle packed, int resolution)
{
    RasterTriangle t;
    t.u = packed.u;
    t.v = packed.v;
    t.w = packed.w;
    t.edge_u = t.u.yzx - t.u;
    t.edge_v = t.v.yzx - t.v;
    t.edge_w = t.w.yzx - t.w;
    t.rise_u = packInt2x32(packed.rise_u);
    t.rise_v = packInt2x32(packed.rise_v);
    t.n_w = packInt2x32(packed.n_w);
    t.axis = packed.bits & 3u;
    t.mirror = -ivec2((packed.bits >> kThesisMirrorShift) & 1u, (packed.bits >> (kThesisMirrorShift + 1u)) & 1u);
    t.exchanged = ((packed.bits >> kThesisExchangedShift) & 1u) != 0u;
    t.low = packed.low;
    t.high = packed.high;
    t.layer_top = t.rise_u == 0 && t.rise_v == 0 ? resolution - 1 : kLatticeLimit;
    return t;
}

// The normal of the lattice points in x, y, z.
vec3 latticeNormal(RasterTriangle t, uint bits)
{
    vec3 size = vec3(t.rise_u, t.rise_v, t.n_w);
    uvec3 negative = (uvec3(bits) >> (kThesisSignShift + uvec3(0u, 1u, 2u))) & 1u;
    vec3 n = mix(size, -size, equal(negative, uvec3(1u)));
    return t.axis == 0u ? n.zxy : (t.axis == 1u ? n.yzx : n);
}

#endif
