// SPDX-License-Identifier: MIT
// Making rays for the traversal.
#ifndef ZVO_SHADERS_LIB_RAY_GLSL
#define ZVO_SHADERS_LIB_RAY_GLSL

#include "lib/finite.glsl"
#include "shared/trace.h"

const float kDirectionMin = 1e-20; // smaller components of a direction count as this

// 1 / direction with components that are too small replaced, their sign kept: no component is zero or infinite.
vec3 inverseDirection(vec3 direction)
{
    vec3 smallest = uintBitsToFloat(floatBitsToUint(vec3(kDirectionMin)) | (floatBitsToUint(direction) & (1u << 31)));
    return 1.0 / mix(direction, smallest, lessThan(abs(direction), vec3(kDirectionMin)));
}

// Whether traverse() takes the ray.
bool isTraceable(Ray ray)
{
    vec3 size = abs(ray.inverse_direction);
    return isFinite(ray.origin) && isFinite(size) && min(size.x, min(size.y, size.z)) >= kTraceTimeMin &&
           isFinite(ray.t_min) && !isNan(ray.t_max);
}

#endif
