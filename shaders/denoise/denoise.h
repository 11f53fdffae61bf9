// SPDX-License-Identifier: MIT
// Denoising of path-traced pictures: what its kernels share with the host.
//
// A variance-guided filter that keeps edges (C. Schied et al., Spatiotemporal Variance-Guided Filtering, 2017). What is
// filtered is the light that arrives at surfaces: the radiance without what the camera sees directly, divided by the
// albedo. A pixel takes from its neighbours what lies in the same plane, has the same normal, and differs by no more
// than the noise of both explains.
//
//   denoise/demodulate  light of each pixel, its moments, and the guide: depth, normal, coverage
//   denoise/reproject   the light of an earlier picture, where it shows the same place
//   denoise/estimate    means over the pixels around that are less than about a voxel away, and their variance
//   denoise/filter      kDenoiseLevels times: 5x5 pixels that are 1, 2, 4, ... pixels apart
//   denoise/modulate    multiplies by the albedo, and adds what the camera sees directly
//
// Light is a vec4: red, green, blue, and in w the second moment of the samples' luminance until denoise/estimate, the
// variance of the pixel's luminance from there on. All arrays have width * height elements, row by row from the top
// left, but for sums and features, which are in the order of strips (path/path.h).
#ifndef ZVO_SHADERS_DENOISE_DENOISE_H
#define ZVO_SHADERS_DENOISE_DENOISE_H

#include "path/path.h"

GPU_NAMESPACE_BEGIN

GPU_BUFFER(vec4, 8);

const uint kDenoiseLevels = 5u;
const uint kDenoiseTile = 8u; // pixels along the edge of a workgroup's tile

const float kDarkest = 0.01f;   // albedo of a channel from which light is known
const float kBrightest = 1e15f; // light: its square must be a float, too

// Of another pixel that tells about this one's light.
const float kPlanesApart = 8.0f; // voxels from the plane of this one at which it counts 1 / e
const float kTurnLeast = 0.1f;   // square of the difference of exact normals at which it counts 1 / e

// Of a pixel of the earlier picture that shows the same place.
const float kDistanceMax = 1.5f; // voxels from the plane of this one
const float kTurnMax = 3.0f;     // as turnOf() has it

const float kFewSamples = 4.0f; // with fewer, their variance is not known
const float kNearNoise = 10.0f; // standard deviations that pixels of denoise/estimate may differ by
// Standard deviations that pixels of denoise/filter may differ by: kNoiseLeast + kNoiseFew / samples, at most this.
const float kNoiseMost = 10.0f;
const float kNoiseLeast = 2.0f;
const float kNoiseFew = 16.0f;
const float kSpikeSamples = 64.0f; // with as many, no pixel is dimmed to what is around it

/// What a pixel shows, for comparisons with others.
struct DenoiseGuide
{
    float depth;  // unit space, along the camera's direction
    uint surface; // normal.x 9 bits | y 9 | z 9 | part of the samples that hit a face 5, from the lowest bit on
};
GPU_BUFFER(DenoiseGuide, 8);

struct DenoiseDemodulateParams // push constants of denoise/demodulate: a thread a pixel
{
    GPU_CONST_PTR(PixelSum) sums;
    GPU_CONST_PTR(PixelFeatures) features;
    GPU_PTR(vec4) light;
    GPU_PTR(DenoiseGuide) guides;
    GPU_PTR(float) samples; // number of samples that light is the mean of
    uint width;
    uint height;
    float sample_count;
};
GPU_KERNEL(denoise, demodulate, Demodulate, DenoiseDemodulateParams, GPU_NO_CONSTANTS)

struct DenoiseReprojectParams // push constants of denoise/reproject: a thread a pixel
{
    GPU_PTR(vec4) light;
    GPU_PTR(float) samples;
    GPU_CONST_PTR(DenoiseGuide) guides;
    GPU_CONST_PTR(vec4) old_light; // of the earlier picture, like the next three
    GPU_CONST_PTR(float) old_samples;
    GPU_CONST_PTR(DenoiseGuide) old_guides;
    GPU_CONST_PTR(PictureCamera) cameras; // [2] of this and the earlier picture
    uint width;
    uint height;
    float history_max; // samples of the earlier picture that count at most
    float edge;        // of a voxel, unit space
};
#define DENOISE_REPROJECT_CONSTANTS(CONSTANT)                                                                          \
    CONSTANT(0, bool, orthographic, kOrthographic, false)                                                              \
    CONSTANT(1, bool, old_orthographic, kOldOrthographic, false)
GPU_KERNEL(denoise, reproject, Reproject, DenoiseReprojectParams, DENOISE_REPROJECT_CONSTANTS)

struct DenoiseFilterParams // push constants of denoise/estimate and denoise/filter: a thread a pixel
{
    GPU_CONST_PTR(vec4) light;
    GPU_CONST_PTR(DenoiseGuide) guides;
    GPU_CONST_PTR(float) samples;
    GPU_PTR(vec4) filtered;
    vec3 forward; // of CameraRays, like the next two
    vec3 half_pixel_x;
    vec3 half_pixel_y;
    uint width;
    uint height;
    uint step;  // pixels between two of the filter's
    float edge; // of a voxel, unit space
};
#define DENOISE_ESTIMATE_CONSTANTS(CONSTANT) CONSTANT(0, bool, orthographic, kOrthographic, false)
GPU_KERNEL(denoise, estimate, Estimate, DenoiseFilterParams, DENOISE_ESTIMATE_CONSTANTS)
#define DENOISE_FILTER_CONSTANTS(CONSTANT) CONSTANT(0, bool, orthographic, kOrthographic, false)
GPU_KERNEL(denoise, filter, Filter, DenoiseFilterParams, DENOISE_FILTER_CONSTANTS)

struct DenoiseModulateParams // push constants of denoise/modulate: a thread a pixel
{
    GPU_CONST_PTR(vec4) light;
    GPU_CONST_PTR(PixelFeatures) features;
    GPU_PTR(PixelSum) sums; // of one sample; luminance_squared is 0
    uint width;
    uint height;
    float sample_part; // 1 / number of samples
};
GPU_KERNEL(denoise, modulate, Modulate, DenoiseModulateParams, GPU_NO_CONSTANTS)

GPU_NAMESPACE_END

#endif
