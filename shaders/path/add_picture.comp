#version 460
// SPDX-License-Identifier: MIT
// Adds a picture in half floats to the sums of its pixels, or begins them with it.
#extension GL_GOOGLE_include_directive : require
#include "path/path.h"

GPU_ENTRY(PathAddPictureParams, PATH_ADD_PICTURE_CONSTANTS);
layout(local_size_x = kPathGroup) in;

#include "lib/dispatch.glsl"
#include "path/pixel.glsl"

void main()
{
    uint number = threadIndex();
    uvec2 size = uvec2(params.width, params.height);
    if (number >= size.x * size.y)
        return;
    uvec2 pixel = pixelOfNumber(number, size);
    uvec2 halfs = unpackUint2x32(uint64_t_ConstPtr(uint64_t(params.picture)).data[pixel.y * size.x + pixel.x]);
    vec3 radiance = vec3(unpackHalf2x16(halfs.x), unpackHalf2x16(halfs.y).x);
    if (kAdds)
        addRadiance(params.sums, number, radiance);
    else
        setRadiance(params.sums, number, radiance);
}
