// SPDX-License-Identifier: MIT
// Path-traced pictures on the command line.
#include "cli/cli_scene.h"
#include "cli/run_zvo.h"
#include "core/base/read_file.h"
#include "io/image/hdr_image_io.h"
#include "support/temp_dir.h"

#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <vector>

namespace zvo::test
{
namespace
{

class CliPath : public testing::Test
{
protected:
    void SetUp() override
    {
        m_dir.write("cube.glb", coloredCube().glb());
        HdrImage sky = {8, 4, std::vector(32, glm::vec3(0.5F))};
        m_dir.write("sky.exr", encodeExr(sky));
        m_dir.write("sky.hdr", encodeHdr(sky));
        sky.texels[3].x = -1.0F;
        m_dir.write("negative.exr", encodeExr(sky));
    }

    static std::vector<std::string> command(const std::vector<std::string>& more)
    {
        std::vector<std::string> arguments = {"render", "cube.glb", "-f", "--size", "40x30", "--resolution", "16"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return arguments;
    }

    Outcome render(const std::vector<std::string>& more) { return runZvo(m_dir.path(), command(more)); }

    // The picture that a run writes.
    std::string picture(std::vector<std::string> more)
    {
        more.insert(more.end(), {"--integrator", "path", "--spp", "2", "-o", "picture.png"});
        const Outcome outcome = render(more);
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        return contentOf(m_dir.path() / "picture.png");
    }

    TempDir m_dir;
};

TEST_F(CliPath, EachOptionChangesThePicture)
{
    const std::string plain = picture({});
    EXPECT_EQ(picture({}), plain);
    const std::vector<std::vector<std::string>> others = {
        {"--seed", "1"},           {"--bounces", "0"},
        {"--exposure", "3"},       {"--aperture", "0.2", "--focus", "3"},
        {"--sun", "1,1,1"},        {"--environment", "sky.exr"},
        {"--environment", "none"}, {"--structure", "svo", "--environment", "sky.hdr", "--environment-strength", "2"}};
    for (const std::vector<std::string>& more : others)
    {
        EXPECT_NE(picture(more), plain) << more.front();
    }
    EXPECT_EQ(picture({"--structure", "svdag"}), plain);
    EXPECT_EQ(picture({"--path-form", "stages"}), plain);
    EXPECT_EQ(picture({"--path-form", "kernel"}), plain);
    EXPECT_EQ(picture({"--environment", "sky.exr"}), picture({"--environment", "sky.hdr"}));
    EXPECT_EQ(picture({"--environment", "sky.exr"}), picture({"--environment", "sky.exr", "--environment-turn", "360"}))
        << "of a map that is the same all around";
}

// A cube in a sky of 0.5: what is behind it is 0.5, and nothing is brighter.
TEST_F(CliPath, RadianceIsWrittenAsItIs)
{
    for (const std::string name : {"picture.exr", "picture.hdr"})
    {
        const Outcome outcome =
            render({"--integrator", "path", "--spp", "64", "--environment", "sky.exr", "-o", name, "--json", "-"});
        ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
        const nlohmann::json report = nlohmann::json::parse(outcome.out);
        EXPECT_EQ(report["paths"]["samples"], 64);
        EXPECT_EQ(report["paths"]["bounces"], 8);
        EXPECT_EQ(report["capped_rays"], 0);
        std::vector<std::string> warnings;
        const HdrImage image = decodeHdrImage(readFile(m_dir.path() / name), name, warnings);
        ASSERT_EQ(image.texels.size(), 40U * 30U);
        EXPECT_NEAR(image.texels.front().x, 0.5F, 0.003F);
        const glm::vec3 middle = image.texels[15 * 40 + 20];
        EXPECT_LT(middle.x + middle.y, 0.05F) << "the face towards +z is blue";
        EXPECT_GT(middle.z, 0.3F);
    }
}

// Of a cube in even light, denoising keeps what the camera sees of the light, and makes the rest smoother.
TEST_F(CliPath, DenoisedPicturesAreSmoother)
{
    const auto radiance = [&](const std::vector<std::string>& more)
    {
        std::vector<std::string> options = {"--integrator", "path", "--spp", "2", "-o", "picture.exr"};
        options.insert(options.end(), more.begin(), more.end());
        const Outcome outcome = render(options);
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        std::vector<std::string> warnings;
        return decodeHdrImage(readFile(m_dir.path() / "picture.exr"), "picture.exr", warnings).texels;
    };
    const std::vector<glm::vec3> plain = radiance({});
    const std::vector<glm::vec3> denoised = radiance({"--denoise"});
    // Neighbours on the face towards +z.
    const auto roughness = [](const std::vector<glm::vec3>& texels)
    {
        float sum = 0.0F;
        for (std::size_t y = 13; y < 18; ++y)
        {
            for (std::size_t x = 17; x < 23; ++x)
            {
                sum += std::abs(texels[y * 40 + x].z - texels[y * 40 + x + 1].z);
            }
        }
        return sum;
    };
    EXPECT_EQ(denoised.front(), plain.front()) << "the sky";
    EXPECT_LT(roughness(denoised), 0.3F * roughness(plain));
    EXPECT_EQ(radiance({"--aov"}), plain) << "channels beside the light do not change it";
    const std::string file = contentOf(m_dir.path() / "picture.exr");
    for (const char* channel :
         {"albedo.R", "albedo.G", "albedo.B", "normal.X", "normal.Y", "normal.Z", "depth.Z", "motion.X", "motion.Y"})
    {
        EXPECT_NE(file.find(channel), std::string::npos) << channel;
    }
}

// Each picture of a sequence has noise of its own, and knows of the ones before.
TEST_F(CliPath, SequencesAreDenoisedTogether)
{
    const auto last = [&](const std::string& frames, const std::string& file)
    {
        const Outcome outcome = render({"--integrator", "path", "--spp", "1", "--denoise", "--frames", frames,
                                        "--camera-path", "still.json", "-o", "frame_#.png"});
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        return contentOf(m_dir.path() / file);
    };
    m_dir.write("still.json", std::string_view(R"({"schema": "zvo.camera_path/1", "keys": [
        {"time": 0, "eye": [2, 2, 3], "target": [0, 0, 0]}, {"time": 9, "eye": [2, 2, 3], "target": [0, 0, 0]}]})"));
    EXPECT_NE(last("0..2", "frame_2.png"), last("2..2", "frame_2.png"));
    EXPECT_EQ(last("0..2", "frame_0.png"), last("0..0", "frame_0.png"));
}

TEST_F(CliPath, BenchTellsHowCloseDenoisedPicturesCome)
{
    const Outcome outcome = runZvo(
        m_dir.path(), {"bench", "--denoise", "cube.glb", "--resolution", "8", "--reference", "16", "--json", "-"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const nlohmann::json report = nlohmann::json::parse(outcome.out);
    ASSERT_EQ(report["rows"].size(), 8U) << "by day alone";
    const nlohmann::json& noisy = report["rows"][0];
    const nlohmann::json& denoised = report["rows"][1];
    EXPECT_EQ(noisy["samples"], 1);
    EXPECT_TRUE(denoised["denoised"]);
    EXPECT_GT(denoised["psnr_db"], noisy["psnr_db"]);
    EXPECT_LE(denoised["ssim"], 1.0);
}

TEST_F(CliPath, MapsThatAreRepairedAreToldOf)
{
    const Outcome outcome =
        render({"--integrator", "path", "--spp", "1", "--environment", "negative.exr", "-o", "picture.png"});
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_NE(outcome.err.find("warning: negative.exr: 1 texels"), std::string::npos) << outcome.err;
}

TEST_F(CliPath, BenchTellsOfRaysAndVariances)
{
    const Outcome outcome = runZvo(m_dir.path(), {"bench", "--path", "cube.glb", "--resolution", "8", "--runs", "1",
                                                  "--environment", "sky.exr", "--json", "-"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const nlohmann::json report = nlohmann::json::parse(outcome.out);
    const nlohmann::json& row = report["rows"][0];
    EXPECT_EQ(row["primary"]["count"], 640 * 360);
    EXPECT_LT(row["bounces"]["count"], row["primary"]["count"]) << "a cube sends no ray back to itself";
    EXPECT_GT(row["shadows"]["count"], 1000);
    EXPECT_GT(row["sample_ms"]["median"], 0.0);
    EXPECT_GT(row["one_kernel_ms"]["median"], 0.0);
    ASSERT_EQ(report["variances"].size(), 1U) << "nothing gives off light";
    EXPECT_EQ(report["variances"][0]["light"], "sky");
    expectErrorLine(runZvo(m_dir.path(), {"bench", "cube.glb", "--environment", "sky.exr"}), 2, {"--environment"});
}

TEST_F(CliPath, ErrorsNameTheOption)
{
    expectErrorLine(render({"--spp", "3", "-o", "x.png"}), 2, {"--spp", "--integrator path"});
    expectErrorLine(render({"--environment", "sky.exr", "-o", "x.png"}), 2, {"--environment", "--integrator path"});
    expectErrorLine(render({"--path-form", "stages", "-o", "x.png"}), 2, {"--path-form", "--integrator path"});
    expectErrorLine(render({"--integrator", "path", "--path-form", "waves", "-o", "x.png"}), 2, {"--path-form"});
    expectErrorLine(render({"--integrator", "path", "--view", "normal", "-o", "x.png"}), 2, {"--view"});
    expectErrorLine(render({"--denoise", "-o", "x.png"}), 2, {"--denoise", "--integrator path"});
    expectErrorLine(render({"--integrator", "path", "--aov", "-o", "x.png"}), 2, {"--aov", "x.png"});
    expectErrorLine(render({"--integrator", "light", "-o", "x.png"}), 2, {"--integrator", "light"});
    expectErrorLine(render({"--integrator", "path", "--spp", "0", "-o", "x.png"}), 2, {"--spp"});
    expectErrorLine(render({"--integrator", "path", "--bounces", "5000", "-o", "x.png"}), 2, {"--bounces"});
    expectErrorLine(render({"--integrator", "path", "-o", "x.jpg"}), 2, {".exr"});
    expectErrorLine(render({"-o", "x.exr"}), 2, {".png"});
    expectErrorLine(render({"--integrator", "path", "--environment", "no.exr", "-o", "x.png"}), 3, {"no.exr"});
    expectErrorLine(render({"--integrator", "path", "--environment", "cube.glb", "-o", "x.png"}), 3, {"cube.glb"});
    expectErrorLine(render({"--integrator", "path", "--environment", "sky.exr", "-o", "sky.exr"}), 2, {"sky.exr"});
}

TEST_F(CliPath, ATimeLimitEndsThePicture)
{
    const Outcome outcome = render({"--integrator", "path", "--spp", "1000000", "--time-limit", "0.2", "-o", "x.png"});
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_NE(outcome.err.find("stopped after"), std::string::npos) << outcome.err;
    EXPECT_FALSE(contentOf(m_dir.path() / "x.png").empty());
}

TEST_F(CliPath, AnInterruptWritesThePictureSoFar)
{
    const auto begin = std::chrono::steady_clock::now();
    picture({});
    const auto whole_run = std::chrono::steady_clock::now() - begin;
    ZvoProcess process(m_dir.path(), command({"--integrator", "path", "--spp", "1000000", "-o", "x.png"}));
    std::this_thread::sleep_for(3 * whole_run); // now paths are traced
    process.signal(SIGINT);
    const Outcome outcome = process.wait();
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_NE(outcome.err.find("stopped after"), std::string::npos) << outcome.err;
    EXPECT_FALSE(contentOf(m_dir.path() / "x.png").empty());
}

} // namespace
} // namespace zvo::test
