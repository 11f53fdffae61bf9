// SPDX-License-Identifier: MIT
// What zvo-bench tells of paths, of the radiance cache, and of choices by device.
#include "bench/bench_run.h"
#include "core/base/tuning.h"
#include "io/image/hdr_image_io.h"
#include "support/scenes.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace zvo::test
{
namespace
{

using BenchLight = BenchRun;

// More frames are closer to paths.
TEST_F(BenchLight, RadianceCacheIsComparedWithPaths)
{
    const json report = reportOf({"cache", "cube.glb", "--resolution", "8", "--size", "24x18", "--reference", "64"});
    EXPECT_EQ(report["schema"], "zvo.bench_cache/1");
    const json& rows = report["rows"];
    ASSERT_EQ(rows.size(), 10U);
    EXPECT_EQ(rows[0]["integrator"], "primary");
    EXPECT_EQ(rows[3]["integrator"], "path");
    for (const std::size_t i : {4U, 6U, 8U})
    {
        EXPECT_EQ(rows[i]["integrator"], "cache");
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
}

// A cube crosses the picture in front of another one; or it moves behind the camera, and nothing is near.
TEST_F(BenchLight, RadianceCacheFollowsWhatMoves)
{
    const auto measure = [&](const std::string& from, const std::string& to)
    {
        m_dir.write("move.scene.json", fmt::format(R"({{"seconds": 2, "frames_per_second": 20, "grid": {{"bounds":
                    {{"min": [-2, -2, -2], "max": [6, 6, 6]}}}}, "camera": {{"eye": [0.5, 0.5, 5], "target": [0.5, 0.5, 0]}},
                    "objects": [{{"file": "cube.glb"}}, {{"file": "cube.glb", "place": {{"scale": 0.4}},
                    "motion": {{"line": {{"from": [{}], "to": [{}]}}}}}}]}})",
                                                   from, to));
        return reportOf({"cache", "move.scene.json", "--resolution", "16", "--size", "24x18", "--reference", "64"});
    };
    const json report = measure("-1, 0.3, 1.5", "2, 0.3, 1.5");
    EXPECT_TRUE(report["rows"].empty());
    ASSERT_EQ(report["motion"].size(), 1U) << "by day: nothing gives off light";
    const json& motion = report["motion"][0];
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
    for (const json& after : motion["after"])
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

    const json unseen = measure("4, 4, 5.4", "5, 4, 5.4")["motion"][0];
    EXPECT_EQ(unseen["near_share"], 0.0);
    EXPECT_TRUE(unseen["still"]["near_relative_error"].is_null());
    EXPECT_TRUE(unseen["after"][0]["near_of_still"].is_null());
    EXPECT_GT(unseen["calm_share"], 0.9);

    m_dir.write("still.scene.json", std::string_view(R"({"objects": [{"file": "cube.glb"}]})"));
    expectError({"cache", "still.scene.json"}, 3, {"still.scene.json", "moves"});
}

// Sponza is seen from inside, where another camera is not asked for.
TEST_F(BenchLight, SponzaIsMeasuredInside)
{
    const std::optional<std::filesystem::path> sponza = sharedScene("sponza.glb");
    if (!sponza)
    {
        GTEST_SKIP() << "sponza.glb is not there";
    }
    const auto rows = [&](const std::vector<std::string>& more)
    {
        std::vector<std::string> arguments = {"cache",  sponza->string(), "--resolution", "32",
                                              "--size", "16x9",           "--reference",  "4"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return reportOf(arguments)["rows"];
    };
    const json inside = rows({"--camera=-10,1.5,-0.4,5,2.5,-0.4,75"});
    const json usual = rows({});
    ASSERT_EQ(usual.size(), 10U) << "by day alone";
    EXPECT_EQ(usual[1]["relative_error"], inside[1]["relative_error"]);
}

TEST_F(BenchLight, DenoiseTellsHowClosePicturesCome)
{
    const json report = reportOf({"denoise", "cube.glb", "--resolution", "8", "--reference", "16"});
    ASSERT_EQ(report["rows"].size(), 8U) << "by day alone";
    const json& noisy = report["rows"][0];
    const json& denoised = report["rows"][1];
    EXPECT_EQ(noisy["samples"], 1);
    EXPECT_TRUE(denoised["denoised"]);
    EXPECT_GT(denoised["psnr_db"], noisy["psnr_db"]);
    EXPECT_LE(denoised["ssim"], 1.0);
}

TEST_F(BenchLight, PathTellsOfRaysAndVariances)
{
    m_dir.write("sky.exr", encodeExr({8, 4, std::vector(32, glm::vec3(0.5F))}));
    const json report = reportOf(
        {"path", "cube.glb", "--resolution", "8", "--runs", "1", "--size", "320x180", "--environment", "sky.exr"});
    const json& row = report["rows"][0];
    EXPECT_EQ(report["width"], 320);
    EXPECT_EQ(report["height"], 180);
    EXPECT_EQ(row["primary"]["count"], 320 * 180);
    EXPECT_LT(row["bounces"]["count"], row["primary"]["count"]) << "a cube sends no ray back to itself";
    EXPECT_GT(row["shadows"]["count"], 1000);
    EXPECT_GT(row["sample_ms"]["median"], 0.0);
    EXPECT_GT(row["one_kernel_ms"]["median"], 0.0);
    ASSERT_EQ(report["variances"].size(), 1U) << "nothing gives off light";
    EXPECT_EQ(report["variances"][0]["light"], "sky");
}

TEST_F(BenchLight, TuneMeasuresEveryChoiceByDevice)
{
    const json report = reportOf({"tune", "cube.glb", "--resolution", "8", "--runs", "1", "--size", "32x18"});
    std::map<std::string, int> value_counts;
    std::map<std::string, int> default_counts;
    for (const json& row : report["rows"])
    {
        value_counts[row["choice"]] += 1;
        default_counts[row["choice"]] += row["is_default"] ? 1 : 0;
        EXPECT_GT(row["ms"]["median"], 0.0) << row["choice"];
    }
    EXPECT_EQ(value_counts["node-lanes"], 5);
    EXPECT_EQ(value_counts["path-form"], 2);
    EXPECT_EQ(value_counts.size(), tuningTable().size());
    for (const auto& [choice, count] : default_counts)
    {
        EXPECT_EQ(count, 1) << choice;
    }
    const json tuned = reportOf(
        {"build", "cube.glb", "--resolution", "32", "--runs", "1", "--tuning", report["tuning"].get<std::string>()});
    EXPECT_EQ(tuned["rows"][0]["voxels"], build(m_grid).octree.voxel_count);
}

} // namespace
} // namespace zvo::test
