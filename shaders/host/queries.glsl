// SPDX-License-Identifier: MIT
// Questions to any tree by its table (lib/query.glsl): a part of host/trace.glsl, which says how it is used.
#ifndef ZVO_SHADERS_HOST_QUERIES_GLSL
#define ZVO_SHADERS_HOST_QUERIES_GLSL

#include "lib/query.glsl"
#include "shared/tree_table.h"
#include "trace/any_tree.glsl"

// The lattice position of a point in world space, rounded down; for NaN, and far away, one that finds nothing.
ivec3 zvo_toLattice(TreeTable_ConstPtr tree, vec3 position)
{
    float beyond = float(2 * kQueryReach);
    precise vec3 voxels = (position - tree.data[0].origin) / tree.data[0].voxel_size;
    vec3 lattice = floor(voxels * float(kVoxelLattice));
    bvec3 near = lessThan(abs(lattice), vec3(beyond)); // not NaN
    return ivec3(mix(vec3(beyond), lattice, near));
}

// Whether questions have anything to look at.
bool setAsked(TreeTable_ConstPtr tree)
{
    setTree(tree);
    return uint64_t(g_halves) != 0ul;
}

// The voxel that a point is in.
Hit zvo_point(TreeTable_ConstPtr tree, ivec3 position)
{
    Traversal found = nothingFound();
    if (setAsked(tree))
        found = findPoint(position);
    return toHit(tree, found);
}

// The first voxel in Morton order that has a point in common with the inside of a box.
Hit zvo_box(TreeTable_ConstPtr tree, ivec3 low, ivec3 high)
{
    Traversal found = nothingFound();
    if (setAsked(tree))
        found = findInBox(low, high);
    return toHit(tree, found);
}

// The nearest voxel to a point, at most `reach` lattice units away. t: about the distance in voxels.
Hit zvo_nearest(TreeTable_ConstPtr tree, ivec3 position, uint reach)
{
    Traversal found = nothingFound();
    if (setAsked(tree))
        found = findNearest(position, reach);
    return toHit(tree, found);
}

// The first voxel that a box meets as it moves. t: about the time.
Hit zvo_sweep(TreeTable_ConstPtr tree, ivec3 low, ivec3 high, ivec3 motion)
{
    Traversal found = nothingFound();
    if (setAsked(tree))
        found = findOnWay(low, high, motion);
    return toHit(tree, found);
}

// The squared distance of a point from a voxel, in lattice units.
uint64_t zvo_squaredDistance(ivec3 position, Hit hit)
{
    return squaredDistance(position, ivec3(hitCell(hit)) << kVoxelLatticeLog2, kVoxelLattice);
}

// The time at which a box meets the voxel that it has found: x / y, in [0, 1).
ivec2 zvo_sweepTime(ivec3 low, ivec3 high, ivec3 motion, Hit hit)
{
    ivec2 time = contactWith(low, high, motion, ivec3(hitCell(hit)) << kVoxelLatticeLog2, kVoxelLattice).time;
    return ivec2(max(time.x, 0), time.y);
}

#endif
