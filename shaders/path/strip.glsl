// SPDX-License-Identifier: MIT
// The numbers of pixels (path.h). The includer includes path/path.h before.
#ifndef ZVO_SHADERS_PATH_STRIP_GLSL
#define ZVO_SHADERS_PATH_STRIP_GLSL

#include "path/path.h"

uvec2 pixelOfNumber(uint number, uvec2 size)
{
    uint strip = number / (kStripRows * size.x);
    uint rest = number - strip * kStripRows * size.x;
    uint rows = min(kStripRows, size.y - strip * kStripRows);
    return uvec2(rest / rows, strip * kStripRows + rest % rows);
}

uint numberOfPixel(uvec2 pixel, uvec2 size)
{
    uint strip = pixel.y / kStripRows;
    uint rows = min(kStripRows, size.y - strip * kStripRows);
    return strip * kStripRows * size.x + pixel.x * rows + pixel.y % kStripRows;
}

#endif
