// SPDX-License-Identifier: MIT
// Directions of an environment map (light/environment.h).
#ifndef ZVO_SHADERS_LIGHT_MAP_GLSL
#define ZVO_SHADERS_LIGHT_MAP_GLSL

const float kPi = 3.14159265358979;

// The direction (length 1) at u in [0, 1] across the map, with this y.
vec3 mapDirection(float u, float y, vec2 turn)
{
    float angle = 2.0 * kPi * u;
    vec2 plain = sqrt(max(1.0 - y * y, 0.0)) * vec2(-sin(angle), cos(angle)); // x and z
    return vec3(turn.x * plain.x + turn.y * plain.y, y, turn.x * plain.y - turn.y * plain.x);
}

// Where the map has a direction (length 1): u and v in [0, 1], v from the top.
vec2 mapCoordinates(vec3 direction, vec2 turn)
{
    vec2 plain = vec2(turn.x * direction.x - turn.y * direction.z, turn.x * direction.z + turn.y * direction.x);
    float angle = plain == vec2(0.0) ? 0.0 : atan(-plain.x, plain.y);
    return vec2(fract(angle / (2.0 * kPi)), acos(clamp(direction.y, -1.0, 1.0)) / kPi);
}

#endif
