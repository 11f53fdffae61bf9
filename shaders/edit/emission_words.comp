#version 460
// SPDX-License-Identifier: MIT
// Clears the words of the emission table that a dab takes. Every voxel has an index, so that nothing needs to be
// counted.
#extension GL_GOOGLE_include_directive : require
#include "edit/edit.h"
#include "lib/dispatch.glsl"

layout(local_size_x = kEditGroup) in;
layout(push_constant, scalar) uniform Push
{
    EditEmissionWordsParams params;
};

void main()
{
    uint voxel_top = max(params.states.data[params.from].voxel_top, params.states.data[params.kept].voxel_top);
    uint word = ((voxel_top + 31u) >> 5) + threadIndex();
    if (32u * word < params.states.data[params.to].voxel_top)
        params.words.data[word] = uvec2(0u, 32u * word + params.emission_offset);
}
