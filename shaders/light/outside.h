// SPDX-License-Identifier: MIT
// What shaders need to know of light from outside of the grid: a map and a sun (light/environment.h). Those of hosts
// get it by its address, too (host/radiance_cache.glsl).
#ifndef ZVO_SHADERS_LIGHT_OUTSIDE_H
#define ZVO_SHADERS_LIGHT_OUTSIDE_H

#include "shared/gpu.h"

GPU_NAMESPACE_BEGIN

const uint kNormals = 6u; // +x, +y, +z, -x, -y, -z

/// A cell in the table of a normal.
struct AliasCell
{
    uint threshold;    // 2^32 times the part of the cell's choices that it keeps
    uint alias;        // gets the others
    float probability; // of being chosen
};
GPU_BUFFER(AliasCell, 4);

/// Which cells a map has, and where it stands.
struct EnvironmentMap
{
    uint width;
    uint height;
    uint cells_x;
    uint cells_y;
    vec3 right; // in the world, length 1: the map's +x, as the next two
    vec3 up;    // +y
    vec3 back;  // +z
};

/// All light from outside of the grid, as kernels find it.
struct Environment
{
    GPU_CONST_PTR(vec3) texels;     // [width * height]
    GPU_CONST_PTR(vec3) background; // [background_width * background_height] what the camera sees of the map
    GPU_CONST_PTR(AliasCell) cells; // [kNormals][cells]
    GPU_CONST_PTR(vec2) gives;      // [kNormals] luminance over which a face gets of the map, and of the sun, at most
    EnvironmentMap map;
    uint background_width;
    uint background_height;
    float strength;   // of the map: its texels count times this
    vec3 to_sun;      // to the middle of the sun's disc, length 1
    vec3 sun;         // radiance of the disc
    float sun_height; // 1 - cosine of the angle from the middle of the disc to its rim
};
GPU_BUFFER(Environment, 8);

GPU_NAMESPACE_END

#endif
