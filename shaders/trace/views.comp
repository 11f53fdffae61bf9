#version 460
// SPDX-License-Identifier: MIT
// Computes the pixels of the views that are not lit (kView*) from hits, one workgroup for each live tile. Pixels
// without a hit keep what is there, except in the heat map of iterations.
#extension GL_GOOGLE_include_directive : require
#include "trace/light.h"

GPU_ENTRY(ViewsParams, TRACE_VIEWS_CONSTANTS);
layout(local_size_x = kTilePixels) in;

#include "lib/camera.glsl"
#include "lib/color.glsl"
#include "lib/dispatch.glsl"
#include "lib/hit.glsl"
#include "trace/texel.glsl"
#include "trace/surface.glsl"

const float kDepthContrast = 0.9; // the farthest point is less black than the background
const float kHeatIterationsLog2 = 7.0; // of one more than the number of iterations that is white
const float kHeatVoxel = 0.25; // heat of voxels
const float kHeatLevels = 0.7; // how much hotter the root is
const float kVoxelDarkest = 0.3; // of a channel, and how much brighter the brightest is
const float kVoxelRange = 0.7;
const float kFaceBrightnessX = 0.8; // of faces across an axis; 1 for y
const float kFaceBrightnessZ = 0.65;
const vec3 kLeafLine = vec3(1.0); // borders of leaves, of their parents, and of larger nodes
const vec3 kParentLine = vec3(1.0, 0.8, 0.1);
const vec3 kLargerLine = vec3(1.0, 0.2, 0.1);
const float kLineOpacity = 0.6;
const vec3 kBrightnessWeights = vec3(0.3, 0.6, 0.1);
const float kOriginDarkest = 0.25; // and how much brighter white is
const float kOriginRange = 0.75;
const vec3 kChangedTint = vec3(1.0, 0.5, 0.1); // of what an update made

// Numbers that look random (M. O'Neill, PCG: A Family of Simple Fast Space-Efficient Statistically Good Algorithms for
// Random Number Generation, 2014).
uint scramble(uint x)
{
    uint state = x * 747796405u + 2891336453u;
    uint word = ((state >> ((state >> 28) + 4u)) ^ state) * 277803737u;
    return (word >> 22) ^ word;
}

// A colour for each voxel: never dark, a little darker on some faces.
vec3 voxelColor(Hit hit)
{
    uvec3 cell = hitCell(hit);
    uint number = scramble(cell.x + scramble(cell.y + scramble(cell.z + scramble(hitLevel(hit)))));
    float face = hitFace(hit) == 0u ? kFaceBrightnessX : hitFace(hit) == 2u ? kFaceBrightnessZ : 1.0;
    return face * (kVoxelDarkest + kVoxelRange * unpackUnorm4x8(number).rgb);
}

// Colours voxels at the lower borders of nodes in the face: white for leaves, yellow and red for larger nodes.
vec3 brickColor(Hit hit, vec3 color)
{
    uvec3 cell = hitCell(hit);
    uint face = hitFace(hit);
    uint rank = 0u; // of the largest node that begins here along an axis of the face
    for (uint axis = 0u; axis < 3u; ++axis)
        for (uint levels = 1u; levels <= 3u; ++levels)
            if (axis != face && (cell[axis] & ((1u << (2u * levels)) - 1u)) == 0u)
                rank = max(rank, levels);
    vec3 line = rank == 1u ? kLeafLine : rank == 2u ? kParentLine : kLargerLine;
    return rank == 0u || face == kFaceInside ? color : mix(color, line, kLineOpacity);
}

vec3 originColor(Hit hit, vec3 color)
{
    float bright = kOriginDarkest + kOriginRange * dot(color, kBrightnessWeights);
    uint first_changed = hitLevel(hit) == kNodeLevels ? params.first_changed_voxel : params.first_changed_node;
    bool is_static = hit.index < first_changed;
    return bright * (is_static || kFormat == kFormatNone ? vec3(1.0) : kChangedTint);
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
    vec3 color; // encoded
    if (kView == kViewIterations)
        color = heatColor(log2(1.0 + float(params.iterations.data[i])) / kHeatIterationsLog2);
    else if (kView == kViewDepth)
    {
        vec2 range = params.depth_range;
        color = vec3(1.0 - kDepthContrast * clamp((hit.t - range.x) / (range.y - range.x), 0.0, 1.0));
    }
    else if (kView == kViewLevel)
        color = heatColor(kHeatVoxel + kHeatLevels * float(kNodeLevels - hitLevel(hit)) / float(kNodeLevels));
    else if (kView == kViewVoxel)
        color = voxelColor(hit);
    else
    {
        vec3 direction = params.forward;
        if (!kOrthographic)
            direction += rayOffset(pixelOffset(pixel, size), params.half_pixel_x, params.half_pixel_y);
        Surface surface = surfaceAt(hit, direction, params.attributes, params.node_attributes);
        if (kView == kViewNormal)
            color = 0.5 + 0.5 * surface.normal;
        else if (kView == kViewBricks)
            color = brickColor(hit, encodeSrgb(surface.albedo));
        else if (kView == kViewOrigin)
            color = originColor(hit, encodeSrgb(surface.albedo));
        else
            color = encodeSrgb(surface.albedo);
    }
    if (kTexels == kTexelHalf)
        color = decodeSrgb(color);
    if (!isMiss(hit) || kView == kViewIterations)
        storeTexel(kTexels, params.image, i, color);
}
