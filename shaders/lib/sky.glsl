// SPDX-License-Identifier: MIT
// A simple sky for pictures without an environment: y is up.

const vec3 kSunColor = vec3(1.0, 0.93, 0.82);
const float kSunDiscCosine = 0.9995; // 1.8 degrees from the middle to the edge

// Radiance from direction (length 1), without the sun.
vec3 skyRadiance(vec3 direction)
{
    float up = direction.y;
    vec3 horizon = vec3(0.78, 0.84, 0.92);
    vec3 zenith = vec3(0.22, 0.42, 0.78);
    vec3 ground = vec3(0.34, 0.32, 0.30);
    vec3 above = mix(horizon, zenith, sqrt(clamp(up, 0.0, 1.0)));
    return mix(ground, above, smoothstep(-0.06, 0.02, up));
}

// Irradiance / pi that a surface with this normal receives from the sky, without the sun.
vec3 skyAmbient(vec3 normal)
{
    return mix(vec3(0.25, 0.24, 0.23), vec3(0.50, 0.62, 0.82), 0.5 + 0.5 * normal.y);
}

float sunDisc(vec3 direction, vec3 to_sun)
{
    return smoothstep(kSunDiscCosine - 0.0004, kSunDiscCosine + 0.0002, dot(direction, to_sun));
}
