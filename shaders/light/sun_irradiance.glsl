// SPDX-License-Identifier: MIT
// What the sun gives. The includer includes light/outside.h before.
#ifndef ZVO_SHADERS_LIGHT_SUN_IRRADIANCE_GLSL
#define ZVO_SHADERS_LIGHT_SUN_IRRADIANCE_GLSL

#include "light/outside.h"

// The irradiance over pi that comes from the sun's whole disc, above a surface with this normal (length 1).
vec3 sunIrradiance(Environment_ConstPtr environment, vec3 normal)
{
    float cosine = max(dot(normal, environment.data[0].to_sun), 0.0);
    return environment.data[0].sun * 2.0 * environment.data[0].sun_height * cosine;
}

#endif
