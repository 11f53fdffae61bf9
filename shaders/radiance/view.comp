#version 460
// SPDX-License-Identifier: MIT
// Adds the light that the camera sees reflected to each pixel: what is cached at its hit, between four faces, or with
// kSmooth around it on up to three sides of the voxel. Pixels that see a lamp, or nothing, are listed.
#extension GL_GOOGLE_include_directive : require
#include "radiance/radiance.h"

GPU_ENTRY(RadianceViewParams, RADIANCE_VIEW_CONSTANTS);
layout(local_size_x = kRadianceGroup) in;

#include "lib/bound.glsl"
#include "lib/camera.glsl"
#include "lib/dispatch.glsl"
#include "lib/emission.glsl"
#include "lib/face.glsl"
#include "lib/hit.glsl"
#include "path/pixel.glsl"

#define FACES_BINDING 0
#define HITS_BINDING 1
#include "path/lists.glsl"
#include "radiance/face_table.glsl"
#include "radiance/hits.glsl"
#include "trace/surface.glsl"

// A weight of the face that is hit which stays where the voxel's normal points along other axes: that face has light.
const float kHitFaceWeight = 0.001;

// Quadratic B-splines at these distances from the middle, within 1.5.
vec2 splineShare(vec2 distance)
{
    distance = abs(distance);
    vec2 far = 1.5 - distance;
    return mix(0.75 - distance * distance, 0.5 * far * far, greaterThan(distance, vec2(0.5)));
}

// Faces count by their samples, up to so many: those of few are noisier, such as sides that the camera does not see.
const float kCountedSamples = 64.0;

// The light that a face keeps, times what it counts, which is w.
vec4 countedLight(uvec3 cell, uint normal)
{
    CachedFace face;
    bool found = findFace(cell, normal, 0u, face) != kNoFace;
    float counts = found ? min(float(cachedWeight(face.light)), kCountedSamples) / kCountedSamples : 0.0;
    return counts * vec4(found ? cachedRadiance(face.light) : vec3(0.0), 1.0);
}

// The light at a place on a face, times what it counts, by those nine faces of its plane that are around the cell.
// Shares are those of a quadratic B-spline, which is smooth where light between four faces has creases, and is made of
// more faces, so that less noise is left of each.
vec4 lightAround(uvec3 cell, uint normal, vec3 place)
{
    vec3 offset = clamp(place, 0.0, 1.0) - 0.5;
    uint axis = normal % 3u;
    vec2 across = axis == 0u ? offset.yz : axis == 1u ? offset.xz : offset.xy;
    vec4 sum = vec4(0.0);
    for (int y = -1; y <= 1; ++y)
        for (int x = -1; x <= 1; ++x)
        {
            vec2 share = splineShare(across - vec2(x, y));
            uvec3 near = uvec3(ivec3(cell) + stepInPlane(normal, ivec2(x, y))) & kHitCoordinateMask;
            sum += share.x * share.y * countedLight(near, normal);
        }
    return sum;
}

// The light at a place of a voxel by its normal: a mean of its faces that the normal points to, weighted by the squares
// of the normal's components, so that a slope of steps looks like a plane. As a mean of what is cached it makes no
// light. The face that weighs most is mixed with its neighbours. w: of all faces; 0 where none has light.
vec4 lightByNormal(uvec3 cell, uint hit_normal, vec3 place, vec3 normal)
{
    vec3 weights = normal * normal;
    uint hit_axis = hit_normal % 3u;
    weights += kHitFaceWeight * abs(normalAxis(hit_normal));
    uint main_axis = weights.x >= max(weights.y, weights.z) ? 0u : weights.y >= weights.z ? 1u : 2u;
    vec4 sum = vec4(0.0);
    [[unroll]] for (uint k = 0u; k < 3u; ++k)
    {
        uint axis = (main_axis + k) % 3u;
        float along = axis == 0u ? normal.x : axis == 1u ? normal.y : normal.z;
        float weight = axis == 0u ? weights.x : axis == 1u ? weights.y : weights.z;
        uint side = axis == hit_axis ? hit_normal : axis + (along < 0.0 ? 3u : 0u);
        sum += weight * (k == 0u ? lightAround(cell, side, place) : countedLight(cell, side));
    }
    return sum;
}

void main()
{
    uvec2 size = uvec2(params.width, params.height);
    uint number = threadIndex();
    bool exists = number < size.x * size.y;
    uvec2 pixel = pixelOfNumber(exists ? number : 0u, size);
    Hit hit = seenHit(params.starts, params.width, pixel);
    bool hits = !isMiss(hit);
    Attribute stored = attributeAt(hits, hit, params.attributes);
    bool is_direct = exists && !hits;
    if (kEmission && kFormat == kFormat8)
        is_direct = is_direct || (exists && ((stored.color >> 24) & kAttributeEmissive) != 0u);
    else if (kEmission)
        is_direct = is_direct || (exists && isEmissive(params.emission_words, hits ? hit.index : 0u));
    uint place = appendTo(0u, kListMisses, is_direct);
    if (is_direct)
        params.direct.data[place] = number;
    bool reflects = kReflects && hits && hitFace(hit) != kFaceInside;
    if (!exists || (kAdds && !reflects))
        return;

    vec3 offset = rayOffset(pixelOffset(pixel, size), params.camera.half_pixel_x, params.camera.half_pixel_y);
    vec3 origin = params.camera.origin + (kOrthographic ? offset : vec3(0.0));
    vec3 direction = params.camera.forward + (kOrthographic ? vec3(0.0) : offset);
    vec3 point = (origin + hit.t * direction - 1.0) * exp2(2.0 * float(kNodeLevels)) - vec3(hitCell(hit));
    uint normal = normalOfHit(hitFace(hit), direction);
    vec4 sum;
    if (kSmooth)
        sum = lightByNormal(hitCell(hit), normal, point, shadingNormal(stored.normal, normalAxis(normal), direction));
    else
        sum = lightBetweenFaces(hitCell(hit), normal, point, 0u);
    vec3 light = sum.rgb / max(sum.w, 1e-6) + lightOfBrick(hitCell(hit), normal, sum.w == 0.0).rgb;
    vec3 reflected = reflects ? albedoOf(stored) * light : vec3(0.0);
    if (kAdds)
        addRadiance(params.sums, number, reflected);
    else
        setRadiance(params.sums, number, reflected);
}
