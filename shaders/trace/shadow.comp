#version 460
// SPDX-License-Identifier: MIT
// Traces shadow rays from hits to the sun, one workgroup for each live tile. Rays that use up their iterations resume
// in another round. Until then, light holds the time of the last event, which is greater than any light.
#extension GL_GOOGLE_include_directive : require
#include "trace/light.h"

GPU_ENTRY(ShadowParams, TRACE_SHADOW_CONSTANTS);
layout(local_size_x = kTilePixels) in;

#define NODES_BINDING 0
#define TRAVERSE_WITHOUT_INDICES
#include "lib/bound.glsl"
#include "lib/camera.glsl"
#include "lib/dispatch.glsl"
#include "lib/half_node.glsl"
#include "lib/hit.glsl"
#include "lib/ray.glsl"
#include "trace/rounds.glsl"

#define PATHS_BINDING 1
#include "trace/lit_point.glsl"
#include "trace/traverse_paths.glsl"

const float kLiftSun = 1.0; // voxels

void main()
{
    uvec2 size = uvec2(params.width, params.height);
    uvec2 tile = params.live.data[workgroupIndex()];
    if (tile.x == kNoTile)
        return;
    uvec2 pixel = kTileEdge * unpackTile(tile.x) + pixelInTile(gl_LocalInvocationIndex);
    if (any(greaterThanEqual(pixel, size)))
        return;
    uint i = pixel.y * size.x + pixel.x;
    uvec3 from = uvec3(0u);
    if (kResume)
    {
        // Resume just before the event, whose axis is not stored. Few events share a time, as the sun's direction has
        // length 1.
        from = uvec3(params.light.data[i]);
        if (from.x <= kLightAll)
            return;
    }
    Hit hit = loadHit(params.hits, i);
    vec3 direction = params.forward;
    if (!kOrthographic)
        direction += rayOffset(pixelOffset(pixel, size), params.half_pixel_x, params.half_pixel_y);
    LitPoint point = litPoint(hit, direction, kFormat, params.attributes, params.node_attributes);
    vec3 origin = point.origin + kLiftSun * point.edge * params.to_sun;
    bool faces_sun = !isMiss(hit) && dot(point.normal, params.to_sun) > 0.0;
    g_halves = uint64_t_ConstPtr(uint64_t(params.nodes));
    g_paths = params.paths;
    Traversal shadow = traverse(origin, inverseDirection(params.to_sun), kTraceTimeMin, faces_sun ? kTraceTimeMax : 0.0,
                                vec2(0.0), from, kIterationsMax);
    if (shadow.unfinished)
        endUnfinished(kMore, params.next_round, params.status.data[0].live_tiles, params.status);
    uint light = kLightAll - (faces_sun && !shadow.hit ? 0u : kLightSun);
    params.light.data[i] = kMore && shadow.unfinished ? floatBitsToUint(shadow.t) : light;
}
