// SPDX-License-Identifier: MIT
// Texture lookup in integers, after docs/voxelization.md.
#pragma once

#include "core/scene/scene.h"

#include <array>
#include <cstdint>
#include <vector>

namespace zvo::oracle
{

/// Linear colour and alpha as fractions of 65535.
struct Texel16
{
    std::array<std::uint32_t, 3> color{65535, 65535, 65535};
    std::uint32_t alpha = 65535;
};

/// round(a b / 65535) for a, b <= 65535.
std::uint32_t mul16(std::uint32_t a, std::uint32_t b);

/// round(65535 * clamp(x, 0, 1)) of the exact product, halves rounded up; 0 for NaN.
std::uint32_t fraction16(float x);

/// sRGB byte to linear fraction of 65535.
std::uint32_t linear16(std::uint8_t srgb);

/// Linear fraction of 65535 to the nearest sRGB byte.
std::uint8_t srgb8(std::uint32_t linear);

/// Texture coordinate in 1/65536 of the texture.
std::int64_t textureCoordinate(float uv);

/// An image of at least one texel and its halvings down to 1 x 1.
class MipChain
{
public:
    explicit MipChain(const Image& image);

    [[nodiscard]] const std::vector<Image>& levels() const { return m_levels; }

    /// The first level whose texels are at least about as large as a voxel. area_uv is |dq1 x dq2|, area is |n_w|.
    [[nodiscard]] std::uint32_t levelFor(std::int64_t area_uv, std::int64_t area) const;

    /// Bilinear lookup at (u, v), in 1/65536 of the texture.
    [[nodiscard]] Texel16 sample(std::uint32_t level, std::int64_t u, std::int64_t v, WrapMode wrap_u,
                                 WrapMode wrap_v) const;

private:
    std::vector<Image> m_levels;
};

} // namespace zvo::oracle
