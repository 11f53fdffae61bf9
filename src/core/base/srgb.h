// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>

namespace zvo
{

/// The linear fraction of an sRGB encoded one (IEC 61966-2-1), both in [0, 1]. NaN becomes 0.
inline double srgbToLinear(double encoded)
{
    const double value = encoded > 0.0 ? std::min(encoded, 1.0) : 0.0;
    return value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
}

/// The sRGB encoded fraction of a linear one in [0, 1].
inline double linearToSrgb(double linear)
{
    return linear <= 0.0031308 ? linear * 12.92 : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055;
}

/// The linear colour of an sRGB encoded one, with its alpha.
inline glm::vec4 srgbToLinear(const glm::dvec4& encoded)
{
    const double alpha = encoded.a > 0.0 ? std::min(encoded.a, 1.0) : 0.0;
    return {srgbToLinear(encoded.r), srgbToLinear(encoded.g), srgbToLinear(encoded.b), alpha};
}

/// The linear colour of a word: sRGB red | green << 8 | blue << 16.
inline glm::dvec3 linearOf(std::uint32_t color)
{
    return {srgbToLinear((color & 255U) / 255.0), srgbToLinear((color >> 8U & 255U) / 255.0),
            srgbToLinear((color >> 16U & 255U) / 255.0)};
}

} // namespace zvo
