// SPDX-License-Identifier: MIT
#pragma once

#include "shared/gpu.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace zvo
{

/// A colour of linear channels from 0 to 65408 in 32 bits, RGB9E5: three mantissas of 9 bits, then their exponent:
/// value = mantissa * 2^(exponent - 24), as decodeRgb9e5() in shaders/lib/color.glsl has it. More is taken as that.
inline std::uint32_t encodeRgb9e5(const gpu::vec3& color)
{
    constexpr int kOneExponent = 16; // of mantissas from 256 on for values from 1 on
    constexpr float kMantissaMax = 511.0F;
    const gpu::vec3 bounded = glm::min(color, 128 * kMantissaMax); // it may be infinite
    const float most = std::max({bounded.r, bounded.g, bounded.b, 1e-6F});
    const int exponent = std::max(kOneExponent + std::ilogb(most), 0);
    const gpu::vec3 scaled = std::ldexp(1.0F, 24 - exponent) * bounded;
    const gpu::uvec3 mantissa(glm::min(glm::round(scaled), kMantissaMax));
    return mantissa.r | mantissa.g << 9U | mantissa.b << 18U | static_cast<std::uint32_t>(exponent) << 27U;
}

inline gpu::vec3 decodeRgb9e5(std::uint32_t code)
{
    const gpu::vec3 mantissa(code & 511U, code >> 9U & 511U, code >> 18U & 511U);
    return std::ldexp(1.0F, static_cast<int>(code >> 27U) - 24) * mantissa;
}

} // namespace zvo
