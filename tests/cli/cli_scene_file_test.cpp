// SPDX-License-Identifier: MIT
// Scene files on the command line: pictures and voxels of a scene with a dynamic object.
#include "cli/cli_folder.h"

#include <cmath>
#include <cstring>
#include <filesystem>
#include <functional>
#include <gtest/gtest.h>
#include <limits>
#include <map>
#include <numbers>
#include <set>
#include <string>
#include <vector>

namespace zvo::test
{
namespace
{

/// A folder with cube.glb, models/slab.glb and test.scene.json, in which the cube is static and the slab moves through
/// it.
class CliSceneFile : public CliFolder
{
protected:
    CliSceneFile()
    {
        std::filesystem::create_directory(m_dir.path() / "models");
        m_dir.write("models/slab.glb", slab(0.0).glb());
        m_dir.write("test.scene.json", std::string_view(R"({"seconds": 2, "frames_per_second": 4,
            "grid": {"depth": 5, "bounds": {"min": [-1.625, -1, -1], "max": [2.375, 3, 3]}},
            "camera": {"eye": [0.5, 0.5, 9], "target": [0.5, 0.5, 0]},
            "objects": [{"file": "cube.glb"},
                        {"file": "slab.glb", "motion": {"line": {"from": [-2, 0, 0], "to": [2, 0, 0]}}}]})"));
    }

    /// The cube, flattened, at x.
    static GltfBuilder slab(double x)
    {
        GltfBuilder builder = coloredCube();
        builder.document["nodes"][0]["scale"] = {0.25, 0.5, 1.5};
        builder.document["nodes"][0]["translation"] = {x, 0.25, -0.25};
        builder.document["nodes"].erase(1);
        builder.document.erase("cameras");
        return builder;
    }

    /// The scene file with another rule, or other objects, beside it.
    void writeChanged(const std::string& name, const std::function<void(json&)>& change) const
    {
        json scene = jsonFile("test.scene.json");
        change(scene);
        m_dir.write(name, scene.dump());
    }
};

const std::string kScene = "test.scene.json --scenes models ";

TEST_F(CliSceneFile, VoxelsAtATimeAreTheUnionOfTheObjectsInTheirPlaces)
{
    for (const double seconds : {0.0, 0.125, 0.5, 1.0, 1.25}) // outside, half outside, beside, within
    {
        // All vertices are on the lattice, so that a slab of its own has the same ones.
        m_dir.write("moved.glb", slab(-2.0 + 2.0 * seconds).glb());
        const json report =
            printedBy("voxelize " + kScene + "-o all.morton -f --json - --time " + std::to_string(seconds));
        EXPECT_EQ(report["resolution"], 32) << "the scene file's";
        EXPECT_EQ(report["scene"]["triangles"], 24);
        EXPECT_EQ(report["grid"]["origin"], (json{-1.625, -1.0, -1.0}));
        const std::string grid = " --resolution 32 -f --grid " + gridText(report["grid"]);
        std::set<std::uint64_t> expected;
        for (const std::string part : {"cube.glb", "moved.glb"})
        {
            run("voxelize -o part.morton " + part + grid);
            const std::vector<std::uint64_t> voxels = codes("part.morton");
            expected.insert(voxels.begin(), voxels.end());
        }
        EXPECT_EQ(codes("all.morton"), std::vector(expected.begin(), expected.end()));
        EXPECT_FALSE(expected.empty());
        const json both = printedBy("voxelize cube.glb moved.glb -o both.morton --json -" + grid);
        EXPECT_EQ(report["octree_sha256"], both["octree_sha256"]) << "attributes too";
    }
}

TEST_F(CliSceneFile, FramesAreTimesAndBeginAnew)
{
    const std::string render = "render --size 64x48 --view albedo " + kScene;
    run(render + "-o f_##.png --frames 2..10 --json updated.json");
    run(render + "-o r_##.png --frames 2..10 --json frames.json --rebuild");
    run(render + "-o start.png");
    for (const std::string frame : {"02", "03", "04", "05", "06", "07", "08", "09", "10"})
    {
        EXPECT_EQ(file("f_" + frame + ".png"), file("r_" + frame + ".png")) << "an update equals a rebuild";
    }
    for (const int frame : {2, 5, 7})
    {
        run(render + "-o time.png -f --time " + std::to_string(frame * 0.25));
        EXPECT_EQ(file("f_0" + std::to_string(frame) + ".png"), file("time.png")) << frame;
    }
    EXPECT_EQ(file("f_08.png"), file("start.png"));
    EXPECT_EQ(file("f_10.png"), file("f_02.png"));
    EXPECT_NE(file("f_03.png"), file("f_02.png"));

    const json report = jsonFile("frames.json");
    EXPECT_EQ(report["schema"], "zvo.render/1");
    EXPECT_EQ(report["picture"]["count"], 9);
    ASSERT_EQ(report["frames"].size(), 9U);
    EXPECT_EQ(report["frames"][0]["octree_sha256"], report["octree_sha256"]);
    EXPECT_EQ(report["frames"][0]["octree_sha256"], report["frames"][8]["octree_sha256"]);
    for (int i = 0; i < 9; ++i)
    {
        const json& frame = report["frames"][i];
        EXPECT_EQ(frame["frame"], i + 2);
        EXPECT_EQ(frame["seconds"], (i + 2) % 8 * 0.25);
        EXPECT_EQ(frame["triangles"], 24);
        EXPECT_GT(frame["voxels"], 0);
        EXPECT_GT(frame["trace_ms"], 0);
    }
    const json updated = jsonFile("updated.json");
    EXPECT_EQ(updated["schema"], "zvo.render_dynamic/1");
    EXPECT_EQ(updated["grid"], report["grid"]);
    EXPECT_EQ(updated["merge"], "average");
    EXPECT_EQ(updated["scene"]["triangles_static"], 12);
    EXPECT_EQ(updated["scene"]["triangles_dynamic"], 12);
    EXPECT_EQ(updated["scene"]["movers"], 1);
    EXPECT_GT(updated["nodes_static"], 0);
    run("voxelize cube.glb --grid " + gridText(report["grid"]) + " --resolution 32 -o cube.morton");
    EXPECT_EQ(updated["voxels_static"], codes("cube.morton").size());
    ASSERT_EQ(updated["frames"].size(), 9U);
    for (int i = 0; i < 9; ++i)
    {
        const json& frame = updated["frames"][i];
        EXPECT_EQ(frame["frame"], i + 2);
        EXPECT_EQ(frame["seconds"], (i + 2) % 8 * 0.25);
        EXPECT_EQ(frame["voxels_dynamic"] > 0, i != 6) << "at the start the slab is outside";
        EXPECT_GT(frame["nodes_dynamic"], 0) << "a root at least";
        EXPECT_GT(frame["dynamic_ms"], 0);
    }
}

TEST_F(CliSceneFile, WhatIsCompressedLooksTheSame)
{
    for (const std::string& how : {kScene, kScene + "--rebuild", std::string("cube.glb")})
    {
        for (const std::string structure : {"svo", "svdag"})
        {
            run("render --frames 3..4 -f --size 64x48 --resolution 64 -o " + structure + "_#.png --json " + structure +
                ".json --structure " + structure + " " + how);
        }
        EXPECT_EQ(file("svo_3.png"), file("svdag_3.png")) << how;
        EXPECT_EQ(file("svo_4.png"), file("svdag_4.png")) << how;
        const json octree = jsonFile("svo.json");
        const json dag = jsonFile("svdag.json");
        if (dag["schema"] == "zvo.render_dynamic/1")
        {
            EXPECT_EQ(dag["structure"], "svdag");
            EXPECT_LT(dag["nodes_static"], octree["nodes_static"]);
            EXPECT_LT(dag["bytes"]["geometry_static"], octree["bytes"]["geometry_static"]);
            EXPECT_GT(dag["compress_ms"], 0);
            EXPECT_EQ(octree["compress_ms"], nullptr);
        }
        else
        {
            EXPECT_EQ(dag["octree_sha256"], octree["octree_sha256"]);
            EXPECT_LT(dag["dag"]["nodes"], octree["nodes"]);
            EXPECT_FALSE(octree.contains("dag"));
        }
    }
}

TEST_F(CliSceneFile, TheSceneFilesRuleDecidesWhatOverlapsLookLike)
{
    // The slab, rotated so that a green side is in front, shares voxels of the cube's blue front.
    std::map<std::string, std::string> pictures;
    for (const char* rule : {"average", "dynamic", "static"})
    {
        writeChanged("rule.scene.json",
                     [rule](json& scene)
                     {
                         scene["merge"] = rule;
                         scene["objects"][1]["place"]["rotation"] = {{"axis", {1, 0, 0}}, {"degrees", 90}};
                         scene["objects"][1]["motion"]["line"] = {{"from", {0, 0.75, 0.25}}, {"to", {1, 0.75, 0.25}}};
                     });
        const std::string told = run("render rule.scene.json --scenes models -o rule.png -f --time 0.5 --size 64x48 "
                                     "--view albedo --camera 3,3,4,0.5,0.5,0.5")
                                     .err;
        EXPECT_FALSE(contains(told, "warning")) << told;
        pictures[rule] = file("rule.png");
    }
    EXPECT_TRUE(pictures["average"] != pictures["dynamic"]);
    EXPECT_TRUE(pictures["average"] != pictures["static"]);
    EXPECT_TRUE(pictures["dynamic"] != pictures["static"]);
}

TEST_F(CliSceneFile, TheCameraOfTheSceneFileStandsStill)
{
    // Finds the middle of the slab's face towards the camera, which is blue and a quarter wide.
    const auto middleAt = [this](const std::string& seconds)
    {
        run("render -o a.png -f --size 512x256 --view albedo --resolution 128 " + kScene + "--time " + seconds);
        const Image image = pixels("a.png");
        double sum = 0;
        int count = 0;
        for (std::uint32_t x = 0; x < image.width; ++x)
        {
            const std::uint8_t* const pixel = image.rgba.data() + std::size_t{4} * (128 * image.width + x);
            if (pixel[2] == 255 && pixel[0] == 0 && pixel[1] == 0)
            {
                sum += x;
                ++count;
            }
        }
        return count == 0 ? -1.0 : sum / count;
    };
    // At 0.25 s the slab spans x from -1.5 to -1.25 at z = 1.25, the cube 0 to 1 at z = 1. So they do not touch in the
    // picture.
    const double pixels_per_unit = 128.0 / std::tan(0.5 * 45.0 * std::numbers::pi / 180.0);
    const double slab = 255.5 + pixels_per_unit * (-1.375 - 0.5) / 7.75;
    const double cube = 255.5;
    const double slab_width = pixels_per_unit * 0.25 / 7.75;
    const double cube_width = pixels_per_unit * 1.0 / 8.0;
    EXPECT_NEAR(middleAt("0.25"), (slab * slab_width + cube * cube_width) / (slab_width + cube_width), 1.5);
    // At 1.2 s the slab is before the cube.
    EXPECT_NEAR(middleAt("1.2"), cube, 1.5);
}

TEST_F(CliSceneFile, OptionsStandBeforeTheSceneFile)
{
    const json report = printedBy("voxelize -o a.morton --resolution 16 --bounds 0,0,0,1,1,1 --json - " + kScene);
    EXPECT_EQ(report["resolution"], 16);
    EXPECT_EQ(report["grid"]["origin"], (json{0.0, 0.0, 0.0}));
    run("render -o named.png --size 32x32 --camera front " + kScene);
    run("render -o file.png --size 32x32 " + kScene);
    EXPECT_NE(file("named.png"), file("file.png"));
}

TEST_F(CliSceneFile, FramesOfWhatStandsStillTurnTheCamera)
{
    m_dir.write("still.scene.json", std::string_view(R"({"objects": [{"file": "cube.glb"}], "grid": {"depth": 5}})"));
    for (const std::string scene : {"still.scene.json", "cube.glb"})
    {
        run("render --frames 0..2 --size 32x32 --resolution 32 " + scene + " -o " + scene + "#.png");
    }
    for (const std::string frame : {"0.png", "1.png", "2.png"})
    {
        EXPECT_EQ(file("still.scene.json" + frame), file("cube.glb" + frame));
    }
    EXPECT_NE(file("cube.glb1.png"), file("cube.glb0.png"));
    const std::string told = run("voxelize cube.glb --time 3 -o a.morton --resolution 8").err;
    EXPECT_TRUE(contains(told, "warning: nothing moves in this scene")) << told;
}

TEST_F(CliSceneFile, WhatMovesStandsStillOnATurntable)
{
    const std::string render = "render --size 64x48 --view albedo " + kScene + "--time 0.75 ";
    run(render + "-o t_#.png --turntable 2");
    run(render + "-o still.png");
    EXPECT_EQ(file("t_0.png"), file("still.png"));
    EXPECT_NE(file("t_1.png"), file("still.png"));
    EXPECT_FALSE(std::filesystem::exists(m_dir.path() / "t_2.png"));
}

TEST_F(CliSceneFile, AnimationsOfAFileRunWhereTimesAreAskedFor)
{
    GltfBuilder builder = coloredCube();
    const std::size_t times = builder.addAccessor("SCALAR", kF32, 2, std::vector<float>{0.0F, 2.0F});
    const std::size_t values = builder.addAccessor("VEC3", kF32, 2, std::vector<float>{1, 0, 0, 3, 0, 0});
    const json sampler = {{"input", times}, {"output", values}};
    const json channel = {{"sampler", 0}, {"target", {{"node", 0}, {"path", "translation"}}}};
    builder.add("animations", {{"samplers", json::array({sampler})}, {"channels", json::array({channel})}});
    m_dir.write("animated.glb", builder.glb());
    const auto voxelsOf = [this](const std::string& arguments)
    {
        run("voxelize --grid 0,0,0,0.125 --resolution 32 -f -o a.morton " + arguments);
        return codes("a.morton");
    };
    EXPECT_EQ(voxelsOf("animated.glb"), voxelsOf("cube.glb")) << "at rest";
    builder.document["nodes"][0]["translation"] = {2.5, 0, 0};
    m_dir.write("moved.glb", builder.glb());
    const std::vector<std::uint64_t> moved = voxelsOf("moved.glb");
    EXPECT_EQ(voxelsOf("animated.glb --time 1.5"), moved);
    EXPECT_EQ(voxelsOf("animated.glb --time 3.5"), moved) << "two seconds later";
    const std::string render = "render --size 64x48 --resolution 32 --camera front --bounds 0,0,0,4,4,4 ";
    run(render + "animated.glb -o f_##.png --frames 44..45");
    run(render + "moved.glb -o moved.png");
    EXPECT_EQ(file("f_45.png"), file("moved.png"));
    EXPECT_NE(file("f_44.png"), file("moved.png"));
}

TEST_F(CliSceneFile, TrianglesOfWhatMovesThatMakeNoSenseAreToldOfOnce)
{
    // One face, of two triangles, has a corner that is NaN; from 0.5 s on another object is too large.
    GltfBuilder broken = slab(0.0);
    const float nan = std::numeric_limits<float>::quiet_NaN();
    std::memcpy(broken.bin.data() + 4, &nan, sizeof(nan)); // y of the first position
    m_dir.write("models/broken.glb", broken.glb());
    writeChanged("broken.scene.json", [](json& scene) { scene["objects"][1]["file"] = "broken.glb"; });
    writeChanged("grows.scene.json",
                 [](json& scene)
                 {
                     const json keys = {{"times", {0, 0.25, 0.5}}, {"scales", {1, 1, 1e30}}};
                     scene["objects"][1] = {{"file", "cube.glb"}, {"motion", {{"keys", keys}}}};
                 });
    const auto render = [this](const std::string& scene)
    { return run("render --scenes models -o f_#.png -f --frames 0..2 --size 32x32 --json report.json " + scene).err; };

    const std::string told = render("broken.scene.json");
    EXPECT_EQ(told.find("warning"), told.rfind("warning")) << told;
    EXPECT_TRUE(contains(told, "warning: at 0 s, left out of what moves: 2 (nonfinite)\n")) << told;
    json report = jsonFile("report.json");
    EXPECT_EQ(report["scene"]["dropped"], json::object());
    EXPECT_EQ(report["frames"][1]["dropped"]["nonfinite"], 2);

    const std::string later = render("grows.scene.json");
    EXPECT_EQ(later.find("warning"), later.rfind("warning")) << later;
    EXPECT_TRUE(contains(later, "warning: at 0.5 s, left out of what moves: 12 (out_of_range)\n")) << later;
    report = jsonFile("report.json");
    EXPECT_FALSE(report["frames"][1]["dropped"].contains("out_of_range"));
    EXPECT_EQ(report["frames"][2]["dropped"]["out_of_range"], 12);

    EXPECT_FALSE(contains(render("test.scene.json"), "warning")) << "outside, at the start, is no fault";
    EXPECT_EQ(jsonFile("report.json")["frames"][0]["dropped"]["outside"], 12);
}

TEST_F(CliSceneFile, RulesThatARebuildCannotFollowAreToldOf)
{
    writeChanged("rule.scene.json", [](json& scene) { scene["merge"] = "dynamic"; });
    for (const std::string how : {"voxelize -o a.morton", "render -o a.png --size 16x16 --rebuild"})
    {
        const std::string told = run(how + " rule.scene.json --scenes models").err;
        EXPECT_TRUE(contains(told, "merge, dynamic, has no effect")) << told;
    }
}

const std::vector<WrongUse>& wrongSceneFiles()
{
    static const std::vector<WrongUse> uses = {
        {"ModelIsNotThere",
         3,
         "render test.scene.json -o a.png",
         {"test.scene.json: objects[1].file is \"slab.glb\"", "; --scenes tells where else to look"}},
        {"UnknownKey",
         3,
         "render typo.scene.json -o a.png",
         {"typo.scene.json: objects[0].plaec is not known; expected name, file"}},
        {"NotJson", 3, "voxelize text.scene.json -o a.ply", {"text.scene.json: not JSON"}},
        {"MissingSceneFile", 3, "render absent.scene.json -o a.png", {"absent.scene.json", "No such file"}},
        {"FolderOfModelsIsNotThere",
         3,
         "render test.scene.json -o a.png --scenes absent",
         {"--scenes absent is not a folder"}},
        {"ModelOutside",
         3,
         "render out.scene.json -o a.png --scenes models",
         {"objects[0].file is \"../../etc/passwd\", which leaves the folder of the scene file or of --scenes;"}},
        {"TwoSceneFiles", 2, "render test.scene.json cube.glb -o a.png --scenes models", {"stands alone"}},
        {"FramesAndTime", 2, "render test.scene.json -o a#.png --frames 0..1 --time 1", {"--frames", "--time"}},
        {"TimeBeforeTheStart", 2, "render test.scene.json -o a.png --time=-1", {"--time -1", "from 0 on"}},
        {"UpOfASceneFile",
         2,
         "render test.scene.json -o a.png --scenes models --up z",
         {"--up, --scale and --bind-pose do not go with test.scene.json"}},
        {"BindPoseOfASceneFile", 2, "render test.scene.json -o a.png --scenes models --bind-pose", {"--bind-pose"}},
        {"FolderForAMesh", 2, "render cube.glb -o a.png --scenes models", {"--scenes goes with a scene"}},
        {"ReportIsAModel",
         2,
         "render test.scene.json -o a.png --scenes models --json models/slab.glb -f",
         {"models/slab.glb", "overwritten"}},
    };
    return uses;
}

class CliSceneFileError : public CliSceneFile, public testing::WithParamInterface<WrongUse>
{
};

INSTANTIATE_TEST_SUITE_P(CliSceneFile, CliSceneFileError, testing::ValuesIn(wrongSceneFiles()),
                         [](const auto& use) { return std::string(use.param.name); });

TEST_P(CliSceneFileError, IsOneLineAndAnExitCodeAndLeavesNothingBehind)
{
    m_dir.write("typo.scene.json", std::string_view(R"({"objects": [{"file": "cube.glb", "plaec": {}}]})"));
    m_dir.write("text.scene.json", std::string_view("a cube, please"));
    m_dir.write("out.scene.json", std::string_view(R"({"objects": [{"file": "../../etc/passwd"}]})"));
    const std::vector<std::string> before = filesIn(m_dir.path());
    const std::string slab = file("models/slab.glb");
    const Outcome outcome = runZvo(m_dir.path(), GetParam().arguments);
    expectErrorLine(outcome, GetParam().exit_code, GetParam().words);
    EXPECT_EQ(filesIn(m_dir.path()), before);
    EXPECT_EQ(file("models/slab.glb"), slab);
}

} // namespace
} // namespace zvo::test
