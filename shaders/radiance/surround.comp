#version 460
// SPDX-License-Identifier: MIT
// Lists the bricks of a level around the listed ones of the level before.
#extension GL_GOOGLE_include_directive : require
#include "radiance/radiance.h"
#include "lib/bound.glsl"
#include "lib/dispatch.glsl"

layout(local_size_x = kRadianceGroup) in;
layout(push_constant, scalar) uniform Push
{
    RadianceSurroundParams params;
};

#include "path/lists.glsl"
#include "radiance/face_key.glsl"
#include "radiance/list_brick.glsl"

void main()
{
    uint i = threadIndex();
    uint length = listLength(kFirstBricks + params.level - 2u, kListPaths);
    bool exists = i < length;
    uint slot = params.bricks.data[(params.level - 2u) * params.batch + min(i, length - 1u)];
    uvec2 key = loadFace(slot).key;
    listBrick(cellOfFace(key), normalOfFace(key), params.level, exists);
}
