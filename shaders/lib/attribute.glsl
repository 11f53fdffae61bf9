// SPDX-License-Identifier: MIT
// Packing of attributes in integers, so that every device packs the same bytes.
#include "lib/normal_code.glsl"
#include "shared/octree.h"
#include "shared/scene.h"

// 8-bit sRGB code of a linear 16-bit fraction.
uint encodeSrgb(SceneView_ConstPtr scene, uint linear)
{
    return (scene.data[0].linear_to_srgb.data[linear >> 2] >> (8u * (linear & 3u))) & 255u;
}

uint packColor(SceneView_ConstPtr scene, uvec3 linear, uint flags)
{
    return encodeSrgb(scene, linear.r) | (encodeSrgb(scene, linear.g) << 8) | (encodeSrgb(scene, linear.b) << 16) |
           (flags << 24);
}

// Linear 16-bit fractions of a packed colour. srgb_to_linear: as in SceneView.
uvec3 linearColor(uint_ConstPtr srgb_to_linear, uint color)
{
    return uvec3(srgb_to_linear.data[color & 255u], srgb_to_linear.data[(color >> 8) & 255u],
                 srgb_to_linear.data[(color >> 16) & 255u]);
}

uvec3 unpackColor(SceneView_ConstPtr scene, uint color)
{
    uint_ConstPtr srgb_to_linear = scene.data[0].srgb_to_linear;
    return linearColor(srgb_to_linear, color);
}
