// SPDX-License-Identifier: MIT
#include "oracle/texture.h"

#include <algorithm>
#include <cmath>

namespace zvo::oracle
{
namespace
{

/// The two texels of one axis between which a lookup lies, and the weight of the second one in 1/256.
struct AxisTexels
{
    std::array<std::int64_t, 2> texel;
    std::uint64_t fraction;
};

AxisTexels axisTexels(std::int64_t u, std::int64_t size, WrapMode mode)
{
    std::int64_t wrapped = 0;
    switch (mode)
    {
    case WrapMode::Repeat:
        wrapped = u & 65535;
        break;
    case WrapMode::MirroredRepeat:
        wrapped = u & 131071;
        wrapped = wrapped > 65536 ? 131072 - wrapped : wrapped;
        break;
    case WrapMode::ClampToEdge:
        wrapped = std::clamp<std::int64_t>(u, 0, 65536);
        break;
    }
    const std::int64_t x = wrapped * size - 32768;
    AxisTexels result{{x >> 16, (x >> 16) + 1}, static_cast<std::uint64_t>(x >> 8) & 255};
    for (std::int64_t& texel : result.texel)
    {
        if (texel < 0)
            texel = mode == WrapMode::Repeat ? size - 1 : 0;
        else if (texel >= size)
            texel = mode == WrapMode::Repeat ? 0 : size - 1;
    }
    return result;
}

const std::uint8_t* texelAt(const Image& image, std::int64_t x, std::int64_t y)
{
    return &image.rgba[static_cast<std::size_t>((y * image.width + x) * 4)];
}

/// Appends the mean of four texels to out.
void appendMean(const std::array<const std::uint8_t*, 4>& texels, std::vector<std::uint8_t>& out)
{
    std::uint64_t alpha = 0;
    for (const std::uint8_t* texel : texels)
        alpha += texel[3];
    for (std::size_t channel = 0; channel < 3; ++channel)
    {
        std::uint64_t weighted = 0;
        std::uint64_t plain = 0;
        for (const std::uint8_t* texel : texels)
        {
            weighted += std::uint64_t{texel[3]} * linear16(texel[channel]);
            plain += linear16(texel[channel]);
        }
        const std::uint64_t linear = alpha == 0 ? (plain + 2) >> 2 : (weighted + alpha / 2) / alpha;
        out.push_back(srgb8(static_cast<std::uint32_t>(linear)));
    }
    out.push_back(static_cast<std::uint8_t>((alpha + 2) >> 2));
}

Image halved(const Image& image)
{
    Image result{{}, std::max(image.width / 2, 1U), std::max(image.height / 2, 1U), {}};
    result.rgba.reserve(std::size_t{result.width} * result.height * 4);
    for (std::int64_t y = 0; y < result.height; ++y)
    {
        const std::int64_t below = std::min<std::int64_t>(2 * y + 1, image.height - 1);
        for (std::int64_t x = 0; x < result.width; ++x)
        {
            const std::int64_t right = std::min<std::int64_t>(2 * x + 1, image.width - 1);
            appendMean({texelAt(image, 2 * x, 2 * y), texelAt(image, right, 2 * y), texelAt(image, 2 * x, below),
                        texelAt(image, right, below)},
                       result.rgba);
        }
    }
    return result;
}

/// The transfer function of IEC 61966-2-1.
double decodedSrgb(double encoded)
{
    return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

double encodedSrgb(double linear)
{
    return linear <= 0.0031308 ? linear * 12.92 : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055;
}

std::vector<std::uint32_t> decodingTable()
{
    std::vector<std::uint32_t> table;
    for (int srgb = 0; srgb < 256; ++srgb)
        table.push_back(static_cast<std::uint32_t>(std::lround(65535.0 * decodedSrgb(srgb / 255.0))));
    return table;
}

std::vector<std::uint8_t> encodingTable()
{
    std::vector<std::uint8_t> table;
    for (int linear = 0; linear < 65536; ++linear)
        table.push_back(static_cast<std::uint8_t>(std::lround(255.0 * encodedSrgb(linear / 65535.0))));
    return table;
}

} // namespace

std::uint32_t mul16(std::uint32_t a, std::uint32_t b)
{
    const std::uint64_t t = std::uint64_t{a} * b + 32768;
    return static_cast<std::uint32_t>((t + (t >> 16)) >> 16);
}

std::uint32_t fraction16(float x)
{
    if (!(x > 0.0F))
        return 0;
    const double exact = 65535.0 * static_cast<double>(std::min(x, 1.0F)); // 40 bits
    return static_cast<std::uint32_t>(std::lround(exact));
}

std::uint32_t linear16(std::uint8_t srgb)
{
    static const std::vector<std::uint32_t> table = decodingTable();
    return table[srgb];
}

std::uint8_t srgb8(std::uint32_t linear)
{
    static const std::vector<std::uint8_t> table = encodingTable();
    return table[linear];
}

std::int64_t textureCoordinate(float uv)
{
    if (std::isnan(uv))
        return 0;
    const float scaled = std::clamp(uv, -8192.0F, 8192.0F) * 65536.0F;
    return static_cast<std::int64_t>(std::nearbyint(scaled));
}

MipChain::MipChain(const Image& image)
{
    m_levels.push_back(image);
    while (m_levels.back().width > 1 || m_levels.back().height > 1)
        m_levels.push_back(halved(m_levels.back()));
}

std::uint32_t MipChain::levelFor(std::int64_t area_uv, std::int64_t area) const
{
    const auto texels = static_cast<float>(std::uint64_t{m_levels[0].width} * m_levels[0].height);
    const float left = static_cast<float>(area_uv) * (texels * 0x1p-16F);
    const float right = static_cast<float>(area) * 2.0F;
    std::uint32_t level = 0;
    while (level + 1 < m_levels.size() && !(left <= std::ldexp(right, static_cast<int>(2 * level))))
        ++level;
    return level;
}

Texel16 MipChain::sample(std::uint32_t level, std::int64_t u, std::int64_t v, WrapMode wrap_u, WrapMode wrap_v) const
{
    const Image& image = m_levels[level];
    const AxisTexels x = axisTexels(u, image.width, wrap_u);
    const AxisTexels y = axisTexels(v, image.height, wrap_v);
    std::array<std::uint64_t, 3> color{};
    std::uint64_t alpha = 0;
    for (std::size_t j = 0; j < 2; ++j)
    {
        for (std::size_t i = 0; i < 2; ++i)
        {
            const std::uint64_t weight =
                (i == 0 ? 256 - x.fraction : x.fraction) * (j == 0 ? 256 - y.fraction : y.fraction);
            const std::uint8_t* texel = texelAt(image, x.texel[i], y.texel[j]);
            for (std::size_t channel = 0; channel < 3; ++channel)
                color[channel] += weight * linear16(texel[channel]);
            alpha += weight * texel[3];
        }
    }
    Texel16 result;
    for (std::size_t channel = 0; channel < 3; ++channel)
        result.color[channel] = static_cast<std::uint32_t>((color[channel] + 32768) >> 16);
    result.alpha = static_cast<std::uint32_t>((alpha * 257 + 32768) >> 16);
    return result;
}

} // namespace zvo::oracle
