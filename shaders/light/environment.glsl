// SPDX-License-Identifier: MIT
// Directions towards the light from outside of the grid, and how probably they are chosen (light/outside.h).
#ifndef ZVO_SHADERS_LIGHT_ENVIRONMENT_GLSL
#define ZVO_SHADERS_LIGHT_ENVIRONMENT_GLSL

#include "lib/sampling.glsl"
#include "light/outside.glsl"
#include "light/outside.h"

// Probability by solid angle of directions in a cell that is chosen with some probability. y: of its upper and lower
// edge.
float cellDensity(EnvironmentMap map, float probability, vec2 y)
{
    return probability * float(map.cells_x) / (2.0 * kPi * (y.x - y.y));
}

vec2 cellEdges(EnvironmentMap map, uint row)
{
    return cos(kPi * vec2(row, row + 1u) / float(map.cells_y));
}

// A direction (length 1) towards the map's light for a face with this normal, and its density by solid angle. chosen:
// two random numbers of 32 bits; u: two in [0, 1).
vec3 chooseMapDirection(Environment_ConstPtr environment, uint normal, uvec2 chosen, vec2 u, out float density)
{
    EnvironmentMap map = environment.data[0].map;
    uint count = map.cells_x * map.cells_y;
    uint cell;
    uint rest;
    umulExtended(chosen.x, count, cell, rest);
    AliasCell entry = environment.data[0].cells.data[normal * count + cell];
    float probability = entry.probability;
    if (chosen.y >= entry.threshold)
    {
        cell = entry.alias;
        probability = environment.data[0].cells.data[normal * count + cell].probability;
    }
    uint row = cell / map.cells_x;
    vec2 y = cellEdges(map, row);
    density = cellDensity(map, probability, y);
    return mapDirection((float(cell % map.cells_x) + u.x) / float(map.cells_x), mix(y.x, y.y, u.y), map);
}

// The density with which chooseMapDirection() chooses a direction (length 1).
float mapDensity(Environment_ConstPtr environment, uint normal, vec3 direction)
{
    EnvironmentMap map = environment.data[0].map;
    vec2 place = mapCoordinates(direction, map) * vec2(map.cells_x, map.cells_y);
    uint column = min(uint(place.x), map.cells_x - 1u);
    uint row = min(uint(place.y), map.cells_y - 1u);
    float probability =
        environment.data[0].cells.data[(normal * map.cells_y + row) * map.cells_x + column].probability;
    return cellDensity(map, probability, cellEdges(map, row));
}

// A direction to the sun's disc, uniformly by solid angle.
vec3 chooseSunDirection(Environment_ConstPtr environment, vec2 u)
{
    float height = u.x * environment.data[0].sun_height;
    float angle = 2.0 * kPi * u.y;
    float radius = sqrt(height * (2.0 - height));
    return frameAround(environment.data[0].to_sun) * vec3(radius * cos(angle), radius * sin(angle), 1.0 - height);
}

// The density of those directions.
float sunDensity(Environment_ConstPtr environment)
{
    return 1.0 / (2.0 * kPi * environment.data[0].sun_height);
}

// Whether a direction (length 1) meets the sun's disc: its distance to the middle tells more exactly than the cosine.
bool meetsSun(Environment_ConstPtr environment, vec3 direction)
{
    vec3 offset = direction - environment.data[0].to_sun;
    return dot(offset, offset) <= 2.0 * environment.data[0].sun_height;
}

#endif
