// SPDX-License-Identifier: MIT
// Sums of samples. The includer includes path/path.h and lib/luminance.glsl before.
#ifndef ZVO_SHADERS_PATH_SUM_GLSL
#define ZVO_SHADERS_PATH_SUM_GLSL

#include "lib/color.glsl"
#include "path/path.h"

// Adds a sample of a pixel, of which no other thread has one at the same time.
void addSample(PixelSum_Ptr sums, uint pixel, vec3 radiance)
{
    float light = luminance(radiance);
    PixelSum sum = sums.data[pixel];
    sums.data[pixel] = PixelSum(sum.radiance + radiance, sum.luminance_squared + light * light);
}

// Adds the light of a sample that the camera does not see directly. direct: luminance of what it does.
void addScattered(PixelFeatures_Ptr features, uint pixel, vec3 radiance, float direct)
{
    float scattered = luminance(radiance) - direct;
    features.data[pixel].scattered_squared += scattered * scattered;
}

#endif
