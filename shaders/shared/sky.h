// SPDX-License-Identifier: MIT
// The colours of the simple sky for a direction of the sun (core/scene/sky.h makes them, lib/sky.glsl reads them).
#ifndef ZVO_SHADERS_SHARED_SKY_H
#define ZVO_SHADERS_SHARED_SKY_H

#include "shared/gpu.h"

GPU_NAMESPACE_BEGIN

struct Sky
{
    vec3 to_sun;  // length 1
    vec3 up;      // length 1
    vec3 sun;     // colour of the sun's light, by its strength
    vec3 zenith;  // radiance straight above
    vec3 horizon; // at the horizon, across from the sun
    vec3 glow;    // around the sun, in addition
    vec3 ground;  // far below the horizon
    vec3 above;   // irradiance / pi of a surface that looks straight up, without the sun
    vec3 below;   // of one that looks straight down
};
GPU_BUFFER(Sky, 4);

GPU_NAMESPACE_END

#endif
