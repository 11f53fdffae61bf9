// SPDX-License-Identifier: MIT
#include "core/upload/texture_pool.h"

#include "core/base/srgb.h"
#include "core/upload/texture_levels.h"
#include "vk/device.h"
#include "zvo/error.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <deque>
#include <future>
#include <new>
#include <span>
#include <thread>
#include <utility>

namespace zvo
{

namespace
{

constexpr double kFractionOne = gpu::kFractionOne;

using Texel = std::array<std::uint8_t, 4>;

// The mean of four texels, colours weighted with alpha.
Texel meanTexel(const std::array<Texel, 4>& texels)
{
    const auto& to_linear = srgbToLinearTable();
    const auto& to_srgb = linearToSrgbTable();
    std::uint32_t alpha = 0;
    std::array<std::uint64_t, 3> weighted{};
    std::array<std::uint64_t, 3> plain{};
    bool is_even = true;
    for (const Texel& texel : texels)
    {
        is_even = is_even && texel[3] == texels[0][3];
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
        // With one alpha for all, both are the same number.
        const std::uint64_t linear = is_even ? (plain[c] + 2) >> 2 : (weighted[c] + alpha / 2) / alpha;
        mean[c] = to_srgb[linear];
    }
    mean[3] = static_cast<std::uint8_t>((alpha + 2) >> 2);
    return mean;
}

// Writes the level after `from`, of width * height texels, to `to`, which may be the same.
void halve(const std::uint8_t* from, std::uint32_t width, std::uint32_t height, std::uint8_t* to)
{
    const std::uint32_t half_width = std::max(width / 2, 1U);
    const std::uint32_t half_height = std::max(height / 2, 1U);
    const auto texel = [&](std::uint32_t x, std::uint32_t y)
    {
        Texel value;
        std::memcpy(value.data(), from + 4 * (std::size_t{std::min(y, height - 1)} * width + std::min(x, width - 1)),
                    value.size());
        return value;
    };
    for (std::uint32_t y = 0; y < half_height; ++y)
    {
        for (std::uint32_t x = 0; x < half_width; ++x)
        {
            const Texel mean = meanTexel(
                {texel(2 * x, 2 * y), texel(2 * x + 1, 2 * y), texel(2 * x, 2 * y + 1), texel(2 * x + 1, 2 * y + 1)});
            std::memcpy(to, mean.data(), mean.size()); // texels that are read later stand behind it
            to += mean.size();
        }
    }
}

Pixels allocatePixels(std::uint64_t bytes)
{
    Pixels pixels(static_cast<std::uint8_t*>(std::malloc(bytes)));
    if (!pixels)
    {
        throw std::bad_alloc();
    }
    return pixels;
}

std::uint64_t bytesOf(const gpu::TextureLevel& level)
{
    return std::uint64_t{4} * level.width * level.height;
}

/// Copies texels to a buffer, in order. Small levels go together.
class TexelWriter
{
public:
    TexelWriter(vk::Uploader& device, vk::BufferOf<gpu::uint>& texels) : m_device(device), m_texels(texels) {}

    void write(const std::uint8_t* rgba, std::uint64_t bytes)
    {
        if (bytes < kBatchBytes)
        {
            m_batch.insert(m_batch.end(), rgba, rgba + bytes);
            if (m_batch.size() >= kBatchBytes)
            {
                flush();
            }
            return;
        }
        flush();
        send(rgba, bytes);
    }

    void flush()
    {
        send(m_batch.data(), m_batch.size());
        m_batch.clear();
    }

private:
    static constexpr std::size_t kBatchBytes = std::size_t{4} << 20U;

    void send(const std::uint8_t* rgba, std::uint64_t bytes)
    {
        const std::span texels(reinterpret_cast<const gpu::uint*>(rgba), bytes / sizeof(gpu::uint));
        m_device.upload(m_texels, texels, m_sent_count);
        m_sent_count += texels.size();
    }

    vk::Uploader& m_device;
    vk::BufferOf<gpu::uint>& m_texels;
    std::vector<std::uint8_t> m_batch;
    std::uint64_t m_sent_count = 0;
};

/// Writes the levels of an image from the least one on. levels: all, with their sizes. pixels: the decoded picture,
/// which is overwritten; if there is none, the image has the bytes, or becomes white.
void writeLevels(const Image& image, std::span<const gpu::TextureLevel> levels, std::uint32_t least_level,
                 Pixels pixels, TexelWriter& writer)
{
    const std::uint8_t* current = pixels ? pixels.get() : image.rgba.data();
    std::uint32_t level = 0;
    if (!pixels && image.decode)
    {
        level = least_level;
        pixels = allocatePixels(bytesOf(levels[level]));
        std::memset(pixels.get(), UINT8_MAX, bytesOf(levels[level]));
        current = pixels.get();
    }
    while (true)
    {
        if (level >= least_level)
        {
            writer.write(current, bytesOf(levels[level]));
        }
        if (level + 1 == levels.size())
        {
            break;
        }
        pixels = pixels ? std::move(pixels) : allocatePixels(bytesOf(levels[level + 1]));
        halve(current, levels[level].width, levels[level].height, pixels.get());
        current = pixels.get();
        ++level;
    }
}

// How many pictures are decoded at once.
std::size_t decoderCount()
{
    return std::clamp(std::thread::hardware_concurrency(), 1U, 2U);
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
                static_cast<std::uint32_t>(std::lround(kFractionOne * srgbToLinear(static_cast<double>(i) / 255)));
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
            values[i] =
                static_cast<std::uint8_t>(std::lround(255 * linearToSrgb(static_cast<double>(i) / kFractionOne)));
        }
        return values;
    }();
    return table;
}

TexturePool::Place TexturePool::add(const Image& image, std::uint32_t least_level)
{
    const auto first_level = static_cast<std::uint32_t>(m_levels.size());
    const std::uint32_t level_count = levelCount(image.width, image.height);
    assert(least_level < level_count);
    const std::uint64_t first_texel = m_texel_count;
    std::uint32_t width = image.width;
    std::uint32_t height = image.height;
    for (std::uint32_t level = 0; level < level_count; ++level)
    {
        const bool is_stored = level >= least_level;
        m_levels.push_back({is_stored ? static_cast<std::uint32_t>(m_texel_count) : gpu::kAbsent, width, height});
        m_texel_count += is_stored ? std::uint64_t{width} * height : 0;
        width = std::max(width / 2, 1U);
        height = std::max(height / 2, 1U);
    }
    m_entries.push_back({&image, first_level, least_level, m_texel_count - first_texel});
    if (m_texel_count > UINT32_MAX)
    {
        throw Error(ErrorCode::Input, "the scene's textures have more than 2^32 texels in all; " + advice());
    }
    return {first_level, level_count | least_level << gpu::kLeastLevelShift};
}

std::string TexturePool::advice() const
{
    const Entry& largest =
        *std::ranges::max_element(m_entries, {}, [](const Entry& entry) { return entry.texel_count; });
    return "scale down " + largest.image->name + ", of " + std::to_string(largest.image->width) + " x " +
           std::to_string(largest.image->height) + " pixels, or use a lower resolution";
}

void TexturePool::checkSize(const vk::Device& device) const
{
    const std::uint64_t bytes = m_texel_count * sizeof(gpu::uint);
    const std::uint64_t bytes_max = device.report().max_buffer_bytes;
    if (bytes > bytes_max)
    {
        throw Error(ErrorCode::Memory, "the scene's textures take " + std::to_string(bytes) +
                                           " bytes, but a buffer on this device has at most " +
                                           std::to_string(bytes_max) + "; " + advice());
    }
}

vk::BufferOf<gpu::uint> TexturePool::upload(vk::Uploader& device, const std::function<void(double)>& progress,
                                            std::vector<std::string>& warnings) const
{
    vk::BufferOf<gpu::uint> texels(device.device(), "scene/texels", m_texel_count);
    TexelWriter writer(device, texels);
    std::deque<std::future<Pixels>> decoding; // of the next entries
    const std::size_t together = decoderCount();
    for (std::size_t i = 0; i < m_entries.size(); ++i)
    {
        while (decoding.size() < std::min(together, m_entries.size() - i))
        {
            const std::function<Pixels()>& decode = m_entries[i + decoding.size()].image->decode;
            decoding.push_back(decode ? std::async(std::launch::async, decode) : std::future<Pixels>());
        }
        const Entry& entry = m_entries[i];
        Pixels pixels;
        try
        {
            pixels = decoding.front().valid() ? decoding.front().get() : Pixels();
        }
        catch (const Error& failure)
        {
            warnings.push_back(std::string("texture left out: ") + failure.what());
        }
        decoding.pop_front();
        const std::span levels(&m_levels[entry.first_level], levelCount(entry.image->width, entry.image->height));
        writeLevels(*entry.image, levels, entry.least_level, std::move(pixels), writer);
        if (progress)
        {
            progress(static_cast<double>(i + 1) / static_cast<double>(m_entries.size()));
        }
    }
    writer.flush();
    return texels;
}

} // namespace zvo
