// SPDX-License-Identifier: MIT
// Choosing light from outside of the grid. The includer includes path/path.h, lib/sobol.glsl, light/environment.glsl,
// path/numbers.glsl and path/chosen.glsl before and declares params.
#ifndef ZVO_SHADERS_PATH_MAP_LIGHT_GLSL
#define ZVO_SHADERS_PATH_MAP_LIGHT_GLSL

#include "lib/sampling.glsl"
#include "light/environment.glsl"
#include "light/map_radiance.glsl"
#include "path/chosen.glsl"
#include "path/numbers.glsl"
#include "path/path.h"

// A direction to the map, or to the sun, for a path that leaves a face.
ChosenDirection chooseMapLight(PathState state, uint bounce)
{
    uint pair = bounce * kPathPairs;
    vec2 point = samplePair(params.sample_index, state.seed, pair + kPairPoint);
    ChosenDirection chosen;
    chosen.target = uvec2(kNoTarget);
    if (samplePair(params.sample_index, state.seed, pair + kPairOther).x < state.kinds.x)
    {
        uvec2 choice = sampleBits(params.sample_index, state.seed, pair + kPairChoice);
        chosen.direction = chooseMapDirection(params.environment, state.normal, choice, point, chosen.density);
        chosen.density *= state.kinds.x;
        chosen.light = mapRadiance(params.environment, chosen.direction);
    }
    else
    {
        chosen.direction = chooseSunDirection(params.environment, point);
        chosen.density = state.kinds.y * sunDensity(params.environment);
        chosen.light = params.environment.data[0].sun;
    }
    return chosen;
}

#endif
