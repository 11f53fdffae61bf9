// SPDX-License-Identifier: MIT
// Packing of attributes in integers, so that every device packs the same bytes.
// COLOR_BINDING (optional): the first of two bindings for the tables of colours in a kernel's bound form
// (lib/bound.glsl), whose pass reaches them by these names.
#ifndef ZVO_SHADERS_LIB_ATTRIBUTE_GLSL
#define ZVO_SHADERS_LIB_ATTRIBUTE_GLSL

#include "lib/bound.glsl"
#include "shared/scene.h"

#if defined(BOUND) && defined(COLOR_BINDING)

TEXELS_1(COLOR_BINDING, linear_to_srgb);
TEXELS_1(COLOR_BINDING + 1, srgb_to_linear);

#define LinearTable uint // stands for an address that this form does not need
#define LINEAR_TABLE(SCENE) 0u

uint srgbCodes(SceneView_ConstPtr scene, uint word)
{
    return texelFetch(texels1_linear_to_srgb, int(word)).x;
}

uint linearOf(LinearTable table, uint code)
{
    return texelFetch(texels1_srgb_to_linear, int(code)).x;
}

#else

// SceneView::srgb_to_linear, for linearOf(). To be read before a loop: in it, the address would be loaded each time.
#define LinearTable uint_ConstPtr
#define LINEAR_TABLE(SCENE) (SCENE).data[0].srgb_to_linear

// Four codes of SceneView::linear_to_srgb.
uint srgbCodes(SceneView_ConstPtr scene, uint word)
{
    return scene.data[0].linear_to_srgb.data[word];
}

uint linearOf(LinearTable table, uint code)
{
    return table.data[code];
}

#endif

// 8-bit sRGB code of a linear 16-bit fraction.
uint encodeSrgb(SceneView_ConstPtr scene, uint linear)
{
    return (srgbCodes(scene, linear >> 2) >> (8u * (linear & 3u))) & 255u;
}

uint packColor(SceneView_ConstPtr scene, uvec3 linear, uint flags)
{
    return encodeSrgb(scene, linear.r) | (encodeSrgb(scene, linear.g) << 8) | (encodeSrgb(scene, linear.b) << 16) |
           (flags << 24);
}

// Linear 16-bit fractions of a packed colour.
uvec3 linearColor(LinearTable table, uint color)
{
    return uvec3(linearOf(table, color & 255u), linearOf(table, (color >> 8) & 255u),
                 linearOf(table, (color >> 16) & 255u));
}

#endif
