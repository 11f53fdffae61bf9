#version 460
// SPDX-License-Identifier: MIT
// Adds the light that the camera sees reflected to each pixel: what is cached at its hit, between four faces. Pixels
// that see a lamp, or nothing, are listed.
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
    vec4 sum = lightBetweenFaces(hitCell(hit), normal, point, 0u);
    vec3 light = sum.rgb / max(sum.w, 1e-6) + lightOfBrick(hitCell(hit), normal, sum.w == 0.0).rgb;
    vec3 reflected = reflects ? albedoOf(stored) * light : vec3(0.0);
    if (kAdds)
        addRadiance(params.sums, number, reflected);
    else
        setRadiance(params.sums, number, reflected);
}
