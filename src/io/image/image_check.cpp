// SPDX-License-Identifier: MIT
// Follows ISO/IEC 10918-1 (JPEG), annex B, and the PNG specification (W3C, second edition, 2003).
#include "io/image/image_check.h"

#include <algorithm>
#include <fmt/format.h>
#include <string_view>

namespace zvo
{

namespace
{

using Bytes = std::span<const std::uint8_t>;

constexpr std::uint64_t kDeflateRatioMax = 1032;     // most bytes that a byte of deflate can become
constexpr std::uint64_t kJpegPixelsPerByteMax = 512; // every 8 x 8 pixels take at least a bit
constexpr std::uint32_t kScansMax = 500;             // the most thorough encoders write about ten

constexpr std::uint64_t kTgaPixelsPerByteMax = 64; // a run of 128 pixels takes two bytes at least
constexpr std::size_t kTgaHeadBytes = 18;          // that of BMP is longer
constexpr std::size_t kTgaBitsAt = 16;             // bits of a pixel in the head
constexpr std::size_t kBmpBitsAt = 28;
constexpr std::uint8_t kTgaRuns = 9; // types from here on have runs

// A JPEG marker is kMark and a code.
constexpr std::uint8_t kMark = 255;
constexpr std::uint8_t kStuffing = 0; // after kMark in pixel data: the byte kMark
constexpr std::uint8_t kRestart0 = 208;
constexpr std::uint8_t kRestart7 = 215;
constexpr std::uint8_t kStartOfImage = 216;
constexpr std::uint8_t kEndOfImage = 217;
constexpr std::uint8_t kHuffmanTables = 196;
constexpr std::uint8_t kStartOfScan = 218;
constexpr std::size_t kCodeLengths = 16;
constexpr std::size_t kSymbolsMax = 256;

constexpr std::string_view kPngSignature = "\x89PNG\r\n\x1a\n";
constexpr std::size_t kChunkFrameBytes = 12; // length, type and checksum
constexpr std::size_t kPngHeaderBytes = 13;

bool isTextAt(Bytes bytes, std::size_t at, std::string_view text)
{
    return bytes.size() >= at + text.size() &&
           std::equal(text.begin(), text.end(), bytes.begin() + static_cast<std::ptrdiff_t>(at),
                      [](char a, std::uint8_t b) { return static_cast<std::uint8_t>(a) == b; });
}

std::uint32_t readBigEndian(Bytes bytes, std::size_t at, std::size_t count)
{
    std::uint32_t value = 0;
    for (const std::uint8_t byte : bytes.subspan(at, count))
    {
        value = value << 8U | byte;
    }
    return value;
}

/// Bits of a pixel for the colour type and depth in a PNG's header; 0 if there is no header.
std::uint64_t pngPixelBits(Bytes png)
{
    for (std::size_t at = kPngSignature.size(); at + kChunkFrameBytes + kPngHeaderBytes <= png.size();)
    {
        if (isTextAt(png, at + 4, "IHDR"))
        {
            constexpr std::uint64_t kChannels[] = {1, 0, 3, 1, 2, 0, 4}; // grey, -, RGB, palette, grey + alpha, -, RGBA
            const std::uint8_t depth = png[at + 16];
            const std::uint8_t color = png[at + 17];
            return color < std::size(kChannels) ? kChannels[color] * depth : 0;
        }
        at += kChunkFrameBytes + readBigEndian(png, at, 4);
    }
    return 0;
}

/// Checks the Huffman tables of a segment. Each has a byte of class and number, the count of symbols of each length,
/// and the symbols.
bool areTablesValid(Bytes segment)
{
    while (!segment.empty())
    {
        if (segment.size() < 1 + kCodeLengths)
        {
            return false;
        }
        std::size_t symbol_count = 0;
        for (const std::uint8_t count : segment.subspan(1, kCodeLengths))
        {
            symbol_count += count;
        }
        if (symbol_count > kSymbolsMax || segment.size() < 1 + kCodeLengths + symbol_count)
        {
            return false;
        }
        segment = segment.subspan(1 + kCodeLengths + symbol_count);
    }
    return true;
}

} // namespace

std::string findImageFault(Bytes encoded)
{
    if (encoded.empty() || encoded.front() != kMark)
    {
        return {}; // no JPEG
    }
    std::uint32_t scan_count = 0;
    for (std::size_t at = 0; at + 1 < encoded.size();)
    {
        const std::uint8_t code = encoded[at + 1];
        if (encoded[at] != kMark || code == kStuffing || code == kMark)
        {
            ++at; // pixel data, or padding between segments
            continue;
        }
        at += 2;
        if ((code >= kRestart0 && code <= kRestart7) || code == kStartOfImage)
        {
            continue;
        }
        if (code == kEndOfImage || encoded.size() - at < 2)
        {
            break;
        }
        const std::size_t segment_bytes = std::min<std::size_t>(readBigEndian(encoded, at, 2), encoded.size() - at);
        if (segment_bytes < 2) // the length includes itself
        {
            return "a segment has no length";
        }
        if (code == kHuffmanTables && !areTablesValid(encoded.subspan(at + 2, segment_bytes - 2)))
        {
            return "a Huffman table is cut short or has more than 256 symbols";
        }
        scan_count += code == kStartOfScan ? 1 : 0;
        if (scan_count > kScansMax)
        {
            return fmt::format("it has more than {} scans", kScansMax);
        }
        at += segment_bytes;
    }
    return {};
}

ImageCost estimateImageCost(Bytes encoded, std::uint32_t width, std::uint32_t height)
{
    constexpr std::uint64_t kUnitEdge = 32; // of the largest block that a JPEG is padded to
    ImageCost cost;
    if (isTextAt(encoded, 0, kPngSignature))
    {
        cost.raw_bytes = (1 + (width * pngPixelBits(encoded) + 7) / 8) * height; // each row begins with a filter byte
        cost.plausible = cost.raw_bytes / kDeflateRatioMax <= encoded.size();
    }
    else if (encoded.front() != kMark) // BMP or TGA
    {
        const bool is_bmp = isTextAt(encoded, 0, "BM");
        const std::size_t bits_at = is_bmp ? kBmpBitsAt : kTgaBitsAt;
        const std::uint64_t pixel_bits = bits_at < encoded.size() ? encoded[bits_at] : 0;
        const bool has_runs = !is_bmp && encoded[2] >= kTgaRuns;
        cost.raw_bytes = std::uint64_t{width} * height * 4;
        cost.plausible = has_runs ? std::uint64_t{width} * height / kTgaPixelsPerByteMax <= encoded.size()
                                  : width * pixel_bits / 8 * height + kTgaHeadBytes <= encoded.size();
    }
    else
    {
        cost.raw_bytes = (width + kUnitEdge) * (height + kUnitEdge) * 2; // 16-bit coefficients of a component
        cost.plausible = std::uint64_t{width} * height / kJpegPixelsPerByteMax <= encoded.size();
    }
    return cost;
}

} // namespace zvo
