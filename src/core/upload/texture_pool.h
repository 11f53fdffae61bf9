// SPDX-License-Identifier: MIT
#pragma once

#include "core/scene/scene.h"
#include "shared/scene.h"
#include "vk/uploader.h"

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace zvo
{

/// Table from 8-bit sRGB codes to linear 16-bit fractions.
const std::array<std::uint32_t, 256>& srgbToLinearTable();

/// Table from linear 16-bit fractions to 8-bit sRGB codes: [65536].
const std::vector<std::uint8_t>& linearToSrgbTable();

/// The levels of several images, one after the other. docs/voxelization.md defines the levels.
class TexturePool
{
public:
    /// Where the levels of an image stand, as gpu::TextureInfo has it.
    struct Place
    {
        std::uint32_t first_level = gpu::kAbsent;
        std::uint32_t level_range = 0;
    };

    /// Gives an image its place, from its size alone; levels below least_level are not stored. Keeps a reference to it.
    /// Throws Error{Input} for more than 2^32 - 1 texels in all.
    Place add(const Image& image, std::uint32_t least_level);

    /// Throws Error{Memory} where a buffer of the device does not hold the texels, with the name of the largest image.
    void checkSize(const vk::Device& device) const;

    /// Decodes the images, at most two at once, and copies their levels to the device. Each decoded picture is freed
    /// before the next one but one is begun. progress, if any, is called with the fraction that is done. What does not
    /// decode becomes white; warnings receives a line for each such image.
    vk::BufferOf<gpu::uint> upload(vk::Uploader& device, const std::function<void(double)>& progress,
                                   std::vector<std::string>& warnings) const;

    [[nodiscard]] const std::vector<gpu::TextureLevel>& levels() const { return m_levels; }
    [[nodiscard]] std::uint64_t texelCount() const { return m_texel_count; }

private:
    [[nodiscard]] std::string advice() const;

    struct Entry
    {
        const Image* image;
        std::uint32_t first_level;
        std::uint32_t least_level;
        std::uint64_t texel_count; // that are stored
    };

    std::vector<Entry> m_entries;
    std::vector<gpu::TextureLevel> m_levels; // with those that are not stored
    std::uint64_t m_texel_count = 0;
};

} // namespace zvo
