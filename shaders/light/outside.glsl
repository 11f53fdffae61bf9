// SPDX-License-Identifier: MIT
// What is outside of the grid (light/outside.h): directions and radiance of an environment map, and what the sun gives.
#ifndef ZVO_SHADERS_LIGHT_OUTSIDE_GLSL
#define ZVO_SHADERS_LIGHT_OUTSIDE_GLSL

#include "light/outside.h"

const float kPi = 3.14159265358979;

// The direction (length 1) at u in [0, 1] across a map, with this y, in the map's axes.
vec3 directionInMap(float u, float y)
{
    float angle = 2.0 * kPi * u;
    vec2 plain = sqrt(max(1.0 - y * y, 0.0)) * vec2(-sin(angle), cos(angle)); // x and z
    return vec3(plain.x, y, plain.y);
}

// That direction in the world.
vec3 mapDirection(float u, float y, EnvironmentMap map)
{
    vec3 direction = directionInMap(u, y);
    return direction.x * map.right + direction.y * map.up + direction.z * map.back;
}

// Where the map has a direction (length 1): u and v in [0, 1], v from the top.
vec2 mapCoordinates(vec3 direction, EnvironmentMap map)
{
    vec2 plain = vec2(dot(direction, map.right), dot(direction, map.back));
    float angle = plain == vec2(0.0) ? 0.0 : atan(-plain.x, plain.y);
    return vec2(fract(angle / (2.0 * kPi)), acos(clamp(dot(direction, map.up), -1.0, 1.0)) / kPi);
}

// Radiance of the map from a direction (length 1): as the camera sees it, which may be blurred, or as it gives light.
vec3 mapRadiance(Environment_ConstPtr environment, vec3 direction, bool by_camera)
{
    EnvironmentMap map = environment.data[0].map;
    vec3_ConstPtr texels = environment.data[0].texels;
    uvec2 size = uvec2(map.width, map.height);
    if (by_camera)
    {
        texels = environment.data[0].background;
        size = uvec2(environment.data[0].background_width, environment.data[0].background_height);
    }
    vec2 place = mapCoordinates(direction, map) * vec2(size) - 0.5;
    vec2 low = floor(place);
    vec2 part = place - low;
    ivec2 corner = ivec2(low);
    uint left = uint(corner.x < 0 ? corner.x + int(size.x) : corner.x) % size.x;
    uint right = (left + 1u) % size.x;
    uint above = uint(clamp(corner.y, 0, int(size.y) - 1)) * size.x;
    uint below = uint(clamp(corner.y + 1, 0, int(size.y) - 1)) * size.x;
    return environment.data[0].strength *
           mix(mix(texels.data[above + left], texels.data[above + right], part.x),
               mix(texels.data[below + left], texels.data[below + right], part.x), part.y);
}

// The light of the map from a direction (length 1).
vec3 mapRadiance(Environment_ConstPtr environment, vec3 direction)
{
    return mapRadiance(environment, direction, false);
}

// The irradiance over pi that comes from the sun's whole disc, above a surface with this normal (length 1).
vec3 sunIrradiance(Environment_ConstPtr environment, vec3 normal)
{
    float cosine = max(dot(normal, environment.data[0].to_sun), 0.0);
    return environment.data[0].sun * 2.0 * environment.data[0].sun_height * cosine;
}

#endif
