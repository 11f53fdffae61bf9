#version 460
// SPDX-License-Identifier: MIT
// Finds which tiles can hit anything, and where their rays start. One ray through the middle of the tile goes through
// the beam grid. While the tile is no wider than a cell, and the middle is in a cell that is not set, no ray of the
// tile is in an occupied part of the octree. With a level of detail, no ray of the tile is then in an occupied node
// either, if the tile and the node together are no wider than a cell. (After S. Laine, T. Karras, Efficient Sparse
// Voxel Octrees, 2010, who trace a coarse picture instead and may miss what falls between its rays.)
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_ballot : require
#include "trace/beam.h"
#include "lib/bound.glsl"
#include "lib/camera.glsl"
#include "lib/dispatch.glsl"
#include "lib/ray.glsl"

layout(constant_id = 5) const bool kOrthographic = false;
layout(constant_id = 6) const bool kBeam = true;   // false: every tile lives from kTraceTimeMin on
layout(constant_id = 7) const bool kEmpty = false; // every tile is dead

layout(local_size_x = kBlockTiles) in;
layout(push_constant, scalar) uniform Push
{
    BeamParams params;
};

#define TRAVERSE_GROUP kBlockTiles
#include "lib/octree_loads.glsl"
#include "lib/traverse.glsl"

const float kBeamScale = float(kBeamCells - 2u) / float(kBeamCells); // from unit space to the beam grid's cube
const float kCoarseEdge = 1.0 / float(kBeamCells - 2u);              // of a cell, in unit space
const float kFineEdge = 0.25 * kCoarseEdge;
const float kBeamMargin = 0.98; // of a cell: the rest covers rounding, for origins within kBeamOriginMax
const float kBeamOriginMax = 1000.0;
const float kCellDepthMax = 1.8 * kCoarseEdge;      // more than a ray's depth grows inside a cell
const float kTileReach = float(kTileEdge - 1u); // from the middle of a tile to its outer pixels, in half pixels

// The time up to which all rays of a tile, and the nodes that they take as occupied, are within an edge of the middle
// ray.
float endWithin(float edge)
{
    vec3 reach = kTileReach * (abs(params.camera.half_pixel_x) + abs(params.camera.half_pixel_y));
    float widest = max(reach.x, max(reach.y, reach.z));
    float room = kBeamMargin * edge - params.detail.y;
    return kOrthographic ? (widest <= room ? kTraceTimeMax : 0.0)
                         : max(room, 0.0) / max(widest + params.detail.x, kTraceTimeMin);
}

// Depth of the octree's farthest corner. The depth of a point is a ray's time there, also where the camera's direction
// is not orthogonal to its pixels.
float lastDepth()
{
    vec3 forward = cross(params.camera.half_pixel_x, params.camera.half_pixel_y);
    forward /= dot(forward, params.camera.forward);
    return dot(1.5 - params.camera.origin, forward) + 0.501 * (abs(forward.x) + abs(forward.y) + abs(forward.z));
}

float tileStart(uvec2 tile)
{
    vec2 middle = vec2(ivec2(2u * kTileEdge * tile + kTileEdge) - ivec2(params.width, params.height));
    vec3 offset = rayOffset(middle, params.camera.half_pixel_x, params.camera.half_pixel_y);
    vec3 direction = params.camera.forward + (kOrthographic ? vec3(0.0) : offset);
    vec3 origin = params.camera.origin + (kOrthographic ? offset : vec3(0.0));
    vec3 from = abs(params.camera.origin);
    bool near = max(from.x, max(from.y, from.z)) <= kBeamOriginMax;
    float end = near ? endWithin(kCoarseEdge) : 0.0;
    // If the ray leaves a coarse cell too late for fine ones, the coarse cell ends it.
    float fine_end = endWithin(kFineEdge) - kCellDepthMax;
    vec2 detail = fine_end > kTraceTimeMin ? vec2(1.0 / (float(kBeamCells) * fine_end), 0.0)
                                           : vec2(0.0, 1.0 / float(kBeamCells));
    g_halves = uint64_t_ConstPtr(uint64_t(params.nodes));
    Traversal beam = traverse(1.5 + (origin - 1.5) * kBeamScale, inverseDirection(direction) / kBeamScale,
                              kTraceTimeMin, end, detail);
    float past = lastDepth() <= end ? kTileDead : max(end, kTraceTimeMin);
    return beam.hit ? beam.t : past;
}

// The tile of a thread, or one outside. Consecutive blocks are far apart, so that all parts of the live list take
// equally long.
uvec2 tileOfThread(uvec2 tiles)
{
    uvec2 blocks = (tiles + kBlockEdge - 1u) / kBlockEdge;
    uint count = blocks.x * blocks.y;
    uint block = uint(uint64_t(workgroupIndex()) * params.block_stride % count);
    uvec2 tile = kBlockEdge * uvec2(block % blocks.x, block / blocks.x) + pixelInTile(gl_LocalInvocationIndex);
    return workgroupIndex() < count ? tile : tiles;
}

void main()
{
    uvec2 tiles = (uvec2(params.width, params.height) + kTileEdge - 1u) / kTileEdge;
    uvec2 tile = tileOfThread(tiles);
    bool inside = all(lessThan(tile, tiles));
    float start = kEmpty ? kTileDead : kBeam ? tileStart(tile) : kTraceTimeMin;
    if (inside)
        params.starts.data[tile.y * tiles.x + tile.x] = start;

    bool live = inside && start < kTileDead;
    uvec4 ballot = subgroupBallot(live);
    uint count = subgroupBallotBitCount(ballot);
    uint first = 0u;
    if (subgroupElect() && count != 0u)
    {
        first = atomicAdd(params.status.data[0].live_tiles, count);
        atomicMax(params.args.data[0].x, min(first + count, kTilesFold));
        atomicMax(params.args.data[0].y, (first + count - 1u) / kTilesFold + 1u);
        atomicMax(params.args.data[0].z, 1u);
    }
    first = subgroupBroadcastFirst(first);
    if (live)
        params.live.data[first + subgroupBallotExclusiveBitCount(ballot)] =
            uvec2(packTile(tile), floatBitsToUint(start));
}
