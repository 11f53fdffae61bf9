// SPDX-License-Identifier: MIT
// Pictures of light that is kept on voxels, on the command line.
#include "cli/cli_scene.h"
#include "cli/run_zvo.h"
#include "io/image/hdr_image_io.h"
#include "support/scenes.h"
#include "support/temp_dir.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace zvo::test
{
namespace
{

class CliCached : public testing::Test
{
protected:
    void SetUp() override
    {
        m_dir.write("cube.glb", coloredCube().glb());
        m_dir.write("sky.exr", encodeExr({8, 4, std::vector(32, glm::vec3(0.5F))}));
    }

    Outcome render(const std::vector<std::string>& more)
    {
        std::vector<std::string> arguments = {"render",       "cube.glb", "-f",           "--size", "40x30",
                                              "--resolution", "16",       "--integrator", "cached"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return runZvo(m_dir.path(), arguments);
    }

    // The picture of a run that succeeds.
    std::string picture(std::vector<std::string> more)
    {
        more.insert(more.end(), {"--spp", "2", "-o", "picture.png"});
        if (std::find(more.begin(), more.end(), "--settle") == more.end())
        {
            more.insert(more.end(), {"--settle", "12"});
        }
        const Outcome outcome = render(more);
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        return contentOf(m_dir.path() / "picture.png");
    }

    TempDir m_dir;
};

TEST_F(CliCached, EachOptionChangesThePicture)
{
    const std::string plain = picture({});
    EXPECT_EQ(picture({}), plain);
    const std::vector<std::vector<std::string>> others = {{"--seed", "1"},
                                                          {"--settle", "0"},
                                                          {"--rays", "5"},
                                                          {"--exposure", "3"},
                                                          {"--sun", "1,1,1"},
                                                          {"--environment", "sky.exr"},
                                                          {"--environment", "none", "--sun", "1,2,3"}};
    for (const std::vector<std::string>& more : others)
    {
        EXPECT_TRUE(picture(more) != plain) << more.front();
    }
    EXPECT_EQ(picture({"--structure", "svdag"}), plain) << "a DAG has its light in the same places";
}

// Cones show the same light in another way, the same in every run and of every structure.
TEST_F(CliCached, ConesShowTheLight)
{
    const auto cones = [&](const std::string& file, const std::vector<std::string>& more)
    {
        std::vector<std::string> arguments = {"render", file,    "-f", "--size", "40x30",    "--integrator",
                                              "cones",  "--spp", "2",  "-o",     "cones.png"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const Outcome outcome = runZvo(m_dir.path(), arguments);
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        return contentOf(m_dir.path() / "cones.png");
    };
    const std::vector<std::string> usual = {"--resolution", "16", "--settle", "12"};
    const std::string plain = cones("cube.glb", usual);
    EXPECT_TRUE(picture({}) != plain);
    EXPECT_TRUE(cones("cube.glb", usual) == plain);
    const std::vector<std::vector<std::string>> others = {
        {"--settle", "12", "--seed", "1"}, {"--settle", "0"}, {"--settle", "12", "--sun", "1,1,1"}};
    for (std::vector<std::string> more : others)
    {
        const std::string option = more[more.size() - 2];
        more.insert(more.end(), {"--resolution", "16"});
        EXPECT_TRUE(cones("cube.glb", more) != plain) << option;
    }
    EXPECT_TRUE(cones("cube.glb", {"--resolution", "16", "--settle", "12", "--structure", "svdag"}) == plain);
    for (const std::string format : {"4", "block"})
    {
        std::vector<std::string> pictures;
        for (const char* structure : {"svo", "svdag"})
        {
            const Outcome built = runZvo(m_dir.path(), {"build", "cube.glb", "-f", "-o", "cube.zvo", "--resolution",
                                                        "16", "--structure", structure, "--attributes", format});
            if (structure == std::string("svo") && built.exit_code != 0)
            {
                continue; // packed formats are of DAGs
            }
            ASSERT_EQ(built.exit_code, 0) << built.err;
            pictures.push_back(cones("cube.zvo", {"--settle", "12"}));
            EXPECT_TRUE(pictures.back() == pictures.front());
        }
        EXPECT_FALSE(pictures.empty());
    }
}

// A picture of radiance, and what the report says.
TEST_F(CliCached, ReportsWhatIsKept)
{
    const Outcome outcome = render({"--settle", "20", "--spp", "3", "--rays", "1000", "--environment", "sky.exr", "-o",
                                    "picture.exr", "--json", "-"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const nlohmann::json cached = nlohmann::json::parse(outcome.out)["cached"];
    EXPECT_EQ(cached["settle"], 20);
    EXPECT_EQ(cached["samples"], 3);
    EXPECT_EQ(cached["rays"], 1000);
    EXPECT_GT(cached["faces"], 150);
    EXPECT_EQ(cached["faces_refused"], 0);
    EXPECT_GT(cached["bytes"], 24 * cached["faces"].get<int>());
    std::vector<std::string> warnings;
    const std::string file = contentOf(m_dir.path() / "picture.exr");
    const HdrImage image =
        decodeHdrImage({reinterpret_cast<const std::uint8_t*>(file.data()), file.size()}, "picture.exr", warnings);
    EXPECT_EQ(image.texels.front(), glm::vec3(0.5F)) << "the sky";
}

// A sequence has one cache: its light settles once.
TEST_F(CliCached, SequencesSettleOnce)
{
    const Outcome outcome =
        render({"--frames", "0..2", "--settle", "5", "--spp", "2", "-o", "turn_#.png", "--json", "-"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const nlohmann::json report = nlohmann::json::parse(outcome.out);
    EXPECT_EQ(report["cached"]["pictures"].size(), 3U);
    EXPECT_EQ(report["capped_rays"], 0);
    EXPECT_NE(contentOf(m_dir.path() / "turn_0.png"), contentOf(m_dir.path() / "turn_1.png"));
}

// Without room for the light there is a picture by primary rays.
TEST_F(CliCached, TracesWithoutLightIfThereIsNoRoom)
{
    const Outcome outcome = render({"-o", "small.png", "--memory-limit", "14M"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_NE(outcome.err.find("warning: no light is kept on voxels"), std::string::npos) << outcome.err;
    EXPECT_NE(outcome.err.find("--memory-limit"), std::string::npos) << outcome.err;
    const Outcome primary =
        runZvo(m_dir.path(), {"render", "cube.glb", "--size", "40x30", "--resolution", "16", "-o", "primary.png"});
    ASSERT_EQ(primary.exit_code, 0) << primary.err;
    EXPECT_TRUE(contentOf(m_dir.path() / "small.png") == contentOf(m_dir.path() / "primary.png"));
    const Outcome radiance = render({"-o", "small.exr", "--memory-limit", "14M"});
    EXPECT_EQ(radiance.exit_code, 6) << radiance.err;
}

// The benchmark compares with paths, and more frames are closer to them.
TEST_F(CliCached, IsMeasuredBesidePaths)
{
    const Outcome outcome = runZvo(m_dir.path(), {"bench", "--kept", "cube.glb", "--resolution", "8", "--size", "24x18",
                                                  "--reference", "64", "--json", "-"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const nlohmann::json report = nlohmann::json::parse(outcome.out);
    EXPECT_EQ(report["schema"], "zvo.bench_kept/1");
    const nlohmann::json& rows = report["rows"];
    ASSERT_EQ(rows.size(), 10U);
    EXPECT_EQ(rows[0]["integrator"], "primary");
    EXPECT_EQ(rows[3]["integrator"], "path");
    for (const std::size_t i : {4U, 6U, 8U})
    {
        EXPECT_EQ(rows[i]["integrator"], "cached");
        EXPECT_EQ(rows[i + 1]["integrator"], "cones");
        EXPECT_EQ(rows[i]["samples"], rows[i + 1]["samples"]);
        EXPECT_EQ(rows[i]["bytes_of_voxel"], rows[i + 1]["bytes_of_voxel"]);
        EXPECT_LT(rows[i + 1]["relative_error"], 0.1) << "nothing but the sky and the sun lights a cube";
        EXPECT_GT(rows[i + 1]["flip"], 0.0);
        EXPECT_GT(rows[i + 1]["frame_ms"], 0.0);
    }
    EXPECT_LT(rows[8]["relative_error"], rows[1]["relative_error"]);
    EXPECT_GT(rows[8]["paths_of_error"], 1.0);
    EXPECT_GT(rows[8]["of_their_time"], 0.0);
    EXPECT_GT(rows[8]["flip"], 0.0);
    EXPECT_LT(rows[8]["flip"], 1.0);
    EXPECT_GT(rows[8]["reference_error"], 0.0);
    EXPECT_LT(rows[8]["reference_error"], rows[3]["relative_error"]) << "of 64 paths, beside 16";
    expectErrorLine(runZvo(m_dir.path(), {"bench", "--kept", "--denoise", "cube.glb"}), 2, {"--kept"});
    expectErrorLine(runZvo(m_dir.path(), {"bench", "--reference", "4", "cube.glb"}), 2, {"--reference", "--kept"});
}

// A cube crosses the picture in front of another one; or it moves behind the camera, and nothing is near.
TEST_F(CliCached, IsMeasuredWhereSomethingMoves)
{
    const auto measure = [&](const std::string& from, const std::string& to)
    {
        m_dir.write("move.scene.json", fmt::format(R"({{"seconds": 2, "frames_per_second": 20, "grid": {{"bounds":
                    {{"min": [-2, -2, -2], "max": [6, 6, 6]}}}}, "camera": {{"eye": [0.5, 0.5, 5], "target": [0.5, 0.5, 0]}},
                    "objects": [{{"file": "cube.glb"}}, {{"file": "cube.glb", "place": {{"scale": 0.4}},
                    "motion": {{"line": {{"from": [{}], "to": [{}]}}}}}}]}})",
                                                   from, to));
        const Outcome outcome = runZvo(m_dir.path(), {"bench", "--kept", "move.scene.json", "--resolution", "16",
                                                      "--size", "24x18", "--reference", "64", "--json", "-"});
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        return nlohmann::json::parse(outcome.out);
    };
    const nlohmann::json report = measure("-1, 0.3, 1.5", "2, 0.3, 1.5");
    EXPECT_TRUE(report["rows"].empty());
    ASSERT_EQ(report["motion"].size(), 1U) << "by day: nothing gives off light";
    const nlohmann::json& motion = report["motion"][0];
    EXPECT_EQ(motion["scene"], "move");
    EXPECT_EQ(motion["light"], "day");
    EXPECT_EQ(motion["resolution"], 16);
    EXPECT_GT(motion["near_share"], 0.02);
    EXPECT_GT(motion["calm_share"], 0.02);
    EXPECT_LT(motion["near_share"].get<double>() + motion["calm_share"].get<double>(), 1.0);
    EXPECT_GT(motion["still"]["near_relative_error"], 0.0);
    EXPECT_LT(motion["still"]["near_relative_error"], 0.5);
    EXPECT_GT(motion["still"]["near_lag"], 0.0) << "other noise";
    ASSERT_EQ(motion["after"].size(), 5U);
    EXPECT_EQ(motion["after"][0]["frames"], 0);
    EXPECT_EQ(motion["after"][4]["frames"], 32);
    for (const nlohmann::json& after : motion["after"])
    {
        EXPECT_NEAR(after["of_still"].get<double>(),
                    after["relative_error"].get<double>() / motion["still"]["relative_error"].get<double>(), 1e-9);
        EXPECT_GT(after["near_of_still"], 0.5);
        EXPECT_LT(after["flip"], 1.0);
    }
    EXPECT_GT(motion["after"][0]["near_lag"], motion["after"][4]["near_lag"]);
    EXPECT_GT(motion["after"][0]["near_lag"], motion["still"]["near_lag"]);
    EXPECT_GT(motion["flicker"]["still"], 0.0);
    EXPECT_LT(motion["flicker"]["moving"], 0.5);
    EXPECT_GE(motion["flicker"]["of_still"], 0.5);

    const nlohmann::json unseen = measure("4, 4, 5.4", "5, 4, 5.4")["motion"][0];
    EXPECT_EQ(unseen["near_share"], 0.0);
    EXPECT_TRUE(unseen["still"]["near_relative_error"].is_null());
    EXPECT_TRUE(unseen["after"][0]["near_of_still"].is_null());
    EXPECT_GT(unseen["calm_share"], 0.9);

    m_dir.write("still.scene.json", std::string_view(R"({"objects": [{"file": "cube.glb"}]})"));
    expectErrorLine(runZvo(m_dir.path(), {"bench", "--kept", "still.scene.json"}), 3, {"still.scene.json", "moves"});
}

// Sponza is seen from inside, where another camera is not asked for.
TEST_F(CliCached, SponzaIsMeasuredInside)
{
    const std::optional<std::filesystem::path> sponza = sharedScene("sponza.glb");
    if (!sponza)
    {
        GTEST_SKIP() << "sponza.glb is not there";
    }
    const auto rows = [&](const std::vector<std::string>& more)
    {
        std::vector<std::string> arguments = {
            "bench",  "--kept", sponza->string(), "--resolution", "32", "--size", "16x9", "--reference", "4",
            "--json", "-"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const Outcome outcome = runZvo(m_dir.path(), arguments);
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        return nlohmann::json::parse(outcome.out)["rows"];
    };
    const nlohmann::json inside = rows({"--camera=-10,1.5,-0.4,5,2.5,-0.4,75"});
    const nlohmann::json usual = rows({});
    ASSERT_EQ(usual.size(), 10U) << "by day alone";
    EXPECT_EQ(usual[1]["relative_error"], inside[1]["relative_error"]);
}

TEST_F(CliCached, ErrorsNameTheOption)
{
    expectErrorLine(render({"--bounces", "3", "-o", "x.png"}), 2, {"--bounces", "--integrator path"});
    expectErrorLine(render({"--denoise", "-o", "x.png"}), 2, {"--denoise", "--integrator path"});
    expectErrorLine(render({"--view", "normal", "-o", "x.png"}), 2, {"--view", "--integrator cached"});
    expectErrorLine(render({"--rays", "0", "-o", "x.png"}), 2, {"--rays"});
    const std::vector<std::string> cones = {"render", "cube.glb", "-o", "x.png", "--integrator", "cones", "--denoise"};
    expectErrorLine(runZvo(m_dir.path(), cones), 2, {"--denoise", "--integrator path"});
    const std::vector<std::string> other = {"render", "cube.glb", "-o", "x.png", "--integrator", "cone"};
    expectErrorLine(runZvo(m_dir.path(), other), 2, {"--integrator", "cached", "cones"});
    const std::vector<std::string> path = {"render", "cube.glb", "-o", "x.png", "--integrator", "path"};
    for (const char* option : {"--settle", "--rays"})
    {
        std::vector<std::string> command = path;
        command.insert(command.end(), {option, "5"});
        expectErrorLine(runZvo(m_dir.path(), command), 2, {option, "--integrator cached"});
    }
}

} // namespace
} // namespace zvo::test
