// SPDX-License-Identifier: MIT
#include "core/upload/texture_pool.h"

#include "zvo/error.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace zvo
{

namespace
{

constexpr double kFractionOne = gpu::kFractionOne;

double decodeSrgb(double encoded)
{
    return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

double encodeSrgb(double linear)
{
    return linear <= 0.0031308 ? linear * 12.92 : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055;
}

using Texel = std::array<std::uint8_t, 4>;

// The mean of four texels, colours weighted with alpha.
Texel meanTexel(const std::array<Texel, 4>& texels)
{
    const auto& to_linear = srgbToLinearTable();
    const auto& to_srgb = linearToSrgbTable();
    std::uint64_t alpha = 0;
    std::array<std::uint64_t, 3> weighted{};
    std::array<std::uint64_t, 3> plain{};
    for (const Texel& texel : texels)
    {
        alpha += texel[3];
        for (std::size_t c = 0; c < 3; ++c)
        {
            const std::uint64_t linear = to_linear[texel[c]];
            weighted[c] += linear * texel[3];
            plain[c] += linear;
        }
    }
    Texel mean{};
    for (std::size_t c = 0; c < 3; ++c)
    {
        const std::uint64_t linear = alpha != 0 ? (weighted[c] + alpha / 2) / alpha : (plain[c] + 2) >> 2;
        mean[c] = to_srgb[linear];
    }
    mean[3] = static_cast<std::uint8_t>((alpha + 2) >> 2);
    return mean;
}

} // namespace

const std::array<std::uint32_t, 256>& srgbToLinearTable()
{
    static const std::array<std::uint32_t, 256> table = []
    {
        std::array<std::uint32_t, 256> values{};
        for (std::size_t i = 0; i < values.size(); ++i)
        {
            values[i] =
                static_cast<std::uint32_t>(std::lround(kFractionOne * decodeSrgb(static_cast<double>(i) / 255)));
        }
        return values;
    }();
    return table;
}

const std::vector<std::uint8_t>& linearToSrgbTable()
{
    static const std::vector<std::uint8_t> table = []
    {
        std::vector<std::uint8_t> values(gpu::kFractionOne + 1);
        for (std::size_t i = 0; i < values.size(); ++i)
        {
            values[i] = static_cast<std::uint8_t>(std::lround(255 * encodeSrgb(static_cast<double>(i) / kFractionOne)));
        }
        return values;
    }();
    return table;
}

std::uint32_t TexturePool::add(const Image& image, std::uint32_t& level_count)
{
    const auto first_level = static_cast<std::uint32_t>(levels.size());
    std::uint32_t width = image.width;
    std::uint32_t height = image.height;
    std::size_t first = texels.size();
    texels.resize(first + std::size_t{width} * height);
    std::memcpy(&texels[first], image.rgba.data(), image.rgba.size());
    levels.push_back({static_cast<std::uint32_t>(first), width, height});
    while (width > 1 || height > 1)
    {
        const std::uint32_t half_width = std::max(width / 2, 1U);
        const std::uint32_t half_height = std::max(height / 2, 1U);
        const std::size_t next = texels.size();
        texels.resize(next + std::size_t{half_width} * half_height);
        const auto texel = [&](std::uint32_t x, std::uint32_t y)
        {
            Texel value;
            std::memcpy(value.data(),
                        &texels[first + std::size_t{std::min(y, height - 1)} * width + std::min(x, width - 1)],
                        value.size());
            return value;
        };
        for (std::uint32_t y = 0; y < half_height; ++y)
        {
            for (std::uint32_t x = 0; x < half_width; ++x)
            {
                const Texel mean = meanTexel({texel(2 * x, 2 * y), texel(2 * x + 1, 2 * y), texel(2 * x, 2 * y + 1),
                                              texel(2 * x + 1, 2 * y + 1)});
                std::memcpy(&texels[next + std::size_t{y} * half_width + x], mean.data(), mean.size());
            }
        }
        width = half_width;
        height = half_height;
        first = next;
        levels.push_back({static_cast<std::uint32_t>(first), width, height});
    }
    if (texels.size() > UINT32_MAX)
    {
        throw Error(ErrorCode::Input, "the scene's textures have more than 2^32 texels in all; use smaller images");
    }
    level_count = static_cast<std::uint32_t>(levels.size()) - first_level;
    return first_level;
}

std::vector<std::uint64_t> TexturePool::linearTexels() const
{
    const auto& to_linear = srgbToLinearTable();
    std::vector<std::uint64_t> linear(texels.size());
    std::transform(texels.begin(), texels.end(), linear.begin(),
                   [&](std::uint32_t packed)
                   {
                       Texel texel;
                       std::memcpy(texel.data(), &packed, texel.size());
                       return to_linear[texel[0]] | std::uint64_t{to_linear[texel[1]]} << 16 |
                              std::uint64_t{to_linear[texel[2]]} << 32 | std::uint64_t{texel[3]} << 48;
                   });
    return linear;
}

} // namespace zvo
