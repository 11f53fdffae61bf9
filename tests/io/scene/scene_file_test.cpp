// SPDX-License-Identifier: MIT
#include "io/scene/scene_file.h"

#include "io/gltf/gltf_builder.h"

#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <ostream>

namespace zvo::test
{

namespace
{

constexpr double kClose = 1e-12;

SceneFile parse(const std::string& content)
{
    return parseSceneFile(content, "folder/test.scene.json");
}

/// The text of a file with one object that has these members.
std::string objectText(const std::string& members)
{
    return R"({"objects": [{"file": "a.glb", )" + members + "}]}";
}

std::string motionText(const std::string& motion)
{
    return objectText(R"("motion": {)" + motion + "}");
}

SceneFileObject parseObject(const std::string& members)
{
    return parse(objectText(members)).objects.at(0);
}

TEST(SceneFile, DefaultsAreThoseOfTheDocumentation)
{
    const SceneFile file = parse(R"({"objects": [{"file": "models/Bunny.low.glb"}]})");
    ASSERT_EQ(file.objects.size(), 1U);
    const SceneFileObject& object = file.objects[0];
    EXPECT_EQ(object.name, "Bunny.low");
    EXPECT_EQ(object.file, "models/Bunny.low.glb");
    EXPECT_EQ(object.where, "objects[0]");
    EXPECT_EQ(object.up, UpAxis::Y);
    EXPECT_EQ(object.transform, glm::dmat4(1.0));
    EXPECT_TRUE(std::holds_alternative<std::monostate>(object.motion));
    EXPECT_EQ(object.is_dynamic, std::nullopt);
    EXPECT_EQ(file.seconds, 4.0);
    EXPECT_EQ(file.frames_per_second, 30.0);
    EXPECT_EQ(file.grid_depth, std::nullopt);
    EXPECT_FALSE(file.grid_bounds);
    EXPECT_FALSE(file.camera);
    EXPECT_EQ(file.merge, MergeRule::Average);
}

TEST(SceneFile, EveryMemberOfTheDocumentIsRead)
{
    const SceneFile file = parse(R"({
        "about": "a test", "seconds": 2.5, "frames_per_second": 24, "merge": "static",
        "grid": {"depth": 7, "bounds": {"min": [-1, -2, -3], "max": [1, 2, 3.5]}},
        "camera": {"eye": [0, 1, 5], "target": [0, 1, 0], "fov": 90},
        "objects": [{"file": "a.glb", "static": true}, {"file": "b.glb", "dynamic": true, "name": "B"},
                    {"file": "c.glb", "static": false}]})");
    EXPECT_EQ(file.seconds, 2.5);
    EXPECT_EQ(file.frames_per_second, 24.0);
    EXPECT_EQ(file.merge, MergeRule::StaticWins);
    EXPECT_EQ(file.grid_depth, 7U);
    ASSERT_TRUE(file.grid_bounds);
    EXPECT_EQ(file.grid_bounds->min, glm::vec3(-1, -2, -3));
    EXPECT_EQ(file.grid_bounds->max, glm::vec3(1, 2, 3.5));
    const auto& camera = std::get<ViewCamera>(file.camera.value());
    EXPECT_EQ(camera.position, glm::dvec3(0, 1, 5));
    EXPECT_EQ(camera.forward, glm::dvec3(0, 0, -1));
    EXPECT_NEAR(camera.vertical_fov, 0.5 * std::numbers::pi, kClose);
    EXPECT_EQ(file.objects.at(0).is_dynamic, false);
    EXPECT_EQ(file.objects.at(1).is_dynamic, true);
    EXPECT_EQ(file.objects.at(1).name, "B");
    EXPECT_EQ(file.objects.at(2).is_dynamic, true);
    EXPECT_EQ(parse(R"({"objects": [{"file": "a"}], "merge": "dynamic"})").merge, MergeRule::DynamicWins);
    EXPECT_EQ(std::get<std::string>(parse(R"({"objects": [{"file": "a"}], "camera": "roof"})").camera.value()), "roof");
}

TEST(SceneFile, PlaceScalesThenTurnsThenMoves)
{
    const SceneFileObject object = parseObject(R"("up": "z", "place": {"translation": [10, 20, 30],
        "rotation": {"axis": [0, 2, 0], "degrees": 90}, "scale": [2, 3, 4]})");
    // z up becomes y up: (1, 2, 3) is (1, 3, -2), scaled (2, 9, -8). A quarter turn about y moves x to -z and z to x.
    EXPECT_EQ(object.transform * glm::dvec4(1, 2, 3, 1), glm::dvec4(10 - 8, 20 + 9, 30 - 2, 1));
    const SceneFileObject uniform = parseObject(R"("place": {"scale": 0.5})");
    EXPECT_EQ(uniform.transform, glm::dmat4(glm::dmat3(0.5)));
    const SceneFileObject turned = parseObject(R"("place": {"rotation": {"axis": [1, 1, 1], "degrees": 120}})");
    const glm::dvec4 point = turned.transform * glm::dvec4(1, 2, 3, 1);
    EXPECT_NEAR(point.x, 3.0, kClose);
    EXPECT_NEAR(point.y, 1.0, kClose);
    EXPECT_NEAR(point.z, 2.0, kClose);
}

TEST(SceneFile, OrbitIsReadInTurnsOrDegrees)
{
    const auto orbit = std::get<OrbitMotion>(parseObject(R"("place": {"translation": [1, 2, 3]},
        "motion": {"orbit": {"turns": 2}})")
                                                 .motion);
    EXPECT_EQ(orbit.center, glm::dvec3(1, 2, 3)) << "where the object is";
    EXPECT_EQ(orbit.home, glm::dvec3(1, 2, 3));
    EXPECT_EQ(orbit.axis, glm::dvec3(0, 1, 0));
    EXPECT_EQ(orbit.turns_per_second, 0.5) << "twice in 4 seconds";
    EXPECT_TRUE(orbit.circles && orbit.spins);
    const auto full = std::get<OrbitMotion>(parseObject(R"("place": {"translation": [1, 2, 3]}, "motion": {"orbit":
        {"centre": [4, 5, 6], "axis": [3, 0, 4], "degrees_per_second": -90, "circles": true, "spins": false}})")
                                                .motion);
    EXPECT_EQ(full.center, glm::dvec3(4, 5, 6));
    EXPECT_EQ(full.home, glm::dvec3(1, 2, 3));
    EXPECT_NEAR(full.axis.x, 0.6, kClose);
    EXPECT_NEAR(full.axis.z, 0.8, kClose);
    EXPECT_EQ(full.turns_per_second, -0.25);
    EXPECT_TRUE(full.circles && !full.spins);
    EXPECT_EQ(parseObject(R"("motion": {"orbit": {"turns": 2}})").is_dynamic, true);
}

TEST(SceneFile, AnimationsAreNamedOrNumbered)
{
    EXPECT_EQ(parseObject(R"("animation": "walk")").animation, AnimationChoice("walk"));
    EXPECT_EQ(parseObject(R"("animation": 2)").animation, AnimationChoice(2U));
    const SceneFileObject object = parseObject(R"("up": "y")");
    EXPECT_FALSE(object.animation.has_value() || object.is_dynamic.has_value());
    EXPECT_FALSE(object.carves);
    EXPECT_FALSE(parseObject(R"("animation": 2)").is_dynamic.has_value()) << "what it moves is dynamic";
    const SceneFileObject carver = parseObject(R"("merge": "carve")");
    EXPECT_TRUE(carver.carves && carver.is_dynamic == true && carver.fill == Fill::Solid);
    EXPECT_EQ(parseObject(R"("merge": "carve", "fill": "none")").fill, Fill::None);
}

TEST(SceneFile, LineIsReadWithItsRepeat)
{
    const auto line =
        std::get<LineMotion>(parseObject(R"("motion": {"line": {"from": [1, 2, 3], "to": [4, 5, 6]}})").motion);
    EXPECT_EQ(line.from, glm::dvec3(1, 2, 3));
    EXPECT_EQ(line.to, glm::dvec3(4, 5, 6));
    EXPECT_EQ(line.seconds, 4.0) << "the scene's";
    EXPECT_FALSE(line.returns);
    const auto back = std::get<LineMotion>(
        parseObject(
            R"("motion": {"line": {"from": [0, 0, 0], "to": [1, 0, 0], "seconds": 0.5, "repeat": "ping-pong"}})")
            .motion);
    EXPECT_EQ(back.seconds, 0.5);
    EXPECT_TRUE(back.returns);
}

TEST(SceneFile, KeysAreReadAndTurnTheShorterWay)
{
    const auto keys = std::get<KeyMotion>(parseObject(R"("motion": {"keys": {"times": [0, 1, 4],
        "translations": [[0, 0, 0], [1, 0, 0], [1, 1, 0]], "scales": [1, [1, 2, 3], 2],
        "rotations": [{"axis": [0, 0, 1], "degrees": 0}, {"axis": [0, 0, 1], "degrees": 120},
                      {"axis": [0, 0, -1], "degrees": 450}]}})")
                                              .motion);
    EXPECT_EQ(keys.times, (std::vector<double>{0, 1, 4}));
    EXPECT_EQ(keys.translations.at(2), glm::dvec3(1, 1, 0));
    EXPECT_EQ(keys.scales, (std::vector<glm::dvec3>{{1, 1, 1}, {1, 2, 3}, {2, 2, 2}}));
    // 30 degrees on the way to 120; then from 120 to 270, which equals 450 the other way around.
    for (const auto& [seconds, degrees, scale] : {std::array{0.25, 30.0, 1.0}, std::array{2.5, 195.0, 1.5}})
    {
        const glm::dvec4 point = motionAt(keys, seconds) * glm::dvec4(1, 0, 0, 0);
        EXPECT_NEAR(point.x, scale * std::cos(glm::radians(degrees)), kClose);
        EXPECT_NEAR(point.y, scale * std::sin(glm::radians(degrees)), kClose);
    }
}

struct WrongFile
{
    const char* name;
    std::string content;
    std::vector<std::string> parts; // in the message
};

void PrintTo(const WrongFile& file, std::ostream* stream)
{
    *stream << file.name;
}

std::string deepText()
{
    return std::string(100000, '[');
}

const std::vector<WrongFile>& wrongFiles()
{
    static const std::vector<WrongFile> files = {
        {"Empty", "", {"not JSON"}},
        {"Cut", R"({"objects": [)", {"not JSON", "line 1"}},
        {"NumberTooLarge", R"({"seconds": 1e999, "objects": []})", {"not JSON"}},
        {"Deep", deepText(), {"nested more than 64 deep"}},
        {"DeepValue", R"({"objects": [{"file": [[[["x"]]]]}]})", {"objects[0].file is an array of 1; expected a text"}},
        {"KeyTwice",
         R"({"objects": [{"file": "a"}, {"file": "b", "place": {"scale": 1, "scale": 2}}]})",
         {"objects[1].place.scale stands there twice"}},
        {"NoObject", "[1]", {"the document is [1]; expected an object"}},
        {"NoObjects", "{}", {"objects is missing"}},
        {"ObjectsOfNothing", R"({"objects": []})", {"objects has 0 objects; expected 1 to 4096"}},
        {"ObjectsOfWrongKind", R"({"objects": {"file": "a"}})", {"objects is an object; expected an array"}},
        {"UnknownKey", R"({"objects": [{"file": "a"}], "fps": 3})", {"fps is not known; expected about, objects"}},
        {"UnknownKeyOfObject",
         objectText(R"("motoin": {})"),
         {"objects[0].motoin is not known; expected name, file, static, dynamic, up, place, motion"}},
        {"UnknownKeyOfPlace", objectText(R"("place": {"rotate": 1})"), {"objects[0].place.rotate is not known"}},
        {"UnknownKeyOfRotation",
         objectText(R"("place": {"rotation": {"axis": [1, 0, 0], "degrees": 1, "turns": 1}})"),
         {"objects[0].place.rotation.turns is not known; expected axis, degrees"}},
        {"UnknownMotion", motionText(R"("spline": {})"), {"objects[0].motion.spline is not known"}},
        {"UnknownKeyOfGrid", R"({"objects": [{"file": "a"}], "grid": {"size": 3}})", {"grid.size is not known"}},
        {"UnknownKeyOfBounds",
         R"({"objects": [{"file": "a"}], "grid": {"bounds": {"low": 3}}})",
         {"grid.bounds.low is not known"}},
        {"UnknownKeyOfCamera", R"({"objects": [{"file": "a"}], "camera": {"up": 3}})", {"camera.up is not known"}},
        {"NoFile", R"({"objects": [{"file": "a"}, {"name": "b"}]})", {"objects[1].file is missing"}},
        {"FileOfWrongKind", R"({"objects": [{"file": 3}]})", {"objects[0].file is 3; expected a text"}},
        {"StaticAndDynamic", objectText(R"("static": true, "dynamic": true)"), {"objects[0].dynamic stands beside"}},
        {"StaticOfWrongKind", objectText(R"("static": 1)"), {"objects[0].static is 1; expected true or false"}},
        {"StaticThatMoves",
         objectText(R"("static": true, "motion": {"orbit": {"turns": 1}})"),
         {"objects[0].motion moves an object that is static"}},
        {"StaticThatIsAnimated",
         objectText(R"("static": true, "animation": "walk")"),
         {"objects[0].animation plays in an object that is static; expected dynamic"}},
        {"StaticThatCarves",
         objectText(R"("static": true, "merge": "carve")"),
         {"objects[0].merge carves by an object that is static; expected dynamic"}},
        {"ObjectWithARuleOfItsOwn",
         objectText(R"("merge": "average")"),
         {"objects[0].merge is \"average\"; expected one of carve"}},
        {"FilledThatDoesNotCarve",
         objectText(R"("fill": "solid")"),
         {"objects[0].fill fills an object that does not carve; expected merge beside it"}},
        {"FillThatNoObjectHas",
         objectText(R"("merge": "carve", "fill": "robust")"),
         {"objects[0].fill is \"robust\"; expected one of none, solid, parity"}},
        {"AnimationOfWrongKind",
         objectText(R"("animation": ["walk"])"),
         {"objects[0].animation is [\"walk\"]; expected the name of an animation of the file, or its number"}},
        {"AnimationOfNoWholeNumber",
         objectText(R"("animation": 1.5)"),
         {"objects[0].animation is 1.5; expected a whole number from 0"}},
        {"Up", objectText(R"("up": "north")"), {"objects[0].up is \"north\"; expected one of x, y, z, -x, -y, -z"}},
        {"TwoNumbers",
         objectText(R"("place": {"translation": [1, 2]})"),
         {"objects[0].place.translation is [1,2]; expected three numbers [x, y, z]"}},
        {"NumberPastSinglePrecision",
         objectText(R"("place": {"translation": [1e39, 0, 0]})"),
         {"objects[0].place.translation is [1e+39,0,0]"}},
        {"ScaleOfWrongKind",
         objectText(R"("place": {"scale": "big"})"),
         {"objects[0].place.scale is \"big\"; expected a number, or three numbers"}},
        {"AxisOfNoLength",
         objectText(R"("place": {"rotation": {"axis": [0, 0, 0], "degrees": 1}})"),
         {"objects[0].place.rotation.axis is [0,0,0]; expected three numbers [x, y, z], not all 0"}},
        {"NoMotion", motionText(""), {"objects[0].motion is not one motion"}},
        {"TwoMotions", motionText(R"("orbit": {"turns": 1}, "line": {})"), {"objects[0].motion is not one motion"}},
        {"OrbitWithoutSpeed", motionText(R"("orbit": {})"), {"objects[0].motion.orbit has neither turns nor degrees"}},
        {"OrbitOfTwoSpeeds",
         motionText(R"("orbit": {"turns": 1, "degrees_per_second": 1})"),
         {"objects[0].motion.orbit has both"}},
        {"OrbitThatDoesNothing",
         motionText(R"("orbit": {"turns": 1, "circles": false, "spins": false})"),
         {"objects[0].motion.orbit neither circles nor spins"}},
        {"LineWithoutEnd", motionText(R"("line": {"from": [0, 0, 0]})"), {"objects[0].motion.line.to is missing"}},
        {"LineOfNoTime",
         motionText(R"("line": {"from": [0, 0, 0], "to": [1, 0, 0], "seconds": 0})"),
         {"objects[0].motion.line.seconds is 0; expected a number above 0"}},
        {"LineOfUnknownRepeat",
         motionText(R"("line": {"from": [0, 0, 0], "to": [1, 0, 0], "repeat": "pong"})"),
         {"objects[0].motion.line.repeat is \"pong\"; expected one of loop, ping-pong"}},
        {"KeysWithoutTimes", motionText(R"("keys": {"scales": [1]})"), {"objects[0].motion.keys.times is missing"}},
        {"KeysOfNoTimes", motionText(R"("keys": {"times": []})"), {"objects[0].motion.keys.times is empty"}},
        {"KeysOfNothing", motionText(R"("keys": {"times": [0]})"), {"objects[0].motion.keys moves nothing"}},
        {"KeysBackwards",
         motionText(R"("keys": {"times": [0, 2, 2], "scales": [1, 1, 1]})"),
         {"objects[0].motion.keys.times[2] is 2; expected ascending times"}},
        {"KeysPastTheEnd",
         motionText(R"("keys": {"times": [0, 5], "scales": [1, 1]})"),
         {"objects[0].motion.keys.times[1] is 5; expected ascending times from 0 to the scene's length, 4 seconds"}},
        {"KeysBeforeTheStart",
         motionText(R"("keys": {"times": [-1, 1], "scales": [1, 1]})"),
         {"objects[0].motion.keys.times[0] is -1"}},
        {"KeysOfAnotherCount",
         motionText(R"("keys": {"times": [0, 1], "scales": [1, 1, 1]})"),
         {"objects[0].motion.keys.scales has 3 items, but there are 2 times"}},
        {"KeysHalfATurnApart",
         motionText(R"("keys": {"times": [0, 1], "rotations": [{"axis": [1, 0, 0], "degrees": 10},
                    {"axis": [1, 0, 0], "degrees": -170}]})"),
         {"objects[0].motion.keys.rotations[1] is half a turn from the key before it"}},
        {"KeyOfWrongKind",
         motionText(R"("keys": {"times": [0, 1], "rotations": [{"axis": [1, 0, 0], "degrees": 0}, 90]})"),
         {"objects[0].motion.keys.rotations[1] is 90; expected an object"}},
        {"Seconds", R"({"objects": [{"file": "a"}], "seconds": -1})", {"seconds is -1; expected a number above 0"}},
        {"FramesPerSecond",
         R"({"objects": [{"file": "a"}], "frames_per_second": "many"})",
         {"frames_per_second is \"many\""}},
        {"Depth",
         R"({"objects": [{"file": "a"}], "grid": {"depth": 18}})",
         {"grid.depth is 18; expected a whole number from 1 to 17"}},
        {"DepthOfHalves", R"({"objects": [{"file": "a"}], "grid": {"depth": 7.5}})", {"grid.depth is 7.5"}},
        {"BoundsUpsideDown",
         R"({"objects": [{"file": "a"}], "grid": {"bounds": {"min": [0, 0, 0], "max": [1, -1, 1]}}})",
         {"grid.bounds has no extent"}},
        {"Merge",
         R"({"objects": [{"file": "a"}], "merge": "newest"})",
         {"merge is \"newest\"; expected one of average, dynamic, static"}},
        {"CameraInItsTarget",
         R"({"objects": [{"file": "a"}], "camera": {"eye": [1, 1, 1], "target": [1, 1, 1]}})",
         {"camera makes no picture", "two different points"}},
        {"CameraOfWideView",
         R"({"objects": [{"file": "a"}], "camera": {"eye": [1, 1, 1], "target": [0, 1, 1], "fov": 200}})",
         {"camera makes no picture", "180 degrees"}},
        {"CameraWithoutTarget",
         R"({"objects": [{"file": "a"}], "camera": {"eye": [1, 1, 1]}})",
         {"camera.target is missing"}},
        {"AboutOfWrongKind", R"({"objects": [{"file": "a"}], "about": 1})", {"about is 1; expected a text"}},
    };
    return files;
}

class WrongSceneFile : public testing::TestWithParam<WrongFile>
{
};

INSTANTIATE_TEST_SUITE_P(SceneFile, WrongSceneFile, testing::ValuesIn(wrongFiles()),
                         [](const auto& file) { return std::string(file.param.name); });

TEST_P(WrongSceneFile, IsOneLineThatNamesFilePlaceAndWhatIsExpected)
{
    expectInputError([] { parse(GetParam().content); }, {"folder/test.scene.json: "});
    for (const std::string& part : GetParam().parts)
    {
        expectInputError([] { parse(GetParam().content); }, {part});
    }
}

TEST(SceneFile, DamagedTextIsReadOrIsAnInputError)
{
    const std::string whole = R"({"about": "x", "seconds": 2, "frames_per_second": 24, "merge": "static",
        "grid": {"depth": 7, "bounds": {"min": [-1, -2, -3], "max": [1, 2, 3]}},
        "camera": {"eye": [0, 1, 5], "target": [0, 1, 0], "fov": 90},
        "objects": [{"file": "a.glb", "static": true, "up": "-x", "place": {"translation": [1, 2, 3], "scale": 2}},
        {"file": "b", "motion": {"orbit": {"turns": 2, "axis": [1, 2, 3], "centre": [0, 0, 0], "spins": false}}},
        {"file": "c", "motion": {"line": {"from": [1, 2, 3], "to": [4, 5, 6], "repeat": "loop", "seconds": 1}}},
        {"file": "d", "motion": {"keys": {"times": [0, 1], "scales": [1, [2, 3, 4]],
        "rotations": [{"axis": [0, 1, 0], "degrees": 0}, {"axis": [0, 1, 0], "degrees": 90}]}}}]})";
    std::mt19937 random(3);
    int read_count = 0;
    constexpr int kRounds = 20000;
    for (int i = 0; i < kRounds; ++i)
    {
        std::string damaged = whole;
        for (std::size_t k = random() % 3 + 1; k > 0; --k)
        {
            const std::size_t at = random() % damaged.size();
            switch (random() % 4)
            {
            case 0:
                damaged[at] = static_cast<char>(random());
                break;
            case 1:
                damaged[at] = "0123456789-.eE\"{}[],: "[random() % 22];
                break;
            case 2:
                damaged.erase(at, random() % 8);
                break;
            default:
                damaged.insert(at, damaged.substr(random() % damaged.size(), random() % 16));
                break;
            }
        }
        const auto read = [&]
        {
            const SceneFile file = parse(damaged);
            EXPECT_GT(file.seconds, 0.0);
            EXPECT_GT(file.frames_per_second, 0.0);
            EXPECT_FALSE(file.objects.empty());
            for (const SceneFileObject& object : file.objects)
            {
                const glm::dmat4 place = motionAt(object.motion, 0.7 * file.seconds) * object.transform;
                EXPECT_TRUE(std::isfinite(glm::dot(place[0] + place[1] + place[2] + place[3], glm::dvec4(1.0))));
            }
        };
        read_count += loadsOrIsRefused(read) ? 1 : 0;
    }
    EXPECT_GT(read_count, kRounds / 100) << "most of the damage is found by the parser";
}

} // namespace

} // namespace zvo::test
