// SPDX-License-Identifier: MIT
#include "io/image/hdr_image_io.h"

#include "support/errors.h"
#include "support/temp_dir.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputFile.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace zvo
{
namespace
{

HdrImage randomImage(std::uint32_t width, std::uint32_t height)
{
    std::mt19937 random(width);
    std::uniform_real_distribution<float> stops(-8.0F, 12.0F);
    HdrImage image = {width, height, {}};
    for (std::uint32_t i = 0; i < width * height; ++i)
    {
        image.texels.emplace_back(std::exp2(stops(random)), std::exp2(stops(random)), std::exp2(stops(random)));
    }
    return image;
}

HdrImage decode(const std::vector<std::uint8_t>& bytes, std::vector<std::string>* warnings = nullptr)
{
    std::vector<std::string> own;
    HdrImage image = decodeHdrImage(bytes, "here", warnings != nullptr ? *warnings : own);
    EXPECT_TRUE(own.empty());
    return image;
}

std::string errorOf(const std::vector<std::uint8_t>& bytes)
{
    return test::messageOf([&] { decode(bytes); }, ErrorCode::Input);
}

TEST(HdrImageIo, ExrKeepsEveryNumber)
{
    for (const auto& [width, height] : {std::pair(1U, 1U), std::pair(33U, 2U), std::pair(70U, 50U)})
    {
        const HdrImage image = randomImage(width, height);
        const HdrImage decoded = decode(encodeExr(image));
        EXPECT_EQ(decoded.width, width);
        EXPECT_EQ(decoded.height, height);
        EXPECT_EQ(decoded.texels, image.texels);
    }
}

// Channels beside the light stand where their names say, and the light is read as before.
TEST(HdrImageIo, ExrHasOtherChannelsToo)
{
    const HdrImage image = randomImage(9, 5);
    std::vector<float> depth;
    std::vector<glm::vec2> motion;
    for (int i = 0; i < 45; ++i)
    {
        depth.push_back(static_cast<float>(i));
        motion.emplace_back(0.5F * static_cast<float>(i), -1.0F * static_cast<float>(i));
    }
    const std::vector<ExrChannel> channels = {
        {"depth.Z", depth.data()}, {"motion.X", &motion[0].x, 2}, {"motion.Y", &motion[0].y, 2}};
    const std::vector<std::uint8_t> encoded = encodeExr(image, channels);
    EXPECT_EQ(decode(encoded).texels, image.texels);

    const test::TempDir dir;
    dir.write("channels.exr", encoded);
    Imf::InputFile file((dir.path() / "channels.exr").c_str());
    Imf::FrameBuffer buffer;
    std::vector<std::vector<float>> read(channels.size(), std::vector<float>(45));
    for (std::size_t i = 0; i < channels.size(); ++i)
    {
        ASSERT_NE(file.header().channels().findChannel(channels[i].name), nullptr);
        buffer.insert(channels[i].name, Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(read[i].data()), sizeof(float),
                                                   9 * sizeof(float)));
    }
    file.setFrameBuffer(buffer);
    file.readPixels(0, 4);
    for (std::size_t i = 0; i < 45; ++i)
    {
        EXPECT_EQ(read[0][i], depth[i]);
        EXPECT_EQ(read[1][i], motion[i].x);
        EXPECT_EQ(read[2][i], motion[i].y);
    }
}

// The largest channel of a texel keeps 8 bits, the others its exponent.
TEST(HdrImageIo, RadianceKeepsEightBits)
{
    for (const auto& [width, height] : {std::pair(1U, 1U), std::pair(7U, 3U), std::pair(70U, 50U)})
    {
        const HdrImage image = randomImage(width, height);
        const HdrImage decoded = decode(encodeHdr(image));
        ASSERT_EQ(decoded.texels.size(), image.texels.size());
        for (std::size_t i = 0; i < image.texels.size(); ++i)
        {
            const glm::vec3 texel = image.texels[i];
            const float largest = std::max(texel.x, std::max(texel.y, texel.z));
            EXPECT_LE(glm::length(decoded.texels[i] - texel), 0.0137F * largest); // sqrt(3) / 127
        }
    }
}

TEST(HdrImageIo, ValuesThatNoLightHasAreReplaced)
{
    HdrImage image = randomImage(3, 2);
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    image.texels[1] = {-1.0F, kInfinity, 2.0F};
    image.texels[2] = {0.5F, 3e38F, 1e11F};
    image.texels[4] = {std::nanf(""), 1e6F, -kInfinity};
    std::vector<std::string> warnings;
    const HdrImage decoded = decode(encodeExr(image), &warnings);
    EXPECT_EQ(decoded.texels[0], image.texels[0]);
    EXPECT_EQ(decoded.texels[1], glm::vec3(0.0F, kRadianceMax, 2.0F));
    EXPECT_EQ(decoded.texels[2], glm::vec3(0.5F, kRadianceMax, 1e11F));
    EXPECT_EQ(decoded.texels[4], glm::vec3(0.0F, 1e6F, 0.0F));
    ASSERT_EQ(warnings.size(), 2U);
    test::expectParts(warnings.front(), {"here: 2 texels", "negative or no number", "as 0"});
    test::expectParts(warnings.back(), {"here: 2 texels", "above 1e+12"});
}

// What a picture holds does not depend on its kind: light that is in range is kept, and the rest becomes the limit.
TEST(HdrImageIo, BothKindsHaveTheSameLimit)
{
    const HdrImage image = {2, 1, {glm::vec3(0x1p20F), glm::vec3(0x1p100F)}};
    for (const auto& encoded : {encodeExr(image), encodeHdr(image)})
    {
        std::vector<std::string> warnings;
        const HdrImage decoded = decode(encoded, &warnings);
        EXPECT_EQ(decoded.texels[0], image.texels[0]);
        EXPECT_EQ(decoded.texels[1], glm::vec3(kRadianceMax));
        ASSERT_EQ(warnings.size(), 1U);
        test::expectParts(warnings.front(), {"here: 1 texel has", "above 1e+12"});
    }
}

TEST(HdrImageIo, ErrorsSayWhatIsWrong)
{
    test::expectParts(errorOf({}), {"here", "neither"});
    test::expectParts(errorOf({1, 2, 3, 4, 5}), {"here", "neither"});
    const std::string_view announced = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 0 +X 4\n";
    test::expectParts(errorOf({announced.begin(), announced.end()}), {"here"});
    const std::string_view large = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 4000 +X 4000\nabcd";
    test::expectParts(errorOf({large.begin(), large.end()}), {"here", "more texels than its bytes"});
    const std::string_view larger = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 10 +X 20000\nabcd";
    test::expectParts(errorOf({larger.begin(), larger.end()}), {"here", "16384"});
}

// However a file is damaged, it is refused in one line, or read.
TEST(HdrImageIo, DamagedFilesEndInOneLine)
{
    std::mt19937 random(1);
    std::size_t refused = 0;
    for (const std::vector<std::uint8_t>& whole : {encodeExr(randomImage(20, 9)), encodeHdr(randomImage(20, 9))})
    {
        for (int i = 0; i < 400; ++i)
        {
            std::vector<std::uint8_t> bytes = whole;
            if (i % 2 == 0)
            {
                bytes.resize(random() % bytes.size());
            }
            else
            {
                bytes[random() % bytes.size()] = static_cast<std::uint8_t>(random());
            }
            std::vector<std::string> warnings;
            refused += test::loadsOrIsRefused([&] { decodeHdrImage(bytes, "here", warnings); }) ? 0 : 1;
        }
    }
    EXPECT_GT(refused, 300U);
}

} // namespace
} // namespace zvo
