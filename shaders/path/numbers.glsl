// SPDX-License-Identifier: MIT
// Pairs of random numbers of a path (lib/sobol.glsl): the camera takes the first two, each bounce kPathPairs.
#ifndef ZVO_SHADERS_PATH_NUMBERS_GLSL
#define ZVO_SHADERS_PATH_NUMBERS_GLSL

const uint kPairPixel = 0u;
const uint kPairLens = 1u;
const uint kPairDirection = 2u; // of the next ray
const uint kPairChoice = 3u;    // of a light
const uint kPairPoint = 4u;     // of the light
const uint kPairOther = 5u;     // kind of light, roulette
const uint kPathPairs = 4u;     // of a bounce

#endif
