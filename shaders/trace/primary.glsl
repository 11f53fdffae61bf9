// SPDX-License-Identifier: MIT
// Traces the rays of all pixels in live tiles, one workgroup for each tile. Rays that use up their iterations resume in
// another round. With PRIMARY_RANKS, hits in a DAG get the ranks that are the indices of their
// attributes (D. Dolonius, E. Sintorn, V. Kaempe, U. Assarsson, Compressing Color Data for Voxelized Surface Geometry,
// 2017, who sum up during the traversal; here only the path of the hit is summed up). Needs GPU_ENTRY with
// PrimaryParams and TRACE_PRIMARY_CONSTANTS or, with PRIMARY_RANKS, with PrimaryRanksParams and
// TRACE_PRIMARY_RANKS_CONSTANTS.
#ifndef ZVO_SHADERS_TRACE_PRIMARY_GLSL
#define ZVO_SHADERS_TRACE_PRIMARY_GLSL

#include "trace/node_paths.h"
#include "lib/camera.glsl"
#include "lib/dispatch.glsl"
#include "lib/hit.glsl"
#include "lib/ray.glsl"

layout(local_size_x = kTilePixels) in;

#ifdef PRIMARY_RANKS
#define TRAVERSE_ENTRIES
#endif
#define NODES_BINDING 0
#define PATHS_BINDING 1
#ifndef PRIMARY_RANKS
#define GROUPS_BINDING 2
#endif
#include "lib/half_node.glsl"
#include "trace/traverse_paths.glsl"
#include "trace/rounds.glsl"

#ifdef PRIMARY_RANKS
#include "lib/morton.glsl"
#define RANKS_BINDING 2
#include "trace/hit_rank.glsl"

// The rank of the hit; for a miss, any number. Misses make all loads, too, except those of the descent;
// lib/traverse.glsl says why.
uint rankOf(Traversal hit)
{
    RankSource source = RankSource(params.nodes, params.before, params.voxels_before_leaf, params.first_short_entry);
    BeforeChild_ConstPtr overlay_ranks = BeforeChild_ConstPtr(kOverlays ? g_paths.data[kRankTableOverlays] : 0ul);
    uvec3 cell = (hit.cell >> (2u * (kNodeLevels - kPathLevels))) & (kPathCells - 1u);
    uint index = kRankTableFirst + (cell.x | (cell.y << kPathCellBits) | (cell.z << (2u * kPathCellBits)));
    uvec2 first = loadPath(index);
    RankedNode at = RankedNode(first.x, first.y, 0u);
    bool in_overlay = kOverlays && (at.node & kChildList) != 0u;
    at.node &= kOverlays ? ~kChildList : ~0u;
    uint to = hit.hit ? kNodeLevels : 0u;
    descendToHit(source, overlay_ranks, hit.cell, kNodeLevels, kPathLevels, to, in_overlay, at);
    if (kNodeLevels > kPathLevels + 1u)
    {
        if (kOverlays)
        {
            uint base = loadHalf(2u * (in_overlay ? at.node : 0u) + (cellInBlock(hit.cell >> 2u) >> 5u)).y;
            in_overlay = in_overlay && (base & kChildList) == 0u;
        }
        at.voxels += voxelsBeforeLeaf(source, max(hit.leaf_entry, params.first_short_entry));
    }
    return voxelRank(hit.index, in_overlay ? 0u : at.voxels); // in leaves of overlays, voxels have numbers of their own
}
#endif

void main()
{
    CameraRays camera = params.camera;
    uvec2 size = uvec2(params.width, params.height);
    uvec2 tile = params.live.data[workgroupIndex()];
    if (tile.x == kNoTile)
        return;
    uvec2 pixel = kTileEdge * unpackTile(tile.x) + pixelInTile(gl_LocalInvocationIndex);
    vec3 offset = rayOffset(pixelOffset(pixel, size), camera.half_pixel_x, camera.half_pixel_y);
    precise vec3 direction = camera.forward + (kOrthographic ? vec3(0.0) : offset);
    precise vec3 origin = camera.origin + (kOrthographic ? offset : vec3(0.0));
    g_halves = uint64_t_ConstPtr(uint64_t(params.nodes));
#ifndef PRIMARY_RANKS
    g_leaf_groups = uint64_t_ConstPtr(uint64_t(params.leaf_groups));
#endif
    g_paths = params.paths;
    uint i = pixel.y * size.x + pixel.x;
#ifdef PRIMARY_RANKS
    const vec2 detail = vec2(0.0);
#else
    vec2 detail = params.detail;
#endif
    uvec3 from = uvec3(0u);
    if (kResume)
    {
        if (any(greaterThanEqual(pixel, size)))
            return;
        Hit last = loadHit(Hit_ConstPtr(uint64_t(params.hits)), i);
        if (last.index != kHitUnfinished)
            return;
        from = limitsAfter(last.t, hitFace(last));
    }
    Traversal result = traverse(origin, inverseDirection(direction), uintBitsToFloat(tile.y), kTraceTimeMax,
                                detail, from, kIterationsMax);
    if (any(greaterThanEqual(pixel, size)))
        return;
    if (result.unfinished)
        endUnfinished(kMore, params.next_round, params.status.data[0].live_tiles, params.status);
#ifdef PRIMARY_RANKS
    result.index = rankOf(result);
#endif
    uint miss = kMore && result.unfinished ? kHitUnfinished : kHitMiss;
    storeHit(params.hits, i, result.t, result.hit ? result.index : miss, result.cell, result.level, result.face);
#ifndef PRIMARY_RANKS
    if (kCountIterations)
        params.iterations.data[i] = result.iterations + (kResume ? params.iterations.data[i] : 0u);
#endif
}

#endif
