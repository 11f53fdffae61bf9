#version 460
// SPDX-License-Identifier: MIT
// Which hits the sun reaches, one workgroup a live tile.
#extension GL_GOOGLE_include_directive : require
#include "trace/trace.h"
#include "lib/attribute.glsl"
#include "lib/camera.glsl"
#include "lib/dispatch.glsl"
#include "lib/hit.glsl"
#include "lib/surface_normal.glsl"

layout(constant_id = 3) const bool kOrthographic = false;
layout(constant_id = 4) const bool kAttributes = true;

layout(local_size_x = kTilePixels) in;
layout(push_constant, scalar) uniform Push
{
    ShadowParams params;
};

#define TRAVERSE_GROUP kTilePixels
#include "lib/octree_half.glsl"
#include "lib/traverse.glsl"

// The ray starts in the middle of the voxel, lifted along both normals and towards the sun, so that neither the voxel
// nor the steps of the surface around it shade it.
const float kLiftFace = 0.75;   // voxels
const float kLiftNormal = 0.75;
const float kLiftSun = 1.0;

void main()
{
    uvec2 size = uvec2(params.width, params.height);
    if (workgroupIndex() >= params.status.data[0].live_tiles)
        return;
    uvec2 tile = params.live.data[workgroupIndex()];
    uvec2 pixel = kTileEdge * unpackTile(tile.x) + pixelInTile(gl_LocalInvocationIndex);
    if (any(greaterThanEqual(pixel, size)))
        return;
    uint i = pixel.y * size.x + pixel.x;
    Hit hit = loadHit(params.hits, i);
    vec3 direction = params.forward;
    if (!kOrthographic)
        direction += rayOffset(pixelOffset(pixel, size), params.step_x, params.step_y);
    vec3 face_normal = faceNormal(hitFace(hit), direction);
    vec3 normal = face_normal;
    if (kAttributes && !isMiss(hit))
    {
        bool voxel = !kDetail || hitLevel(hit) == kNodeLevels;
        uint64_t attributes = voxel ? uint64_t(params.attributes) : uint64_t(params.node_attributes);
        normal = shadingNormal(Attribute_ConstPtr(attributes).data[hit.index].normal, direction);
    }
    float edge = exp2(-2.0 * float(hitLevel(hit)));
    vec3 middle = 1.0 + (vec3(hitCell(hit)) + 0.5) * edge;
    vec3 origin = middle + edge * (kLiftFace * face_normal + kLiftNormal * normal + kLiftSun * params.to_sun);
    bool faces_sun = !isMiss(hit) && dot(normal, params.to_sun) > 0.0;
    g_halves = uint64_t_ConstPtr(uint64_t(params.nodes));
    Traversal shadow = traverse(origin, params.to_sun_inverse, kTraceTimeMin, faces_sun ? kTraceTimeMax : 0.0,
                                vec2(0.0));
    if (shadow.capped)
        atomicAdd(params.status.data[0].capped_rays, 1u);
    params.light.data[i] = faces_sun && !shadow.hit ? kLightSun : 0u;
}
