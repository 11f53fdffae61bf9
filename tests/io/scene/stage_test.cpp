// SPDX-License-Identifier: MIT
#include "io/scene/stage.h"

#include "io/gltf/gltf_builder.h"
#include "stage_fixture.h"
#include "support/param_names.h"
#include "support/scenes.h"

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>
#include <numbers>

namespace zvo::test
{

namespace
{

namespace fs = std::filesystem;

TEST_F(StageTest, FilesLieBesideTheSceneFileOrInTheFolderOfScenes)
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

TEST_F(StageTest, FilesThatLeaveTheFoldersAreRefused)
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
    // "../scenes/triangle.glb" goes out and comes back: it lies in the folder.
    EXPECT_EQ(loadFileOf("../scenes/triangle.glb").fixed.triangleCount(), 1U);
}

TEST_F(StageTest, WhatIsNoModelIsAnInputError)
{
    expectInputError([&] { loadFileOf(""); }, {"Is a directory"});
    expectInputError([&] { loadFileOf("below"); }, {"Is a directory"});
    expectInputError([&] { loadFileOf("test.scene.json"); }, {"a scene file, which cannot be part of another"});
    m_dir.write("scenes/bad.glb", std::string_view("glTF"));
    expectInputError([&] { loadFileOf("bad.glb"); }, {"bad.glb"});
    expectInputError([&] { loadStage(m_dir.path() / "absent.scene.json"); }, {"absent.scene.json", "No such file"});
    expectInputError([&] { load(std::string((std::size_t{4} << 20U) + 1, ' ')); }, {"4194305 bytes"});
}

TEST_F(StageTest, PlacesThatOverflowAreAnInputError)
{
    expectInputError(
        [&] { load(R"({"objects": [{"file": "triangle.glb"}, {"file": "far.glb", "place": {"scale": 3e38}}]})"); },
        {"objects[1].place makes the object larger than single precision holds"});
}

TEST_F(StageTest, SceneFilesAreToldByTheirName)
{
    EXPECT_TRUE(isStageFile("a.scene.json"));
    EXPECT_TRUE(isStageFile("folder/a.b.Scene.JSON"));
    for (const char* name : {"scene.json", "a.json", "a.scene.glb", "a.scene.json.glb", "a.scene.json/b.glb"})
    {
        EXPECT_FALSE(isStageFile(name)) << name;
    }
}

constexpr const char* kThree = R"({"seconds": 2, "frames_per_second": 4, "objects": [
    {"file": "triangle.glb", "place": {"translation": [1, 0, 0]}},
    {"file": "far.glb", "name": "slides", "motion": {"line": {"from": [0, 0, 0], "to": [4, 0, 0]}}},
    {"file": "triangle.glb", "name": "waits", "dynamic": true, "place": {"scale": 3}},
    {"file": "far.glb", "static": true, "place": {"translation": [0, 0, 5], "scale": 2}}]})";

TEST_F(StageTest, ObjectsAreFixedOrMove)
{
    const Stage stage = load(kThree);
    EXPECT_EQ(stage.fixed.triangleCount(), 2U);
    ASSERT_EQ(stage.movers.size(), 2U);
    EXPECT_EQ(stage.movers[0].name, "slides");
    EXPECT_EQ(stage.movers[1].name, "waits");
    EXPECT_EQ(stage.files.size(), 5U);
    EXPECT_EQ(corners(stage.fixed), (std::vector<glm::vec3>{{1, 0, 0},
                                                            {2, 0, 0},
                                                            {1, 1, 0}, //
                                                            {20, 40, 65},
                                                            {24, 40, 65},
                                                            {20, 44, 65}}));
    // The fixed object's camera goes along, the moving one's does not come.
    ASSERT_EQ(stage.fixed.cameras.size(), 1U);
    EXPECT_EQ(stage.fixed.cameras[0].transform[3], glm::vec4(0, 0, 7, 1));
    EXPECT_EQ(stage.fixed.cameras[0].half_height, 6.0F);
}

TEST_F(StageTest, AtATimeEverythingIsOneScene)
{
    const Stage stage = load(kThree);
    const std::vector<glm::vec3> expected = {{1, 0, 0},    {2, 0, 0},    {1, 1, 0},    {20, 40, 65},
                                             {24, 40, 65}, {20, 44, 65}, {11, 20, 30}, {13, 20, 30},
                                             {11, 22, 30}, {0, 0, 0},    {3, 0, 0},    {0, 3, 0}};
    const Scene scene = stageAt(stage, 0.5); // a quarter of the line
    EXPECT_EQ(corners(scene), expected);
    EXPECT_EQ(scene.cameras.size(), 1U);
    EXPECT_EQ(corners(stageAt(Stage(stage), 0.5)), expected);
    EXPECT_EQ(corners(stageAt(stage, 0.0)).at(6), glm::vec3(10, 20, 30));
}

TEST_F(StageTest, TransformsAreComposedInDoublePrecisionAndRoundedOnce)
{
    const Stage stage = load(R"({"objects": [{"file": "far.glb",
        "place": {"translation": [0.1, -0.7, 1e3], "scale": 0.3, "rotation": {"axis": [1, 2, 3], "degrees": 77}},
        "motion": {"orbit": {"centre": [1e3, 0, 3], "axis": [0.2, 1, 0], "turns": 1}}}]})");
    const glm::dvec3 axis = glm::normalize(glm::dvec3(0.2, 1, 0));
    for (const double seconds : {0.3, 1.7, 3.99})
    {
        // GLM's own rotations and products, in double precision throughout.
        glm::dmat4 expected = glm::translate(glm::dmat4(1.0), glm::dvec3(1e3, 0, 3));
        expected = glm::rotate(expected, 2.0 * std::numbers::pi * seconds / 4.0, axis);
        expected = glm::translate(expected, glm::dvec3(-1e3, 0, -3));
        expected = glm::translate(expected, glm::dvec3(0.1, -0.7, 1e3));
        expected = glm::rotate(expected, glm::radians(77.0), glm::normalize(glm::dvec3(1, 2, 3)));
        expected = glm::scale(expected, glm::dvec3(0.3));
        expected = glm::translate(expected, glm::dvec3(10, 20, 30));
        expected = glm::scale(expected, glm::dvec3(2));
        const glm::mat4 transform = stageAt(stage, seconds).instances.at(0).transform;
        for (int i = 0; i < 16; ++i)
        {
            // Half a unit in the last place, and what double precision leaves of numbers around 1e3.
            const double exact = expected[i / 4][i % 4];
            EXPECT_NEAR(transform[i / 4][i % 4], exact, std::abs(exact) * 0x1p-24 + 1e-11);
        }
    }
}

TEST_F(StageTest, PlacesWithoutEffectChangeNoBit)
{
    GltfBuilder builder = triangleDocument();
    builder.document["nodes"][0]["translation"] = {1.0 / 3.0, -7.1, 1e-4};
    builder.document["nodes"][0]["rotation"] = {0.1, 0.2, 0.3, 0.9};
    m_dir.write("scenes/odd.glb", builder.glb());
    const Stage stage =
        load(R"({"objects": [{"file": "odd.glb"}, {"file": "odd.glb", "motion": {"orbit": {"turns": 3}}}]})");
    const glm::mat4 transform = builder.load().instances.at(0).transform;
    EXPECT_EQ(stageAt(stage, 0.0).instances.at(0).transform, transform);
    EXPECT_EQ(stageAt(stage, 0.0).instances.at(1).transform, transform);
}

TEST_F(StageTest, FramesThatShowTheSameHaveTheSameTime)
{
    Stage stage;
    for (const double rate : {30.0, 24.0, 29.97, 0.3, 7.0})
    {
        for (const double seconds : {4.0, 10.0, 1.0 / 3.0, 100.0})
        {
            stage.seconds = seconds;
            stage.frames_per_second = rate;
            const double count = seconds * rate;
            for (std::uint64_t frame = 0; frame < 5000; ++frame)
            {
                const double time = frameTime(stage, frame);
                ASSERT_GE(time, 0.0);
                ASSERT_LT(time, seconds);
                const double ahead = static_cast<double>(frame) / rate - time;
                ASSERT_NEAR(ahead / seconds, std::round(ahead / seconds), 1e-9);
                if (count == std::round(count))
                {
                    ASSERT_EQ(frameTime(stage, frame + static_cast<std::uint64_t>(count)), time);
                }
            }
        }
    }
    stage.seconds = 4.0;
    stage.frames_per_second = 30.0;
    EXPECT_EQ(frameTime(stage, 121), 1.0 / 30.0);
    EXPECT_EQ(loopedTime(stage, 4.0), 0.0);
    EXPECT_EQ(loopedTime(stage, 9.5), 1.5);
}

TEST_F(StageTest, BoundsHoldEverythingAtAllTimesAndNotMuchMore)
{
    const Stage stage = load(R"({"seconds": 3, "objects": [{"file": "triangle.glb"},
        {"file": "far.glb", "place": {"translation": [-10, -20, -30]},
         "motion": {"orbit": {"centre": [5, 0, 0], "axis": [1, 3, 1], "turns": 0.7}}},
        {"file": "far.glb", "motion": {"line": {"from": [-40, 1, -30], "to": [20, 3, 1], "seconds": 1.3}}},
        {"file": "triangle.glb", "place": {"translation": [0, 0, 3]}, "motion": {"keys": {"times": [0.5, 1, 2.5],
         "rotations": [{"axis": [0, 1, 0], "degrees": 0}, {"axis": [1, 1, 0], "degrees": 150},
                       {"axis": [0, 1, 1], "degrees": -90}], "scales": [1, 5, 2]}}}]})");
    const Bounds bounds = stageBounds(stage);
    Bounds reached;
    constexpr int kTimes = 20000;
    for (int i = 0; i < kTimes; ++i)
    {
        for (const glm::vec3& point : corners(stageAt(stage, stage.seconds * i / kTimes)))
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

TEST_F(StageTest, BoundsOfWhatStandsStillAreTheScenes)
{
    const Stage stage = load(R"({"objects": [{"file": "far.glb", "dynamic": true}, {"file": "triangle.glb"}]})");
    const Bounds bounds = stageBounds(stage);
    EXPECT_EQ(bounds.min, stageAt(stage, 0.0).bounds().min);
    EXPECT_EQ(bounds.max, stageAt(stage, 0.0).bounds().max);
}

TEST_F(StageTest, ObjectsOfNoSizeHaveAPlace)
{
    const Stage stage = load(R"({"objects": [{"file": "far.glb", "place": {"scale": 0, "translation": [1, 2, 3]},
        "motion": {"line": {"from": [0, 0, 0], "to": [4, 0, 0]}}}]})");
    EXPECT_EQ(corners(stageAt(stage, 2.0)), (std::vector<glm::vec3>(3, {3, 2, 3})));
    EXPECT_NEAR(stageBounds(stage).max.x, 5.0, 1e-4);
}

TEST_F(StageTest, CameraOfAStaticObjectCanBeNamed)
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

TEST_F(StageTest, WarningsOfAFileAreToldOnce)
{
    GltfBuilder builder = triangleDocument();
    builder.document["meshes"][0]["primitives"].push_back(builder.document["meshes"][0]["primitives"][0]);
    builder.document["meshes"][0]["primitives"][1]["mode"] = kPoints;
    m_dir.write("scenes/points.glb", builder.glb());
    const Stage stage =
        load(R"({"objects": [{"file": "points.glb"}, {"file": "points.glb"}, {"file": "points.glb"}]})");
    EXPECT_EQ(stage.warnings.size(), 1U);
    EXPECT_EQ(stage.fixed.triangleCount(), 3U);
}

TEST_F(StageTest, ManyObjectsOfOneFile)
{
    std::string text = R"({"objects": [{"file": "triangle.glb")";
    for (int i = 1; i < 256; ++i)
    {
        text += R"(}, {"file": "triangle.glb", "motion": {"orbit": {"turns": )" + std::to_string(i) + "}}";
    }
    const Stage stage = load(text + "}]}");
    EXPECT_EQ(stage.movers.size(), 255U);
    EXPECT_EQ(stageAt(stage, 1.0).triangleCount(), 256U);
}

class OwnStage : public testing::TestWithParam<std::string>
{
};

INSTANTIATE_TEST_SUITE_P(Stage, OwnStage, testing::Values("atrium_knot", "buddha_dragon", "sponza_bunny"),
                         paramName<std::string>);

TEST_P(OwnStage, IsWhole)
{
    const fs::path path = ownScene(GetParam() + ".scene.json");
    const fs::path models = ZVO_SHARED_SCENES_DIR;
    if (const std::string model = missingModelOf(GetParam()); !model.empty())
    {
        GTEST_SKIP() << model << " is not there";
    }
    const Stage stage = loadStage(path, {models});
    EXPECT_GT(stage.fixed.triangleCount(), 0U);
    ASSERT_EQ(stage.movers.size(), 1U);
    EXPECT_EQ(frameTime(stage, 120), 0.0) << "frames 0..119 are one round";
    EXPECT_NE(placeAt(stage.movers[0], 1.0), placeAt(stage.movers[0], 0.0));
}

} // namespace

} // namespace zvo::test
