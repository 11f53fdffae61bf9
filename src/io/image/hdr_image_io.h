// SPDX-License-Identifier: MIT
#pragma once

#include "core/scene/hdr_image.h"
#include "io/image/image_io.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace zvo
{

/// The most texels of a picture that is read.
inline constexpr std::uint64_t kHdrTexelsMax = std::uint64_t{1} << 25;

/// Decodes a Radiance picture (.hdr) or an OpenEXR picture of one part with the channels R, G and B, or Y. Values that
/// are negative or NaN become 0, and those above kRadianceMax become that; warnings gets a line for each of both.
/// where: the beginning of messages. Throws Error{Input}.
HdrImage decodeHdrImage(std::span<const std::uint8_t> encoded, const std::string& where,
                        std::vector<std::string>& warnings);

/// A channel of an OpenEXR picture, such as "depth.Z": a number for each texel, each a number of floats behind the one
/// before.
struct ExrChannel
{
    std::string name;
    const float* values;
    std::size_t stride = 1;
};

/// An OpenEXR picture of 32-bit floats with the channels R, G and B, and others of the same size, compressed without
/// loss. Throws Error{Memory}.
std::vector<std::uint8_t> encodeExr(const HdrImage& image, std::span<const ExrChannel> others = {});

} // namespace zvo
