#version 460
// SPDX-License-Identifier: MIT
// Lists the faces that the camera sees, a workgroup for each live tile. Of each 2x2 pixels some take part in a
// frame, in turns.
#extension GL_GOOGLE_include_directive : require
#include "radiance/radiance.h"

GPU_ENTRY(RadianceRequestParams, RADIANCE_REQUEST_CONSTANTS);
layout(local_size_x = kTilePixels / 4u) in;

#include "lib/bound.glsl"
#include "lib/camera.glsl"
#include "lib/dispatch.glsl"
#include "lib/face.glsl"
#include "lib/hit.glsl"

#define FACES_BINDING 0
#define HITS_BINDING 2
#define STATES_BINDING 1
#include "radiance/face_table.glsl"
#include "radiance/hits.glsl"
#include "radiance/insert_face.glsl"
#include "radiance/list_faces.glsl"

// Lists the face that a pixel sees, if it exists.
void wantSeen(uvec2 pixel, bool exists)
{
    uvec2 size = uvec2(params.width, params.height);
    exists = exists && all(lessThan(pixel, size));
    pixel = exists ? pixel : uvec2(0u);
    Hit hit = hitAt(exists ? pixel.y * size.x + pixel.x : 0u);
    exists = exists && !isMiss(hit) && hitFace(hit) != kFaceInside;
    vec3 direction = params.forward;
    if (!kOrthographic)
        direction += rayOffset(pixelOffset(pixel, size), params.half_pixel_x, params.half_pixel_y);
    uint slot = kNoFace;
    if (exists)
        slot = insertFace(hitCell(hit), normalOfHit(hitFace(hit), direction), 0u);
    wantFace(params.wanted, slot, kFaceSeen, wantedList(params.frame));
}

void main()
{
    uvec2 tile = params.live.data[workgroupIndex()];
    bool exists = tile.x != kNoTile;
    uvec2 corner = kTileEdge * unpackTile(exists ? tile.x : 0u) + 2u * pixelInTile(gl_LocalInvocationIndex);
    for (uint turn = 0u; turn < kTurns; ++turn)
    {
        uint place = params.frame * kTurns + turn;
        wantSeen(corner + uvec2(place & 1u, (place >> 1) & 1u), exists);
    }
}
