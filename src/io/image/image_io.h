// SPDX-License-Identifier: MIT
#pragma once

#include "core/scene/hdr_image.h"
#include "core/scene/scene.h"
#include "zvo/error.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace zvo
{

/// The most pixels along an edge of a picture that is read or written.
inline constexpr std::uint32_t kImageEdgeMax = 16384;

/// Decodes a PNG, JPEG, WebP, BMP or TGA to 8-bit RGBA; 16-bit channels keep their upper byte, grey and palettes become
/// colours. name: of the resulting Image. where: the beginning of messages. Throws Error{Input}, before anything is
/// decoded for an image of more than bytes_max decoded bytes.
Image decodeImage(std::span<const std::uint8_t> encoded, const std::string& name, const std::string& where,
                  std::uint64_t bytes_max = UINT64_MAX);

/// When the pictures of a file are decoded.
enum class ImageDecoding
{
    WhenLoaded,
    WhenUploaded // one after the other, when it is known which of their levels are needed; files are read again then
};

/// Where an encoded image stands.
struct EncodedImage
{
    std::filesystem::path file; // byte_count bytes, from first_byte on
    std::uint64_t first_byte = 0;
    std::uint64_t byte_count = 0;
    std::shared_ptr<const std::vector<std::uint8_t>> bytes = {}; // in place of the file
};

/// An image that decodes what decodeImage() would, when it is asked to: Image::decode, whose messages begin with path,
/// that of the document. encoded: the bytes that source stands for. Throws as decodeImage() before it decodes.
Image deferImage(std::span<const std::uint8_t> encoded, EncodedImage source, const std::string& name,
                 const std::string& where, const std::filesystem::path& path, std::uint64_t bytes_max);

/// A PNG file of width * height pixels from rgba, 4 bytes each, rows from the top. Equal pictures give equal bytes.
std::vector<std::uint8_t> encodePng(std::uint32_t width, std::uint32_t height, std::span<const std::uint8_t> rgba);

/// A JPEG file of such a picture; alpha is left out. quality: 1 to 100. Equal pictures give equal bytes. Throws
/// Error{Memory}.
std::vector<std::uint8_t> encodeJpeg(std::uint32_t width, std::uint32_t height, std::span<const std::uint8_t> rgba,
                                     std::uint32_t quality);

/// A Radiance picture (.hdr): 8 bits of mantissa with a common exponent. Throws Error{Memory}.
std::vector<std::uint8_t> encodeHdr(const HdrImage& image);

/// Error{Input}: what is wrong with a picture. where: the beginning of the message.
Error imageError(const std::string& where, const std::string& what);

} // namespace zvo
