#version 460
// SPDX-License-Identifier: MIT
// Adds what each pixel reflects of the light that comes through one of six cones above its hit, and of the sun. Cones
// are turned at random, of which the mean over frames is left.
#extension GL_GOOGLE_include_directive : require
#define TRAVERSE_VARIABLES
#define ZVO_DETAIL
#define TREE_CONSTANTS
#define ZVO_NODE_LEVELS kNodeLevels
#define ZVO_ENTRIES_PER_WORD kEntriesPerWord
#include "radiance/radiance.h"

GPU_ENTRY(RadianceConesParams, RADIANCE_CONES_CONSTANTS);
layout(local_size_x = kRadianceGroup) in;

#include "lib/bound.glsl"
#include "lib/dispatch.glsl"
#include "lib/face.glsl"
#include "lib/hit.glsl"
#include "lib/sampling.glsl"
#include "light/outside.glsl"
#include "path/pixel.glsl"

#define FACES_BINDING 0
#define HITS_BINDING 1
#include "radiance/cone.glsl"
#include "radiance/hits.glsl"
#include "trace/any_tree.glsl"

// Cones of 60 degrees, whose weights are the shares of the cosine: one around the normal, and five around it at 60
// degrees. Since nodes are narrower than cones, the axes are anywhere in that share of them.
const float kConeSpread = 0.57735027; // tangent of 30 degrees
const float kAxisShare = 0.75;
const float kConeWeight = 0.25;
const float kSideWeight = 0.15;

// The axis of a cone. turn, u: random numbers.
vec3 coneDirection(vec3 normal, uint cone, float turn, vec2 u)
{
    float angle = 2.0 * kPi * (float(cone) / 5.0 + turn);
    vec3 aside = vec3(0.8660254 * vec2(cos(angle), sin(angle)), 0.5);
    vec3 middle = frameAround(normal) * (cone == 0u ? vec3(0.0, 0.0, 1.0) : aside);
    vec2 off = kAxisShare * kConeSpread * sqrt(u.x) * vec2(cos(2.0 * kPi * u.y), sin(2.0 * kPi * u.y));
    return normalize(frameAround(middle) * vec3(off, 1.0));
}

// Of the sun's disc at that height: irradiance over pi.
vec3 sunAt(vec3 point, vec3 normal)
{
    vec3 to_sun = params.environment.data[0].to_sun;
    vec3 sun = sunIrradiance(params.environment, normal);
    return sun != vec3(0.0) && !zvo_occluded(params.tree, point, to_sun, 0.0, kTraceTimeMax) ? sun : vec3(0.0);
}

void main()
{
    uvec2 size = uvec2(params.width, params.height);
    uint number = threadIndex();
    if (number >= size.x * size.y)
        return;
    uvec2 pixel = pixelOfNumber(number, size);
    Hit hit = seenHit(params.starts, params.width, pixel);
    if (isMiss(hit) || hitFace(hit) == kFaceInside)
        return;

    vec3 origin = zvo_pixelOrigin(params.camera, kOrthographic, pixel, size);
    vec3 direction = zvo_pixelDirection(params.camera, kOrthographic, pixel, size);
    zvo_Surface surface = zvo_surface(params.tree, hit, direction);
    vec3 normal = normalAxis(normalOfHit(hitFace(hit), direction));
    vec3 point = zvo_toWorld(params.tree, origin + hit.t * direction) + surface.edge * normal;
    uint seed = hashPair(number, params.seed);
    vec2 u = samplePair(params.frame, seed, 1u + params.cone);
    vec3 towards = coneDirection(normal, params.cone, samplePair(params.frame, seed, 0u).x, u);
    uint seed_of_cone = hashPair(seed, params.frame * kDiffuseCones + params.cone);
    vec4 found = lightThroughCone(params.tree, point, towards, kConeSpread, kTraceTimeMax, seed_of_cone);
    vec3 light = found.rgb + found.w * mapRadiance(params.environment, towards);
    light *= params.cone == 0u ? kConeWeight : kSideWeight;
    if (params.cone == 0u)
        light += sunAt(point, normal);
    addRadiance(params.sums, number, surface.base_color * light);
}
