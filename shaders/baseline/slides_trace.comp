#version 460
// SPDX-License-Identifier: MIT
// The first voxel along the ray of each pixel, after HERO (M. Agate, R. Grimsdale, P. Lister, The HERO Algorithm for
// Ray-Tracing Octrees, 1991) as the slides have it. A node is known by the times at which the ray crosses its lower
// planes; those of its upper ones are a span later, which halves with each level. Directions are mirrored to be positive:
// a child's bits tell by which of the node's middle planes the ray has passed, and the child's place in memory is these
// bits XOR those of the mirrored axes. So children come in the order in which the ray meets them.
//
// Two forms find the same hits. One goes down to the next child at once and keeps the state of the node, from which it
// resumes; the other (kPushChildren) puts all children that the ray meets on the stack, the nearest on top.
//
//   kStopAtFarSide   the slides' first tip: a node is done as soon as the ray reaches its far side. Without it, states are
//                    kept although no child is left, and the children behind the far side are looked at.
//   kSkipBehind      the second: what ends behind the ray's origin is not entered. Without it, only voxels are tested.
#extension GL_GOOGLE_include_directive : require
#include "baseline/slides.h"
#include "trace/trace.h"

GPU_ENTRY(SlidesTraceParams, BASELINE_SLIDES_TRACE_CONSTANTS);
layout(local_size_x = kTilePixels) in;

#include "lib/bound.glsl"
#include "lib/camera.glsl"
#include "lib/dispatch.glsl"
#include "lib/hit.glsl"
#include "lib/morton.glsl"
#include "lib/ray.glsl"

const bool kHasSums = kNodeWords == kSlidesSumNodeWords;

#include "baseline/slides_traverse.glsl"

void store(uint pixel, Found found)
{
    if (!found.hit)
    {
        storeMiss(params.hits, pixel);
        return;
    }
    float t = greatest(found.begin);
    uint face = t <= 0.0 ? kFaceInside : (t == found.begin.x ? 0u : (t == found.begin.y ? 1u : 2u));
    const uint mask = (1u << 30) - 1u;
    uvec3 cell = mortonDecode(uint(found.code) & mask) | (mortonDecode(uint(found.code >> 30)) << 10);
    storeHit(params.hits, pixel, max(t, kTraceTimeMin), found.voxel, cell, (params.depth + 1u) / 2u, face);
}

void main()
{
    CameraRays camera = params.camera;
    uvec2 size = uvec2(params.width, params.height);
    uint tiles_x = (size.x + kTileEdge - 1u) / kTileEdge;
    uvec2 tile = uvec2(workgroupIndex() % tiles_x, workgroupIndex() / tiles_x);
    uvec2 pixel = kTileEdge * tile + pixelInTile(gl_LocalInvocationIndex);
    if (any(greaterThanEqual(pixel, size)))
        return;
    vec3 offset = rayOffset(pixelOffset(pixel, size), camera.half_pixel_x, camera.half_pixel_y);
    precise vec3 direction = camera.forward + (kOrthographic ? vec3(0.0) : offset);
    precise vec3 origin = camera.origin + (kOrthographic ? offset : vec3(0.0));
    Found found = traverse(origin, inverseDirection(direction));
    if (found.capped)
        atomicAdd(params.status.data[0].capped_rays, 1u);
    store(pixel.y * size.x + pixel.x, found);
}
