// SPDX-License-Identifier: MIT
// Animated scenes from files with animations: which animations play, and which parts of a file become dynamic objects.
#include "io/scene/animated_scene.h"

#include "animated_scene_fixture.h"
#include "io/gltf/gltf_builder.h"

#include <gtest/gtest.h>

namespace zvo::test
{

namespace
{

/// Two triangles and a camera. The first node moves from x = 0 to x = 4 within two seconds; the second one, at z = 5,
/// and the third, at z = 9, do not move. The first two show the same mesh, the third a textured one.
GltfBuilder animatedDocument()
{
    GltfBuilder builder = triangleDocument();
    builder.add("nodes", {{"mesh", 0}, {"translation", {0, 0, 5}}});
    json textured = trianglePrimitive(builder);
    textured["material"] = 1;
    builder.document["materials"] = {
        json::object(), {{"name", "still"}, {"pbrMetallicRoughness", {{"baseColorFactor", {0, 1, 0, 1}}}}}};
    builder.document["meshes"][0]["primitives"][0]["material"] = 0;
    builder.addMeshNode(textured);
    builder.document["nodes"][2]["translation"] = {0, 0, 9};
    builder.add("cameras",
                {{"type", "perspective"}, {"name", "still"}, {"perspective", {{"yfov", 1}, {"znear", 0.1}}}});
    builder.add("nodes", {{"camera", 0}, {"translation", {1, 2, 3}}});
    const std::size_t times = builder.addAccessor("SCALAR", kF32, 2, std::vector<float>{0.0F, 2.0F});
    const std::size_t values = builder.addAccessor("VEC3", kF32, 2, std::vector<float>{0, 0, 0, 4, 0, 0});
    const json sampler = {{"input", times}, {"output", values}};
    const json channel = {{"sampler", 0}, {"target", {{"node", 0}, {"path", "translation"}}}};
    builder.add("animations", {{"samplers", json::array({sampler})}, {"channels", json::array({channel})}});
    return builder;
}

TEST_F(AnimatedSceneTest, AnimatedInstancesOfAFileAreADynamicObject)
{
    const AnimatedScene animated = loadAnimatedScene(m_dir.write("scenes/animated.glb", animatedDocument().glb()));
    EXPECT_EQ(animated.seconds, 2.0) << "as long as the animation";
    ASSERT_EQ(animated.objects.size(), 1U);
    EXPECT_EQ(animated.objects[0].name, "animated");
    EXPECT_TRUE(animated.objects[0].deforms);
    EXPECT_EQ(animated.objects[0].scene->triangleCount(), 1U);
    EXPECT_EQ(animated.objects[0].scene->materials.size(), 1U) << "only what it needs";
    EXPECT_EQ(animated.fixed.materials.size(), 2U);
    EXPECT_EQ(
        animated.fixed.materials.at(animated.fixed.primitives.at(animated.fixed.instances.at(1).primitive).material)
            .name,
        "still");
    ASSERT_EQ(animated.fixed.cameras.size(), 1U);
    EXPECT_TRUE(animated.fixed.nodes.empty() && animated.fixed.animations.empty());
    const std::vector<glm::vec3> expected = {{0, 0, 5}, {1, 0, 5}, {0, 1, 5}, {0, 0, 9}, {1, 0, 9},
                                             {0, 1, 9}, {3, 0, 0}, {4, 0, 0}, {3, 1, 0}};
    EXPECT_EQ(corners(sceneAt(animated, 1.5)), expected);
    EXPECT_EQ(sceneAt(animated, 1.5).cameras.size(), 1U);
    const Bounds bounds = boundsOverTime(animated);
    EXPECT_EQ(bounds.min, glm::vec3(0, 0, 0));
    EXPECT_NEAR(bounds.max.x, 5.0F, 4.0F / 60.0F) << "at the last frame";
    EXPECT_EQ(bounds.max.z, 9.0F);
}

TEST_F(AnimatedSceneTest, AnimationsOfObjectsRunUnlessTheyAreStatic)
{
    m_dir.write("scenes/animated.glb", animatedDocument().glb());
    const AnimatedScene split =
        load(R"({"objects": [{"file": "animated.glb", "place": {"translation": [0, 10, 0]}}]})");
    ASSERT_EQ(split.objects.size(), 1U);
    EXPECT_EQ(split.fixed.triangleCount(), 2U);
    EXPECT_EQ(split.fixed.cameras.at(0).transform[3], glm::vec4(1, 12, 3, 1));
    EXPECT_EQ(corners(sceneAt(split, 1.0)).at(6), glm::vec3(2, 10, 0));
    EXPECT_EQ(corners(sceneAt(split, 3.0)).at(6), glm::vec3(2, 10, 0)) << "the animation lasts two seconds";

    const AnimatedScene still = load(R"({"objects": [{"file": "animated.glb", "static": true}]})");
    EXPECT_TRUE(still.objects.empty());
    EXPECT_EQ(corners(sceneAt(still, 1.0)).at(0), glm::vec3(0, 0, 0));

    const AnimatedScene whole = load(R"({"objects": [{"file": "animated.glb", "dynamic": true}]})");
    ASSERT_EQ(whole.objects.size(), 1U);
    EXPECT_EQ(whole.fixed.triangleCount(), 0U);
    EXPECT_EQ(whole.objects[0].scene->triangleCount(), 3U);
    EXPECT_EQ(whole.fixed.cameras.size(), 1U) << "its place does not move";

    // The motion is applied after the animation.
    const AnimatedScene both = load(R"({"objects": [{"file": "animated.glb", "place": {"scale": 2}, "motion": {"orbit":
        {"axis": [0, 0, 1], "turns": 1}}}]})");
    EXPECT_EQ(corners(sceneAt(both, 1.0)).at(0), glm::vec3(0, 4, 0)) << "2 to the right, scaled, a quarter turn";
    EXPECT_EQ(poseAt(both.objects.at(0), 1.0).transforms.at(0), sceneAt(both, 1.0).instances.at(0).transform);
    EXPECT_TRUE(both.fixed.cameras.empty());
}

/// animatedDocument with more animations: 0 "go" as before, 1 moves nothing, 2 "rise" moves the first node up to y = 6
/// within three seconds, and 3, without a name, moves the second one to x = 1.
GltfBuilder manyAnimationsDocument()
{
    GltfBuilder builder = animatedDocument();
    const auto add = [&builder](std::size_t node, float seconds, const std::vector<float>& end)
    {
        std::vector<float> places = {0, 0, 0};
        places.insert(places.end(), end.begin(), end.end());
        const json sampler = {{"input", builder.addAccessor("SCALAR", kF32, 2, std::vector<float>{0, seconds})},
                              {"output", builder.addAccessor("VEC3", kF32, 2, places)}};
        const json channel = {{"sampler", 0}, {"target", {{"node", node}, {"path", "translation"}}}};
        return builder.add("animations", {{"samplers", json::array({sampler})}, {"channels", json::array({channel})}});
    };
    builder.document["animations"][0]["name"] = "go";
    builder.add("animations", {{"samplers", json::array()}, {"channels", json::array()}, {"name", "nothing"}});
    builder.document["animations"][add(0, 3.0F, {0, 6, 0})]["name"] = "rise";
    add(1, 1.0F, {1, 0, 0});
    return builder;
}

TEST_F(AnimatedSceneTest, TheFirstAnimationOfAFilePlays)
{
    const AnimatedScene animated = loadAnimatedScene(m_dir.write("scenes/many.glb", manyAnimationsDocument().glb()));
    EXPECT_EQ(animated.seconds, 2.0) << "as long as the one that plays";
    EXPECT_EQ(animated.fixed.triangleCount(), 2U) << "what other animations move stands still";
    EXPECT_EQ(corners(sceneAt(animated, 1.5)).at(6), glm::vec3(3, 0, 0));
    const AnimatedScene object = load(R"({"objects": [{"file": "many.glb"}]})");
    EXPECT_EQ(object.fixed.triangleCount(), 2U);
    EXPECT_EQ(corners(sceneAt(object, 1.5)).at(6), glm::vec3(3, 0, 0));
}

TEST_F(AnimatedSceneTest, ObjectsChooseTheAnimationThatPlays)
{
    m_dir.write("scenes/many.glb", manyAnimationsDocument().glb());
    const auto play = [this](const std::string& choice)
    { return load(R"({"objects": [{"file": "many.glb", "animation": )" + choice + "}]}"); };
    for (const char* choice : {"\"rise\"", "2"})
    {
        const AnimatedScene animated = play(choice);
        EXPECT_EQ(animated.objects.at(0).scene->triangleCount(), 1U);
        EXPECT_EQ(corners(sceneAt(animated, 1.0)).at(6), glm::vec3(0, 2, 0)) << choice;
    }
    EXPECT_EQ(corners(sceneAt(play("3"), 0.5)).at(6), glm::vec3(0.5F, 0, 0)) << "the second node";
    // One file, two objects.
    const AnimatedScene both =
        load(R"({"objects": [{"file": "many.glb", "animation": 0}, {"file": "many.glb", "animation": 2}]})");
    ASSERT_EQ(both.objects.size(), 2U);
    EXPECT_EQ(corners(posedScene(*both.objects[0].scene, poseAt(both.objects[0], 1.0))).at(0), glm::vec3(2, 0, 0));
    EXPECT_EQ(corners(posedScene(*both.objects[1].scene, poseAt(both.objects[1], 1.0))).at(0), glm::vec3(0, 2, 0));
}

TEST_F(AnimatedSceneTest, ObjectsShareWhatIsTheSameInTheirFile)
{
    m_dir.write("scenes/many.glb", manyAnimationsDocument().glb());
    const AnimatedScene animated = load(R"({"objects": [
        {"file": "many.glb", "animation": 0}, {"file": "many.glb", "animation": 2}, {"file": "many.glb", "dynamic": true},
        {"file": "many.glb", "animation": 2, "place": {"scale": 2}}, {"file": "many.glb", "dynamic": true}]})");
    ASSERT_EQ(animated.objects.size(), 5U);
    EXPECT_NE(animated.objects[0].scene, animated.objects[1].scene) << "of another animation";
    EXPECT_NE(animated.objects[0].scene, animated.objects[2].scene) << "all of it moves";
    EXPECT_EQ(animated.objects[1].scene, animated.objects[3].scene);
    EXPECT_EQ(animated.objects[2].scene, animated.objects[4].scene);
    // The fixed parts of objects 1 and 3 are the same, that of object 0 is another one; 2 and 4 have none.
    EXPECT_EQ(animated.fixed.triangleCount(), 6U);
    EXPECT_EQ(animated.fixed.primitives.size(), 4U);
    EXPECT_EQ(corners(posedScene(*animated.objects[3].scene, poseAt(animated.objects[3], 1.0))).at(0),
              glm::vec3(0, 4, 0));
}

TEST_F(AnimatedSceneTest, AnimationsThatAreNotThereAreToldWithThoseThatAre)
{
    GltfBuilder many = manyAnimationsDocument();
    m_dir.write("scenes/many.glb", many.glb());
    const auto expectMissing = [this](const std::string& file, const std::string& choice, const std::string& rest)
    {
        expectInputError(
            [&] { load(R"({"objects": [{"file": ")" + file + R"(", "animation": )" + choice + "}]}"); },
            {"test.scene.json: objects[0].animation is " + choice + ", which " + file + " does not have; it " + rest});
    };
    const std::string all = R"(has 0 ("go"), 2 ("rise"), 3)";
    expectMissing("many.glb", "\"walk\"", all);
    expectMissing("many.glb", "\"Rise\"", all);
    expectMissing("many.glb", "\"\"", all);
    expectMissing("many.glb", "\"nothing\"", all);
    expectMissing("many.glb", "1", all);
    expectMissing("many.glb", "4", all);
    expectMissing("triangle.glb", "0", "has no animations that move anything");
    for (int i = 0; i < 9; ++i)
    {
        json copy = many.document["animations"][0];
        many.document["animations"].push_back(copy);
    }
    m_dir.write("scenes/many.glb", many.glb());
    expectMissing("many.glb", "99",
                  R"(has 0 ("go"), 2 ("rise"), 3, 4 ("go"), 5 ("go"), 6 ("go"), 7 ("go"), 8 ("go"), 4 more)");
}

TEST_F(AnimatedSceneTest, WhatStandsAtRestIsMorphed)
{
    GltfBuilder builder = animatedDocument();
    const std::size_t deltas = builder.addPositions({0, 0, 1, 0, 0, 1, 0, 0, 1});
    json& mesh = builder.document["meshes"][1]; // the mesh of the static node
    mesh["primitives"][0]["targets"] = json::array({{{"POSITION", deltas}}});
    mesh["weights"] = {1.0};
    m_dir.write("scenes/morphed.glb", builder.glb());
    const AnimatedScene split = load(R"({"objects": [{"file": "morphed.glb"}]})");
    EXPECT_TRUE(split.warnings.empty());
    EXPECT_EQ(corners(sceneAt(split, 0.0)).at(3), glm::vec3(0, 0, 10));
    const AnimatedScene whole = load(R"({"objects": [{"file": "morphed.glb", "dynamic": true}]})");
    EXPECT_TRUE(whole.warnings.empty());
    EXPECT_EQ(corners(sceneAt(whole, 0.0)).at(6), glm::vec3(0, 0, 10));
    EXPECT_EQ(boundsOverTime(whole).max.z, 10.0F);
}

} // namespace

} // namespace zvo::test
