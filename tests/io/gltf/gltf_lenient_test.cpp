// SPDX-License-Identifier: MIT
// Files that break the rules where the scene is clear nevertheless: they load with one warning, and are refused where
// nothing may be left out.
#include "gltf_builder.h"
#include "io/gltf/gltf_loader.h"
#include "io/scene/load_scene.h"

#include <gtest/gtest.h>

namespace zvo::test
{

namespace
{

/// Loads builder's file, and expects that it gives one warning of one line that has all the parts in it, and an error
/// with the same line where nothing may be left out.
Scene loadWithOneWarning(const GltfBuilder& builder, std::initializer_list<std::string> parts)
{
    const TempDir dir;
    const std::filesystem::path path = dir.write("scene.glb", builder.glb());
    Scene scene = loadScene(std::span(&path, 1));
    EXPECT_EQ(sceneFault(scene), "");
    EXPECT_EQ(scene.warnings.size(), 1U) << *parts.begin();
    for (const std::string& warning : scene.warnings)
    {
        EXPECT_EQ(warning.find_first_of("\n\r\t"), std::string::npos) << warning;
        for (const std::string& part : parts)
        {
            EXPECT_TRUE(contains(warning, part)) << '"' << part << "\" is not in: " << warning;
        }
    }
    expectInputError([&] { return loadScene(std::span(&path, 1), {.strict = true}); }, parts);
    return scene;
}

TEST(GltfLenient, AccessorsWithoutBufferViewAreZeros)
{
    GltfBuilder builder = triangleDocument();
    const std::size_t accessor = builder.add("accessors", {{"componentType", kF32}, {"count", 3}, {"type", "VEC3"}});
    builder.document["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] = accessor;
    const Scene scene = loadWithOneWarning(
        builder, {"accessors without a buffer view have only zeros (accessors[1] (NORMAL of meshes[0].primitives[0])"});
    EXPECT_EQ(scene.primitives.at(0).normals, std::vector<glm::vec3>(3));
    builder.document["meshes"][0]["primitives"][0]["attributes"] = {{"POSITION", accessor}};
    const Scene flat = loadWithOneWarning(builder, {"accessors[1] (POSITION of meshes[0].primitives[0])"});
    EXPECT_EQ(flat.primitives.at(0).positions, std::vector<glm::vec3>(3));
}

TEST(GltfLenient, AccessorsWithoutBufferViewAreZerosInRigsToo)
{
    GltfBuilder builder = triangleDocument();
    const std::size_t times = builder.addAccessor<float>("SCALAR", kF32, 2, {0, 1});
    const std::size_t values = builder.add("accessors", {{"componentType", kF32}, {"count", 2}, {"type", "VEC3"}});
    builder.add("animations", {{"samplers", {{{"input", times}, {"output", values}}}},
                               {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "translation"}}}}}}});
    const Scene moved =
        loadWithOneWarning(builder, {"accessors[2] (output of animations[0].channels[0])", "have only zeros"});
    ASSERT_EQ(moved.animations.size(), 1U);
    EXPECT_EQ(moved.animations[0].channels.at(0).values, std::vector<float>(6));

    builder.document["accessors"][times] = {{"componentType", kF32}, {"count", 2}, {"type", "SCALAR"}};
    const Scene still = loadWithOneWarning(builder, {"have only zeros", "and 1 more"});
    EXPECT_EQ(still.animations.at(0).channels.at(0).times, std::vector<float>(2));
}

TEST(GltfLenient, FaultsInWhatNothingNeedsCostNothing)
{
    const char* const kind = "parts with faults left out, as nothing needs them";
    const std::vector<std::pair<json, std::string>> accessors = {
        {{{"count", 3}, {"type", "VEC3"}}, "accessors[1] has no componentType"},
        {{{"componentType", kF32}, {"count", -3}, {"type", "VEC3"}}, "accessors[1].count is not a whole number"},
        {{{"componentType", kF32}, {"count", 3}, {"type", "VEC9"}}, "accessors[1].type is \"VEC9\""},
        {{{"componentType", 1}, {"count", 3}, {"type", "VEC3"}}, "accessors[1].componentType is not a component type"},
        {{{"componentType", kF32}, {"count", 3}, {"type", "VEC3"}, {"bufferView", 7}}, "bufferView is 7"},
        {{{"componentType", kF32}, {"count", 3}, {"type", "VEC3"}, {"sparse", {{"count", 1}}}}, "has no indices"},
        {5, "accessors[1] is not an object"}};
    for (const auto& [accessor, fault] : accessors)
    {
        GltfBuilder builder = triangleDocument();
        builder.add("accessors", accessor);
        EXPECT_EQ(loadWithOneWarning(builder, {kind, fault}).triangleCount(), 1U);
        builder.document["meshes"][0]["primitives"][0]["attributes"]["TANGENT"] = 1; // is not read
        EXPECT_EQ(loadWithOneWarning(builder, {kind, fault}).triangleCount(), 1U);
        builder.document["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] = 1;
        expectInputError(builder, {"scene.glb: accessors[1]", fault});
    }
    // Data that is outside of its buffer, or does not unpack, is not even looked at.
    GltfBuilder builder = triangleDocument();
    builder.add("bufferViews", {{"buffer", 0}, {"byteOffset", 1000}, {"byteLength", 36}});
    builder.add("accessors", {{"componentType", kF32}, {"count", 3}, {"type", "VEC3"}, {"bufferView", 1}});
    const json meshopt = {{"buffer", 0}, {"byteLength", 4}, {"byteStride", 4}, {"count", 9}, {"mode", "ATTRIBUTES"}};
    builder.add("bufferViews",
                {{"buffer", 0}, {"byteLength", 36}, {"extensions", {{"EXT_meshopt_compression", meshopt}}}});
    EXPECT_TRUE(builder.load().warnings.empty());
    builder.document["accessors"][0]["bufferView"] = 2;
    expectInputError(builder, {"meshopt_compression of bufferViews[2]", "does not decode"});
}

TEST(GltfLenient, FaultsInOtherPartsCostNothingEither)
{
    const char* const kind = "parts with faults left out, as nothing needs them";
    const auto expectHarmless = [&](const char* array, const json& item, const std::string& fault)
    {
        GltfBuilder builder = triangleDocument();
        builder.add(array, item);
        EXPECT_EQ(loadWithOneWarning(builder, {kind, fault}).triangleCount(), 1U);
    };
    expectHarmless("bufferViews", {{"buffer", 0}, {"byteLength", 36}, {"byteStride", 5}},
                   "bufferViews[1].byteStride is not a multiple of 4 up to 252");
    expectHarmless("bufferViews", {{"buffer", 3}, {"byteLength", 36}}, "bufferViews[1].buffer is 3");
    expectHarmless("images", {{"uri", 3}}, "images[0].uri is not a string");
    expectHarmless("samplers", {{"wrapS", "repeat"}}, "samplers[0].wrapS is not");
    expectHarmless("textures", {{"extensions", {{"EXT_texture_webp", {{"source", 3}}}}}},
                   "EXT_texture_webp.source is 3");
    expectHarmless("materials", {{"extensions", {{"KHR_materials_pbrSpecularGlossiness", 4}}}},
                   "KHR_materials_pbrSpecularGlossiness is not an object");
    expectHarmless("cameras", {{"type", "fisheye"}}, "cameras[0] has neither");
    expectHarmless("cameras", {{"type", "perspective"}}, "cameras[0] has neither");
    expectHarmless("meshes", {{"primitives", {{{"attributes", 5}}}}}, "meshes[1].primitives[0].attributes is not");
    expectHarmless("skins", {{"joints", {9}}}, "skins[0].joints[0] is 9");
}

TEST(GltfLenient, ExtensionsThatAreNotReadMayHoldAnything)
{
    GltfBuilder builder = triangleDocument();
    const json odd = {{"KHR_lights_punctual", {{"light", "sun"}}}, {"EXT_of_nobody", json::array({1, "a"})}};
    builder.document["extensions"] = 5;
    builder.document["nodes"][0]["extensions"] = odd;
    builder.document["meshes"][0]["primitives"][0]["extensions"] = odd;
    builder.document["accessors"][0]["extensions"] = 7;
    builder.document["accessors"][0]["min"] = "none";
    builder.document["meshes"][0]["primitives"][0]["material"] = 0;
    builder.add("materials",
                {{"normalTexture", 3}, {"occlusionTexture", "yes"}, {"extensions", {{"KHR_materials_sheen", 1}}}});
    const Scene scene = builder.load();
    EXPECT_EQ(scene.triangleCount(), 1U);
    EXPECT_TRUE(scene.warnings.empty()) << scene.warnings[0];
}

TEST(GltfLenient, EmissionIsReadWhereThereIsSome)
{
    GltfBuilder builder = triangleDocument();
    builder.document["meshes"][0]["primitives"][0]["material"] = 0;
    json material = {{"emissiveTexture", {{"index", 4}}},
                     {"extensions", {{"KHR_materials_emissive_strength", {{"emissiveStrength", "much"}}}}}};
    builder.add("materials", material);
    static_cast<void>(loadWithOneWarning(builder, {"materials[0].emissiveTexture.index is 4", "and 1 more"}));
    builder.document["materials"][0]["emissiveFactor"] = {0, 1, 0};
    expectInputError(builder, {"materials[0].emissiveTexture.index is 4"});
}

TEST(GltfLenient, WholeNumbersMayHaveADecimalPoint)
{
    GltfBuilder builder = triangleDocument();
    builder.document["accessors"][0]["count"] = 3.0;
    builder.document["accessors"][0]["componentType"] = 5126.0;
    builder.document["nodes"][0]["mesh"] = 0.0;
    builder.document["bufferViews"][0]["byteLength"] = 36.0;
    builder.document["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = 0.0;
    const Scene scene =
        loadWithOneWarning(builder, {"numbers with a decimal point taken as whole numbers (nodes[0].mesh and 4 more)"});
    EXPECT_EQ(scene.triangleCount(), 1U);
    EXPECT_EQ(scene.primitives.at(0).positions, triangleDocument().load().primitives.at(0).positions);
    for (const json& value : {json(0.5), json(-1.0), json(1e300), json(1.0)})
    {
        builder.document["nodes"][0]["mesh"] = value;
        expectInputError(builder, {"nodes[0].mesh is "});
    }
}

TEST(GltfLenient, NodesAreTakenWhereTheyAreMetFirst)
{
    // Depth first from the scene's roots: 3, then its child 1, then 0 below that; 2 comes later.
    GltfBuilder builder = triangleDocument();
    builder.add("nodes", {{"translation", {1, 0, 0}}, {"children", {0}}});
    builder.add("nodes", {{"translation", {2, 0, 0}}, {"children", {0, 1}}});
    builder.add("nodes", {{"translation", {4, 0, 0}}, {"children", {1, 0}}});
    builder.document["scenes"] = {{{"nodes", {3, 2}}}};
    const Scene scene = loadWithOneWarning(
        builder, {"nodes that are met again", "stay where they were met first (nodes[0] and 2 more)"});
    ASSERT_EQ(scene.instances.size(), 1U);
    EXPECT_EQ(scene.instances[0].transform[3], glm::vec4(5, 0, 0, 1));
    ASSERT_EQ(scene.nodes.size(), 4U);
    builder.document["scenes"] = {{{"nodes", {0, 0}}}};
    EXPECT_EQ(loadWithOneWarning(builder, {"(nodes[0])"}).instances.at(0).transform[3], glm::vec4(0, 0, 0, 1));
}

TEST(GltfLenient, CyclesOfNodesEnd)
{
    GltfBuilder builder = triangleDocument();
    builder.document["nodes"][0]["children"] = {0};
    EXPECT_EQ(loadWithOneWarning(builder, {"in a cycle", "(nodes[0])"}).triangleCount(), 1U);
    builder = triangleDocument();
    builder.add("nodes", {{"translation", {1, 0, 0}}, {"children", {2}}});
    builder.add("nodes", {{"translation", {2, 0, 0}}, {"children", {1}}});
    const Scene scene = loadWithOneWarning(builder, {"in a cycle", "(nodes[1])"});
    EXPECT_EQ(scene.nodes.size(), 3U); // without scenes a cycle without a root is in the scene, too
    builder.document["nodes"][1]["children"] = {2, 0};
    builder.document["scenes"] = {{{"nodes", {2}}}};
    EXPECT_EQ(loadWithOneWarning(builder, {"(nodes[2])"}).instances.at(0).transform[3], glm::vec4(3, 0, 0, 1));
}

} // namespace

} // namespace zvo::test
