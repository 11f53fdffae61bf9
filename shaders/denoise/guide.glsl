// SPDX-License-Identifier: MIT
// Guides of the filter (denoise/denoise.h), packed and compared, and the albedo by which light is divided before it is
// filtered. Where a channel of the albedo is dark, the light is not known well in that channel.
#ifndef ZVO_SHADERS_DENOISE_GUIDE_GLSL
#define ZVO_SHADERS_DENOISE_GUIDE_GLSL

#include "denoise/denoise.h"
#include "lib/camera.glsl"

/// What a pixel shows.
struct Guide
{
    float depth;
    vec3 normal;    // mean over the samples: shorter than 1 where they show several faces
    float coverage; // part of the samples that hit a surface
};

const int kCodeBits = 9;
const uint kCodeMask = (1u << kCodeBits) - 1u;
const float kCodeSteps = 255.0;
const float kCoverageSteps = 31.0;

uint packSurface(vec3 normal, float coverage)
{
    uvec3 code = uvec3(ivec3(round(clamp(normal, -1.0, 1.0) * kCodeSteps))) & kCodeMask;
    uint cover = coverage > 0.0 ? max(uint(coverage * kCoverageSteps + 0.5), 1u) : 0u;
    return code.x | (code.y << kCodeBits) | (code.z << (2 * kCodeBits)) | (cover << (3 * kCodeBits));
}

Guide loadGuide(DenoiseGuide_ConstPtr guides, uint pixel)
{
    uvec2 word = unpackUint2x32(uint64_t_ConstPtr(uint64_t(guides)).data[pixel]);
    int bits = int(word.y);
    ivec3 code = ivec3(bitfieldExtract(bits, 0, kCodeBits), bitfieldExtract(bits, kCodeBits, kCodeBits),
                       bitfieldExtract(bits, 2 * kCodeBits, kCodeBits));
    return Guide(uintBitsToFloat(word.x), vec3(code) / kCodeSteps,
                 float(word.y >> (3 * kCodeBits)) / kCoverageSteps);
}

vec4 loadLight(vec4_ConstPtr light, uint pixel)
{
    uint64_t_ConstPtr words = uint64_t_ConstPtr(uint64_t(light));
    return uintBitsToFloat(uvec4(unpackUint2x32(words.data[2u * pixel]), unpackUint2x32(words.data[2u * pixel + 1u])));
}

void storeLight(vec4_Ptr light, uint pixel, vec4 value)
{
    uint64_t_Ptr words = uint64_t_Ptr(uint64_t(light));
    words.data[2u * pixel] = packUint2x32(floatBitsToUint(value.rg));
    words.data[2u * pixel + 1u] = packUint2x32(floatBitsToUint(value.ba));
}

// Workgroups take tiles of kDenoiseTile x kDenoiseTile pixels, row by row.
ivec2 pixelOfThread(uint workgroup, uint thread, uint width)
{
    uint columns = (width + kDenoiseTile - 1u) / kDenoiseTile;
    return ivec2(kDenoiseTile * uvec2(workgroup % columns, workgroup / columns) + pixelInTile(thread));
}

// A place at a pixel, from the camera's origin.
vec3 placeAt(ivec2 pixel, float depth, uvec2 size, bool orthographic, vec3 forward, vec3 half_pixel_x,
             vec3 half_pixel_y)
{
    vec3 offset = rayOffset(pixelOffset(uvec2(pixel), size), half_pixel_x, half_pixel_y);
    return depth * forward + (orthographic ? 1.0 : depth) * offset;
}

// Whether faces of about one direction are seen. Those of all directions have no plane.
bool hasPlane(Guide guide)
{
    return dot(guide.normal, guide.normal) > 0.01;
}

// The distance of a place from the plane of a pixel, in voxels; 0 without a plane. way: from the pixel's place to that
// one.
float distanceFromPlane(Guide guide, vec3 way, float edge)
{
    return hasPlane(guide) ? abs(dot(guide.normal, way)) / (length(guide.normal) * edge) : 0.0;
}

// How different the normals of two pixels are; at 1, by as much as may be chance. Means over few samples of several
// faces are less exact the shorter they are.
float turnOf(Guide a, Guide b)
{
    vec3 turn = a.normal - b.normal;
    float mixed = max(1.0 - dot(a.normal, a.normal), 0.0) + max(1.0 - dot(b.normal, b.normal), 0.0);
    return dot(turn, turn) / (kTurnLeast + mixed);
}

// How much the light of a pixel tells about that of another one.
float alikeness(Guide guide, Guide other, vec3 way, float edge)
{
    return other.coverage * exp(-distanceFromPlane(guide, way, edge) / kPlanesApart - turnOf(guide, other));
}

bool isDark(vec3 albedo)
{
    return max(max(albedo.r, albedo.g), albedo.b) < kDarkest;
}

// By what light is divided, and multiplied again: the albedo, unless all of it is dark.
vec3 divisorOf(vec3 albedo)
{
    return isDark(albedo) ? vec3(kDarkest) : max(albedo, vec3(1e-6));
}

// Light in the channels that are dark is taken from the others.
vec3 lightOf(vec3 scattered, vec3 albedo)
{
    vec3 light = scattered / divisorOf(albedo);
    vec3 known = vec3(greaterThanEqual(albedo, vec3(kDarkest)));
    float known_count = dot(known, vec3(1.0));
    return known_count == 0.0 ? light : mix(vec3(dot(light, known) / known_count), light, known);
}

#endif
