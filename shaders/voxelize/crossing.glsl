// SPDX-License-Identifier: MIT
// Where triangles cross the lines along an axis through the centres of voxels (docs/voxelization.md). A line along y is
// moved by e along x and by e^2 along z, e being smaller than any number: then it passes all edges and vertices, so that
// of triangles that share one, as many are crossed as enclose the line. For lines along z and x, the axes are turned.
//
// Thin coverage covers every voxel in which a triangle crosses such a line: the crossing is on the major axis' line of
// the voxel, too, or less than half a voxel from it, as the plane is steepest along the major axis. So the fragments of
// a triangle are all that need a look. A crossing on the face between two voxels belongs to the upper one in mirrored
// coordinates of the triangle, which is always covered.
#ifndef ZVO_SHADERS_VOXELIZE_CROSSING_GLSL
#define ZVO_SHADERS_VOXELIZE_CROSSING_GLSL

#include "voxelize/setup.glsl"
#include "voxelize/window.glsl"

// Whether edge functions are positive at the moved line. edges_a, edges_b: of the two axes, in the order of the function
// edge_a * to_b - edge_b * to_a. move_a, move_b: 1 or -1, the line's moves along them. a_first: it moves more along a.
bvec3 areInside(i64vec3 edge, ivec3 edges_a, ivec3 edges_b, int move_a, int move_b, bool a_first)
{
    ivec3 by_a = -edges_b * move_a;
    ivec3 by_b = edges_a * move_b;
    ivec3 first = a_first ? by_a : by_b;
    ivec3 second = a_first ? by_b : by_a;
    ivec3 moved = mix(first, second, equal(first, ivec3(0)));
    return bvec3(edge.x > 0l || (edge.x == 0l && moved.x > 0), edge.y > 0l || (edge.y == 0l && moved.y > 0),
                 edge.z > 0l || (edge.z == 0l && moved.z > 0));
}

// floor((a.x b.x + a.y b.y + a.z b.z) / (kVoxelLattice / 2)): it must fit, the products need not.
int64_t halfVoxels(i64vec3 a, ivec3 b)
{
    const int log2 = kVoxelLatticeLog2 - 1;
    const int low_bits = (1 << log2) - 1;
    ivec3 low_b = b & low_bits;
    ivec3 low_a = ivec3(a) & low_bits;
    i64vec3 high = a * i64vec3(b >> log2) + (a >> log2) * i64vec3(low_b);
    ivec3 low = low_a * low_b;
    return high.x + high.y + high.z + int64_t((low.x + low.y + low.z) >> log2);
}

// Axes of lines.
const int kAlongW = 0;
const int kAlongU = 1;
const int kAlongV = 2;

// Whether the triangle crosses a line above the voxel's centre, which is moved as the line is, and then up by e^3: so
// it lies on no triangle. plane, exact: what halfVoxels() gives, and its product modulo 2^64. rises: along u and v.
bool isAbove(int64_t plane, int64_t exact, i64vec2 rises, ivec2 unmirrored, int along)
{
    int side = plane > 0l || exact != 0l ? 1 : -1; // of the plane over the centre, along w; only where plane is not below 0
    if (plane == 0l && exact == 0l)
    {
        bool by_v = along == kAlongW && rises.y != 0l;
        bool by_u = along != kAlongU && rises.x != 0l;
        side = by_v ? unmirrored.y : by_u ? unmirrored.x : -1;
    }
    side = plane < 0l ? -1 : side;
    int flip = along == kAlongU ? unmirrored.x : unmirrored.y; // along u and v, the plane is on the other side
    return along == kAlongW ? side > 0 : side * flip < 0;
}

// 1 where the triangle crosses the line within the voxel and faces up, -1 where it faces down, 0 where it does not
// cross it. line: 0 along y, 1 along z, 2 along x. above: whether that is above the centre, of lines along y.
int crossing(TriangleSetup setup, ivec3 voxel, uint line, out bool above)
{
    above = false;
    uint axis = setup.flags & kSetupAxis;
    int turn = int(line) + 1 - int(axis); // u, v and w follow each other as x, y and z do
    int along = turn < 0 ? turn + 3 : turn > 2 ? turn - 3 : turn;
    ivec2 mirror = mirrorOf(setup);
    ivec3 place = permuted(voxel, axis);
    place.xy ^= mirror;
    ivec3 centre = place * kVoxelLattice + kVoxelLattice / 2;
    ivec3 to_u = centre.x - setup.u;
    ivec3 to_v = centre.y - setup.v;
    ivec3 to_w = centre.z - setup.w;
    ivec3 edge_u = setup.u.yzx - setup.u;
    ivec3 edge_v = setup.v.yzx - setup.v;
    ivec3 edge_w = setup.w.yzx - setup.w;
    int64_t rise_u = abs(product(edge_v.x, edge_w.y) - product(edge_w.x, edge_v.y));
    int64_t rise_v = abs(product(edge_w.x, edge_u.y) - product(edge_u.x, edge_w.y));
    int64_t n_w = abs(product(edge_u.x, edge_v.y) - product(edge_v.x, edge_u.y));

    // From the voxel's centre to the plane, times n_w along w, times -rise_u along u and -rise_v along v.
    int64_t reach = along == kAlongW ? n_w : along == kAlongU ? rise_u : rise_v;
    int64_t plane = halfVoxels(i64vec3(rise_u, rise_v, -n_w), ivec3(to_u.x, to_v.x, to_w.x));
    bool in_top = along == kAlongW && rise_u == 0l && rise_v == 0l && place.z + 1 == gridResolution(); // as topLayer() has it
    if (plane < -reach || (in_top ? plane > reach : plane >= reach))
        return 0;

    // The triangle along the line: over (u, v), (w, v) and (u, w).
    bool is_w = along == kAlongU; // a is w
    ivec3 edges_a = is_w ? edge_w : edge_u;
    ivec3 to_a = is_w ? to_w : to_u;
    ivec3 edges_b = along == kAlongV ? edge_w : edge_v;
    ivec3 to_b = along == kAlongV ? to_w : to_v;
    ivec2 unmirrored = 2 * mirror + 1; // 1, or -1 where mirrored
    int move_a = is_w ? 1 : unmirrored.x;
    int move_b = along == kAlongV ? 1 : unmirrored.y;
    i64vec3 edge = product(edges_a, to_b) - product(edges_b, to_a);
    if (!all(areInside(edge, edges_a, edges_b, move_a, move_b, along != kAlongW)))
        return 0;
    int64_t exact = rise_u * int64_t(to_u.x) + rise_v * int64_t(to_v.x) - n_w * int64_t(to_w.x);
    above = isAbove(plane, exact, i64vec2(rise_u, rise_v), unmirrored, along);
    bool w_is_positive = hasFlag(setup, kSetupExchanged) == (mirror.x != mirror.y); // of the normal
    int flip = along == kAlongU ? mirror.x : mirror.y;
    bool is_up = along == kAlongW ? w_is_positive : w_is_positive == (flip != 0);
    return is_up ? 1 : -1;
}

#endif
