// SPDX-License-Identifier: MIT
// Every way to break a file gives an error that says what is wrong, where, and what to do.
#include "io/gltf/gltf_loader.h"

#include "gltf_builder.h"
#include "io/image/image_io.h"

#include <gtest/gtest.h>
#include <random>

namespace zvo::test
{

namespace
{

constexpr const char* kHint = "export it again";

/// Changes the triangle document, loads it as .glb, and expects an error with the parts.
void expectBroken(const Change& change, std::initializer_list<std::string> parts)
{
    expectInputError(triangleDocument(), change, parts);
}

void expectBrokenFile(const std::string& name, std::string_view content, std::initializer_list<std::string> parts)
{
    const TempDir dir;
    const auto path = dir.write(name, content);
    expectInputError([&] { loadGltf(path); }, parts);
}

json textured(GltfBuilder& builder, const json& image)
{
    builder.document["meshes"][0]["primitives"][0]["material"] = 0;
    builder.add("textures", {{"source", 0}});
    builder.add("images", image);
    builder.add("materials", {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}});
    return builder.document;
}

TEST(GltfErrors, MissingFileNamesThePathAndTheReason)
{
    expectInputError([] { loadGltf("/no/such/scene.glb"); }, {"/no/such/scene.glb", "No such file", "check the path"});
    expectInputError([] { loadGltf("/"); }, {"Is a directory"});
}

TEST(GltfErrors, WhatIsNoGltfIsSaidToBeNone)
{
    expectBrokenFile("empty.gltf", "", {"empty.gltf", "not a glTF file", "check that it is glTF 2.0"});
    expectBrokenFile("text.gltf", "Hello,\nworld", {"not a glTF file", "line 1"});
    expectBrokenFile("cut.gltf", "{\"asset\": {\n\"version\": \"2.", {"not a glTF file", "line 2"});
    expectBrokenFile("array.gltf", "[]", {"asset.version is missing"});
    expectBrokenFile("object.gltf", "{}", {"asset.version is missing"});
    expectBrokenFile("scene.json", R"({"objects": []})", {"asset.version is missing", "name it .scene.json"});
    expectBrokenFile("utf8.gltf", "{\"asset\": {\"version\": \"\xff\"}}", {"not a glTF file", "\\xff"});
}

TEST(GltfErrors, OtherVersionsAreRefused)
{
    expectBrokenFile("one.gltf", R"({"asset": {"version": "1.0"}})", {"glTF version 1.0", "export it as glTF 2.0"});
    expectBrokenFile("new.gltf", R"({"asset": {"version": "2.1", "minVersion": "2.1"}})", {"glTF version 2.1"});
    GltfBuilder later = triangleDocument();
    later.document["asset"]["version"] = "2.1";
    EXPECT_EQ(later.load().triangleCount(), 1U);
}

TEST(GltfErrors, DeepJsonIsRefused)
{
    const std::string deep(100000, '[');
    expectBrokenFile("deep.gltf", R"({"asset": {"version": "2.0"}, "extras": )" + deep, {"nested more than"});
    GltfBuilder text = triangleDocument();
    text.document["extras"] = "\"[" + deep;
    EXPECT_EQ(text.load().triangleCount(), 1U);
}

TEST(GltfErrors, GlbThatWasCutShortIsRefusedWhereverItEnds)
{
    const TempDir dir;
    const std::vector<std::uint8_t> whole = triangleDocument().glb();
    for (std::size_t size = 4; size < whole.size(); size += 7)
    {
        const auto path = dir.write("cut.glb", std::span(whole).first(size));
        expectInputError([&] { loadGltf(path); }, {"cut.glb", "cut short, copy or download it again"});
    }
}

TEST(GltfErrors, GlbWithWrongChunksIsRefused)
{
    const auto change = [](std::size_t offset, std::uint8_t value)
    {
        std::vector<std::uint8_t> file = triangleDocument().glb();
        file[offset] = value;
        return std::string(file.begin(), file.end());
    };
    expectBrokenFile("version.glb", change(4, 1), {"binary glTF version 1"});
    expectBrokenFile("length.glb", change(11, 1), {"the header announces", "cut short"});
    expectBrokenFile("chunk.glb", change(14, 1), {"chunk 0 announces", "cut short"});
    expectBrokenFile("type.glb", change(16, 'X'), {"the first chunk is not JSON"});
}

TEST(GltfErrors, RequiredExtensionsThatAreUnknownAreNamed)
{
    expectBroken(set("/extensionsRequired", {"KHR_unheard_of"}),
                 {"KHR_unheard_of", "not supported", "export it without"});
    expectBroken(set("/extensionsRequired", {"NEW\nLINE"}), {"NEW LINE"});
}

TEST(GltfErrors, WrongTypesAndIndicesAreNamedByTheirPlace)
{
    expectBroken(set("/nodes/0/mesh", 7), {"nodes[0].mesh is 7, but the file has 1 meshes", kHint});
    expectBroken(set("/nodes/0/mesh", "a"), {"nodes[0].mesh is not a whole number"});
    expectBroken(set("/nodes/0/mesh", -1), {"nodes[0].mesh is not a whole number"});
    expectBroken(set("/nodes/0/mesh", 1ULL << 32U), {"nodes[0].mesh is 4294967296"});
    expectBroken(set("/nodes/0/matrix", {1, 2}), {"array of 16 numbers"});
    expectBroken(set("/nodes", 3), {"nodes is not an array"});
    expectBroken(set("/nodes/0", 3), {"nodes[0] is not an object"});
    expectBroken(set("/scenes", {{{"nodes", {1}}}}), {"scenes[0].nodes[0] is 1"});
    expectBroken(set("/scene", 0), {"scene is 0, but the file has 0 scenes"});
    expectBroken(without("/accessors/0/count"), {"accessors[0] has no count"});
    expectBroken(without("/meshes/0/primitives/0/attributes"), {"primitives[0] has no attributes"});
    expectBroken(set("/meshes/0/primitives/0/attributes/POSITION", 5), {"attributes.POSITION is 5"});
    expectBroken(set("/meshes/0/primitives/0/material", 0), {"0 materials"});
    expectBroken(set("/meshes/0/primitives/0/mode", 9), {"mode is 9"});
}

TEST(GltfErrors, TransformsThatAreNotAffineOrTooLargeAreRefused)
{
    expectBroken(set("/nodes/0/matrix", {1, 0, 0, 1, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}),
                 {"last row of nodes[0].matrix"});
    expectBroken(set("/nodes/0/scale", {1e300, 1, 1}), {"overflows single precision"});
}

TEST(GltfErrors, AccessorsMustLieInsideTheirViewsAndBuffers)
{
    constexpr std::uint64_t kHuge = ~0ULL;
    expectBroken(set("/accessors/0/count", 4),
                 {"accessors[0] (POSITION of meshes[0].primitives[0]) takes 4 elements", "has 36 bytes", kHint});
    expectBroken(set("/accessors/0/count", kHuge), {"elements of 12 bytes"});
    expectBroken(set("/accessors/0/byteOffset", 1), {"at 1 of bufferViews[0]"});
    expectBroken(set("/accessors/0/byteOffset", kHuge), {"of bufferViews[0]"});
    expectBroken(set("/bufferViews/0/byteStride", 252), {"252 apart"});
    expectBroken(set("/bufferViews/0/byteStride", 8), {"elements of 12 bytes, 8 apart"});
    expectBroken(set("/bufferViews/0/byteStride", 7), {"byteStride", kHint});
    expectBroken(set("/bufferViews/0/byteLength", 37), {"bufferViews[0] takes 37 bytes", "has 36"});
    expectBroken(set("/bufferViews/0/byteOffset", kHuge), {"bufferViews[0] takes 36 bytes"});
    expectBroken(set("/accessors/0/type", "MAT3"), {"element type that nothing has"});
    expectBroken(set("/accessors/0/type", "VEC9"), {"VEC9"});
    expectBroken(set("/accessors/0/componentType", 5124), {"component type 5124"});
    expectBroken(set("/accessors/0/componentType", kU8), {"does not allow there"});
}

TEST(GltfErrors, AttributesMustFitTheVertices)
{
    const std::string attributes = "/meshes/0/primitives/0/attributes/";
    const std::vector<std::uint8_t> bytes = {1, 2, 3, 4, 5, 6};
    const std::vector<float> numbers = {1, 2, 3, 4, 5, 6};
    const auto one = [](GltfBuilder& b) { return b.addPositions(std::vector<float>{0, 0, 1}); };
    expectBroken(setTo(attributes + "NORMAL", one), {"NORMAL of meshes[0].primitives[0]", "1 elements for 3 vertices"});
    expectBroken(setTo(attributes + "TEXCOORD_0", [&](auto& b) { return b.addAccessor("VEC2", kU8, 3, bytes); }),
                 {"TEXCOORD_0", "not normalized"});
    expectBroken(setTo(attributes + "COLOR_0", [&](auto& b) { return b.addAccessor("VEC2", kF32, 3, numbers); }),
                 {"COLOR_0", "does not allow there"});
}

TEST(GltfErrors, IndicesMustNameVertices)
{
    const std::vector<std::uint8_t> bytes = {0, 1, 3};
    const std::vector<float> numbers = {0, 1, 2};
    const char* const indices = "/meshes/0/primitives/0/indices";
    expectBroken(
        setTo(indices, [&](auto& b) { return b.addAccessor("SCALAR", kU8, 3, bytes); }),
        {"element 2 of accessors[1] (indices of meshes[0].primitives[0]) is vertex 3, but there are 3", kHint});
    expectBroken(setTo(indices, [&](auto& b) { return b.addAccessor("SCALAR", kF32, 3, numbers); }),
                 {"does not allow there"});
}

TEST(GltfErrors, BuffersMustBeThereAndLongEnough)
{
    const auto with = [](const char* uri) { return set("/buffers", {{{"byteLength", 36}, {"uri", uri}}}); };
    expectBroken(with("missing.bin"), {"buffers[0].uri is missing.bin", "no such file"});
    expectBroken(set("/buffers", {{{"byteLength", 41}}}), {"buffers[0] needs 41 bytes", "has 36"});
    expectBroken(with("data:;base64,A*"), {"buffers[0].uri is not a valid data URI"});
    expectBroken(with("data:;base64,AAAA"), {"buffers[0] needs 36 bytes", "has 3"});
    expectBroken(with("https://example.com/a.bin"), {"https://example.com/a.bin", "download it"});
    expectBrokenFile("none.gltf", R"({"asset": {"version": "2.0"}, "buffers": [{"byteLength": 1}]})",
                     {"buffers[0] has neither a URI nor a binary chunk"});
}

TEST(GltfErrors, MaterialsMustBePossible)
{
    const auto with = [](const json& material)
    {
        return [material](GltfBuilder& b)
        {
            b.document["meshes"][0]["primitives"][0]["material"] = 0;
            b.add("materials", material);
        };
    };
    expectBroken(with({{"alphaMode", "GLASS"}}), {"materials[0].alphaMode is \"GLASS\""});
    expectBroken(with({{"emissiveFactor", {-1, 0, 0}}}), {"materials[0].emissiveFactor is -1"});
    expectBroken(with({{"alphaCutoff", -0.5}}), {"materials[0].alphaCutoff is -0.5"});
    expectBroken(with({{"pbrMetallicRoughness", {{"baseColorFactor", {1, 1, 1}}}}}), {"array of 4 numbers"});
}

TEST(GltfErrors, LongMessagesAreShortened)
{
    const std::string name(5000, 'x');
    GltfBuilder builder = triangleDocument();
    builder.document["extensionsRequired"] = {name};
    const std::string message = messageOf([&] { static_cast<void>(builder.load()); }, ErrorCode::Input);
    EXPECT_LT(message.size(), 700U);
    expectParts(message, {"export it without"});
}

TEST(GltfErrors, DamagedBytesGiveASceneOrAnInputError)
{
    GltfBuilder builder = triangleDocument();
    const std::vector<std::uint8_t> png = encodePng(4, 4, std::vector<std::uint8_t>(64, 9));
    textured(builder, {{"bufferView", builder.addView(png.data(), png.size())}});
    json& primitive = builder.document["meshes"][0]["primitives"][0];
    primitive["indices"] = builder.addAccessor<std::uint16_t>("SCALAR", kU16, 3, {0, 1, 2});
    primitive["attributes"]["TEXCOORD_0"] = builder.addAccessor<float>("VEC2", kF32, 3, {0, 0, 1, 0, 0, 1});
    const std::vector<std::uint8_t> whole = builder.glb();
    const TempDir dir;
    std::mt19937 random(7); // NOLINT: the same damage on every run
    for (int i = 0; i < 1000; ++i)
    {
        std::vector<std::uint8_t> damaged = whole;
        for (std::size_t k = 0; k <= random() % 3; ++k)
        {
            // Mostly digits and brackets, which often keep the JSON readable.
            constexpr std::string_view kLikely = "0123456789-[]{}\",:e";
            const bool likely = random() % 4 != 0;
            damaged[random() % damaged.size()] =
                static_cast<std::uint8_t>(likely ? kLikely[random() % kLikely.size()] : random());
        }
        expectSceneOrInputError(dir.write("damaged.glb", damaged));
    }
}

} // namespace

} // namespace zvo::test
