// SPDX-License-Identifier: MIT
// The ends of shadow rays. The includer includes path/path.h and lib/hit.glsl before.
#ifndef ZVO_SHADERS_PATH_REACH_GLSL
#define ZVO_SHADERS_PATH_REACH_GLSL

#include "lib/hit.glsl"
#include "path/path.h"

// Whether nothing is in the way of a shadow ray that has met this. target: as in ShadowState.
bool reachesLight(Hit hit, uvec2 target)
{
    return target == uvec2(kNoTarget) ? isMiss(hit) : !isMiss(hit) && hit.where == target;
}

#endif
