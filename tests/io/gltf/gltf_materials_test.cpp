// SPDX-License-Identifier: MIT
#include "io/gltf/gltf_loader.h"

#include "gltf_builder.h"
#include "io/image/image_io.h"
#include "io/scene/load_scene.h"

#include <gtest/gtest.h>
#include <numbers>
#include <webp/encode.h>

namespace zvo::test
{

namespace
{

/// A triangle with material 0 and two sets of texture coordinates; texture 0 is a PNG of one pixel.
GltfBuilder texturedTriangle(const json& material)
{
    GltfBuilder builder;
    json primitive = trianglePrimitive(builder);
    primitive["material"] = 0;
    primitive["attributes"]["TEXCOORD_0"] = builder.addAccessor<float>("VEC2", kF32, 3, {0, 0, 1, 0, 0, 1});
    primitive["attributes"]["TEXCOORD_1"] = builder.addAccessor<float>("VEC2", kF32, 3, {5, 5, 6, 5, 5, 6});
    builder.addMeshNode(primitive);
    const std::vector<std::uint8_t> png = encodePng(1, 1, std::vector<std::uint8_t>{10, 20, 30, 40});
    builder.add("images", {{"bufferView", builder.addView(png.data(), png.size())}, {"mimeType", "image/png"}});
    builder.add("textures", {{"source", 0}});
    builder.add("materials", material);
    return builder;
}

Material materialOf(const json& material)
{
    return texturedTriangle(material).load().materials.at(0);
}

json baseColorTexture(const json& texture)
{
    return {{"pbrMetallicRoughness", {{"baseColorTexture", texture}}}};
}

TEST(GltfMaterials, MissingMaterialIsWhiteAndOpaque)
{
    const Scene scene = triangleDocument().load();
    ASSERT_EQ(scene.materials.size(), 1U);
    EXPECT_EQ(scene.materials[0].base_color, glm::vec4(1.0F));
    EXPECT_EQ(scene.materials[0].emission, glm::vec3(0.0F));
    EXPECT_EQ(scene.materials[0].alpha_mode, AlphaMode::Opaque);
    EXPECT_FALSE(scene.materials[0].base_color_texture.has_value());
}

TEST(GltfMaterials, FactorsAndModesAreRead)
{
    const Material material = materialOf({{"name", "leaf"},
                                          {"pbrMetallicRoughness", {{"baseColorFactor", {0.1, 0.2, 0.3, 0.4}}}},
                                          {"emissiveFactor", {0.5, 0.25, 1.0}},
                                          {"alphaMode", "MASK"},
                                          {"alphaCutoff", 0.75},
                                          {"doubleSided", true}});
    EXPECT_EQ(material.name, "leaf");
    EXPECT_EQ(material.base_color, glm::vec4(0.1F, 0.2F, 0.3F, 0.4F));
    EXPECT_EQ(material.emission, glm::vec3(0.5F, 0.25F, 1.0F));
    EXPECT_EQ(material.alpha_mode, AlphaMode::Mask);
    EXPECT_EQ(material.alpha_cutoff, 0.75F);
    EXPECT_TRUE(material.double_sided);
    EXPECT_FALSE(materialOf({{"name", "leaf"}}).double_sided);
    EXPECT_EQ(materialOf({{"alphaMode", "BLEND"}}).alpha_mode, AlphaMode::Blend);
    EXPECT_EQ(materialOf({{"alphaMode", "MASK"}}).alpha_cutoff, 0.5F);
}

TEST(GltfMaterials, EmissiveStrengthMultipliesTheFactor)
{
    const Material material =
        materialOf({{"emissiveFactor", {1.0, 0.5, 0.0}},
                    {"extensions", {{"KHR_materials_emissive_strength", {{"emissiveStrength", 8.0}}}}}});
    EXPECT_EQ(material.emission, glm::vec3(8.0F, 4.0F, 0.0F));
    const Material without = materialOf(
        {{"emissiveFactor", {1.0, 0.5, 0.0}}, {"extensions", {{"KHR_materials_emissive_strength", json::object()}}}});
    EXPECT_EQ(without.emission, glm::vec3(1.0F, 0.5F, 0.0F));
}

TEST(GltfMaterials, TexturesOfColorAndEmissionShareOneImage)
{
    json material = baseColorTexture({{"index", 0}});
    material["emissiveTexture"] = {{"index", 0}};
    material["emissiveFactor"] = {1, 1, 1};
    const Scene scene = texturedTriangle(material).load();
    ASSERT_EQ(scene.images.size(), 1U);
    EXPECT_EQ(scene.images[0].rgba, (std::vector<std::uint8_t>{10, 20, 30, 40}));
    ASSERT_EQ(scene.textures.size(), 1U);
    EXPECT_EQ(scene.textures[0].wrap_u, WrapMode::Repeat);
    EXPECT_EQ(scene.materials[0].base_color_texture, 0U);
    EXPECT_EQ(scene.materials[0].emission_texture, 0U);
    EXPECT_TRUE(scene.warnings.empty());
}

TEST(GltfMaterials, SamplerSaysHowCoordinatesWrap)
{
    GltfBuilder builder = texturedTriangle(baseColorTexture({{"index", 0}}));
    builder.document["textures"][0]["sampler"] = 0;
    builder.add("samplers", {{"wrapS", 33071}, {"wrapT", 33648}});
    const Scene scene = builder.load();
    EXPECT_EQ(scene.textures.at(0).wrap_u, WrapMode::ClampToEdge);
    EXPECT_EQ(scene.textures.at(0).wrap_v, WrapMode::MirroredRepeat);
}

TEST(GltfMaterials, OnlyImagesThatAreNeededAreDecoded)
{
    // Image 1 is damaged. It may be so as a normal map, as an emissive texture without emission, or if it is unused.
    json material = baseColorTexture({{"index", 0}});
    material["normalTexture"] = {{"index", 1}};
    material["emissiveTexture"] = {{"index", 1}};
    GltfBuilder builder = texturedTriangle(material);
    builder.add("images", {{"uri", "data:image/png;base64,AAAA"}});
    builder.add("images", {{"uri", "missing.png"}});
    builder.add("textures", {{"source", 1}});
    builder.add("materials", baseColorTexture({{"index", 1}}));
    const Scene scene = builder.load();
    EXPECT_EQ(scene.images.size(), 1U);
    EXPECT_EQ(scene.materials.size(), 1U);
    EXPECT_FALSE(scene.materials[0].emission_texture.has_value());
}

TEST(GltfMaterials, TextureMayTakeAnySetOfCoordinates)
{
    EXPECT_EQ(texturedTriangle(baseColorTexture({{"index", 0}})).load().primitives[0].uvs[0], glm::vec2(0, 0));
    const Scene scene = texturedTriangle(baseColorTexture({{"index", 0}, {"texCoord", 1}})).load();
    EXPECT_EQ(scene.primitives[0].uvs[0], glm::vec2(5, 5));
    EXPECT_TRUE(scene.warnings.empty());
}

TEST(GltfMaterials, MissingCoordinatesAreAWarning)
{
    const Scene scene = texturedTriangle(baseColorTexture({{"index", 0}, {"texCoord", 2}})).load();
    EXPECT_TRUE(scene.primitives[0].uvs.empty());
    expectOneLine(scene.warnings, {"TEXCOORD_2"});
}

TEST(GltfMaterials, EmissionMayHaveOtherCoordinatesThanTheBaseColor)
{
    json material = baseColorTexture({{"index", 0}});
    material["emissiveTexture"] = {{"index", 0}, {"texCoord", 1}};
    material["emissiveFactor"] = {1, 1, 1};
    const Scene scene = texturedTriangle(material).load();
    EXPECT_TRUE(scene.warnings.empty());
    EXPECT_EQ(scene.materials[0].emission, glm::vec3(1.0F));
    EXPECT_EQ(scene.materials[0].emission_texture, 0U);
    EXPECT_EQ(scene.primitives[0].uvs, (std::vector<glm::vec2>{{0, 0}, {1, 0}, {0, 1}}));
    EXPECT_EQ(scene.primitives[0].emission_uvs, (std::vector<glm::vec2>{{5, 5}, {6, 5}, {5, 6}}));

    material["emissiveTexture"]["texCoord"] = 0;
    EXPECT_TRUE(texturedTriangle(material).load().primitives[0].emission_uvs.empty());
    material["emissiveTexture"]["extensions"] = {{"KHR_texture_transform", {{"scale", {2, 3}}}}};
    EXPECT_EQ(texturedTriangle(material).load().primitives[0].emission_uvs,
              (std::vector<glm::vec2>{{0, 0}, {2, 0}, {0, 3}}));
    material["emissiveTexture"]["texCoord"] = 2;
    const Scene missing = texturedTriangle(material).load();
    EXPECT_EQ(missing.primitives[0].emission_uvs, std::vector<glm::vec2>(3, glm::vec2(0.0F)));
    expectOneLine(missing.warnings, {"TEXCOORD_2"});
}

TEST(GltfMaterials, TextureTransformMovesTheCoordinates)
{
    // The extension's example: the lower left quadrant of the image, rotated by 90 degrees.
    const json transform = {{"offset", {0, 1}}, {"rotation", std::numbers::pi / 2}, {"scale", {0.5, 0.5}}};
    const json texture = {{"index", 0}, {"extensions", {{"KHR_texture_transform", transform}}}};
    const std::vector<glm::vec2> uvs = texturedTriangle(baseColorTexture(texture)).load().primitives[0].uvs;
    const std::vector<glm::vec2> wanted = {{0.0F, 1.0F}, {0.0F, 0.5F}, {0.5F, 1.0F}};
    for (std::size_t i = 0; i < wanted.size(); ++i)
    {
        EXPECT_NEAR(uvs[i].x, wanted[i].x, 1e-7F) << i;
        EXPECT_NEAR(uvs[i].y, wanted[i].y, 1e-7F) << i;
    }
    const json other_set = {{"index", 0}, {"extensions", {{"KHR_texture_transform", {{"texCoord", 1}}}}}};
    EXPECT_EQ(texturedTriangle(baseColorTexture(other_set)).load().primitives[0].uvs[0], glm::vec2(5, 5));
}

TEST(GltfMaterials, DiffuseOfSpecularGlossinessIsTheBaseColor)
{
    const json transform = {{"offset", {0.5, 0.25}}};
    const json texture = {{"index", 0}, {"texCoord", 1}, {"extensions", {{"KHR_texture_transform", transform}}}};
    const json diffuse = {{"diffuseFactor", {0.1, 0.2, 0.3, 0.4}},
                          {"diffuseTexture", texture},
                          {"specularFactor", {1, 1, 1}},
                          {"glossinessFactor", 0.5}};
    json material = {{"extensions", {{"KHR_materials_pbrSpecularGlossiness", diffuse}}},
                     {"pbrMetallicRoughness", {{"baseColorFactor", {1, 0, 0, 1}}}}};
    GltfBuilder builder = texturedTriangle(material);
    builder.document["extensionsRequired"] = {"KHR_materials_pbrSpecularGlossiness", "KHR_texture_transform"};
    const Scene scene = builder.load();
    EXPECT_EQ(scene.materials[0].base_color, glm::vec4(0.1F, 0.2F, 0.3F, 0.4F));
    EXPECT_EQ(scene.materials[0].base_color_texture, 0U);
    EXPECT_EQ(scene.primitives[0].uvs[0], glm::vec2(5.5F, 5.25F));
    EXPECT_TRUE(scene.warnings.empty());
    // Without members the colour is white, whatever the metallic-roughness colour is.
    material["extensions"]["KHR_materials_pbrSpecularGlossiness"] = json::object();
    EXPECT_EQ(materialOf(material).base_color, glm::vec4(1.0F));
    EXPECT_FALSE(materialOf(material).base_color_texture.has_value());
    material["extensions"]["KHR_materials_pbrSpecularGlossiness"] = {{"diffuseTexture", {{"index", 5}}}};
    expectInputError([&] { materialOf(material); }, {"diffuseTexture.index is 5"});
    material["extensions"]["KHR_materials_pbrSpecularGlossiness"] = {{"diffuseFactor", {1, -1, 1, 1}}};
    expectInputError([&] { materialOf(material); }, {"materials[0].diffuseFactor is -1"});
}

TEST(GltfMaterials, UnlitIsTheBaseColor)
{
    GltfBuilder builder = texturedTriangle({{"pbrMetallicRoughness", {{"baseColorFactor", {0.1, 0.2, 0.3, 1}}}},
                                            {"extensions", {{"KHR_materials_unlit", json::object()}}}});
    builder.document["extensionsRequired"] = {"KHR_materials_unlit"};
    const Scene scene = builder.load();
    EXPECT_EQ(scene.materials[0].base_color, glm::vec4(0.1F, 0.2F, 0.3F, 1.0F));
    EXPECT_EQ(scene.materials[0].emission, glm::vec3(0.0F));
    EXPECT_TRUE(scene.warnings.empty());
}

TEST(GltfMaterials, WebpTextureStandsBeforeItsFallback)
{
    const std::vector<std::uint8_t> pixel = {200, 100, 50, 255};
    std::uint8_t* bytes = nullptr;
    const std::size_t size = WebPEncodeLosslessRGBA(pixel.data(), 1, 1, 4, &bytes);
    GltfBuilder builder = texturedTriangle(baseColorTexture({{"index", 0}}));
    builder.add("images", {{"bufferView", builder.addView(bytes, size)}, {"mimeType", "image/webp"}});
    WebPFree(bytes);
    json& texture = builder.document["textures"][0];
    texture["extensions"]["EXT_texture_webp"]["source"] = 1;
    for (const bool has_fallback : {true, false})
    {
        if (!has_fallback)
        {
            texture.erase("source");
            builder.document["extensionsRequired"] = {"EXT_texture_webp"};
        }
        const Scene scene = builder.load();
        ASSERT_EQ(scene.images.size(), 1U);
        EXPECT_EQ(scene.images[0].rgba, pixel);
        EXPECT_TRUE(scene.warnings.empty());
    }
    texture["extensions"]["EXT_texture_webp"]["source"] = 2;
    expectInputError(builder, {"EXT_texture_webp.source is 2"});
}

TEST(GltfMaterials, TextureWithoutAKnownImageIsLeftOutEvenIfItsFormatIsRequired)
{
    GltfBuilder builder = texturedTriangle(baseColorTexture({{"index", 0}}));
    builder.document["textures"][0] = {{"extensions", {{"KHR_texture_basisu", {{"source", 0}}}}}};
    for (const json& required : {json::array(), json::array({"KHR_texture_basisu"})})
    {
        builder.document["extensionsRequired"] = required;
        const Scene scene = builder.load();
        EXPECT_EQ(scene.triangleCount(), 1U);
        EXPECT_FALSE(scene.materials[0].base_color_texture.has_value());
        expectOneLine(scene.warnings, {"texture left out", "but one of KHR_texture_basisu; export"});
    }
    builder.document["textures"][0] = json::object();
    expectOneLine(builder.load().warnings, {"it has no PNG, JPEG or WebP image; export"});
}

TEST(GltfMaterials, ImagesThatCannotBeUsedAreLeftOutWithAWarning)
{
    const auto bytes = [](std::string_view text) { return std::vector<std::uint8_t>(text.begin(), text.end()); };
    std::vector<std::uint8_t> cut = encodePng(64, 64, std::vector<std::uint8_t>(64 * 64 * 4, 7));
    cut.resize(cut.size() - 30);
    std::vector<std::uint8_t> wide = encodePng(1, 1, std::vector<std::uint8_t>(4));
    wide[16] = 127; // the upper byte of the width
    const TempDir dir;
    dir.write("brick.dds", bytes("DDS |" + std::string(200, '\0')));
    dir.write("empty.png", std::vector<std::uint8_t>());
    struct Case
    {
        json image;
        std::vector<std::uint8_t> data; // of a buffer view, if there is any
        std::string reason;
    };
    const std::vector<Case> cases = {
        {{{"uri", "missing%20one.png"}}, {}, "images[0].uri is missing%20one.png: there is no such file"},
        {{{"uri", "brick.dds"}}, {}, "images[0] (brick.dds): not a PNG, JPEG, WebP, BMP or TGA image"},
        {{{"uri", "empty.png"}}, {}, "images[0] (empty.png): not a PNG, JPEG, WebP, BMP or TGA image (it is empty)"},
        {{{"uri", "https://example.com/a.png"}}, {}, "images[0].uri is https://example.com/a.png: only files"},
        {{{"uri", "data:image/png;base64,AAAA"}}, {}, "images[0] (images[0]): not a PNG, JPEG, WebP, BMP or TGA image"},
        {{{"uri", "data:image/png;base64,A*"}}, {}, "images[0].uri is not a valid data URI"},
        {{{"name", "skin"}}, bytes("GIF89a text"), "images[0] (images[0]): not a PNG, JPEG, WebP, BMP or TGA image"},
        {json::object(), cut, "images[0] (images[0]): the image does not decode"},
        {json::object(), wide, "images[0] (images[0]): "},
        {{{"name", "skin"}}, {}, "images[0] has neither a URI nor a buffer view"}};
    for (const auto& [image, data, reason] : cases)
    {
        json material = baseColorTexture({{"index", 0}});
        material["pbrMetallicRoughness"]["baseColorFactor"] = {0.5, 0.25, 1, 1};
        material["emissiveTexture"] = {{"index", 0}};
        material["emissiveFactor"] = {1, 2, 3};
        GltfBuilder builder = texturedTriangle(material);
        builder.document["images"][0] = image;
        if (!data.empty())
        {
            builder.document["images"][0]["bufferView"] = builder.addView(data.data(), data.size());
        }
        const std::filesystem::path path = dir.write("scene.glb", builder.glb());
        const Scene scene = loadScene(std::span(&path, 1));
        EXPECT_TRUE(scene.images.empty()) << reason;
        EXPECT_EQ(sceneFault(scene), "") << reason;
        const Material& loaded = scene.materials.at(0);
        EXPECT_FALSE(loaded.base_color_texture || loaded.emission_texture) << reason;
        EXPECT_EQ(loaded.base_color, glm::vec4(0.5F, 0.25F, 1.0F, 1.0F)) << "white times the factor";
        EXPECT_EQ(loaded.emission, glm::vec3(1, 2, 3));
        expectOneLine(scene.warnings, {"scene.glb: texture left out: " + reason,
                                       "(materials[0].pbrMetallicRoughness.baseColorTexture and 1 more)"});
        EXPECT_EQ(scene.warnings[0].find_first_of("\n\r\t"), std::string::npos);
        expectInputError([&] { return loadScene(std::span(&path, 1), {.strict = true}); }, {reason});
    }
}

TEST(GltfMaterials, ExtensionsThatOnlyChangeShadingMayBeRequired)
{
    GltfBuilder builder = triangleDocument();
    builder.document["extensionsUsed"] = {"KHR_materials_ior", "VENDOR_unheard_of"};
    builder.document["extensionsRequired"] = {"KHR_materials_ior", "KHR_lights_punctual",
                                              "KHR_materials_emissive_strength", "KHR_materials_diffuse_transmission",
                                              "KHR_materials_not_yet_known"};
    EXPECT_EQ(builder.load().triangleCount(), 1U);
    builder.document["extensionsRequired"] = {"VENDOR_materials"};
    expectInputError(builder, {"requires the extension VENDOR_materials"});
}

} // namespace

} // namespace zvo::test
