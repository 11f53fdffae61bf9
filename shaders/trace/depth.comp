#version 460
// SPDX-License-Identifier: MIT
// Converts hits to a host's depth, one workgroup for each live tile. The depth of a pixel is that which a rasterizer
// would give to the point where the pixel's ray enters its voxel.
#extension GL_GOOGLE_include_directive : require
#include "trace/trace.h"

GPU_ENTRY(DepthParams, TRACE_DEPTH_CONSTANTS);
layout(local_size_x = kTilePixels) in;

#include "lib/camera.glsl"
#include "lib/dispatch.glsl"
#include "lib/hit.glsl"

// A clip coordinate along a pixel's ray. Linear in t, so that nothing is lost to the distance of the point from the
// origin of the world or of the grid.
float clipAlongRay(vec4 clip, vec2 offset, float t)
{
    float across = offset.x * clip.z + offset.y * clip.w;
    return kOrthographic ? clip.x + across + t * clip.y : clip.x + t * (clip.y + across);
}

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
    vec2 offset = pixelOffset(pixel, size);
    float depth = clipAlongRay(params.clip_z, offset, hit.t) / clipAlongRay(params.clip_w, offset, hit.t);
    // Depth images allow only [0, 1], so points before the near plane, up to the eye, where w is 0, and beyond the far
    // one are clamped.
    if (!isMiss(hit))
        params.depth.data[i] = depth > 0.0 ? min(depth, 1.0) : 0.0;
}
