// SPDX-License-Identifier: MIT
// How nodes, skins, morph targets and animations are loaded. gltf_rig_errors_test.cpp has mistakes in them.
#include "io/gltf/gltf_loader.h"

#include "gltf_builder.h"
#include "io/scene/load_scene.h"
#include "rig_documents.h"

#include <gtest/gtest.h>
#include <numeric>
#include <utility>

namespace zvo::test
{

namespace
{

using Joints = std::vector<glm::u16vec4>;
using Weights = std::vector<glm::vec4>;
using Vectors = std::vector<glm::vec3>;

/// Loads a triangle whose vertices have these joints and weights.
template <typename Joint, typename Weight>
Primitive loadBound(int joint_type, const std::vector<Joint>& joints, int weight_type,
                    const std::vector<Weight>& weights, bool normalized = true)
{
    GltfBuilder builder;
    json primitive = trianglePrimitive(builder);
    primitive["attributes"]["JOINTS_0"] = builder.addAccessor("VEC4", joint_type, 3, joints);
    primitive["attributes"]["WEIGHTS_0"] =
        builder.addAccessor("VEC4", weight_type, 3, weights, normalized && weight_type != kF32);
    builder.addMeshNode(primitive);
    const Scene scene = builder.load();
    EXPECT_EQ(sceneFault(scene), "");
    return scene.primitives.at(0);
}

/// Loads a channel with these values, for node 0, which has two morph targets.
template <typename T>
Channel loadChannel(const std::string& path, const std::string& interpolation, const std::vector<float>& times,
                    const std::string& type, int component_type, std::size_t count, const std::vector<T>& values)
{
    GltfBuilder builder = morphDocument({});
    addAnimation(builder, 0, path, interpolation, times, type, component_type, count, values);
    const Scene scene = builder.load();
    EXPECT_EQ(sceneFault(scene), "");
    EXPECT_TRUE(scene.warnings.empty()) << scene.warnings.front();
    return scene.animations.at(0).channels.at(0);
}

TEST(GltfRig, NodesStandBehindTheirParents)
{
    GltfBuilder builder = triangleDocument(); // node 0 has the mesh
    builder.document["nodes"][0]["name"] = "leaf";
    builder.document["nodes"][0]["rotation"] = {0, 0, 0.6, 0.8};
    builder.add("nodes", {{"name", "middle"}, {"children", {0}}, {"scale", {1, 2, 3}}});
    builder.add("nodes",
                {{"name", "root"}, {"children", {1}}, {"matrix", {0, 2, 0, 0, -3, 0, 0, 0, 0, 0, 4, 0, 1, 2, 3, 1}}});
    builder.add("nodes", {{"name", "other"}, {"translation", {7, 8, 9}}});
    const Scene scene = builder.load();
    EXPECT_EQ(sceneFault(scene), "");
    ASSERT_EQ(scene.nodes.size(), 4U);
    const std::vector<std::string> names = {"root", "middle", "leaf", "other"};
    const std::vector<std::uint32_t> parents = {kNone, 0, 1, kNone};
    for (std::size_t i = 0; i < 4; ++i)
    {
        EXPECT_EQ(scene.nodes[i].name, names[i]);
        EXPECT_EQ(scene.nodes[i].parent, parents[i]);
        EXPECT_EQ(scene.nodes[i].matrix.has_value(), i == 0);
        EXPECT_TRUE(scene.nodes[i].morph_weights.empty());
    }
    EXPECT_EQ(scene.nodes[0].matrix->operator[](1), glm::vec4(-3, 0, 0, 0));
    EXPECT_EQ(scene.nodes[1].scale, glm::vec3(1, 2, 3));
    EXPECT_EQ(scene.nodes[1].translation, glm::vec3(0));
    EXPECT_EQ(scene.nodes[2].rotation, glm::quat(0.8F, 0, 0, 0.6F));
    EXPECT_EQ(scene.nodes[2].scale, glm::vec3(1));
    EXPECT_EQ(scene.nodes[3].translation, glm::vec3(7, 8, 9));
    EXPECT_EQ(scene.instances.at(0).node, 2U);
    EXPECT_EQ(scene.instances.at(0).skin, kNone);
}

TEST(GltfRig, OnlyNodesOfTheSceneAreThere)
{
    GltfBuilder builder = triangleDocument();
    builder.add("nodes", {{"name", "shown"}, {"mesh", 0}});
    builder.document["scenes"] = {{{"nodes", {1}}}};
    addAnimation<float>(builder, 0, "scale", "STEP", {1}, "VEC3", kF32, 1, {1, 2, 3});
    addAnimation<float>(builder, 1, "scale", "STEP", {2}, "VEC3", kF32, 1, {4, 5, 6});
    const Scene scene = builder.load();
    ASSERT_EQ(scene.nodes.size(), 1U);
    EXPECT_EQ(scene.nodes[0].name, "shown");
    ASSERT_EQ(scene.animations.size(), 1U);
    EXPECT_EQ(scene.animations[0].channels.at(0).values, (std::vector<float>{4, 5, 6}));
    EXPECT_TRUE(scene.warnings.empty());
}

TEST(GltfRig, JointsHaveEightOrSixteenBits)
{
    const std::vector<float> weights = {1, 0, 0, 0, 0.5F, 0.5F, 0, 0, 0.25F, 0.25F, 0.25F, 0.25F};
    const Primitive narrow = loadBound<std::uint8_t, float>(kU8, {3, 3, 3, 3, 1, 2, 1, 1, 1, 2, 3, 255}, kF32, weights);
    EXPECT_EQ(narrow.joints, (Joints{{3, 3, 3, 3}, {1, 2, 1, 1}, {1, 2, 3, 255}}));
    const Primitive wide =
        loadBound<std::uint16_t, float>(kU16, {300, 300, 300, 300, 1, 2, 1, 1, 1, 2, 3, 65535}, kF32, weights);
    EXPECT_EQ(wide.joints, (Joints{{300, 300, 300, 300}, {1, 2, 1, 1}, {1, 2, 3, 65535}}));
    EXPECT_EQ(wide.weights, (Weights{{1, 0, 0, 0}, {0.5F, 0.5F, 0, 0}, glm::vec4(0.25F)}));
}

TEST(GltfRig, WeightsAreFloatsOrNormalizedAndTheirSumIsOne)
{
    const std::vector<std::uint8_t> joints(12, 0);
    const Weights wanted = {{1, 0, 0, 0}, {0.2F, 0.8F, 0, 0}, {0.25F, 0.25F, 0.25F, 0.25F}};
    const auto expectWanted = [&](const Primitive& primitive)
    {
        ASSERT_EQ(primitive.weights.size(), 3U);
        for (int i = 0; i < 12; ++i)
        {
            EXPECT_NEAR(primitive.weights[i / 4][i % 4], wanted[i / 4][i % 4], 1e-7F) << i;
        }
    };
    for (const bool normalized : {true, false}) // they count as normalized in both cases
    {
        expectWanted(loadBound<std::uint8_t, std::uint8_t>(kU8, joints, kU8, {255, 0, 0, 0, 51, 204, 0, 0, 9, 9, 9, 9},
                                                           normalized));
        expectWanted(loadBound<std::uint8_t, std::uint16_t>(
            kU8, joints, kU16, {65535, 0, 0, 0, 13107, 52428, 0, 0, 999, 999, 999, 999}, normalized));
    }
    expectWanted(loadBound<std::uint8_t, float>(kU8, joints, kF32,
                                                {1e-3F, 0, 0, 0, 0.3F, 1.2F, 0, 0, 1e30F, 1e30F, 1e30F, 1e30F}));
}

TEST(GltfRig, JointsOfWeightZeroRepeatTheHeaviest)
{
    const Primitive primitive = loadBound<std::uint8_t, float>(
        kU8, {1, 2, 3, 4, 1, 2, 3, 4, 1, 2, 3, 4}, kF32, {0, 0, 1, 0, 0, 0.25F, 0, 0.75F, 0.3F, 0.4F, 0.2F, 0.1F});
    EXPECT_EQ(primitive.joints, (Joints{{3, 3, 3, 3}, {4, 2, 4, 4}, {1, 2, 3, 4}}));
}

TEST(GltfRig, SkinsHaveTheirJointsAndInverseBindMatrices)
{
    const Scene scene = armDocument().load();
    EXPECT_EQ(sceneFault(scene), "");
    EXPECT_TRUE(scene.warnings.empty());
    ASSERT_EQ(scene.skins.size(), 1U);
    EXPECT_EQ(scene.skins[0].joints, (std::vector<std::uint32_t>{1, 2}));
    EXPECT_EQ(scene.skins[0].inverse_bind.at(0)[3], glm::vec4(0, 0, -5, 1));
    EXPECT_EQ(scene.skins[0].inverse_bind.at(1)[3], glm::vec4(0, -1, -5, 1));
    ASSERT_EQ(scene.instances.size(), 1U);
    EXPECT_EQ(scene.instances[0].skin, 0U);
    EXPECT_EQ(scene.instances[0].transform[3], glm::vec4(100, 0, 0, 1)); // without a pose it is as modelled
}

TEST(GltfRig, WithoutInverseBindMatricesTheyAreIdentities)
{
    GltfBuilder builder = armDocument();
    builder.document["skins"][0].erase("inverseBindMatrices");
    EXPECT_EQ(builder.load().skins.at(0).inverse_bind, std::vector<glm::mat4>(2, glm::mat4(1.0F)));
}

TEST(GltfRig, InverseBindMatricesComeByColumnsAndMayBeMoreThanJoints)
{
    GltfBuilder builder = armDocument();
    const std::vector<float> numbers = {0, 2, 0, 0, -3, 0, 0, 0, 0, 0, 4, 0, 5, 6, 7, 1, // a turn, a scale, a shift
                                        1, 0, 0, 0, 0,  1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1.0000001F,
                                        9, 9, 9, 9, 9,  9, 9, 9, 9, 9, 9, 9, 9, 9, 9, 9};
    builder.document["skins"][0]["inverseBindMatrices"] = builder.addAccessor("MAT4", kF32, 3, numbers);
    const Skin skin = builder.load().skins.at(0);
    ASSERT_EQ(skin.inverse_bind.size(), 2U);
    EXPECT_EQ(transformPoint(skin.inverse_bind[0], {1, 10, 100}), glm::vec3(-25, 8, 407));
    EXPECT_EQ(skin.inverse_bind[1], glm::mat4(1.0F));
}

TEST(GltfRig, SkinIsLoadedOnceForAllItsMeshes)
{
    GltfBuilder builder = armDocument();
    builder.add("nodes", {{"mesh", 0}, {"skin", 0}});
    builder.add("nodes", {{"mesh", 0}});
    const Scene scene = builder.load();
    EXPECT_EQ(scene.skins.size(), 1U);
    ASSERT_EQ(scene.instances.size(), 3U);
    EXPECT_EQ(scene.instances[1].skin, 0U);
    EXPECT_EQ(scene.instances[2].skin, kNone);
}

TEST(GltfRig, MorphTargetsHavePositionsAndNormals)
{
    const Scene scene = morphDocument({}).load();
    EXPECT_EQ(sceneFault(scene), "");
    const std::vector<MorphTarget>& targets = scene.primitives.at(0).morph_targets;
    ASSERT_EQ(targets.size(), 2U);
    EXPECT_EQ(targets[0].positions, (Vectors(3, {0, 0, 1})));
    EXPECT_EQ(targets[0].normals, (Vectors(3, {1, 0, 0})));
    EXPECT_EQ(targets[1].positions, (Vectors{{0, 0, 0}, {2, 0, 0}, {0, 0, 0}}));
    EXPECT_TRUE(targets[1].normals.empty());
    EXPECT_EQ(scene.primitives[0].positions, (Vectors{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
    EXPECT_TRUE(scene.warnings.empty());
}

TEST(GltfRig, NormalsOfMorphTargetsNeedNormalsToChange)
{
    GltfBuilder builder = morphDocument({});
    builder.document["meshes"][0]["primitives"][0]["attributes"].erase("NORMAL");
    const Scene scene = builder.load();
    EXPECT_EQ(scene.primitives.at(0).morph_targets.at(0).positions.size(), 3U);
    EXPECT_TRUE(scene.primitives[0].morph_targets[0].normals.empty());
}

TEST(GltfRig, MorphTargetsMayBeSparse)
{
    GltfBuilder builder = morphDocument({});
    const std::uint16_t index = 2;
    const glm::vec3 change(1, 2, 3);
    const std::size_t target = builder.add(
        "accessors", {{"componentType", kF32},
                      {"count", 3},
                      {"type", "VEC3"},
                      {"sparse",
                       {{"count", 1},
                        {"indices", {{"bufferView", builder.addView(&index, sizeof(index))}, {"componentType", kU16}}},
                        {"values", {{"bufferView", builder.addView(&change, sizeof(change))}}}}}});
    builder.document["meshes"][0]["primitives"][0]["targets"][1]["POSITION"] = target;
    EXPECT_EQ(builder.load().primitives.at(0).morph_targets.at(1).positions, (Vectors{{0, 0, 0}, {0, 0, 0}, change}));
}

TEST(GltfRig, MorphTargetsMayBeQuantized)
{
    GltfBuilder builder = morphDocument({});
    builder.document["extensionsRequired"] = {"KHR_mesh_quantization"};
    json& targets = builder.document["meshes"][0]["primitives"][0]["targets"];
    const std::vector<std::int16_t> words = {-32768, 1, 2, 9, 32767, 0, 0, 9, 3, 4, 5, 9};
    const std::vector<std::int8_t> bytes = {-128, 127, 0, 9, 0, 0, 0, 9, 0, 0, 127, 9};
    targets[0] = {{"POSITION", builder.addAccessor("VEC3", kI16, 3, words, false, 8)},
                  {"NORMAL", builder.addAccessor("VEC3", kI8, 3, bytes, true, 4)}};
    targets[1] = {{"POSITION", builder.addAccessor("VEC3", kI16, 3, words, true, 8)}};
    const Scene scene = builder.load();
    const std::vector<MorphTarget>& loaded = scene.primitives.at(0).morph_targets;
    EXPECT_EQ(loaded.at(0).positions, (Vectors{{-32768, 1, 2}, {32767, 0, 0}, {3, 4, 5}}));
    EXPECT_EQ(loaded.at(0).normals, (Vectors{{-1, 1, 0}, {0, 0, 0}, {0, 0, 1}}));
    EXPECT_EQ(loaded.at(1).positions.at(0), glm::vec3(-1, 1.0F / 32767.0F, 2.0F / 32767.0F));
}

TEST(GltfRig, WeightsAtRestAreTheNodesOrTheMeshesOrZero)
{
    EXPECT_EQ(morphDocument({}).load().nodes.at(0).morph_weights, (std::vector<float>{0, 0}));
    GltfBuilder builder = morphDocument({0.5F, 2});
    builder.add("nodes", {{"mesh", 0}, {"weights", {0, -1}}});
    const Scene scene = builder.load();
    EXPECT_EQ(scene.nodes.at(0).morph_weights, (std::vector<float>{0.5F, 2}));
    EXPECT_EQ(scene.nodes.at(1).morph_weights, (std::vector<float>{0, -1}));
    EXPECT_TRUE(scene.warnings.empty());
}

TEST(GltfRig, ChannelsOfEveryPathAreLoaded)
{
    const std::vector<float> three = {1, 2, 3, 4, 5, 6};
    for (const auto& [name, path] :
         {std::pair("translation", ChannelPath::Translation), std::pair("scale", ChannelPath::Scale)})
    {
        const Channel channel = loadChannel<float>(name, "LINEAR", {0.5F, 2}, "VEC3", kF32, 2, three);
        EXPECT_EQ(channel.path, path);
        EXPECT_EQ(channel.node, 0U);
        EXPECT_EQ(channel.interpolation, Interpolation::Linear);
        EXPECT_EQ(channel.times, (std::vector<float>{0.5F, 2}));
        EXPECT_EQ(channel.values, three);
    }
    const Channel rotation = loadChannel<float>("rotation", "STEP", {0}, "VEC4", kF32, 1, {0.1F, 0.2F, 0.3F, 0.4F});
    EXPECT_EQ(rotation.path, ChannelPath::Rotation);
    EXPECT_EQ(rotation.interpolation, Interpolation::Step);
    EXPECT_EQ(rotation.values, (std::vector<float>{0.1F, 0.2F, 0.3F, 0.4F}));
    const Channel weights = loadChannel<float>("weights", "LINEAR", {0, 1}, "SCALAR", kF32, 4, {1, 2, 3, 4});
    EXPECT_EQ(weights.path, ChannelPath::Weights);
    EXPECT_EQ(weights.values, (std::vector<float>{1, 2, 3, 4}));
}

TEST(GltfRig, CubicSplinesHaveTangentsBesideEachValue)
{
    std::vector<float> numbers(18);
    std::iota(numbers.begin(), numbers.end(), 0.0F);
    const Channel channel = loadChannel<float>("translation", "CUBICSPLINE", {1, 2}, "VEC3", kF32, 6, numbers);
    EXPECT_EQ(channel.interpolation, Interpolation::CubicSpline);
    EXPECT_EQ(channel.values, numbers);
    numbers.resize(12);
    EXPECT_EQ(loadChannel<float>("weights", "CUBICSPLINE", {1, 2}, "SCALAR", kF32, 12, numbers).values, numbers);
}

TEST(GltfRig, RotationsAndWeightsMayBeNormalizedIntegers)
{
    const std::vector<float> wanted = {0, 1, -1, 0};
    EXPECT_EQ(loadChannel<std::int8_t>("rotation", "LINEAR", {0}, "VEC4", kI8, 1, {0, 127, -128, 0}).values, wanted);
    EXPECT_EQ(loadChannel<std::int16_t>("rotation", "LINEAR", {0}, "VEC4", kI16, 1, {0, 32767, -32768, 0}).values,
              wanted);
    EXPECT_EQ(loadChannel<std::uint8_t>("rotation", "LINEAR", {0}, "VEC4", kU8, 1, {0, 255, 51, 0}).values,
              (std::vector<float>{0, 1, 0.2F, 0}));
    EXPECT_EQ(loadChannel<std::uint16_t>("weights", "LINEAR", {0}, "SCALAR", kU16, 2, {65535, 13107}).values,
              (std::vector<float>{1, 0.2F}));
    EXPECT_EQ(loadChannel<std::int8_t>("weights", "LINEAR", {0}, "SCALAR", kI8, 2, {-127, 127}).values,
              (std::vector<float>{-1, 1}));
}

TEST(GltfRig, AnimationsLastAsLongAsTheirLongestChannel)
{
    GltfBuilder builder = morphDocument({});
    addAnimation<float>(builder, 0, "translation", "STEP", {0, 1.5F}, "VEC3", kF32, 2, {1, 2, 3, 4, 5, 6});
    json& animation = builder.document["animations"][0];
    const std::size_t times = builder.addAccessor<float>("SCALAR", kF32, 1, {4.25F});
    const std::size_t scales = builder.addAccessor<float>("VEC3", kF32, 1, {1, 1, 1});
    animation["samplers"].push_back({{"input", times}, {"output", scales}}); // the default is LINEAR
    animation["channels"].push_back({{"sampler", 1}, {"target", {{"node", 0}, {"path", "scale"}}}});
    animation["name"] = "both";
    const Scene scene = builder.load();
    ASSERT_EQ(scene.animations.size(), 1U);
    EXPECT_EQ(scene.animations[0].name, "both");
    EXPECT_EQ(scene.animations[0].seconds, 4.25);
    ASSERT_EQ(scene.animations[0].channels.size(), 2U);
    EXPECT_EQ(scene.animations[0].channels[0].interpolation, Interpolation::Step);
    EXPECT_EQ(scene.animations[0].channels[1].interpolation, Interpolation::Linear);
}

TEST(GltfRig, StaticFilesHaveNoWarningsAndNothingThatMoves)
{
    const Scene scene = triangleDocument().load();
    EXPECT_TRUE(scene.skins.empty());
    EXPECT_TRUE(scene.animations.empty());
    EXPECT_TRUE(scene.warnings.empty());
    EXPECT_EQ(scene.nodes.size(), 1U);
    EXPECT_EQ(scene.instances.at(0).node, 0U);
}

TEST(GltfRig, SeveralFilesBecomeOneScene)
{
    const TempDir dir;
    const std::vector<std::filesystem::path> paths = {dir.write("a.glb", armDocument().glb()),
                                                      dir.write("b.glb", morphDocument({1, 1}).glb()),
                                                      dir.write("c.glb", armDocument().glb())};
    const Scene scene = loadScene(paths);
    EXPECT_EQ(sceneFault(scene), "");
    ASSERT_EQ(scene.nodes.size(), 7U);
    EXPECT_EQ(scene.nodes[6].parent, 5U);
    EXPECT_EQ(scene.instances.at(1).node, 3U);
    EXPECT_EQ(scene.instances.at(1).skin, kNone);
    EXPECT_EQ(scene.instances.at(2).node, 4U);
    EXPECT_EQ(scene.instances.at(2).skin, 1U);
    EXPECT_EQ(scene.skins.at(1).joints, (std::vector<std::uint32_t>{5, 6}));
    EXPECT_EQ(scene.animations.at(1).channels.at(0).node, 6U);
}

TEST(GltfRig, OfEachFileTheFirstAnimationThatMovesSomethingPlays)
{
    GltfBuilder twice = armDocument();
    addAnimation<float>(twice, 2, "translation", "STEP", {0}, "VEC3", kF32, 1, {1, 2, 3});
    GltfBuilder late = armDocument();
    json nothing = json::array({{{"channels", json::array()}, {"samplers", json::array()}}});
    nothing.push_back(late.document["animations"][0]);
    late.document["animations"] = nothing;
    const TempDir dir;
    const std::vector<std::filesystem::path> paths = {dir.write("a.glb", twice.glb()), dir.write("b.glb", late.glb())};
    const Scene scene = loadScene(paths);
    ASSERT_EQ(scene.animations.size(), 2U);
    EXPECT_EQ(scene.animations[0].name, "rotation");
    EXPECT_EQ(scene.animations[0].number, 0U);
    EXPECT_EQ(scene.animations[1].number, 1U) << "as the file counts";
    EXPECT_EQ(scene.animations[1].channels.at(0).node, 5U);
    EXPECT_EQ(loadScene(paths, {.every_animation = true}).animations.size(), 3U);
}

} // namespace

} // namespace zvo::test
