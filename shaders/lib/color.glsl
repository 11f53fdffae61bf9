// SPDX-License-Identifier: MIT
// Colours between their stored and their linear values, and how bright they are.
#ifndef ZVO_SHADERS_LIB_COLOR_GLSL
#define ZVO_SHADERS_LIB_COLOR_GLSL

vec3 decodeSrgb(vec3 code)
{
    return mix(code / 12.92, pow((code + 0.055) / 1.055, vec3(2.4)), greaterThan(code, vec3(0.04045)));
}

vec3 encodeSrgb(vec3 linear)
{
    return mix(linear * 12.92, 1.055 * pow(linear, vec3(1.0 / 2.4)) - 0.055, greaterThan(linear, vec3(0.0031308)));
}

// Shared-exponent RGB9E5: three mantissas of 9 bits, then the exponent.
vec3 decodeRgb9e5(uint code)
{
    uvec3 mantissa = (uvec3(code) >> uvec3(0u, 9u, 18u)) & 511u;
    return vec3(mantissa) * exp2(float(code >> 27) - 24.0);
}

// Filmic curve from radiance, which may be infinite, to [0, 1] (K. Narkowicz, ACES Filmic Tone Mapping Curve, 2015).
vec3 toneMap(vec3 radiance)
{
    const float white = 1e6; // far beyond where the curve reaches 1; its square is finite
    vec3 x = 0.6 * radiance;
    vec3 curve = clamp(x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14), 0.0, 1.0);
    return mix(curve, vec3(1.0), greaterThan(radiance, vec3(white)));
}

// Adds an ordered pattern of up to half a step in either direction, for codes from 0 to steps, so that gradients show
// no bands.
float dither(uvec2 pixel, float steps)
{
    uint x = pixel.x ^ pixel.y;
    uint rank = ((x & 1u) << 3) | ((pixel.y & 1u) << 2) | (x & 2u) | ((pixel.y & 2u) >> 1);
    return (float(rank) - 7.5) / (16.0 * steps);
}

// From radiance to encoded values, for codes from 0 to steps.
vec3 develop(vec3 radiance, float exposure, uvec2 pixel, float steps)
{
    return clamp(encodeSrgb(toneMap(exposure * radiance)) + dither(pixel, steps), 0.0, 1.0);
}

// Red, green, blue in [0, 1], already encoded, with full alpha.
uint packColor8(vec3 color)
{
    uvec3 code = uvec3(color * 255.0 + 0.5);
    return code.r | (code.g << 8) | (code.b << 16) | (255u << 24);
}

// Heat from black over blue, red and yellow to white, for x in [0, 1].
vec3 heatColor(float x)
{
    return clamp(vec3(3.0 * x - 0.75, 3.0 * x - 1.75,
                      x < 0.5 ? 4.0 * x * (1.0 - x) - 2.0 * max(x - 0.25, 0.0) : 4.0 * x - 3.0),
                 0.0, 1.0);
}

// Relative luminance of linear sRGB (ITU-R BT.709).
float luminance(vec3 color)
{
    return dot(color, vec3(0.2126, 0.7152, 0.0722));
}

#endif
