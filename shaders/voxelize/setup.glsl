// SPDX-License-Identifier: MIT
// The setups of triangles, which voxelize/bin writes.
// Needs params.setups, the macros of voxelize/raster.glsl, and the constant kEmits.
// SETUPS_BINDING (optional): the binding of params.setups in the kernel's bound form (lib/bound.glsl).
#ifndef ZVO_SHADERS_VOXELIZE_SETUP_GLSL
#define ZVO_SHADERS_VOXELIZE_SETUP_GLSL

#include "lib/bound.glsl"
#include "voxelize/bricks.h"
#include "voxelize/raster.glsl"

// TriangleSetup::flags: axis 2 bits, and
const uint kSetupAxis = 3u;
const uint kSetupMirrorU = 4u;
const uint kSetupMirrorV = 8u;
const uint kSetupExchanged = 16u;
const uint kSetupTextured = 32u;
const uint kSetupColored = 64u;
const uint kSetupEmissionTextured = 128u;
const uint kSetupFlat = 256u; // a segment or a point
const uint kSetupWrapU = 9u;  // 2 bits from this one on
const uint kSetupWrapV = 11u;
const uint kSetupEmissionWrapU = 13u;
const uint kSetupEmissionWrapV = 15u;

const uint kSurfacesOfTriangle = kEmits ? 2u : 1u; // SurfaceSetups

#if defined(BOUND) && defined(SETUPS_BINDING)
TEXELS_4(SETUPS_BINDING, setups);
#define SETUP_WORDS(I) texelFetch(texels4_setups, int(I))
#else
#define SETUP_WORDS(I) uvec4_ConstPtr(uint64_t(params.setups)).data[I]
#endif

// Compilers may load a struct word by word.
TriangleSetup loadSetup(uint i)
{
    uvec4 a = SETUP_WORDS(4u * i);
    uvec4 b = SETUP_WORDS(4u * i + 1u);
    uvec4 c = SETUP_WORDS(4u * i + 2u);
    uvec4 d = SETUP_WORDS(4u * i + 3u);
    return TriangleSetup(ivec3(a.xyz), ivec3(a.w, b.xy), ivec3(b.zw, c.x), uvec4(c.yzw, d.x), d.y, d.z, d.w);
}

bool hasFlag(TriangleSetup setup, uint flag)
{
    return (setup.flags & flag) != 0u;
}

uint pack16(int low, int high)
{
    return bitfieldInsert(uint(low), uint(high), 16, 16);
}

int low16(uint word)
{
    return bitfieldExtract(int(word), 0, 16);
}

int high16(uint word)
{
    return int(word) >> 16;
}

// -1 where u or v is mirrored, else 0.
ivec2 mirrorOf(TriangleSetup setup)
{
    return -ivec2(hasFlag(setup, kSetupMirrorU), hasFlag(setup, kSetupMirrorV));
}

// The normals of the vertices.
void unpackNormals(TriangleSetup setup, out ivec3 normals[3])
{
    uvec4 n = setup.normals;
    normals[0] = ivec3(low16(n.x), high16(n.x), low16(n.y));
    normals[1] = ivec3(high16(n.y), low16(n.z), high16(n.z));
    normals[2] = ivec3(low16(n.w), high16(n.w), low16(setup.last_normal));
}

// The voxels of a triangle that are among the cells low to high, given in x, y, z.
CellBox voxelBox(TriangleSetup setup, ivec3 low, ivec3 high)
{
    CellBox box = boxOf(setup.flags & kSetupAxis, mirrorOf(setup), low, high);
    ivec3 least = ivec3(min(setup.u.x, min(setup.u.y, setup.u.z)), min(setup.v.x, min(setup.v.y, setup.v.z)),
                        min(setup.w.x, min(setup.w.y, setup.w.z)));
    ivec3 most = ivec3(max(setup.u.x, max(setup.u.y, setup.u.z)), max(setup.v.x, max(setup.v.y, setup.v.z)),
                       max(setup.w.x, max(setup.w.y, setup.w.z)));
    // As voxelize/snap.glsl has it.
    box.low = max(box.low, ((least + (kVoxelLattice - 1)) >> kVoxelLatticeLog2) - 1);
    box.high = min(box.high, most >> kVoxelLatticeLog2);
    return box;
}

// box: of cells of the raster's size.
RasterTriangle rasterTriangle(TriangleSetup setup, CellBox box, int resolution)
{
    RasterTriangle t;
    t.u = setup.u;
    t.v = setup.v;
    t.w = setup.w;
    t.axis = setup.flags & kSetupAxis;
    t.mirror = mirrorOf(setup);
    t.exchanged = hasFlag(setup, kSetupExchanged);
    t.edge_u = t.u.yzx - t.u;
    t.edge_v = t.v.yzx - t.v;
    t.edge_w = t.w.yzx - t.w;
    t.rise_u = abs(product(t.edge_v.x, t.edge_w.y) - product(t.edge_w.x, t.edge_v.y));
    t.rise_v = abs(product(t.edge_w.x, t.edge_u.y) - product(t.edge_u.x, t.edge_w.y));
    t.n_w = abs(product(t.edge_u.x, t.edge_v.y) - product(t.edge_v.x, t.edge_u.y));
    t.low = box.low;
    t.high = box.high;
    t.layer_top = topLayer(t, resolution);
    return t;
}

#endif
