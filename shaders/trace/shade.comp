#version 460
// SPDX-License-Identifier: MIT
// From hits to their pixels, one workgroup a live tile: sun with shadow, sky light, emission; or one of the other
// views. Misses keep what is there (trace/sky).
#extension GL_GOOGLE_include_directive : require
#include "trace/trace.h"
#include "lib/attribute_forms.glsl"
#include "lib/camera.glsl"
#include "lib/color.glsl"
#include "lib/dispatch.glsl"
#include "lib/hit.glsl"
#include "lib/sky.glsl"
#include "lib/surface_normal.glsl"
#include "trace/texel.glsl"

layout(constant_id = 0) const uint kView = kViewColor;
layout(constant_id = 1) const uint kNodeLevels = 5u;
layout(constant_id = 2) const bool kOrthographic = false;
layout(constant_id = 3) const uint kForm = kForm8; // of attributes
layout(constant_id = 4) const bool kEmission = false;
layout(constant_id = 5) const bool kLight = true; // params.light was filled
layout(constant_id = 6) const uint kTexels = kTexelRgba8;

layout(local_size_x = kTilePixels) in;
layout(push_constant, scalar) uniform Push
{
    ShadeParams params;
};

const vec3 kPlainAlbedo = vec3(0.6); // without attributes

const float kBounced = 0.12; // of the sky's light that reaches even a closed corner, by way of other surfaces

struct Surface
{
    vec3 albedo;
    vec3 normal;
    vec3 emission;
};

vec3 emissionAt(uint voxel)
{
    uvec2 word = params.emission_words.data[voxel >> 5];
    uint bit = 1u << (voxel & 31u);
    if ((word.x & bit) == 0u)
        return vec3(0.0);
    uint rank = word.y + bitCount(word.x & (bit - 1u));
    return params.emission_scale * decodeRgb9e5(params.emission.data[rank]);
}

Surface surfaceAt(Hit hit, vec3 direction)
{
    vec3 face_normal = faceNormal(hitFace(hit), direction);
    Surface surface = Surface(kPlainAlbedo, face_normal, vec3(0.0));
    if (kForm != kFormNone && !isMiss(hit))
    {
        bool voxel = hitLevel(hit) == kNodeLevels;
        Attribute stored = readAttribute(kForm, voxel, params.attributes, params.node_attributes, hit.index);
        surface.albedo = decodeSrgb(unpackUnorm4x8(stored.color).rgb);
        surface.normal = shadingNormal(stored.normal, face_normal, direction);
        bool may_emit = kForm != kForm8 || ((stored.color >> 24) & kAttributeEmissive) != 0u;
        if (kEmission && voxel && may_emit)
            surface.emission = emissionAt(hit.index);
    }
    return surface;
}

const float kDepthContrast = 0.9; // what is farthest away is not as black as the background

vec3 lit(Surface surface, uint light)
{
    float sun = max(dot(surface.normal, params.sun), 0.0) * float(light & kLightSun) / 255.0;
    float sky = mix(kBounced, 1.0, float(light >> kLightSkyShift) / 255.0);
    return surface.albedo * (sun * kSunColor + sky * skyAmbient(surface.normal)) + surface.emission;
}

// Any numbers that look like chance (M. O'Neill, PCG: A Family of Simple Fast Space-Efficient Statistically Good
// Algorithms for Random Number Generation, 2014).
uint scramble(uint x)
{
    uint state = x * 747796405u + 2891336453u;
    uint word = ((state >> ((state >> 28) + 4u)) ^ state) * 277803737u;
    return (word >> 22) ^ word;
}

// Never dark, a little darker on some faces than on others.
vec3 voxelColor(Hit hit)
{
    uvec3 cell = hitCell(hit);
    uint number = scramble(cell.x + scramble(cell.y + scramble(cell.z + scramble(hitLevel(hit)))));
    float face = hitFace(hit) == 0u ? 0.8 : hitFace(hit) == 2u ? 0.65 : 1.0;
    return face * (0.3 + 0.7 * unpackUnorm4x8(number).rgb);
}

// Voxels at a node's lower borders, as the face shows them: white for leaves, then yellow, then red for what is larger.
vec3 brickColor(Hit hit, vec3 color)
{
    uvec3 cell = hitCell(hit);
    uint face = hitFace(hit);
    uint rank = 0u; // of the largest node that begins here along an axis of the face
    for (uint axis = 0u; axis < 3u; ++axis)
        for (uint levels = 1u; levels <= 3u; ++levels)
            if (axis != face && (cell[axis] & ((1u << (2u * levels)) - 1u)) == 0u)
                rank = max(rank, levels);
    vec3 line = rank == 1u ? vec3(1.0) : rank == 2u ? vec3(1.0, 0.8, 0.1) : vec3(1.0, 0.2, 0.1);
    return rank == 0u || face == kFaceInside ? color : mix(color, line, 0.6);
}

vec3 originColor(Hit hit, vec3 color)
{
    float bright = 0.25 + 0.75 * dot(color, vec3(0.3, 0.6, 0.1));
    uint first_voxel = floatBitsToUint(params.sun.x);
    uint first_node = floatBitsToUint(params.sun.y);
    bool is_static = hit.index < (hitLevel(hit) == kNodeLevels ? first_voxel : first_node);
    return bright * (is_static || kForm == kFormNone ? vec3(1.0) : vec3(1.0, 0.5, 0.1));
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
    uint light = kLight ? params.light.data[i] : kLightAll;
    vec3 color; // encoded; kViewColor in half floats: linear
    if (kView == kViewIterations)
        color = heatColor(log2(1.0 + float(light)) / 7.0);
    else if (kView == kViewDepth)
        color = vec3(1.0 - kDepthContrast * clamp((hit.t - params.sun.x) / (params.sun.y - params.sun.x), 0.0, 1.0));
    else if (kView == kViewLevel)
        color = heatColor(0.25 + 0.7 * float(kNodeLevels - hitLevel(hit)) / float(kNodeLevels));
    else if (kView == kViewVoxel)
        color = voxelColor(hit);
    else
    {
        vec3 direction = params.forward;
        if (!kOrthographic)
            direction += rayOffset(pixelOffset(pixel, size), params.step_x, params.step_y);
        Surface surface = surfaceAt(hit, direction);
        if (kView == kViewNormal)
            color = 0.5 + 0.5 * surface.normal;
        else if (kView == kViewAlbedo)
            color = encodeSrgb(surface.albedo);
        else if (kView == kViewBricks)
            color = brickColor(hit, encodeSrgb(surface.albedo));
        else if (kView == kViewOrigin)
            color = originColor(hit, encodeSrgb(surface.albedo));
        else
            color = developTexel(kTexels, lit(surface, light), params.exposure, pixel);
    }
    if (kTexels == kTexelHalf && kView != kViewColor)
        color = decodeSrgb(color);
    if (!isMiss(hit) || kView == kViewIterations)
        storeTexel(kTexels, params.image, i, color);
}
