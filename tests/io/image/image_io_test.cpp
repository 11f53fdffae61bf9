// SPDX-License-Identifier: MIT
#include "io/image/image_io.h"

#include "io/gltf/gltf_builder.h"
#include "io/gltf/gltf_uri.h"
#include "io/image/webp_write.h"
#include "support/errors.h"
#include "zvo/error.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <memory>
#include <webp/demux.h>
#include <webp/encode.h>

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

TEST(ImageIo, WebpWithoutLossKeepsAllButAlpha)
{
    for (const auto& [width, height] : {std::pair(1U, 1U), std::pair(27U, 1U), std::pair(64U, 49U)})
    {
        Image image = checkerboard(width, height);
        const Image decoded = decodeImage(encodeWebp(width, height, image.rgba, kWebpLossless), "name", "here");
        for (std::size_t i = 3; i < image.rgba.size(); i += 4)
        {
            image.rgba[i] = 255;
        }
        EXPECT_EQ(decoded.width, width);
        EXPECT_EQ(decoded.rgba, image.rgba);
    }
}

TEST(ImageIo, LossyPicturesAreNear)
{
    Image image{.name = "slope", .width = 64, .height = 48, .rgba = {}};
    for (std::uint32_t i = 0; i < image.width * image.height; ++i)
    {
        const auto x = static_cast<std::uint8_t>(4 * (i % 64));
        const auto y = static_cast<std::uint8_t>(5 * (i / 64));
        image.rgba.insert(image.rgba.end(), {x, y, 90, 255});
    }
    for (const auto& encoded : {encodeJpeg(64, 48, image.rgba, 90), encodeWebp(64, 48, image.rgba, 90)})
    {
        const Image decoded = decodeImage(encoded, "name", "here");
        ASSERT_EQ(decoded.rgba.size(), image.rgba.size());
        for (std::size_t i = 0; i < image.rgba.size(); ++i)
        {
            ASSERT_NEAR(decoded.rgba[i], image.rgba[i], 12) << i;
        }
    }
}

TEST(ImageIo, AnimationsPlayTheirPicturesInTheirTime)
{
    WebpAnimation animation(16, 8, kWebpLossless);
    for (std::uint32_t i = 0; i < 3; ++i)
    {
        animation.add(std::vector(16 * 8 * 4, static_cast<std::uint8_t>(50 * i)), i * 40);
    }
    const std::vector<std::uint8_t> file = animation.finish(200);
    const WebPData data = {file.data(), file.size()};
    const std::unique_ptr<WebPAnimDecoder, decltype(&WebPAnimDecoderDelete)> decoder(WebPAnimDecoderNew(&data, nullptr),
                                                                                     WebPAnimDecoderDelete);
    ASSERT_TRUE(decoder);
    WebPAnimInfo info;
    WebPAnimDecoderGetInfo(decoder.get(), &info);
    EXPECT_EQ(info.frame_count, 3U);
    EXPECT_EQ(info.loop_count, 0U) << "for ever";
    constexpr int kEnds[] = {40, 80, 200};
    for (int i = 0; i < 3; ++i)
    {
        std::uint8_t* rgba = nullptr;
        int end = 0;
        ASSERT_TRUE(WebPAnimDecoderGetNext(decoder.get(), &rgba, &end));
        EXPECT_EQ(end, kEnds[i]);
        EXPECT_EQ(rgba[0], 50 * i);
        EXPECT_EQ(rgba[3], 255);
    }
}

TEST(ImageIo, EqualPicturesGiveEqualFiles)
{
    const Image image = checkerboard(50, 40);
    EXPECT_EQ(encodeJpeg(50, 40, image.rgba, 90), encodeJpeg(50, 40, image.rgba, 90));
    EXPECT_EQ(encodeWebp(50, 40, image.rgba, 90), encodeWebp(50, 40, image.rgba, 90));
    EXPECT_EQ(encodePng(50, 40, image.rgba), encodePng(50, 40, image.rgba));
}

// Two pixels in a row: (1, 2, 3) and (200, 100, 50). In the files blue comes first.
std::vector<std::uint8_t> bmp()
{
    std::vector<std::uint8_t> file = {'B', 'M', 62, 0, 0, 0, 0, 0, 0, 0, 54, 0, 0, 0, // sizes of the file and its head
                                      40,  0,   0,  0, 2, 0, 0, 0, 1, 0, 0,  0, 1, 0, // width, height, planes
                                      24,  0};                                        // bits of a pixel
    file.resize(54);
    file.insert(file.end(), {3, 2, 1, 50, 100, 200, 0, 0});
    return file;
}

std::vector<std::uint8_t> tga(std::uint8_t type, std::uint8_t bits, std::initializer_list<std::uint8_t> pixels)
{
    constexpr std::uint8_t kFromTop = 32;
    std::vector<std::uint8_t> file = {0, 0, type, 0, 0, 0, 0, 0, 0, 0, 0, 0, 2, 0, 1, 0, bits, kFromTop};
    file.insert(file.end(), pixels);
    return file;
}

TEST(ImageIo, BmpAndTgaKeepEveryByte)
{
    const std::vector<std::uint8_t> wanted = {1, 2, 3, 255, 200, 100, 50, 255};
    EXPECT_EQ(decodeImage(bmp(), "name", "here").rgba, wanted);
    EXPECT_EQ(decodeImage(tga(2, 24, {3, 2, 1, 50, 100, 200}), "name", "here").rgba, wanted);
    EXPECT_EQ(decodeImage(tga(10, 24, {1, 3, 2, 1, 50, 100, 200}), "name", "here").rgba, wanted) << "no run";
    EXPECT_EQ(decodeImage(tga(10, 32, {129, 3, 2, 1, 4}), "name", "here").rgba,
              (std::vector<std::uint8_t>{1, 2, 3, 4, 1, 2, 3, 4}));
    EXPECT_EQ(decodeImage(tga(3, 8, {7, 9}), "name", "here").rgba,
              (std::vector<std::uint8_t>{7, 7, 7, 255, 9, 9, 9, 255}));
}

TEST(ImageIo, BmpAndTgaThatAreCutShortAreInputErrors)
{
    std::vector<std::uint8_t> large = tga(10, 24, {129, 3, 2, 1});
    large[13] = 64; // 16,386 pixels wide
    std::vector<std::uint8_t> runs = tga(10, 24, {129, 3, 2, 1});
    runs[15] = 32; // 8193 rows
    std::vector<std::uint8_t> flat = bmp();
    flat[22] = 100; // rows
    for (const auto& [damaged, reason] :
         {std::pair(large, "16386 x 1"), std::pair(runs, "more than its"), std::pair(flat, "more than its"),
          std::pair(tga(2, 24, {}), "more than its"), std::pair(tga(2, 12, {1, 2, 3, 4}), "not a PNG")})
    {
        test::expectParts(test::messageOf([&file = damaged] { static_cast<void>(decodeImage(file, "name", "here")); },
                                          ErrorCode::Input),
                          {"here: ", reason});
    }
}

// Two pixels, 16 bits per channel: 12ff 8000 ffff 00ff, 0100 7f80 fe01 ffff.
constexpr const char* kSixteenBitPng =
    "iVBORw0KGgoAAAANSUhEUgAAAAIAAAABEAYAAACksqPJAAAAGklEQVR42mMQ+t/A8P8/w39GhvqGf4z//wMAQ3wIjOdM/JYAAAAA"
    "SUVORK5CYII=";
// Two pixels of grey, 7 and 200.
constexpr const char* kGrayPng =
    "iVBORw0KGgoAAAANSUhEUgAAAAIAAAABCAAAAADRSSBWAAAAC0lEQVR42mNgPwEAANkA0EQCVdsAAAAASUVORK5CYII=";
// Two pixels with a palette: (40, 50, 60) at alpha 128, (10, 20, 30) opaque.
constexpr const char* kPalettePng =
    "iVBORw0KGgoAAAANSUhEUgAAAAIAAAABCAMAAADD/I+4AAAABlBMVEUKFB4oMjzVG7TpAAAAAnRSTlP/gAgPs2oAAAALSURBVHja"
    "Y2BkAAAABQACQsJEnwAAAABJRU5ErkJggg==";

// Grey 7 opaque, 200 at alpha 64; then the same with 16 bits.
constexpr const char* kGrayAlphaPng =
    "iVBORw0KGgoAAAANSUhEUgAAAAIAAAABCAQAAABeK7cBAAAADUlEQVR4nGNg/3/CAQAE7gIP8XIdWQAAAABJRU5ErkJggg==";
constexpr const char* kGrayAlpha16Png =
    "iVBORw0KGgoAAAANSUhEUgAAAAIAAAABEAQAAAAOu2tCAAAAEUlEQVR4nGNgT/7PeILJgRkADJ4CeCe57G8AAAAASUVORK5CYII=";
// Grey 0x0763 and 0xC802.
constexpr const char* kGray16Png =
    "iVBORw0KGgoAAAANSUhEUgAAAAIAAAABEAAAAACB2fwVAAAADUlEQVR4nGNgTz7BBAAC3AE10qFwygAAAABJRU5ErkJggg==";
// Eight pixels of one bit: 10110001.
constexpr const char* kOneBitPng =
    "iVBORw0KGgoAAAANSUhEUgAAAAgAAAABAQAAAADLe9LuAAAACklEQVR4nGPYCAAAswCyIZJRygAAAABJRU5ErkJggg==";
// Two pixels of four bits: 3 and 15.
constexpr const char* kFourBitPng =
    "iVBORw0KGgoAAAANSUhEUgAAAAIAAAABBAAAAAAUuc1XAAAACklEQVR4nGOwBwAAQQBAjW7VEwAAAABJRU5ErkJggg==";
// Four pixels, two colours: 0110.
constexpr const char* kOneBitPalettePng =
    "iVBORw0KGgoAAAANSUhEUgAAAAQAAAABAQMAAADD8p2OAAAABlBMVEUBAgP6+/z9XuajAAAACklEQVR4nGNIAAAAYgBhsZh58gAA"
    "AABJRU5ErkJggg==";

TEST(ImageIo, SixteenBitChannelsKeepTheirUpperByte)
{
    const Image image = decodeImage(base64(kSixteenBitPng), "", "here");
    EXPECT_EQ(image.rgba, (std::vector<std::uint8_t>{18, 128, 255, 0, 1, 127, 254, 255}));
}

TEST(ImageIo, GrayAndPalettesBecomeColors)
{
    const Image gray = decodeImage(base64(kGrayPng), "", "here");
    EXPECT_EQ(gray.rgba, (std::vector<std::uint8_t>{7, 7, 7, 255, 200, 200, 200, 255}));
    const Image palette = decodeImage(base64(kPalettePng), "", "here");
    EXPECT_EQ(palette.rgba, (std::vector<std::uint8_t>{40, 50, 60, 128, 10, 20, 30, 255}));
}

TEST(ImageIo, GrayMayHaveAnyDepthAndAlpha)
{
    const auto pixels = [](const char* png) { return decodeImage(base64(png), "", "here").rgba; };
    using Pixels = std::vector<std::uint8_t>;
    EXPECT_EQ(pixels(kGrayAlphaPng), (Pixels{7, 7, 7, 255, 200, 200, 200, 64}));
    EXPECT_EQ(pixels(kGrayAlpha16Png), (Pixels{7, 7, 7, 255, 200, 200, 200, 64}));
    EXPECT_EQ(pixels(kGray16Png), (Pixels{7, 7, 7, 255, 200, 200, 200, 255}));
    EXPECT_EQ(pixels(kFourBitPng), (Pixels{51, 51, 51, 255, 255, 255, 255, 255}));
    Pixels bits;
    for (const std::uint8_t value : Pixels{255, 0, 255, 255, 0, 0, 0, 255})
    {
        bits.insert(bits.end(), {value, value, value, 255});
    }
    EXPECT_EQ(pixels(kOneBitPng), bits);
    EXPECT_EQ(pixels(kOneBitPalettePng), (Pixels{1, 2, 3, 255, 250, 251, 252, 255, 250, 251, 252, 255, 1, 2, 3, 255}));
}

std::vector<std::uint8_t> encodeWebp(const Image& image, bool lossless)
{
    std::uint8_t* bytes = nullptr;
    const auto width = static_cast<int>(image.width);
    const auto height = static_cast<int>(image.height);
    const std::size_t size = lossless ? WebPEncodeLosslessRGBA(image.rgba.data(), width, height, 4 * width, &bytes)
                                      : WebPEncodeRGBA(image.rgba.data(), width, height, 4 * width, 90.0F, &bytes);
    const std::vector<std::uint8_t> webp(bytes, bytes + size);
    WebPFree(bytes);
    return webp;
}

TEST(ImageIo, LosslessWebpKeepsEveryVisibleByte)
{
    Image image = checkerboard(50, 41);
    for (std::size_t i = 3; i < image.rgba.size(); i += 4)
    {
        image.rgba[i] =
            std::max<std::uint8_t>(image.rgba[i], 1); // the encoder changes the colours of transparent pixels
    }
    const Image decoded = decodeImage(encodeWebp(image, true), "name", "here");
    EXPECT_EQ(decoded.name, "name");
    EXPECT_EQ(decoded.width, 50U);
    EXPECT_EQ(decoded.height, 41U);
    EXPECT_EQ(decoded.rgba, image.rgba);
}

TEST(ImageIo, LossyWebpIsClose)
{
    Image image{.name = "", .width = 64, .height = 32, .rgba = {}};
    for (std::uint32_t i = 0; i < 64 * 32; ++i)
    {
        const auto shade = static_cast<std::uint8_t>(i % 64 * 3);
        image.rgba.insert(image.rgba.end(), {shade, shade, 128, 255});
    }
    const Image decoded = decodeImage(encodeWebp(image, false), "", "here");
    ASSERT_EQ(decoded.rgba.size(), image.rgba.size());
    for (std::size_t i = 0; i < image.rgba.size(); ++i)
    {
        EXPECT_NEAR(decoded.rgba[i], image.rgba[i], 16) << i;
    }
}

TEST(ImageIo, BrokenWebpIsAnInputError)
{
    std::vector<std::uint8_t> webp = encodeWebp(checkerboard(64, 64), true);
    webp.resize(webp.size() / 2);
    test::expectInputError([&] { decodeImage(webp, "", "here"); }, {"here: ", "WebP image does not decode"});
    webp.resize(13);
    test::expectInputError([&] { decodeImage(webp, "", "here"); }, {"here: ", "WebP image does not decode"});
}

TEST(ImageIo, BrokenImagesAreInputErrors)
{
    const Image image = checkerboard(64, 64);
    std::vector<std::uint8_t> png = encodePng(64, 64, image.rgba);
    png.resize(png.size() / 2);
    test::expectInputError([&] { decodeImage(png, "", "here"); }, {"here: ", "does not decode"});
    png.resize(3);
    test::expectInputError([&] { decodeImage(png, "", "here"); }, {"here: ", "not a PNG, JPEG, WebP, BMP or TGA"});
    test::expectInputError([&] { decodeImage({}, "", "here"); }, {"here: ", "not a PNG, JPEG, WebP, BMP or TGA"});
}

TEST(ImageIo, TooLongEdgeIsAnInputError)
{
    const std::vector<std::uint8_t> just_right = encodePng(kImageEdgeMax, 1, checkerboard(kImageEdgeMax, 1).rgba);
    EXPECT_EQ(decodeImage(just_right, "", "here").width, kImageEdgeMax);
    // The same file with one pixel more in its header: width, big-endian, follows signature, length and type.
    constexpr std::size_t kPngWidthOffset = 16;
    std::vector<std::uint8_t> too_wide = just_right;
    too_wide[kPngWidthOffset + 3] = 1;
    test::expectInputError([&] { decodeImage(too_wide, "", "here"); }, {"16385 x 1", "scale it down"});
}

} // namespace

} // namespace zvo
