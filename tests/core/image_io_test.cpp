// SPDX-License-Identifier: MIT
#include "core/image_io.h"

#include "core/gltf_uri.h"
#include "gltf_builder.h"
#include "zvo/error.h"

#include <gtest/gtest.h>

namespace zvo
{

namespace
{

std::vector<std::uint8_t> base64(const std::string& text)
{
    return decodeDataUri("data:image/png;base64," + text).value();
}

Image checkerboard(std::uint32_t width, std::uint32_t height)
{
    Image image{.name = "board", .width = width, .height = height, .rgba = {}};
    for (std::uint32_t i = 0; i < width * height; ++i)
    {
        const auto value = static_cast<std::uint8_t>(i * 37);
        image.rgba.insert(image.rgba.end(), {value, static_cast<std::uint8_t>(255 - value), 128, value});
    }
    return image;
}

TEST(ImageIo, PngKeepsEveryByte)
{
    for (const auto& [width, height] : {std::pair(1U, 1U), std::pair(27U, 1U), std::pair(64U, 49U)})
    {
        const Image image = checkerboard(width, height);
        const Image decoded = decodeImage(encodePng(width, height, image.rgba), "name", "here");
        EXPECT_EQ(decoded.name, "name");
        EXPECT_EQ(decoded.width, width);
        EXPECT_EQ(decoded.height, height);
        EXPECT_EQ(decoded.rgba, image.rgba);
    }
}

TEST(ImageIo, EqualPicturesGiveEqualFiles)
{
    const Image image = checkerboard(50, 40);
    EXPECT_EQ(encodePng(50, 40, image.rgba), encodePng(50, 40, image.rgba));
}

// Two pixels, 16 bits per channel: 12ff 8000 ffff 00ff, 0100 7f80 fe01 ffff.
constexpr const char* kSixteenBitPng =
    "iVBORw0KGgoAAAANSUhEUgAAAAIAAAABEAYAAACksqPJAAAAGklEQVR42mMQ+t/A8P8/w39GhvqGf4z//wMAQ3wIjOdM/JYAAAAA"
    "SUVORK5CYII=";
// Two pixels of grey, 7 and 200.
constexpr const char* kGreyPng =
    "iVBORw0KGgoAAAANSUhEUgAAAAIAAAABCAAAAADRSSBWAAAAC0lEQVR42mNgPwEAANkA0EQCVdsAAAAASUVORK5CYII=";
// Two pixels with a palette: (40, 50, 60) at alpha 128, (10, 20, 30) opaque.
constexpr const char* kPalettePng =
    "iVBORw0KGgoAAAANSUhEUgAAAAIAAAABCAMAAADD/I+4AAAABlBMVEUKFB4oMjzVG7TpAAAAAnRSTlP/gAgPs2oAAAALSURBVHja"
    "Y2BkAAAABQACQsJEnwAAAABJRU5ErkJggg==";

TEST(ImageIo, SixteenBitChannelsKeepTheirUpperByte)
{
    const Image image = decodeImage(base64(kSixteenBitPng), "", "here");
    EXPECT_EQ(image.rgba, (std::vector<std::uint8_t>{18, 128, 255, 0, 1, 127, 254, 255}));
}

TEST(ImageIo, GreyAndPalettesBecomeColours)
{
    const Image grey = decodeImage(base64(kGreyPng), "", "here");
    EXPECT_EQ(grey.rgba, (std::vector<std::uint8_t>{7, 7, 7, 255, 200, 200, 200, 255}));
    const Image palette = decodeImage(base64(kPalettePng), "", "here");
    EXPECT_EQ(palette.rgba, (std::vector<std::uint8_t>{40, 50, 60, 128, 10, 20, 30, 255}));
}

TEST(ImageIo, BrokenImagesAreInputErrors)
{
    const Image image = checkerboard(64, 64);
    std::vector<std::uint8_t> png = encodePng(64, 64, image.rgba);
    png.resize(png.size() / 2);
    test::expectInputError([&] { decodeImage(png, "", "here"); }, {"here: ", "does not decode"});
    png.resize(3);
    test::expectInputError([&] { decodeImage(png, "", "here"); }, {"here: ", "not a PNG or JPEG"});
    test::expectInputError([&] { decodeImage({}, "", "here"); }, {"here: ", "not a PNG or JPEG"});
}

TEST(ImageIo, TooLongEdgeIsAnInputError)
{
    const std::vector<std::uint8_t> just_right = encodePng(kImageEdgeMax, 1, checkerboard(kImageEdgeMax, 1).rgba);
    EXPECT_EQ(decodeImage(just_right, "", "here").width, kImageEdgeMax);
    // The same file with one pixel more in its header: big-endian width after signature, length and type.
    constexpr std::size_t kWidthOffset = 16;
    std::vector<std::uint8_t> too_wide = just_right;
    too_wide[kWidthOffset + 3] = 1;
    test::expectInputError([&] { decodeImage(too_wide, "", "here"); }, {"16385 x 1", "scale it down"});
}

} // namespace

} // namespace zvo
