// SPDX-License-Identifier: MIT
#pragma once

#include "core/scene/hdr_image.h"

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace zvo::cli
{

/// What names of pictures end in.
inline constexpr std::array<std::string_view, 6> kPictureExtensions = {".png",  ".jpg", ".jpeg",
                                                                       ".webp", ".exr", ".hdr"};

/// How good pictures of kinds with a quality are, unless somebody says otherwise.
inline constexpr std::uint32_t kUsualQuality = 90;

/// The file of a picture of the kind that path tells, or a PNG. texels: [width * height] red | green << 8 | blue << 16
/// | 255 << 24, rows from the top. quality: of a JPEG or WebP, 1 to 100.
std::vector<std::uint8_t> encodePicture(const std::string& path, std::uint32_t width, std::uint32_t height,
                                        std::span<const std::uint32_t> texels, std::uint32_t quality = kUsualQuality);

/// The file of a picture of radiance: Radiance (.hdr) if path tells so, else OpenEXR.
std::vector<std::uint8_t> encodeRadiance(const std::string& path, const HdrImage& image);

} // namespace zvo::cli
