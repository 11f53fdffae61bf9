// SPDX-License-Identifier: MIT
#include "io/image/image_io.h"

#include "core/base/read_file.h"
#include "io/gltf/gltf_builder.h"
#include "io/mesh/obj_file.h"
#include "support/errors.h"
#include "support/temp_dir.h"

#include <gtest/gtest.h>

namespace zvo::test
{
namespace
{

using Bytes = std::vector<std::uint8_t>;

const Bytes kPicture = {10, 20, 30, 40, 50, 60, 70, 80};

Bytes decoded(const Image& image)
{
    EXPECT_TRUE(image.rgba.empty());
    const Pixels pixels = image.decode();
    return {pixels.get(), pixels.get() + std::size_t{4} * image.width * image.height};
}

/// A triangle with a texture; image: in the document.
GltfBuilder texturedTriangle(const json& image)
{
    GltfBuilder builder;
    json primitive = trianglePrimitive(builder);
    primitive["material"] = 0;
    primitive["attributes"]["TEXCOORD_0"] = builder.addAccessor<float>("VEC2", kF32, 3, {0, 0, 1, 0, 0, 1});
    builder.addMeshNode(primitive);
    builder.add("images", image);
    builder.add("textures", {{"source", 0}});
    builder.add("materials", {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}});
    return builder;
}

Scene loadDeferred(const std::filesystem::path& path)
{
    return loadGltf(path, readFile(path), ImageDecoding::WhenUploaded);
}

TEST(DeferredImage, OfEveryPlaceDecodesWhenItIsAskedTo)
{
    const Bytes png = encodePng(2, 1, kPicture);
    const TempDir dir;
    dir.write("a b.png", png);
    GltfBuilder inside = texturedTriangle({{"mimeType", "image/png"}});
    inside.document["images"][0]["bufferView"] = inside.addView(png.data(), png.size());
    const std::filesystem::path binary = dir.write("inside.glb", inside.glb());
    const std::filesystem::path beside = dir.write("beside.glb", texturedTriangle({{"uri", "a%20b.png"}}).glb());
    for (const std::filesystem::path& path : {binary, beside})
    {
        const Scene scene = loadDeferred(path);
        ASSERT_EQ(scene.images.size(), 1U);
        EXPECT_EQ(scene.images[0].width, 2U);
        EXPECT_EQ(scene.images[0].height, 1U);
        EXPECT_EQ(decoded(scene.images[0]), kPicture);
        EXPECT_EQ(decoded(scene.images[0]), kPicture); // again
    }
    dir.write("a.mtl", std::string_view("newmtl m\nmap_Kd a b.png\n"));
    const std::string_view obj = "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nusemtl m\nf 1/1 2/1 3/1\n";
    const Scene mesh =
        readObj(dir.path() / "a.obj", std::span(reinterpret_cast<const std::uint8_t*>(obj.data()), obj.size()),
                ImageDecoding::WhenUploaded);
    ASSERT_EQ(mesh.images.size(), 1U);
    EXPECT_EQ(decoded(mesh.images[0]), kPicture);
}

TEST(DeferredImage, ThatIsTooLargeIsLeftOutWhenTheFileIsLoaded)
{
    const TempDir dir;
    Bytes png = encodePng(1, 1, Bytes(4));
    png[18] = 64; // 16385 pixels wide
    dir.write("wide.png", png);
    const std::filesystem::path path = dir.write("a.glb", texturedTriangle({{"uri", "wide.png"}}).glb());
    const Scene scene = loadDeferred(path);
    EXPECT_TRUE(scene.images.empty());
    expectOneLine(scene.warnings, {"a.glb", "wide.png", "16385 x 1 pixels, more than 16384", "scale it down"});
}

TEST(DeferredImage, NamesThePictureThatDoesNotDecode)
{
    const TempDir dir;
    Bytes png = encodePng(64, 64, Bytes(std::size_t{64} * 64 * 4, 7));
    dir.write("torn.png", std::span(png).first(png.size() - 20));
    const std::filesystem::path path = dir.write("a.glb", texturedTriangle({{"uri", "torn.png"}}).glb());
    const Scene scene = loadDeferred(path);
    expectInputError([&] { scene.images.at(0).decode(); },
                     {path.string() + ": images[0] (torn.png): ", "save it again"});
    dir.write("torn.png", encodePng(32, 16, Bytes(std::size_t{32} * 16 * 4, 7)));
    expectInputError([&] { scene.images.at(0).decode(); }, {"torn.png: ", "load it again"});
    std::filesystem::remove(dir.path() / "torn.png");
    expectInputError([&] { scene.images.at(0).decode(); }, {path.string(), "torn.png"});
}

} // namespace
} // namespace zvo::test
