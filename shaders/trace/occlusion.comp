#version 460
// SPDX-License-Identifier: MIT
// Estimates how much of the sky's light arrives at hits: a few short rays, spread over the hemisphere by the cosine in
// the same pattern for every pixel (a Fibonacci lattice), which each sample turns. One workgroup for each live tile.
// The rays of a pixel share the iterations that an invocation has; those for which none are left count as open.
#extension GL_GOOGLE_include_directive : require
#include "trace/light.h"

GPU_ENTRY(OcclusionParams, TRACE_OCCLUSION_CONSTANTS);
layout(local_size_x = kTilePixels) in;

#define NODES_BINDING 0
#define TRAVERSE_WITHOUT_INDICES
#include "lib/bound.glsl"
#include "lib/camera.glsl"
#include "lib/dispatch.glsl"
#include "lib/half_node.glsl"
#include "lib/hit.glsl"
#include "lib/ray.glsl"
#include "lib/sampling.glsl"

#define PATHS_BINDING 1
#include "trace/lit_point.glsl"
#include "trace/traverse_paths.glsl"

const float kGoldenAngle = 2.39996323;

// The light of a ray that starts inside of a voxel, in a crevice narrower than the lift, for which nothing is known.
const float kInsideShare = 0.4;

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
    Hit hit = loadHit(params.hits, i);
    vec3 direction = params.forward;
    if (!kOrthographic)
        direction += rayOffset(pixelOffset(pixel, size), params.half_pixel_x, params.half_pixel_y);
    LitPoint point = litPoint(hit, direction, kFormat, params.attributes, params.node_attributes);
    mat3 frame = frameAround(point.normal);
    float end = isMiss(hit) ? 0.0 : params.radius;
    g_halves = uint64_t_ConstPtr(uint64_t(params.nodes));
    g_paths = params.paths;
    float open = 0.0;
    uint iterations_left = kIterationsMax;
    uint unfinished_count = 0u;
    for (uint k = 0u; k < params.ray_count; ++k)
    {
        float u = (float(k) + 0.5) / float(params.ray_count);
        vec3 toward = frame * cosineDirection(u, kGoldenAngle * float(k) + params.turn);
        Traversal ray = traverse(point.origin, inverseDirection(toward), kTraceTimeMin, end, vec2(0.0), uvec3(0u),
                                 max(iterations_left, 1u));
        float way = ray.face == kFaceInside ? kInsideShare : ray.t / max(end, kTraceTimeMin);
        float reached = ray.hit ? way : 1.0;
        open += reached;
        iterations_left -= min(ray.iterations, iterations_left);
        unfinished_count += ray.unfinished ? 1u : 0u;
    }
    if (unfinished_count != 0u)
        atomicAdd(params.status.data[0].capped_rays, unfinished_count);
    uint arriving = uint(255.0 * open / float(params.ray_count) + 0.5);
    params.light.data[i] = (kShadows ? params.light.data[i] & kLightSun : kLightSun) | (arriving << kLightSkyShift);
}
