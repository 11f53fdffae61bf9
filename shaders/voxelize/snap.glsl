// SPDX-License-Identifier: MIT
// A triangle on the lattice, and whether it is left out (docs/voxelization.md).
// Needs what voxelize/vertex.glsl and window.glsl need, and params.lattice_offset.
#ifndef ZVO_SHADERS_VOXELIZE_SNAP_GLSL
#define ZVO_SHADERS_VOXELIZE_SNAP_GLSL

#include "lib/arithmetic.glsl"
#include "voxelize/vertex.glsl"
#include "voxelize/window.glsl"

// Reasons to leave a triangle out.
const uint kKept = 0u;
const uint kNonfinite = 1u;
const uint kOutOfRange = 2u;
const uint kOutside = 3u;
const uint kZeroArea = 4u;

struct SnappedTriangle
{
    ivec3 v0;
    ivec3 v1;
    ivec3 v2;
    i64vec3 normal;
    ivec3 low; // touched voxels, inside the window
    ivec3 high;
    uint fate;
};

// A closed range [min, max] touches the closed voxels from ceil(min / 256) - 1 to floor(max / 256).
void touchedVoxels(inout SnappedTriangle t)
{
    t.low = ((min(t.v0, min(t.v1, t.v2)) + (kVoxelLattice - 1)) >> kVoxelLatticeLog2) - 1;
    t.high = max(t.v0, max(t.v1, t.v2)) >> kVoxelLatticeLog2;
}

ivec3 unpackPointShift(uint word)
{
    int shift = int(word);
    return ivec3(bitfieldExtract(shift, 0, 8), bitfieldExtract(shift, 8, 8), bitfieldExtract(shift, 16, 8));
}

// Makes a point a triangle that covers its voxel alone, thin or conservatively: over the voxel's middle, and away from
// its faces. shift: in half voxels.
void spreadPoint(inout SnappedTriangle t, ivec3 shift)
{
    const int quarter = kVoxelLattice / 4;
    ivec3 inside = min(t.v0, kVoxelLattice * gridResolution() - 1); // the grid's upper faces are the last layers'
    ivec3 place = inside - params.lattice_offset + shift * (kVoxelLattice / 2);
    ivec3 corner = (place & ~(kVoxelLattice - 1)) + params.lattice_offset;
    t.v0 = corner + ivec3(quarter, quarter, 2 * quarter);
    t.v1 = corner + ivec3(3 * quarter, quarter, 2 * quarter);
    t.v2 = corner + ivec3(quarter, 3 * quarter, 2 * quarter);
}

// drops_flat: a triangle without area has no voxels.
SnappedTriangle snapTriangle(Draw draw, uvec3 vertices, bool drops_flat)
{
    vec3 p0 = worldPosition(draw, vertices.x);
    vec3 p1 = worldPosition(draw, vertices.y);
    vec3 p2 = worldPosition(draw, vertices.z);
    vec3 q0 = latticePosition(p0);
    vec3 q1 = latticePosition(p1);
    vec3 q2 = latticePosition(p2);
    bool finite = isFinite(p0) && isFinite(p1) && isFinite(p2);
    bool in_range = finite && onLattice(q0) && onLattice(q1) && onLattice(q2);

    SnappedTriangle t;
    t.v0 = in_range ? ivec3(q0) + params.lattice_offset : ivec3(0);
    t.v1 = in_range ? ivec3(q1) + params.lattice_offset : ivec3(0);
    t.v2 = in_range ? ivec3(q2) + params.lattice_offset : ivec3(0);
    touchedVoxels(t);
    bool outside = any(lessThan(t.high, ivec3(0))) || any(greaterThanEqual(t.low, ivec3(gridResolution())));
    if (draw.is_points != 0u)
    {
        spreadPoint(t, unpackPointShift(draw.point_shift));
        touchedVoxels(t);
    }
    i64vec3 a = i64vec3(t.v1 - t.v0);
    i64vec3 b = i64vec3(t.v2 - t.v0);
    t.normal = a.yzx * b.zxy - a.zxy * b.yzx;
    clipToWindow(t.low, t.high);
    bool flat_out = drops_flat && t.normal == i64vec3(0);
    t.fate = !finite ? kNonfinite : (!in_range ? kOutOfRange : (outside ? kOutside : (flat_out ? kZeroArea : kKept)));
    return t;
}

#endif
