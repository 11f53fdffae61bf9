// SPDX-License-Identifier: MIT
// Skins, morph targets and animations with mistakes. Parts that cannot be used are left out with a warning, and the
// mesh stays as it was modelled. Contradictions in the file's structure are errors.
#include "io/gltf/gltf_loader.h"

#include "core/scene/scene_size.h"
#include "gltf_builder.h"
#include "rig_documents.h"

#include <gtest/gtest.h>
#include <limits>

namespace zvo::test
{

namespace
{

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinite = std::numeric_limits<float>::infinity();

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
    expectInputError(everything(), change, parts);
}

// Pointers to parts of everything().
const std::string kArmAttributes = "/meshes/0/primitives/0/attributes/";
const std::string kMorphTargets = "/meshes/1/primitives/0/targets/";

std::string samplerOf(std::size_t animation)
{
    return "/animations/" + std::to_string(animation) + "/samplers/0/";
}

std::string targetOf(std::size_t animation)
{
    return "/animations/" + std::to_string(animation) + "/channels/0/target/";
}

/// Sets a member to an accessor of numbers.
Change setNumbers(const std::string& pointer, const std::string& type, std::size_t count,
                  const std::vector<float>& values)
{
    return setTo(pointer, [=](GltfBuilder& b) { return b.addAccessor(type, kF32, count, values); });
}

/// Sets a member to the value of another.
Change copy(const std::string& to, const std::string& from)
{
    return [=](GltfBuilder& b) { set(to, b.document.at(json::json_pointer(from)))(b); };
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
    expectBroken(set("/animations", 3), {"animations is not an array"});
    expectBroken(without("/skins/0/joints"), {"skins[0] has no joints"});
    expectBroken(set("/skins/0/joints/1", 4), {"skins[0].joints[1] is 4"});
    expectBroken(set("/skins/0/joints/1", -1), {"skins[0].joints[1]"});
    expectBroken(set("/skins/0/inverseBindMatrices", 99), {"is 99"});
    expectBroken(set("/nodes/0/skin", 1), {"nodes[0].skin is 1"});
    expectBroken(set("/nodes/3/weights", {1, "a"}), {"array of numbers"});
    expectBroken(set("/meshes/1/weights", 1), {"array of numbers"});
    expectBroken(set(kMorphTargets + "0", 1), {"targets[0] is not an object"});
    expectBroken(set(kMorphTargets + "1/POSITION", 99), {"targets[1].POSITION is 99"});
    expectBroken(without("/animations/0/channels"), {"has no channels"});
    expectBroken(without("/animations/0/samplers"), {"has no samplers"});
    expectBroken(set(targetOf(0) + "node", 4), {"target.node is 4"});
    expectBroken(without(targetOf(0) + "path"), {"has no path"});
    expectBroken(set("/animations/1/channels/0/sampler", 1),
                 {"animations[1].channels[0].sampler is 1, but the animation has 1 samplers"});
    expectBroken(set("/animations/1/channels/0/sampler", ~0ULL), {"sampler is 18446744073709551615"});
    expectBroken(set(samplerOf(0) + "input", 99), {"samplers[0].input is 99"});
    expectBroken(without(samplerOf(0) + "output"), {"has no output"});
}

TEST(GltfRigErrors, AccessorsMustLieInTheirBuffers)
{
    const auto expectTooLong = [](const std::string& pointer, const std::string& use)
    {
        const auto accessor = everything().document.at(json::json_pointer(pointer)).get<std::size_t>();
        expectBroken(set("/accessors/" + std::to_string(accessor) + "/count", 1000), {use, "takes 1000 elements"});
    };
    expectTooLong(kArmAttributes + "JOINTS_0", "JOINTS_0 of meshes[0].primitives[0]");
    expectTooLong(kArmAttributes + "WEIGHTS_0", "WEIGHTS_0 of meshes[0].primitives[0]");
    expectTooLong(kMorphTargets + "0/NORMAL", "NORMAL of meshes[1].primitives[0].targets[0]");
    expectTooLong("/skins/0/inverseBindMatrices", "inverseBindMatrices of skins[0]");
    expectTooLong(samplerOf(0) + "input", "input of animations[0].channels[0]");
    expectTooLong(samplerOf(1) + "output", "output of animations[1].channels[0]");
}

TEST(GltfRigErrors, VertexDataMustFitTheVertices)
{
    const auto bytes = [](GltfBuilder& b) { return b.addAccessor("VEC4", kU8, 3, std::vector<std::uint8_t>(12)); };
    const auto shorts = [](GltfBuilder& b)
    { return b.addAccessor("VEC3", kI16, 3, std::vector<std::int16_t>(12), true, 8); };
    expectBroken(setNumbers(kArmAttributes + "JOINTS_0", "VEC4", 4, std::vector<float>(16)),
                 {"JOINTS_0", "does not allow there"});
    expectBroken(setTo(kArmAttributes + "JOINTS_0", bytes), {"JOINTS_0", "3 elements for 4 vertices"});
    expectBroken(setNumbers(kArmAttributes + "WEIGHTS_0", "VEC3", 4, std::vector<float>(12)),
                 {"WEIGHTS_0", "does not allow there"});
    expectBroken(setNumbers(kMorphTargets + "1/POSITION", "VEC3", 2, std::vector<float>(6)),
                 {"POSITION of meshes[1].primitives[0].targets[1]", "2 elements for 3 vertices"});
    expectBroken(setTo(kMorphTargets + "1/POSITION", shorts),
                 {"targets[1]", "does not allow there"}); // without KHR_mesh_quantization
}

TEST(GltfRigErrors, JointsWithoutWeightsAreLeftOut)
{
    for (const char* missing : {"JOINTS_0", "WEIGHTS_0"})
    {
        const Scene scene = expectWarnings(without(kArmAttributes + missing),
                                           {"left out (meshes[0].primitives[0])", "mesh without joints"});
        EXPECT_TRUE(scene.primitives.at(0).joints.empty());
        EXPECT_TRUE(scene.primitives.at(0).weights.empty());
        EXPECT_EQ(scene.instances.at(0).skin, kNone);
    }
}

TEST(GltfRigErrors, MoreThanFourJointsAVertexAreCounted)
{
    expectWarnings(copy(kArmAttributes + "JOINTS_1", kArmAttributes + "JOINTS_0"),
                   {"joints beyond four a vertex left out (meshes[0].primitives[0])"});
}

TEST(GltfRigErrors, VerticesWithoutUsableWeightsFollowTheFirstJoint)
{
    for (const float bad : {kNan, kInfinite, -0.5F, 0.0F})
    {
        std::vector<float> weights(16, 0.25F);
        weights[8] = bad;
        weights[9] = weights[10] = weights[11] = bad == 0.0F ? 0.0F : 0.5F;
        const Scene scene = expectWarnings(setNumbers(kArmAttributes + "WEIGHTS_0", "VEC4", 4, weights),
                                           {"vertices whose joint weights are negative, not finite or all 0"});
        EXPECT_EQ(scene.primitives.at(0).weights.at(2), glm::vec4(1, 0, 0, 0));
        EXPECT_EQ(scene.primitives.at(0).joints.at(2), glm::u16vec4(0));
        EXPECT_EQ(scene.primitives.at(0).weights.at(1), glm::vec4(0.25F));
    }
}

TEST(GltfRigErrors, JointsThatTheSkinDoesNotHaveLeaveTheMeshAsItIs)
{
    const Scene scene = expectWarnings(set("/skins/0/joints", {1}), {"joints that its skin does not have"});
    EXPECT_EQ(scene.instances.at(0).skin, kNone);
    // With a weight of 0 they are harmless.
    const std::vector<std::uint8_t> joints = {0, 255, 255, 255, 0, 1, 77, 99, 1, 88, 88, 88, 1, 0, 2, 2};
    const Scene harmless = expectWarnings(
        setTo(kArmAttributes + "JOINTS_0", [&](auto& b) { return b.addAccessor("VEC4", kU8, 4, joints); }), {});
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
    expectLeftOut(set("/skins/0/joints", json::array()), kJoints);
    expectLeftOut(set("/scenes", {{{"nodes", {0, 3}}}}), kJoints);
    const auto matrices = [](const std::string& type, int component_type, std::size_t count, float number)
    {
        const auto add = [=](GltfBuilder& b)
        { return b.addAccessor(type, component_type, count, std::vector<float>(64, number)); };
        return setTo("/skins/0/inverseBindMatrices", add);
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
    expectBroken(setNumbers("/skins/0/inverseBindMatrices", "MAT3", 2, std::vector<float>(18)),
                 {"inverseBindMatrices of skins[0]", "element type that nothing has"});
}

TEST(GltfRigErrors, MorphTargetsThatAreNotFiniteDoNotMove)
{
    const Scene scene =
        expectWarnings(setNumbers(kMorphTargets + "1/POSITION", "VEC3", 3, {1, 2, kNan, 4, 5, 6, 7, kInfinite, 9}),
                       {"not finite stay where they are (meshes[1].primitives[0].targets[1])"});
    EXPECT_EQ(scene.primitives.at(1).morph_targets.at(1).positions,
              (std::vector<glm::vec3>{{0, 0, 0}, {4, 5, 6}, {0, 0, 0}}));
}

TEST(GltfRigErrors, WeightsAtRestMustFitTheTargets)
{
    const auto expectWeights = [](const json& weights, const std::vector<float>& wanted)
    {
        const Scene scene = expectWarnings(set("/nodes/3/weights", weights),
                                           {"morph weights that are not finite, or not as many as targets"});
        EXPECT_EQ(scene.nodes.at(3).morph_weights, wanted);
    };
    expectWeights({1}, {1, 0});
    expectWeights({1, 2, 3}, {1, 2});
    expectWeights({1e300, 2}, {0, 2});
}

TEST(GltfRigErrors, TexturesAndColorsDoNotMorph)
{
    expectWarnings(copy(kMorphTargets + "0/COLOR_0", kMorphTargets + "0/POSITION"),
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
    { return setNumbers(samplerOf(0) + "input", "SCALAR", values.size(), values); };
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
    expectLeftOut(0, set(samplerOf(0) + "interpolation", "CUBICSPLINE"), kCounts);
    expectLeftOut(1, set(samplerOf(1) + "interpolation", "STEP"), kCounts);

    const std::string kTypes = "its times or values have a type that glTF does not allow there";
    const auto whole = [](GltfBuilder& b) { return b.addAccessor("VEC4", kU32, 2, std::vector<std::uint32_t>(8)); };
    const auto move = [](GltfBuilder& b) // by values that must be floats
    {
        b.document["accessors"][b.document.at(json::json_pointer(samplerOf(2) + "output")).get<std::size_t>()]["type"] =
            "VEC3";
        set(targetOf(2) + "path", "translation")(b);
    };
    expectLeftOut(0, copy(samplerOf(0) + "input", samplerOf(2) + "output"), kTypes);
    expectLeftOut(0, set(targetOf(0) + "path", "scale"), kTypes);
    expectLeftOut(2, move, kTypes);
    expectLeftOut(2, setTo(samplerOf(2) + "output", whole), kTypes);

    expectLeftOut(0, setNumbers(samplerOf(0) + "output", "VEC4", 3, {0, 0, 0, 1, 0, 0, kNan, 1, 0, 0, 0, 1}),
                  "its values are not finite");
    const std::string kUnknown = "what it moves, or how, is not part of glTF 2.0";
    expectLeftOut(0, set(targetOf(0) + "path", "pointer"), kUnknown);
    expectLeftOut(0, without(targetOf(0) + "node"), kUnknown);
    expectLeftOut(0, set(samplerOf(0) + "interpolation", "linear"), kUnknown);
    expectLeftOut(1, set(targetOf(1) + "node", 1), "its node has no morph targets");
    const auto hold = [](GltfBuilder& b)
    {
        without("/nodes/2/translation")(b);
        set("/nodes/2/matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 1, 0, 1})(b);
    };
    expectLeftOut(0, hold, "its node has a matrix");
}

TEST(GltfRigErrors, EqualTimesAreAJump)
{
    const Scene scene = expectWarnings(setNumbers(samplerOf(0) + "input", "SCALAR", 3, {0, 1, 1}), {});
    EXPECT_EQ(scene.animations.at(0).channels.at(0).times, (std::vector<float>{0, 1, 1}));
}

TEST(GltfRigErrors, FilesMayBeCutOrHaveABitFlippedAnywhere)
{
    EXPECT_GT(loadCutAndFlipped(everything()), 500); // most changed numbers in the buffer load
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
    setNumbers(samplerOf(0) + "input", "SCALAR", kKeys, times)(builder);
    setNumbers(samplerOf(0) + "output", "VEC4", kKeys, std::vector<float>(4 * kKeys))(builder);
    json& channels = builder.document["animations"][0]["channels"];
    channels = std::vector<json>(sceneBytesMax() / (kKeys * 5 * sizeof(float)) + 1, json(channels[0]));
    expectInputError(builder, {"half of this machine's memory"});
}

TEST(GltfRigErrors, MorphTargetsThatShareDataMayNotFillTheMemory)
{
    constexpr std::size_t kVertices = 1 << 16;
    GltfBuilder builder;
    const std::size_t positions = builder.addPositions(std::vector<float>(3 * kVertices));
    const std::vector<json> targets(sceneBytesMax() / (kVertices * sizeof(glm::vec3)) + 1,
                                    json{{"POSITION", positions}});
    builder.addMeshNode({{"attributes", {{"POSITION", positions}}}, {"targets", targets}});
    expectInputError(builder, {"half of this machine's memory"});
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
    expectInputError(builder, {"half of this machine's memory"});
    // A pose has morph weights for each instance, too.
    GltfBuilder morph = morphDocument({});
    json& targets = morph.document["meshes"][0]["primitives"][0]["targets"];
    constexpr std::size_t kTargets = 1 << 16;
    targets = std::vector<json>(kTargets, json::object());
    const std::size_t shown = sceneBytesMax() / (2 * kTargets * sizeof(float)) + 1;
    morph.document["nodes"] = std::vector<json>(shown, json{{"mesh", 0}});
    expectInputError(morph, {"half of this machine's memory"});
}

} // namespace

} // namespace zvo::test
