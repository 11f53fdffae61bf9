// SPDX-License-Identifier: MIT
#pragma once

#include "core/scene/scene.h"
#include "shared/scene.h"

#include <array>
#include <cstdint>
#include <vector>

namespace zvo
{

/// Table from 8-bit sRGB codes to linear 16-bit fractions.
const std::array<std::uint32_t, 256>& srgbToLinearTable();

/// Table from linear 16-bit fractions to 8-bit sRGB codes: [65536].
const std::vector<std::uint8_t>& linearToSrgbTable();

/// All levels of several images, one after the other. docs/voxelization.md defines the levels.
struct TexturePool
{
    std::vector<gpu::TextureLevel> levels;
    std::vector<std::uint32_t> texels; // RGBA8 in the order of the bytes

    /// Adds an image with all its levels. Returns the number of its first level; level_count receives their number.
    std::uint32_t add(const Image& image, std::uint32_t& level_count);

    /// The texels in the form that kernels read (gpu::SceneView::texels), in the same order.
    [[nodiscard]] std::vector<std::uint64_t> linearTexels() const;
};

} // namespace zvo
