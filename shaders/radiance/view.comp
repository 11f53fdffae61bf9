#version 460
// SPDX-License-Identifier: MIT
// Adds the light that the camera sees reflected to each pixel: what is cached at its hit, between four faces, or with
// kSmooth on up to three sides of the voxel. Pixels that see a lamp, or nothing, are listed.
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

// The light at a place of a voxel by its normal: a mean of its faces that the normal points to, weighted by the squares
// of the normal's components, so that a slope of steps looks like a plane. As a mean of what is cached it makes no
// light. The face that weighs most is mixed with its neighbours. w: 0 where none has light.
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
        vec4 light;
        if (k == 0u)
        {
            light = lightBetweenFaces(cell, side, place, 0u);
            light /= max(light.w, 1e-6);
        }
        else
        {
            CachedFace face;
            bool found = findFace(cell, side, 0u, face) != kNoFace && cachedWeight(face.light) != 0u;
            light = found ? vec4(cachedRadiance(face.light), 1.0) : vec4(0.0);
        }
        sum += weight * light;
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
