// SPDX-License-Identifier: MIT
#include "io/scene/animated_scene.h"

#include "animated_scene_fixture.h"
#include "core/scene/scene_size.h"
#include "io/gltf/gltf_builder.h"
#include "support/param_names.h"
#include "support/scenes.h"

#include <cmath>
#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>
#include <numbers>

namespace zvo::test
{

namespace
{

namespace fs = std::filesystem;

TEST_F(AnimatedSceneTest, FilesLieBesideTheSceneFileOrInTheFolderOfScenes)
{
    EXPECT_EQ(loadFileOf("triangle.glb", false).fixed.triangleCount(), 1U);
    EXPECT_EQ(loadFileOf("below/other.glb", false).fixed.triangleCount(), 1U);
    EXPECT_EQ(loadFileOf("below/../triangle.glb", false).fixed.triangleCount(), 1U);
    EXPECT_EQ(corners(loadFileOf("far.glb").fixed).at(0), glm::vec3(10, 20, 30));
    m_dir.write("models/triangle.glb", movedTriangle().glb());
    EXPECT_EQ(corners(loadFileOf("triangle.glb").fixed).at(0), glm::vec3(0, 0, 0)) << "what lies beside comes first";
    expectInputError([&] { loadFileOf("far.glb", false); },
                     {"test.scene.json: objects[0].file is \"far.glb\", which is not in ",
                      "scenes; scenes_folder tells where else to look"});
    expectInputError([&] { loadFileOf("absent.glb"); }, {"\"absent.glb\", which is not in ", " or ", "models"});
}

TEST_F(AnimatedSceneTest, FilesThatLeaveTheFoldersAreRefused)
{
    fs::create_symlink(m_dir.path() / "outside.glb", m_dir.path() / "scenes" / "link.glb");
    fs::create_directory_symlink(m_dir.path() / "models", m_dir.path() / "scenes" / "way");
    const std::vector<std::string> files = {"../outside.glb",
                                            "below/../../outside.glb",
                                            "../scenes2/absent.glb",
                                            (m_dir.path() / "outside.glb").string(),
                                            (m_dir.path() / "scenes" / "triangle.glb").string(),
                                            "/etc/passwd",
                                            "/dev/zero",
                                            "link.glb",
                                            "way/far.glb"};
    for (const std::string& file : files)
    {
        expectInputError([&] { loadFileOf(file); }, {"test.scene.json: objects[0].file is \"", "leaves the folder"});
        expectInputError([&] { loadFileOf(file, false); }, {"leaves the folder"});
    }
    // "../scenes/triangle.glb" leads back into the folder.
    EXPECT_EQ(loadFileOf("../scenes/triangle.glb").fixed.triangleCount(), 1U);
}

TEST_F(AnimatedSceneTest, WhatIsNoModelIsAnInputError)
{
    expectInputError([&] { loadFileOf(""); }, {"Is a directory"});
    expectInputError([&] { loadFileOf("below"); }, {"Is a directory"});
    expectInputError([&] { loadFileOf("test.scene.json"); }, {"a scene file, which cannot be part of another"});
    m_dir.write("scenes/bad.glb", std::string_view("glTF"));
    expectInputError([&] { loadFileOf("bad.glb"); }, {"bad.glb"});
    expectInputError([&] { loadAnimatedScene(m_dir.path() / "absent.scene.json"); },
                     {"absent.scene.json", "No such file"});
    expectInputError([&] { load(std::string((std::size_t{4} << 20U) + 1, ' ')); }, {"4194305 bytes"});
}

TEST_F(AnimatedSceneTest, PlacesThatOverflowAreAnInputError)
{
    expectInputError(
        [&] { load(R"({"objects": [{"file": "triangle.glb"}, {"file": "far.glb", "place": {"scale": 3e38}}]})"); },
        {"objects[1].place makes the object larger than single precision holds"});
}

TEST_F(AnimatedSceneTest, SceneFilesAreToldByTheirName)
{
    EXPECT_TRUE(isSceneFile("a.scene.json"));
    EXPECT_TRUE(isSceneFile("folder/a.b.Scene.JSON"));
    for (const char* name : {"scene.json", "a.json", "a.scene.glb", "a.scene.json.glb", "a.scene.json/b.glb"})
    {
        EXPECT_FALSE(isSceneFile(name)) << name;
    }
}

constexpr const char* kThree = R"({"seconds": 2, "frames_per_second": 4, "objects": [
    {"file": "triangle.glb", "place": {"translation": [1, 0, 0]}},
    {"file": "far.glb", "name": "slides", "motion": {"line": {"from": [0, 0, 0], "to": [4, 0, 0]}}},
    {"file": "triangle.glb", "name": "waits", "dynamic": true, "place": {"scale": 3}},
    {"file": "far.glb", "static": true, "place": {"translation": [0, 0, 5], "scale": 2}}]})";

TEST_F(AnimatedSceneTest, ObjectsAreFixedOrMove)
{
    const AnimatedScene animated = load(kThree);
    EXPECT_EQ(animated.fixed.triangleCount(), 2U);
    ASSERT_EQ(animated.objects.size(), 2U);
    EXPECT_EQ(animated.objects[0].name, "slides");
    EXPECT_EQ(animated.objects[1].name, "waits");
    EXPECT_EQ(animated.files.size(), 5U);
    EXPECT_EQ(corners(animated.fixed), (std::vector<glm::vec3>{{1, 0, 0},
                                                               {2, 0, 0},
                                                               {1, 1, 0}, //
                                                               {20, 40, 65},
                                                               {24, 40, 65},
                                                               {20, 44, 65}}));
    // The fixed object's camera is loaded, the moving one's is not.
    ASSERT_EQ(animated.fixed.cameras.size(), 1U);
    EXPECT_EQ(animated.fixed.cameras[0].transform[3], glm::vec4(0, 0, 7, 1));
    EXPECT_EQ(animated.fixed.cameras[0].half_height, 6.0F);
}

TEST_F(AnimatedSceneTest, AtATimeEverythingIsOneScene)
{
    const AnimatedScene animated = load(kThree);
    const std::vector<glm::vec3> expected = {{1, 0, 0},    {2, 0, 0},    {1, 1, 0},    {20, 40, 65},
                                             {24, 40, 65}, {20, 44, 65}, {11, 20, 30}, {13, 20, 30},
                                             {11, 22, 30}, {0, 0, 0},    {3, 0, 0},    {0, 3, 0}};
    const Scene scene = sceneAt(animated, 0.5); // a quarter of the line
    EXPECT_EQ(corners(scene), expected);
    EXPECT_EQ(scene.cameras.size(), 1U);
    EXPECT_EQ(corners(sceneAt(AnimatedScene(animated), 0.5)), expected);
    EXPECT_EQ(corners(sceneAt(animated, 0.0)).at(6), glm::vec3(10, 20, 30));
}

TEST_F(AnimatedSceneTest, TransformsAreComposedInDoublePrecisionAndRoundedOnce)
{
    const AnimatedScene animated = load(R"({"objects": [{"file": "far.glb",
        "place": {"translation": [0.1, -0.7, 1e3], "scale": 0.3, "rotation": {"axis": [1, 2, 3], "degrees": 77}},
        "motion": {"orbit": {"centre": [1e3, 0, 3], "axis": [0.2, 1, 0], "turns": 1}}}]})");
    const glm::dvec3 axis = glm::normalize(glm::dvec3(0.2, 1, 0));
    for (const double seconds : {0.3, 1.7, 3.99})
    {
        // GLM's rotations and products, all in double precision.
        glm::dmat4 expected = glm::translate(glm::dmat4(1.0), glm::dvec3(1e3, 0, 3));
        expected = glm::rotate(expected, 2.0 * std::numbers::pi * seconds / 4.0, axis);
        expected = glm::translate(expected, glm::dvec3(-1e3, 0, -3));
        expected = glm::translate(expected, glm::dvec3(0.1, -0.7, 1e3));
        expected = glm::rotate(expected, glm::radians(77.0), glm::normalize(glm::dvec3(1, 2, 3)));
        expected = glm::scale(expected, glm::dvec3(0.3));
        expected = glm::translate(expected, glm::dvec3(10, 20, 30));
        expected = glm::scale(expected, glm::dvec3(2));
        const glm::mat4 transform = sceneAt(animated, seconds).instances.at(0).transform;
        for (int i = 0; i < 16; ++i)
        {
            // Half a unit in the last place, and the rounding of double precision for numbers around 1e3.
            const double exact = expected[i / 4][i % 4];
            EXPECT_NEAR(transform[i / 4][i % 4], exact, std::abs(exact) * 0x1p-24 + 1e-11);
        }
    }
}

TEST_F(AnimatedSceneTest, PlacesWithoutEffectChangeNoBit)
{
    GltfBuilder builder = triangleDocument();
    builder.document["nodes"][0]["translation"] = {1.0 / 3.0, -7.1, 1e-4};
    builder.document["nodes"][0]["rotation"] = {0.1, 0.2, 0.3, 0.9};
    m_dir.write("scenes/odd.glb", builder.glb());
    const AnimatedScene animated =
        load(R"({"objects": [{"file": "odd.glb"}, {"file": "odd.glb", "motion": {"orbit": {"turns": 3}}}]})");
    const glm::mat4 transform = builder.load().instances.at(0).transform;
    EXPECT_EQ(sceneAt(animated, 0.0).instances.at(0).transform, transform);
    EXPECT_EQ(sceneAt(animated, 0.0).instances.at(1).transform, transform);
}

TEST_F(AnimatedSceneTest, FramesThatShowTheSameHaveTheSameTime)
{
    AnimatedScene animated;
    for (const double rate : {30.0, 24.0, 29.97, 0.3, 7.0})
    {
        for (const double seconds : {4.0, 10.0, 1.0 / 3.0, 100.0})
        {
            animated.seconds = seconds;
            animated.frames_per_second = rate;
            const double count = seconds * rate;
            for (std::uint64_t frame = 0; frame < 5000; ++frame)
            {
                const double time = frameTime(animated, frame);
                ASSERT_GE(time, 0.0);
                ASSERT_LT(time, seconds);
                const double ahead = static_cast<double>(frame) / rate - time;
                ASSERT_NEAR(ahead / seconds, std::round(ahead / seconds), 1e-9);
                if (count == std::round(count))
                {
                    ASSERT_EQ(frameTime(animated, frame + static_cast<std::uint64_t>(count)), time);
                }
            }
        }
    }
    animated.seconds = 4.0;
    animated.frames_per_second = 30.0;
    EXPECT_EQ(frameTime(animated, 121), 1.0 / 30.0);
    EXPECT_EQ(loopedTime(animated, 4.0), 0.0);
    EXPECT_EQ(loopedTime(animated, 9.5), 1.5);
}

TEST_F(AnimatedSceneTest, BoundsHoldEverythingAtAllTimesAndNotMuchMore)
{
    const AnimatedScene animated = load(R"({"seconds": 3, "objects": [{"file": "triangle.glb"},
        {"file": "far.glb", "place": {"translation": [-10, -20, -30]},
         "motion": {"orbit": {"centre": [5, 0, 0], "axis": [1, 3, 1], "turns": 0.7}}},
        {"file": "far.glb", "motion": {"line": {"from": [-40, 1, -30], "to": [20, 3, 1], "seconds": 1.3}}},
        {"file": "triangle.glb", "place": {"translation": [0, 0, 3]}, "motion": {"keys": {"times": [0.5, 1, 2.5],
         "rotations": [{"axis": [0, 1, 0], "degrees": 0}, {"axis": [1, 1, 0], "degrees": 150},
                       {"axis": [0, 1, 1], "degrees": -90}], "scales": [1, 5, 2]}}}]})");
    const Bounds bounds = boundsOverTime(animated);
    Bounds reached;
    constexpr int kTimes = 20000;
    for (int i = 0; i < kTimes; ++i)
    {
        for (const glm::vec3& point : corners(sceneAt(animated, animated.seconds * i / kTimes)))
        {
            reached.extend(point);
        }
    }
    EXPECT_TRUE(glm::all(glm::lessThanEqual(bounds.min, reached.min)));
    EXPECT_TRUE(glm::all(glm::greaterThanEqual(bounds.max, reached.max)));
    const float slack = 0.005F * glm::length(reached.max - reached.min);
    EXPECT_TRUE(glm::all(glm::greaterThan(bounds.min, reached.min - slack)));
    EXPECT_TRUE(glm::all(glm::lessThan(bounds.max, reached.max + slack)));
}

TEST_F(AnimatedSceneTest, BoundsOfWhatStandsStillAreTheScenes)
{
    const AnimatedScene animated =
        load(R"({"objects": [{"file": "far.glb", "dynamic": true}, {"file": "triangle.glb"}]})");
    const Bounds bounds = boundsOverTime(animated);
    EXPECT_EQ(bounds.min, sceneAt(animated, 0.0).bounds().min);
    EXPECT_EQ(bounds.max, sceneAt(animated, 0.0).bounds().max);
}

TEST_F(AnimatedSceneTest, ObjectsOfNoSizeHaveAPlace)
{
    const AnimatedScene animated =
        load(R"({"objects": [{"file": "far.glb", "place": {"scale": 0, "translation": [1, 2, 3]},
        "motion": {"line": {"from": [0, 0, 0], "to": [4, 0, 0]}}}]})");
    EXPECT_EQ(corners(sceneAt(animated, 2.0)), (std::vector<glm::vec3>(3, {3, 2, 3})));
    EXPECT_NEAR(boundsOverTime(animated).max.x, 5.0, 1e-4);
}

TEST_F(AnimatedSceneTest, CameraOfAStaticObjectCanBeNamed)
{
    const std::string objects = R"("objects": [{"file": "far.glb"}, {"file": "triangle.glb"}])";
    for (const char* name : {"far", "auto", "close"})
    {
        EXPECT_EQ(
            std::get<std::string>(load(R"({"camera": ")" + std::string(name) + "\", " + objects + "}").camera.value()),
            name);
    }
    expectInputError([&] { load(R"({"camera": "near", )" + objects + "}"); },
                     {"test.scene.json: camera is \"near\"; expected one of auto, close, far"});
}

TEST_F(AnimatedSceneTest, WarningsOfAFileAreToldOnce)
{
    GltfBuilder builder = triangleDocument();
    builder.document["meshes"][0]["primitives"].push_back(builder.document["meshes"][0]["primitives"][0]);
    builder.document["meshes"][0]["primitives"][1]["mode"] = kLines;
    m_dir.write("scenes/points.glb", builder.glb());
    const AnimatedScene animated =
        load(R"({"objects": [{"file": "points.glb"}, {"file": "points.glb"}, {"file": "points.glb"}]})");
    EXPECT_EQ(animated.warnings.size(), 1U);
    EXPECT_EQ(animated.fixed.triangleCount(), 3U);
}

TEST_F(AnimatedSceneTest, ManyObjectsOfOneFile)
{
    std::string text = R"({"objects": [{"file": "triangle.glb")";
    for (int i = 1; i < 256; ++i)
    {
        text += R"(}, {"file": "triangle.glb", "motion": {"orbit": {"turns": )" + std::to_string(i) + "}}";
    }
    const AnimatedScene animated = load(text + "}]}");
    EXPECT_EQ(animated.objects.size(), 255U);
    EXPECT_EQ(sceneAt(animated, 1.0).triangleCount(), 256U);
}

TEST_F(AnimatedSceneTest, ObjectsOfOneFileShareItsMeshes)
{
    GltfBuilder builder = triangleDocument();
    builder.document["nodes"].push_back({{"mesh", 0}, {"translation", {0, 0, 5}}});
    m_dir.write("scenes/two.glb", builder.glb());
    const AnimatedScene animated = load(R"({"objects": [
        {"file": "two.glb", "static": true}, {"file": "two.glb", "dynamic": true},
        {"file": "two.glb", "static": true, "place": {"translation": [7, 0, 0]}},
        {"file": "two.glb", "dynamic": true, "place": {"translation": [0, 7, 0]}}, {"file": "triangle.glb"}]})");
    EXPECT_EQ(animated.fixed.primitives.size(), 2U);
    ASSERT_EQ(animated.objects.size(), 2U);
    EXPECT_EQ(animated.objects[0].scene, animated.objects[1].scene);
    EXPECT_EQ(corners(sceneAt(animated, 0.0)),
              (std::vector<glm::vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 5}, {1, 0, 5}, {0, 1, 5}, //
                                      {7, 0, 0}, {8, 0, 0}, {7, 1, 0}, {7, 0, 5}, {8, 0, 5}, {7, 1, 5}, //
                                      {0, 0, 0}, {1, 0, 0}, {0, 1, 0},                                  //
                                      {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 5}, {1, 0, 5}, {0, 1, 5}, //
                                      {0, 7, 0}, {1, 7, 0}, {0, 8, 0}, {0, 7, 5}, {1, 7, 5}, {0, 8, 5}}));
}

TEST_F(AnimatedSceneTest, MeshesOfAFileCountOnceHoweverManyObjectsShowThem)
{
    // The objects' meshes would take more memory than a file's may, if each had its own.
    constexpr int kObjects = 4096;
    const std::uint64_t vertex_count = sceneBytesMax() / (sizeof(glm::vec3) * kObjects) + 1;
    GltfBuilder builder = triangleDocument();
    const json& attributes = builder.document["meshes"][0]["primitives"][0]["attributes"];
    json& position = builder.document["accessors"][attributes["POSITION"].get<std::size_t>()];
    position["count"] = vertex_count;
    position.erase("bufferView"); // zeros
    position["min"] = {0, 0, 0};
    position["max"] = {0, 0, 0};
    m_dir.write("scenes/large.glb", builder.glb());
    std::string text;
    for (int i = 0; i < kObjects; ++i)
    {
        text += fmt::format(R"({}{{"file": "large.glb"}})", i == 0 ? "" : ", ");
    }
    const AnimatedScene animated = load(R"({"objects": [)" + text + "]}");
    ASSERT_EQ(animated.fixed.primitives.size(), 1U);
    EXPECT_EQ(animated.fixed.primitives[0].positions.size(), vertex_count);
    EXPECT_EQ(animated.fixed.instances.size(), static_cast<std::size_t>(kObjects));
}

class OwnAnimatedScene : public testing::TestWithParam<std::string>
{
};

INSTANTIATE_TEST_SUITE_P(AnimatedScene, OwnAnimatedScene,
                         testing::Values("atrium_knot", "buddha_dragon", "sponza_bunny"), paramName<std::string>);

TEST_P(OwnAnimatedScene, IsWhole)
{
    const fs::path path = ownScene(GetParam() + ".scene.json");
    const fs::path models = modelsFolder();
    if (const std::string model = missingModelOf(GetParam()); !model.empty())
    {
        GTEST_SKIP() << model << " is not there";
    }
    const AnimatedScene animated = loadAnimatedScene(path, {models});
    EXPECT_GT(animated.fixed.triangleCount(), 0U);
    ASSERT_EQ(animated.objects.size(), 1U);
    EXPECT_EQ(frameTime(animated, 120), 0.0) << "frames 0..119 are one round";
    EXPECT_NE(transformAt(animated.objects[0], 1.0), transformAt(animated.objects[0], 0.0));
}

} // namespace

} // namespace zvo::test
