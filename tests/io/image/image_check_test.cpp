// SPDX-License-Identifier: MIT
// Images that would harm the decoder are refused before decoding.
#include "io/image/image_check.h"

#include "io/gltf/gltf_builder.h"
#include "io/gltf/gltf_uri.h"
#include "io/image/image_io.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <iterator>

namespace zvo
{

namespace
{

using Bytes = std::vector<std::uint8_t>;

// Offsets in a PNG. The header follows signature, length and type, and begins with width and height, big-endian.
constexpr std::size_t kWidthOffset = 16;
constexpr std::size_t kHeightOffset = 20;

void setBigEndian(Bytes& bytes, std::size_t offset, std::uint32_t value)
{
    for (std::size_t i = 0; i < 4; ++i)
    {
        bytes[offset + i] = static_cast<std::uint8_t>(value >> (24 - 8 * i));
    }
}

/// A PNG of one colour whose header announces another size.
Bytes pngThatAnnounces(std::uint32_t width, std::uint32_t height, std::uint32_t real_edge = 1)
{
    Bytes png = encodePng(real_edge, real_edge, Bytes(std::size_t{real_edge} * real_edge * 4, 255));
    setBigEndian(png, kWidthOffset, width);
    setBigEndian(png, kHeightOffset, height);
    return png;
}

void append(Bytes& bytes, const Bytes& more)
{
    std::copy(more.begin(), more.end(), std::back_inserter(bytes));
}

Bytes segment(std::uint8_t marker, const Bytes& content)
{
    const std::size_t length = content.size() + 2;
    Bytes bytes = {255, marker, static_cast<std::uint8_t>(length / 256), static_cast<std::uint8_t>(length % 256)};
    append(bytes, content);
    return bytes;
}

constexpr std::uint8_t kProgressive = 194;
constexpr std::uint8_t kTables = 196;
constexpr std::uint8_t kScan = 218;
constexpr std::uint8_t kQuantization = 219;

/// A Huffman table of class 0 with the symbols 0, 1, 2, ..., whose codes all have code_length bits.
Bytes huffmanTable(std::size_t symbol_count, std::size_t code_length)
{
    Bytes table(17, 0);
    for (std::size_t rest = symbol_count; rest > 0; ++code_length)
    {
        const std::size_t count = std::min<std::size_t>(rest, 255);
        table[code_length] = static_cast<std::uint8_t>(count);
        rest -= count;
    }
    for (std::size_t i = 0; i < symbol_count; ++i)
    {
        table.push_back(static_cast<std::uint8_t>(i % 12));
    }
    return table;
}

/// A progressive grey JPEG with that table and number of scans of the first coefficients.
Bytes progressiveJpeg(std::uint16_t width, std::uint16_t height, const Bytes& table, std::size_t scan_count)
{
    const auto high = [](std::uint16_t value) { return static_cast<std::uint8_t>(value / 256); };
    const auto low = [](std::uint16_t value) { return static_cast<std::uint8_t>(value % 256); };
    Bytes quantization(65, 1);
    quantization[0] = 0;
    Bytes jpeg = {255, 216};
    append(jpeg, segment(kQuantization, quantization));
    append(jpeg, segment(kTables, table));
    append(jpeg, segment(kProgressive, {8, high(height), low(height), high(width), low(width), 1, 1, 17, 0}));
    for (std::size_t i = 0; i < scan_count; ++i)
    {
        append(jpeg, segment(kScan, {1, 1, 0, 0, 0, 0}));
        append(jpeg, {0, 0});
    }
    append(jpeg, {255, 217});
    return jpeg;
}

void expectRefused(const Bytes& image, const std::string& part)
{
    test::expectInputError([&] { decodeImage(image, "", "here"); }, {"here: ", part});
}

TEST(ImageCheck, HuffmanTableOfMoreThan256SymbolsIsRefused)
{
    EXPECT_EQ(decodeImage(progressiveJpeg(8, 8, huffmanTable(2, 4), 1), "", "here").width, 8U);
    EXPECT_EQ(findImageFault(progressiveJpeg(8, 8, huffmanTable(256, 9), 1)), "");
    expectRefused(progressiveJpeg(8, 8, huffmanTable(257, 9), 1), "more than 256 symbols");
    expectRefused(progressiveJpeg(8, 8, huffmanTable(4000, 1), 1), "more than 256 symbols");
}

TEST(ImageCheck, HuffmanTableThatLeavesItsSegmentIsRefused)
{
    Bytes table = huffmanTable(100, 8);
    table.resize(50);
    expectRefused(progressiveJpeg(8, 8, table, 1), "cut short");
    table.resize(3);
    expectRefused(progressiveJpeg(8, 8, table, 1), "cut short");
}

TEST(ImageCheck, TablesAreFoundBehindPaddingAndPixels)
{
    const Bytes bad = segment(kTables, huffmanTable(300, 9));
    Bytes padded = {255, 216, 0, 7, 255, 255};
    append(padded, bad);
    EXPECT_NE(findImageFault(padded), "");
    Bytes behind = progressiveJpeg(8, 8, huffmanTable(2, 4), 1);
    behind.resize(behind.size() - 2);
    append(behind, {1, 2, 255, 0, 3, 255, 208, 4}); // a byte 255 in pixel data, and a restart marker
    append(behind, bad);
    EXPECT_NE(findImageFault(behind), "");
    Bytes inside = {255, 216}; // in a comment it is no table
    append(inside, segment(254, bad));
    EXPECT_EQ(findImageFault(inside), "");
}

TEST(ImageCheck, JpegOfEndlessScansIsRefused)
{
    EXPECT_EQ(decodeImage(progressiveJpeg(8, 8, huffmanTable(2, 4), 500), "", "here").height, 8U);
    expectRefused(progressiveJpeg(8, 8, huffmanTable(2, 4), 501), "more than 500 scans");
}

TEST(ImageCheck, JpegOfAnySizeThatEndsAnywhereIsNoHarm)
{
    const Bytes whole = progressiveJpeg(8, 8, huffmanTable(4, 4), 2);
    for (std::size_t size = 0; size < whole.size(); ++size)
    {
        test::loadsOrIsRefused([&] { decodeImage(std::span(whole).first(size), "", "here"); });
    }
}

TEST(ImageCheck, PixelsThatAJpegLeavesOutAreTheSameOnEveryRun)
{
    const Bytes no_scans = progressiveJpeg(64, 64, huffmanTable(2, 4), 0);
    const Image image = decodeImage(no_scans, "", "here");
    for (int i = 0; i < 20; ++i)
    {
        {
            std::vector<Bytes> used(40, Bytes(std::size_t{64} * 64 * 2, static_cast<std::uint8_t>(i * 13)));
        } // freed: the decoder may get it
        EXPECT_EQ(decodeImage(no_scans, "", "here").rgba, image.rgba);
    }
    EXPECT_TRUE(
        std::all_of(image.rgba.begin(), image.rgba.end(), [&](auto value) { return value == 128 || value == 255; }));
}

TEST(ImageCheck, MorePixelsThanTheBytesCanHoldAreRefusedBeforeDecoding)
{
    expectRefused(pngThatAnnounces(kImageEdgeMax, kImageEdgeMax), "more than its");
    expectRefused(pngThatAnnounces(1, kImageEdgeMax, 3), "more than its");
    expectRefused(progressiveJpeg(16384, 16384, huffmanTable(2, 4), 1), "more than its");
    expectRefused(progressiveJpeg(1000, 1000, huffmanTable(2, 4), 1), "more than its");
    // A picture of one colour has the least possible bytes.
    constexpr std::uint32_t kEdge = 2048;
    const Bytes flat = encodePng(kEdge, kEdge, Bytes(std::size_t{kEdge} * kEdge * 4, 77));
    EXPECT_EQ(decodeImage(flat, "", "here").rgba.size(), std::size_t{kEdge} * kEdge * 4);
}

TEST(ImageCheck, AbsurdSizesAreRefused)
{
    for (const std::uint32_t edge : {1U << 15U, 1U << 24U, 1U << 30U, (1U << 31U) - 1, 1U << 31U, ~0U})
    {
        SCOPED_TRACE(edge);
        expectRefused(pngThatAnnounces(edge, edge), "here");
        expectRefused(pngThatAnnounces(edge, 1), "here");
        expectRefused(pngThatAnnounces(1, edge), "here");
    }
    expectRefused(pngThatAnnounces(0, 1), "here");
    expectRefused(pngThatAnnounces(1, 0), "here");
}

TEST(ImageCheck, DataThatUnfoldsFarBeyondThePictureIsStopped)
{
    expectRefused(pngThatAnnounces(1, 1, 2048), "does not decode");
}

TEST(ImageCheck, ImagesThatTogetherAreTooLargeAreRefusedBeforeDecoding)
{
    const Bytes png = encodePng(10, 10, Bytes(400, 1));
    EXPECT_EQ(decodeImage(png, "", "here", 400).width, 10U);
    test::expectInputError([&] { decodeImage(png, "", "here", 399); }, {"10 x 10", "more than 399 bytes"});
}

} // namespace

} // namespace zvo
