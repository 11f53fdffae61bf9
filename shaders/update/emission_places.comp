#version 460
// SPDX-License-Identifier: MIT
// Sets the index of the first emission value of each word of 32 voxels. Every voxel has a value, so nothing needs to be
// counted.
#extension GL_GOOGLE_include_directive : require
#include "update/update.h"

GPU_ENTRY(EmissionPlacesParams, GPU_NO_CONSTANTS);
layout(local_size_x = kUpdateGroup) in;

#include "lib/dispatch.glsl"

void main()
{
    uint word = threadIndex();
    if (word < params.word_count)
        params.words.data[params.first_word + word] = uvec2(0u, params.first_index + 32u * word);
}
