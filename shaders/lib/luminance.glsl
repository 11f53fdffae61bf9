// SPDX-License-Identifier: MIT
#ifndef ZVO_SHADERS_LIB_LUMINANCE_GLSL
#define ZVO_SHADERS_LIB_LUMINANCE_GLSL

// Relative luminance of linear sRGB (ITU-R BT.709).
float luminance(vec3 color)
{
    return dot(color, vec3(0.2126, 0.7152, 0.0722));
}

#endif
