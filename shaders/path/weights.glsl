// SPDX-License-Identifier: MIT
// Weights of light that can be found in two ways (path.h). The includer declares kSampling.
#ifndef ZVO_SHADERS_PATH_WEIGHTS_GLSL
#define ZVO_SHADERS_PATH_WEIGHTS_GLSL

#include "path/path.h"

// The weight of light that was found in one way, by the densities of this and the other way.
float balance(float own, float other)
{
    if (kSampling == kSampleBoth)
        return own / (own + other);
    return 1.0;
}

// The weight of light that a ray has met, which light sampling would have chosen with this density.
float chanceWeight(PathState state, float light_density)
{
    if (state.density == 0.0)
        return 1.0;
    return kSampling == kSampleLights ? 0.0 : balance(state.density, light_density);
}

#endif
