// SPDX-License-Identifier: MIT
// What an environment map shows. The includer includes light/outside.h before.
#ifndef ZVO_SHADERS_LIGHT_MAP_RADIANCE_GLSL
#define ZVO_SHADERS_LIGHT_MAP_RADIANCE_GLSL

#include "light/map.glsl"
#include "light/outside.h"

// Radiance of the map from a direction (length 1).
vec3 mapRadiance(Environment_ConstPtr environment, vec3 direction)
{
    EnvironmentMap map = environment.data[0].map;
    vec2 size = vec2(map.width, map.height);
    vec2 place = mapCoordinates(direction, map.turn) * size - 0.5;
    vec2 low = floor(place);
    vec2 part = place - low;
    ivec2 corner = ivec2(low);
    uint left = uint(corner.x < 0 ? corner.x + int(map.width) : corner.x) % map.width;
    uint right = (left + 1u) % map.width;
    uint above = uint(clamp(corner.y, 0, int(map.height) - 1)) * map.width;
    uint below = uint(clamp(corner.y + 1, 0, int(map.height) - 1)) * map.width;
    vec3_ConstPtr texels = environment.data[0].texels;
    return environment.data[0].strength *
           mix(mix(texels.data[above + left], texels.data[above + right], part.x),
               mix(texels.data[below + left], texels.data[below + right], part.x), part.y);
}

#endif
