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

// Relative luminance of linear sRGB (ITU-R BT.709).
float luminance(vec3 color)
{
    return dot(color, vec3(0.2126, 0.7152, 0.0722));
}

// The curve of one channel of AgX over its range of stops, x in [0, 1].
vec3 agxCurve(vec3 x)
{
    return ((((((15.5 * x - 40.14) * x + 31.96) * x - 6.868) * x + 0.4298) * x + 0.1191) * x) - 0.00232;
}

// From radiance, which may be infinite, to codes in [0, 1]: AgX (T. Sobotka, github.com/sobotka/AgX, 2022) as a
// polynomial (B. Wrensch, Minimal AgX Implementation, 2023). Bright colours fade to white, so no hue turns into
// another. What differs: contrast and saturation stand between those of AgX's base and of its look "punchy", and
// radiance is scaled so that middle grey, 0.2, has the code 0.44, as by the curve of K. Narkowicz (ACES Filmic Tone
// Mapping Curve, 2015).
vec3 toneMap(vec3 radiance)
{
    const mat3 inset = mat3(0.842479, 0.042328, 0.042376, 0.078434, 0.878469, 0.078434, 0.079224, 0.079166, 0.879143);
    const mat3 outset =
        mat3(1.196879, -0.052897, -0.052972, -0.098021, 1.151903, -0.098043, -0.099030, -0.098961, 1.151074);
    const float scale = 0.95;
    const float darkest = -12.47393; // stops, like the next
    const float brightest = 4.026069;
    const float contrast = 1.2;
    const float saturation = 1.25;
    vec3 light = clamp(inset * (scale * radiance), vec3(exp2(darkest)), vec3(exp2(brightest)));
    vec3 code = agxCurve((log2(light) - darkest) / (brightest - darkest));
    code = pow(max(code, vec3(1e-6)), vec3(contrast));
    return clamp(outset * mix(vec3(luminance(code)), code, saturation), 0.0, 1.0);
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
    return clamp(toneMap(exposure * radiance) + dither(pixel, steps), 0.0, 1.0);
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

#endif
