#version 460
// SPDX-License-Identifier: MIT
// Sets the index of the first emission value of each word of 32 voxels. Every voxel has a value, so nothing needs to be
// counted.
#extension GL_GOOGLE_include_directive : require
#include "update/update.h"
#include "lib/dispatch.glsl"

layout(local_size_x = kUpdateGroup) in;
layout(push_constant, scalar) uniform Push
{
    EmissionPlacesParams params;
};

void main()
{
    uint word = threadIndex();
    if (word < params.word_count)
        params.words.data[params.first_word + word] = uvec2(0u, params.first_index + 32u * word);
}
