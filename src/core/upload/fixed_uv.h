// SPDX-License-Identifier: MIT
#pragma once

#include "shared/scene.h"

#include <algorithm>
#include <cmath>

namespace zvo
{

/// Texture coordinates as 16.16 fixed-point numbers, as kernels read them: clamped to +-gpu::kUvLimit, NaN as 0.
inline gpu::ivec2 toFixedUv(const gpu::vec2& uv)
{
    const auto convert = [](float value)
    {
        constexpr auto kLimit = static_cast<float>(gpu::kUvLimit);
        const float clamped = std::isnan(value) ? 0.0F : std::clamp(value, -kLimit, kLimit);
        return static_cast<int>(std::nearbyint(clamped * static_cast<float>(gpu::kUvOne)));
    };
    return {convert(uv.x), convert(uv.y)};
}

} // namespace zvo
