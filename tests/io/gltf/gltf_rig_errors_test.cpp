// SPDX-License-Identifier: MIT
// Skins, morph targets and animations with mistakes. Parts that cannot be used are left out with a warning, and the
// mesh stays as it was modelled. Contradictions in the file's structure are errors.
#include "io/gltf/gltf_loader.h"

#include "core/scene/scene_size.h"
#include "gltf_builder.h"
#include "rig_documents.h"

#include <functional>
#include <gtest/gtest.h>
#include <limits>

namespace zvo::test
{

namespace
{

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinite = std::numeric_limits<float>::infinity();

using Change = std::function<void(GltfBuilder&)>;

/// An arm, and a triangle with morph targets (node 3) that an animation moves, too.
GltfBuilder everything()
{
    GltfBuilder builder = armDocument();
    GltfBuilder morph = morphDocument({0.5F, 0});
    // The arrays of morphDocument(), in this document.
    const std::size_t first = builder.document["accessors"].size();
    for (json view : morph.document["bufferViews"])
    {
        builder.addView(morph.bin.data() + view["byteOffset"].get<std::size_t>(), view["byteLength"]);
    }
    for (json accessor : morph.document["accessors"])
    {
        accessor["bufferView"] = accessor["bufferView"].get<std::size_t>() + first;
        builder.add("accessors", accessor);
    }
    json mesh = morph.document["meshes"][0];
    for (json& accessor : mesh["primitives"][0]["attributes"])
    {
        accessor = accessor.get<std::size_t>() + first;
    }
    for (json& target : mesh["primitives"][0]["targets"])
    {
        for (json& accessor : target)
        {
            accessor = accessor.get<std::size_t>() + first;
        }
    }
    builder.add("nodes", {{"mesh", builder.add("meshes", mesh)}});
    addAnimation<float>(builder, 3, "weights", "CUBICSPLINE", {0, 1}, "SCALAR", kF32, 12,
                        std::vector<float>(12, 0.25F));
    addAnimation<std::int16_t>(builder, 3, "rotation", "STEP", {0, 1}, "VEC4", kI16, 2,
                               {0, 0, 0, 32767, 0, 0, 32767, 0});
    return builder;
}

/// Expects that the scene loads with these warnings and no others, with all of its triangles.
Scene expectWarnings(const Change& change, const std::vector<std::string>& parts)
{
    GltfBuilder builder = everything();
    change(builder);
    Scene scene = builder.load();
    EXPECT_EQ(sceneFault(scene), "");
    EXPECT_EQ(scene.triangleCount(), 3U);
    EXPECT_EQ(scene.warnings.size(), parts.size()) << testing::PrintToString(scene.warnings);
    for (std::size_t i = 0; i < std::min(parts.size(), scene.warnings.size()); ++i)
    {
        EXPECT_TRUE(contains(scene.warnings[i], parts[i])) << '"' << parts[i] << "\" is not in: " << scene.warnings[i];
    }
    return scene;
}

void expectBroken(const Change& change, std::initializer_list<std::string> parts)
{
    GltfBuilder builder = everything();
    change(builder);
    expectInputError([&] { static_cast<void>(builder.load()); }, parts);
}

json& arm(GltfBuilder& builder)
{
    return builder.document["meshes"][0]["primitives"][0];
}

json& target(GltfBuilder& builder, std::size_t index)
{
    return builder.document["meshes"][1]["primitives"][0]["targets"][index];
}

json& sampler(GltfBuilder& builder, std::size_t animation)
{
    return builder.document["animations"][animation]["samplers"][0];
}

json& channelTarget(GltfBuilder& builder, std::size_t animation)
{
    return builder.document["animations"][animation]["channels"][0]["target"];
}

std::size_t addNumbers(GltfBuilder& builder, const std::string& type, std::size_t count,
                       const std::vector<float>& values)
{
    return builder.addAccessor(type, kF32, count, values);
}

TEST(GltfRigErrors, NothingIsWrongWithTheDocumentThatTheyChange)
{
    const Scene scene = expectWarnings([](GltfBuilder&) {}, {});
    EXPECT_EQ(scene.animations.size(), 3U);
    EXPECT_EQ(scene.skins.size(), 1U);
    EXPECT_EQ(scene.primitives.at(1).morph_targets.size(), 2U);
}

TEST(GltfRigErrors, PropertiesMustHaveTheirTypesAndIndicesTheirTargets)
{
    const auto document = [](GltfBuilder& b) -> json& { return b.document; };
    expectBroken([&](GltfBuilder& b) { document(b)["animations"] = 3; }, {"animations is not an array"});
    expectBroken([&](GltfBuilder& b) { document(b)["skins"][0].erase("joints"); }, {"skins[0] has no joints"});
    expectBroken([&](GltfBuilder& b) { document(b)["skins"][0]["joints"][1] = 4; }, {"skins[0].joints[1] is 4"});
    expectBroken([&](GltfBuilder& b) { document(b)["skins"][0]["joints"][1] = -1; }, {"skins[0].joints[1]"});
    expectBroken([&](GltfBuilder& b) { document(b)["skins"][0]["inverseBindMatrices"] = 99; }, {"is 99"});
    expectBroken([&](GltfBuilder& b) { document(b)["nodes"][0]["skin"] = 1; }, {"nodes[0].skin is 1"});
    expectBroken([&](GltfBuilder& b) { document(b)["nodes"][3]["weights"] = {1, "a"}; }, {"array of numbers"});
    expectBroken([&](GltfBuilder& b) { document(b)["meshes"][1]["weights"] = 1; }, {"array of numbers"});
    expectBroken([&](GltfBuilder& b) { target(b, 0) = 1; }, {"targets[0] is not an object"});
    expectBroken([&](GltfBuilder& b) { target(b, 1)["POSITION"] = 99; }, {"targets[1].POSITION is 99"});
    expectBroken([&](GltfBuilder& b) { document(b)["animations"][0].erase("channels"); }, {"has no channels"});
    expectBroken([&](GltfBuilder& b) { document(b)["animations"][0].erase("samplers"); }, {"has no samplers"});
    expectBroken([&](GltfBuilder& b) { channelTarget(b, 0)["node"] = 4; }, {"target.node is 4"});
    expectBroken([&](GltfBuilder& b) { channelTarget(b, 0).erase("path"); }, {"has no path"});
    expectBroken([&](GltfBuilder& b) { document(b)["animations"][1]["channels"][0]["sampler"] = 1; },
                 {"animations[1].channels[0].sampler is 1, but the animation has 1 samplers"});
    expectBroken([&](GltfBuilder& b) { document(b)["animations"][1]["channels"][0]["sampler"] = ~0ULL; },
                 {"sampler is 18446744073709551615"});
    expectBroken([&](GltfBuilder& b) { sampler(b, 0)["input"] = 99; }, {"samplers[0].input is 99"});
    expectBroken([&](GltfBuilder& b) { sampler(b, 0).erase("output"); }, {"has no output"});
}

TEST(GltfRigErrors, AccessorsMustLieInTheirBuffers)
{
    const auto grow = [](const json& accessor)
    { return [accessor](GltfBuilder& b) { b.document["accessors"][accessor.get<std::size_t>()]["count"] = 1000; }; };
    const auto expectTooLong = [&](const json& accessor, const std::string& use) {
        expectBroken(grow(accessor), {use, "takes 1000 elements"});
    };
    GltfBuilder builder = everything();
    expectTooLong(arm(builder)["attributes"]["JOINTS_0"], "JOINTS_0 of meshes[0].primitives[0]");
    expectTooLong(arm(builder)["attributes"]["WEIGHTS_0"], "WEIGHTS_0 of meshes[0].primitives[0]");
    expectTooLong(target(builder, 0)["NORMAL"], "NORMAL of meshes[1].primitives[0].targets[0]");
    expectTooLong(builder.document["skins"][0]["inverseBindMatrices"], "inverseBindMatrices of skins[0]");
    expectTooLong(sampler(builder, 0)["input"], "input of animations[0].channels[0]");
    expectTooLong(sampler(builder, 1)["output"], "output of animations[1].channels[0]");
}

TEST(GltfRigErrors, VertexDataMustFitTheVertices)
{
    const auto set = [](const char* attribute, const std::function<std::size_t(GltfBuilder&)>& add)
    {
        return [=](GltfBuilder& b)
        {
            const std::size_t accessor = add(b);
            arm(b)["attributes"][attribute] = accessor;
        };
    };
    expectBroken(set("JOINTS_0", [](GltfBuilder& b) { return addNumbers(b, "VEC4", 4, std::vector<float>(16)); }),
                 {"JOINTS_0", "does not allow there"});
    expectBroken(
        set("JOINTS_0", [](GltfBuilder& b) { return b.addAccessor("VEC4", kU8, 3, std::vector<std::uint8_t>(12)); }),
        {"JOINTS_0", "3 elements for 4 vertices"});
    expectBroken(set("WEIGHTS_0", [](GltfBuilder& b) { return addNumbers(b, "VEC3", 4, std::vector<float>(12)); }),
                 {"WEIGHTS_0", "does not allow there"});
    expectBroken(
        [](GltfBuilder& b)
        {
            const std::size_t accessor = addNumbers(b, "VEC3", 2, std::vector<float>(6));
            target(b, 1)["POSITION"] = accessor;
        },
        {"POSITION of meshes[1].primitives[0].targets[1]", "2 elements for 3 vertices"});
    expectBroken(
        [](GltfBuilder& b)
        {
            const std::size_t accessor = b.addAccessor("VEC3", kI16, 3, std::vector<std::int16_t>(12), true, 8);
            target(b, 1)["POSITION"] = accessor;
        },
        {"targets[1]", "does not allow there"}); // without KHR_mesh_quantization
}

TEST(GltfRigErrors, JointsWithoutWeightsAreLeftOut)
{
    for (const char* missing : {"JOINTS_0", "WEIGHTS_0"})
    {
        const Scene scene = expectWarnings([&](GltfBuilder& b) { arm(b)["attributes"].erase(missing); },
                                           {"left out (meshes[0].primitives[0])", "mesh without joints"});
        EXPECT_TRUE(scene.primitives.at(0).joints.empty());
        EXPECT_TRUE(scene.primitives.at(0).weights.empty());
        EXPECT_EQ(scene.instances.at(0).skin, kNone);
    }
}

TEST(GltfRigErrors, MoreThanFourJointsAVertexAreCounted)
{
    expectWarnings([](GltfBuilder& b) { arm(b)["attributes"]["JOINTS_1"] = arm(b)["attributes"]["JOINTS_0"]; },
                   {"joints beyond four a vertex left out (meshes[0].primitives[0])"});
}

TEST(GltfRigErrors, VerticesWithoutUsableWeightsFollowTheFirstJoint)
{
    for (const float bad : {kNan, kInfinite, -0.5F, 0.0F})
    {
        const Scene scene = expectWarnings(
            [&](GltfBuilder& b)
            {
                std::vector<float> weights(16, 0.25F);
                weights[8] = bad;
                weights[9] = weights[10] = weights[11] = bad == 0.0F ? 0.0F : 0.5F;
                const std::size_t accessor = addNumbers(b, "VEC4", 4, weights);
                arm(b)["attributes"]["WEIGHTS_0"] = accessor;
            },
            {"vertices whose joint weights are negative, not finite or all 0"});
        EXPECT_EQ(scene.primitives.at(0).weights.at(2), glm::vec4(1, 0, 0, 0));
        EXPECT_EQ(scene.primitives.at(0).joints.at(2), glm::u16vec4(0));
        EXPECT_EQ(scene.primitives.at(0).weights.at(1), glm::vec4(0.25F));
    }
}

TEST(GltfRigErrors, JointsThatTheSkinDoesNotHaveLeaveTheMeshAsItIs)
{
    const Scene scene = expectWarnings([](GltfBuilder& b) { b.document["skins"][0]["joints"] = {1}; },
                                       {
                                           "joints that its skin does not have",
                                       });
    EXPECT_EQ(scene.instances.at(0).skin, kNone);
    EXPECT_TRUE(contains(scene.rest_warnings.at(0), "morph")) << "nothing is missing where no skin is";
    // With a weight of 0 they are harmless.
    const Scene harmless = expectWarnings(
        [](GltfBuilder& b)
        {
            const std::size_t accessor = b.addAccessor<std::uint8_t>(
                "VEC4", kU8, 4, {0, 255, 255, 255, 0, 1, 77, 99, 1, 88, 88, 88, 1, 0, 2, 2});
            arm(b)["attributes"]["JOINTS_0"] = accessor;
        },
        {});
    EXPECT_EQ(harmless.instances.at(0).skin, 0U);
}

TEST(GltfRigErrors, SkinsThatMakeNoSenseAreLeftOut)
{
    const auto expectLeftOut = [](const Change& change, const std::string& why)
    {
        const Scene scene = expectWarnings(change, {"skin left out, as " + why});
        EXPECT_TRUE(scene.skins.empty());
        EXPECT_EQ(scene.instances.at(0).skin, kNone);
    };
    const std::string kJoints = "it has joints that are not in the scene, or none (skins[0])";
    const std::string kMatrices = "it does not have an affine inverse bind matrix for each joint (skins[0])";
    expectLeftOut([](GltfBuilder& b) { b.document["skins"][0]["joints"] = json::array(); }, kJoints);
    expectLeftOut([](GltfBuilder& b) { b.document["scenes"] = {{{"nodes", {0, 3}}}}; }, kJoints);
    const auto matrices = [](const std::string& type, int component_type, std::size_t count, float number)
    {
        return [=](GltfBuilder& b)
        {
            std::vector<float> numbers(64, number);
            b.document["skins"][0]["inverseBindMatrices"] = b.addAccessor(type, component_type, count, numbers);
        };
    };
    expectLeftOut(matrices("MAT4", kF32, 1, 0.0F), kMatrices);
    expectLeftOut(matrices("MAT4", kF32, 2, 0.0F), kMatrices); // the last row is not (0, 0, 0, 1)
    expectLeftOut(matrices("MAT4", kF32, 2, kNan), kMatrices);
    expectLeftOut(matrices("MAT4", kF32, 2, kInfinite), kMatrices);
    expectLeftOut(matrices("MAT4", kU16, 2, 1.0F), kMatrices);
    expectLeftOut(matrices("VEC4", kF32, 2, 1.0F), kMatrices);
    // An unusable matrix that no joint needs.
    GltfBuilder builder = everything();
    builder.add("skins", {{"joints", json::array()}});
    EXPECT_TRUE(builder.load().warnings.empty());
}

TEST(GltfRigErrors, SmallerMatricesAreNothingThatASceneHas)
{
    expectBroken(
        [](GltfBuilder& b)
        {
            const std::size_t accessor = addNumbers(b, "MAT3", 2, std::vector<float>(18));
            b.document["skins"][0]["inverseBindMatrices"] = accessor;
        },
        {"inverseBindMatrices of skins[0]", "element type that nothing has"});
}

TEST(GltfRigErrors, MorphTargetsThatAreNotFiniteDoNotMove)
{
    const Scene scene = expectWarnings(
        [](GltfBuilder& b)
        {
            const std::size_t accessor = addNumbers(b, "VEC3", 3, {1, 2, kNan, 4, 5, 6, 7, kInfinite, 9});
            target(b, 1)["POSITION"] = accessor;
        },
        {"not finite stay where they are (meshes[1].primitives[0].targets[1])"});
    EXPECT_EQ(scene.primitives.at(1).morph_targets.at(1).positions,
              (std::vector<glm::vec3>{{0, 0, 0}, {4, 5, 6}, {0, 0, 0}}));
}

TEST(GltfRigErrors, WeightsAtRestMustFitTheTargets)
{
    const auto expectWeights = [](const json& weights, const std::vector<float>& wanted)
    {
        const Scene scene = expectWarnings([&](GltfBuilder& b) { b.document["nodes"][3]["weights"] = weights; },
                                           {"morph weights that are not finite, or not as many as targets"});
        EXPECT_EQ(scene.nodes.at(3).morph_weights, wanted);
    };
    expectWeights({1}, {1, 0});
    expectWeights({1, 2, 3}, {1, 2});
    expectWeights({1e300, 2}, {0, 2});
}

TEST(GltfRigErrors, TexturesAndColorsDoNotMorph)
{
    expectWarnings([](GltfBuilder& b) { target(b, 0)["COLOR_0"] = target(b, 0)["POSITION"]; },
                   {"morph targets do not move texture coordinates and colours (meshes[1].primitives[0].targets[0])"});
}

TEST(GltfRigErrors, ChannelsThatMakeNoSenseAreLeftOut)
{
    const auto expectLeftOut = [](std::size_t animation, const Change& change, const std::string& why)
    {
        const Scene scene = expectWarnings(change, {"animation channel left out, as " + why + " (animations[" +
                                                    std::to_string(animation) + "].channels[0])"});
        EXPECT_EQ(scene.animations.size(), 2U); // an animation without channels is dropped
    };
    const auto times = [](const std::vector<float>& values)
    { return [=](GltfBuilder& b) { sampler(b, 0)["input"] = addNumbers(b, "SCALAR", values.size(), values); }; };
    const std::string kTimes = "its times do not increase from 0 on";
    expectLeftOut(0, times({0, 2, 1}), kTimes);
    expectLeftOut(0, times({-1, 0, 1}), kTimes);
    expectLeftOut(0, times({0, kNan, 1}), kTimes);
    expectLeftOut(0, times({kNan, 0, 1}), kTimes);
    expectLeftOut(0, times({0, 1, kInfinite}), kTimes);

    const std::string kCounts = "it does not have a value for each time";
    expectLeftOut(0, times({0, 1}), kCounts);
    expectLeftOut(0, times({0, 1, 2, 3}), kCounts);
    expectLeftOut(0, times({}), kCounts);
    expectLeftOut(
        0, [](GltfBuilder& b) { sampler(b, 0)["interpolation"] = "CUBICSPLINE"; }, kCounts);
    expectLeftOut(
        1, [](GltfBuilder& b) { sampler(b, 1)["interpolation"] = "STEP"; }, kCounts);

    const std::string kTypes = "its times or values have a type that glTF does not allow there";
    expectLeftOut(
        0, [](GltfBuilder& b) { sampler(b, 0)["input"] = sampler(b, 2)["output"]; }, kTypes);
    expectLeftOut(
        0, [](GltfBuilder& b) { channelTarget(b, 0)["path"] = "scale"; }, kTypes);
    expectLeftOut(
        2,
        [](GltfBuilder& b)
        {
            b.document["accessors"][sampler(b, 2)["output"].get<std::size_t>()]["type"] = "VEC3";
            channelTarget(b, 2)["path"] = "translation"; // its values must be floats
        },
        kTypes);
    expectLeftOut(
        2,
        [](GltfBuilder& b) { sampler(b, 2)["output"] = b.addAccessor("VEC4", kU32, 2, std::vector<std::uint32_t>(8)); },
        kTypes);

    expectLeftOut(
        0,
        [](GltfBuilder& b) {
            sampler(b, 0)["output"] = addNumbers(b, "VEC4", 3, {0, 0, 0, 1, 0, 0, kNan, 1, 0, 0, 0, 1});
        },
        "its values are not finite");
    const std::string kUnknown = "what it moves, or how, is not part of glTF 2.0";
    expectLeftOut(
        0, [](GltfBuilder& b) { channelTarget(b, 0)["path"] = "pointer"; }, kUnknown);
    expectLeftOut(
        0, [](GltfBuilder& b) { channelTarget(b, 0).erase("node"); }, kUnknown);
    expectLeftOut(
        0, [](GltfBuilder& b) { sampler(b, 0)["interpolation"] = "linear"; }, kUnknown);
    expectLeftOut(
        1, [](GltfBuilder& b) { channelTarget(b, 1)["node"] = 1; }, "its node has no morph targets");
    expectLeftOut(
        0,
        [](GltfBuilder& b)
        {
            b.document["nodes"][2].erase("translation");
            b.document["nodes"][2]["matrix"] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 1, 0, 1};
        },
        "its node has a matrix");
}

TEST(GltfRigErrors, EqualTimesAreAJump)
{
    const Scene scene = expectWarnings(
        [](GltfBuilder& b) {
            sampler(b, 0)["input"] = addNumbers(b, "SCALAR", 3, {0, 1, 1});
        },
        {});
    EXPECT_EQ(scene.animations.at(0).channels.at(0).times, (std::vector<float>{0, 1, 1}));
}

TEST(GltfRigErrors, EveryPrefixOfAFileIsRefused)
{
    const TempDir dir;
    const std::vector<std::uint8_t> whole = everything().glb();
    for (std::size_t size = 0; size < whole.size(); ++size)
    {
        const auto path = dir.write("cut.glb", std::span(whole).first(size));
        expectInputError([&] { loadGltf(path); }, {"cut.glb"});
    }
    EXPECT_EQ(loadGltf(dir.write("whole.glb", whole)).triangleCount(), 3U);
}

TEST(GltfRigErrors, ABitOfEveryByteMayBeFlipped)
{
    const TempDir dir;
    const std::vector<std::uint8_t> whole = everything().glb();
    int loaded_count = 0;
    for (std::size_t at = 0; at < whole.size(); ++at)
    {
        std::vector<std::uint8_t> damaged = whole;
        damaged[at] = static_cast<std::uint8_t>(damaged[at] ^ (1U << (at % 8)));
        try
        {
            EXPECT_EQ(sceneFault(loadGltf(dir.write("flipped.glb", damaged))), "") << at;
            ++loaded_count;
        }
        catch (const Error& error)
        {
            EXPECT_EQ(error.code(), ErrorCode::Input) << error.what();
        }
    }
    EXPECT_GT(loaded_count, 500); // most changed numbers in the buffer load
}

TEST(GltfRigErrors, DamagedDataGivesWholeScenes)
{
    EXPECT_GT(loadDamaged(everything(), 2000, 5), 1000);
}

TEST(GltfRigErrors, ChannelsThatShareKeysMayNotFillTheMemory)
{
    GltfBuilder builder = everything();
    constexpr std::size_t kKeys = 1 << 16;
    const std::vector<float> times(kKeys);
    sampler(builder, 0)["input"] = builder.addAccessor("SCALAR", kF32, kKeys, times);
    sampler(builder, 0)["output"] = builder.addAccessor("VEC4", kF32, kKeys, std::vector<float>(4 * kKeys));
    json& channels = builder.document["animations"][0]["channels"];
    channels = std::vector<json>(sceneBytesMax() / (kKeys * 5 * sizeof(float)) + 1, json(channels[0]));
    expectInputError([&] { static_cast<void>(builder.load()); }, {"half of this machine's memory"});
}

TEST(GltfRigErrors, MorphTargetsThatShareDataMayNotFillTheMemory)
{
    constexpr std::size_t kVertices = 1 << 16;
    GltfBuilder builder;
    const std::size_t positions = builder.addPositions(std::vector<float>(3 * kVertices));
    const std::vector<json> targets(sceneBytesMax() / (kVertices * sizeof(glm::vec3)) + 1,
                                    json{{"POSITION", positions}});
    builder.addMeshNode({{"attributes", {{"POSITION", positions}}}, {"targets", targets}});
    expectInputError([&] { static_cast<void>(builder.load()); }, {"half of this machine's memory"});
}

TEST(GltfRigErrors, PosesOfManyMeshesMayNotFillTheMemory)
{
    // A pose has a matrix for each joint of each instance.
    GltfBuilder builder = everything();
    constexpr std::size_t kJoints = 1 << 14;
    builder.document["skins"][0] = {{"joints", std::vector<int>(kJoints, 1)}};
    json& primitives = builder.document["meshes"][0]["primitives"];
    constexpr std::size_t kPrimitives = 64;
    primitives = std::vector<json>(kPrimitives, json(primitives[0]));
    json& nodes = builder.document["nodes"];
    const std::size_t count = sceneBytesMax() / (kJoints * kPrimitives * sizeof(glm::mat4)) + 1;
    ASSERT_LT(count, kInstancesMax / kPrimitives);
    const json node = {{"mesh", 0}, {"skin", 0}};
    for (std::size_t i = 0; i < count; ++i)
    {
        nodes.push_back(node);
    }
    expectInputError([&] { static_cast<void>(builder.load()); }, {"half of this machine's memory"});
    // A pose has morph weights for each instance, too.
    GltfBuilder morph = morphDocument({});
    json& targets = morph.document["meshes"][0]["primitives"][0]["targets"];
    constexpr std::size_t kTargets = 1 << 16;
    targets = std::vector<json>(kTargets, json::object());
    const std::size_t shown = sceneBytesMax() / (2 * kTargets * sizeof(float)) + 1;
    morph.document["nodes"] = std::vector<json>(shown, json{{"mesh", 0}});
    expectInputError([&] { static_cast<void>(morph.load()); }, {"half of this machine's memory"});
}

} // namespace

} // namespace zvo::test
