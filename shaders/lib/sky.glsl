// SPDX-License-Identifier: MIT
// A simple sky for pictures without an environment: y is up.
#ifndef ZVO_SHADERS_LIB_SKY_GLSL
#define ZVO_SHADERS_LIB_SKY_GLSL

const vec3 kSunColor = vec3(1.0, 0.93, 0.82);
const float kSunDiscCosine = 0.9995; // 1.8 degrees from the middle to the edge

// Radiance from direction (length 1), without the sun: blue above, a bright horizon, a calm floor of haze below.
vec3 skyRadiance(vec3 direction)
{
    float up = clamp(direction.y, 0.0, 1.0);
    float down = clamp(-direction.y, 0.0, 1.0);
    vec3 horizon = vec3(0.72, 0.80, 0.90);
    vec3 above = mix(horizon, vec3(0.16, 0.34, 0.70), 1.0 - (1.0 - up) * (1.0 - up));
    vec3 below = mix(horizon, vec3(0.20, 0.22, 0.26), 1.0 - (1.0 - down) * (1.0 - down));
    return direction.y > 0.0 ? above : below;
}

// Irradiance / pi that a surface with this normal (length 1) receives from the sky, without the sun.
vec3 skyAmbient(vec3 normal)
{
    return mix(vec3(0.17, 0.16, 0.15), vec3(0.40, 0.48, 0.62), 0.5 + 0.5 * normal.y);
}

float sunDisc(vec3 direction, vec3 to_sun)
{
    return smoothstep(kSunDiscCosine - 0.0004, kSunDiscCosine + 0.0002, dot(direction, to_sun));
}

#endif
