#version 460
// SPDX-License-Identifier: MIT
// Finds which tiles can hit anything, and where their rays start: just before the first occupied cells that any ray of
// the tile can be in. So the picture is the same, bit for bit.
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_ballot : require
#extension GL_KHR_shader_subgroup_shuffle : require
#include "trace/beam.h"

GPU_ENTRY(BeamParams, TRACE_BEAM_CONSTANTS);
layout(local_size_x = kBlockTiles) in;

#define NODES_BINDING 0
#include "lib/bound.glsl"
#include "lib/camera.glsl"
#include "lib/dispatch.glsl"
#include "lib/half_node.glsl"
#include "lib/ray.glsl"
#include "trace/beam_start.glsl"

const float kTileReach = float(kTileEdge - 1u); // from the middle of a tile to its outer pixels, in half pixels
const float kRounding = 1.0 / float(1u << 19);  // relative: more than rays' positions, directions and times have
const float kSmallCell = 0.5;                   // of the beam's width

// Where the rays of a tile start; kTileDead if they can hit nothing.
float tileStart(uvec2 tile)
{
    vec2 middle = vec2(ivec2(2u * kTileEdge * tile + kTileEdge) - ivec2(params.width, params.height));
    vec3 offset = rayOffset(middle, params.camera.half_pixel_x, params.camera.half_pixel_y);
    vec3 reach = kTileReach * (abs(params.camera.half_pixel_x) + abs(params.camera.half_pixel_y));
    vec3 sizes = abs(middle.x * params.camera.half_pixel_x) + abs(middle.y * params.camera.half_pixel_y) + reach;
    float small_edge = 2.0 * kSmallCell * max(reach.x, max(reach.y, reach.z));

    // How far the rays of the tile may be from the one in its middle, rounding included.
    vec3 farthest = abs(params.camera.origin) + (kOrthographic ? sizes : vec3(0.0));
    float origin_rounding = kRounding * (4.0 + max(farthest.x, max(farthest.y, farthest.z)));
    vec3 origin_reach = origin_rounding + (kOrthographic ? reach : vec3(0.0));
    vec3 direction_sizes = abs(params.camera.forward) + (kOrthographic ? vec3(0.0) : sizes);
    vec3 direction_reach = kRounding * direction_sizes + (kOrthographic ? vec3(0.0) : reach);

    vec3 origin = params.camera.origin + (kOrthographic ? offset : vec3(0.0));
    vec3 direction = params.camera.forward + (kOrthographic ? vec3(0.0) : offset);
    bvec3 upward = greaterThanEqual(direction, vec3(0.0));
    vec3 ahead = mix(vec3(-1.0), vec3(1.0), upward);
    vec3 fast_inverse = inverseDirection(direction + ahead * direction_reach);
    vec3 slow_inverse = inverseDirection(direction - ahead * direction_reach);
    // Slow rays leave, so their times are made later; where rays go both ways they enter, so they are made earlier.
    bvec3 one_way = equal(greaterThan(slow_inverse, vec3(0.0)), upward);
    Beam beam;
    beam.fast_origin = origin + ahead * origin_reach;
    beam.slow_origin = origin - ahead * origin_reach;
    beam.fast_inverse = (1.0 - kRounding) * fast_inverse;
    beam.slow_inverse = mix(vec3(1.0 - kRounding), vec3(1.0 + kRounding), one_way) * slow_inverse;
    beam.small = max((1.0 + kRounding) * params.detail, kOrthographic ? vec2(0.0, small_edge) : vec2(small_edge, 0.0));
    g_halves = uint64_t_ConstPtr(uint64_t(params.nodes));
    return beamStart(beam, mirrorBits(not(upward))); // kTileDead is what it returns for no cell
}

// The tile of a thread, or one outside. Consecutive blocks are far apart, so that all parts of the live list take
// equally long. With lanes, as many workgroups share a block.
uvec2 tileOfThread(uvec2 tiles)
{
    uint thread = kLanes == 1u ? gl_LocalInvocationIndex : gl_SubgroupID * gl_SubgroupSize + gl_SubgroupInvocationID;
    uint number = workgroupIndex() % kLanes * (kBlockTiles / kLanes) + thread / kLanes; // in its block
    uvec2 blocks = (tiles + kBlockEdge - 1u) / kBlockEdge;
    uint count = blocks.x * blocks.y;
    uint block = uint(uint64_t(workgroupIndex() / kLanes) * params.block_stride % count);
    uvec2 tile = kBlockEdge * uvec2(block % blocks.x, block / blocks.x) + pixelInTile(number);
    return workgroupIndex() / kLanes < count ? tile : tiles;
}

void main()
{
    uvec2 tiles = (uvec2(params.width, params.height) + kTileEdge - 1u) / kTileEdge;
    uvec2 tile = tileOfThread(tiles);
    bool inside = all(lessThan(tile, tiles)) && laneOfBeam() == 0u; // the first of its lanes writes
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
