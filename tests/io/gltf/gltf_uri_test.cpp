// SPDX-License-Identifier: MIT
#include "io/gltf/gltf_uri.h"

#include "gltf_builder.h"
#include "io/image/image_io.h"

#include <gtest/gtest.h>

namespace zvo::test
{

namespace
{

std::string asText(const std::vector<std::uint8_t>& bytes)
{
    return {bytes.begin(), bytes.end()};
}

std::string base64(const std::vector<std::uint8_t>& bytes)
{
    constexpr std::string_view kAlphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (std::size_t i = 0; i < bytes.size(); i += 3)
    {
        std::uint32_t bits = 0;
        for (std::size_t k = 0; k < 3; ++k)
        {
            bits = bits * 256 + (i + k < bytes.size() ? bytes[i + k] : 0U);
        }
        for (std::size_t k = 0; k < 4; ++k)
        {
            text += i + k <= bytes.size() ? kAlphabet[(bits >> (18 - 6 * k)) % 64] : '=';
        }
    }
    return text;
}

TEST(GltfUri, PercentEncodingIsDecoded)
{
    EXPECT_EQ(decodePercent("a%20b%C3%a4.bin"), "a b\xc3\xa4.bin");
    EXPECT_EQ(decodePercent("100%"), "100%");
    EXPECT_EQ(decodePercent("5%zz%2"), "5%zz%2");
    EXPECT_EQ(decodePercent("%41"), "A");
}

TEST(GltfUri, DataUrisAreDecoded)
{
    EXPECT_EQ(asText(decodeDataUri("data:;base64,SGVsbG8=").value()), "Hello");
    EXPECT_EQ(asText(decodeDataUri("DATA:application/octet-stream;base64,SGVsbG8").value()), "Hello");
    EXPECT_EQ(asText(decodeDataUri("data:text/plain,a%20b").value()), "a b");
    EXPECT_EQ(asText(decodeDataUri("data:,").value()), "");
    EXPECT_FALSE(decodeDataUri("data:;base64,A").has_value());
    EXPECT_FALSE(decodeDataUri("data:;base64,A?==").has_value());
    EXPECT_FALSE(decodeDataUri("data:;base64").has_value());
    EXPECT_FALSE(decodeDataUri("file.bin").has_value());
}

TEST(GltfUri, RemotePlacesAreToldFromFiles)
{
    EXPECT_TRUE(isRemoteUri("https://example.com/a.bin"));
    EXPECT_TRUE(isRemoteUri("file:///a.bin"));
    EXPECT_FALSE(isRemoteUri("folder/a.bin"));
    EXPECT_FALSE(isRemoteUri("folder/x://a.bin"));
}

TEST(GltfUri, BufferMayBeALongerFileOfAnyNameOrADataUri)
{
    const TempDir dir;
    GltfBuilder builder = triangleDocument();
    std::vector<std::uint8_t> longer = builder.bin;
    longer.resize(longer.size() + 1000);
    std::filesystem::create_directory(dir.path() / "sub folder");
    dir.write("buffer.bin", builder.bin);
    dir.write("longer.bin", longer);
    dir.write("sub folder/100%25.bin", builder.bin);
    const std::string data_uri = "data:application/gltf-buffer;base64," + base64(builder.bin);
    for (const std::string& uri : {std::string("buffer.bin"), std::string("longer.bin"),
                                   std::string("sub%20folder/100%2525.bin"), // names may be percent-encoded
                                   std::string("sub folder/100%25.bin"), data_uri})
    {
        builder.document["buffers"] = json::array({{{"byteLength", builder.bin.size()}, {"uri", uri}}});
        EXPECT_EQ(loadGltf(dir.write("scene.gltf", builder.document.dump())).triangleCount(), 1U) << uri;
    }
}

TEST(GltfUri, ImageMayBeAFileOrADataUri)
{
    const TempDir dir;
    const std::vector<std::uint8_t> png = encodePng(2, 1, std::vector<std::uint8_t>{1, 2, 3, 4, 5, 6, 7, 8});
    dir.write("a picture.png", png);
    for (const std::string& uri : {std::string("a%20picture.png"), "data:image/png;base64," + base64(png)})
    {
        GltfBuilder builder = triangleDocument();
        builder.document["meshes"][0]["primitives"][0]["material"] = 0;
        builder.add("materials", {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}});
        builder.add("textures", {{"source", 0}});
        builder.add("images", {{"uri", uri}});
        const Scene scene = loadGltf(dir.write("scene.glb", builder.glb()));
        ASSERT_EQ(scene.images.size(), 1U);
        EXPECT_EQ(scene.images[0].width, 2U);
        EXPECT_EQ(scene.images[0].rgba[7], 8U);
    }
}

} // namespace

} // namespace zvo::test
