// SPDX-License-Identifier: MIT
// Path-traced pictures on the command line.
#include "cli/cli_scene.h"
#include "cli/run_zvo.h"
#include "core/base/read_file.h"
#include "io/image/hdr_image_io.h"
#include "io/image/image_io.h"
#include "support/temp_dir.h"

#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <numeric>
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

    // A run that is interrupted while it traces its first picture.
    Outcome interrupted(std::vector<std::string> more)
    {
        const auto begin = std::chrono::steady_clock::now();
        const Outcome whole =
            ZvoProcess(m_dir.path(), command({"--integrator", "path", "--spp", "2", "-o", "picture.png"})).wait();
        EXPECT_EQ(whole.exit_code, 0) << whole.err;
        const auto whole_run = std::chrono::steady_clock::now() - begin;
        more.insert(more.end(), {"--integrator", "path", "--spp", "1000000"});
        ZvoProcess process(m_dir.path(), command(more));
        std::this_thread::sleep_for(3 * whole_run); // now paths are traced
        process.signal(SIGINT);
        return process.wait();
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

TEST_F(CliPath, TheReportTellsHowPathsWereTraced)
{
    const auto reported = [&](const std::vector<std::string>& more)
    {
        std::vector<std::string> options = {"--integrator", "path", "--spp", "2", "--json", "-"};
        options.insert(options.end(), more.begin(), more.end());
        const Outcome outcome = render(options);
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        return nlohmann::json::parse(outcome.out)["paths"];
    };
    const nlohmann::json plain = reported({"-o", "plain.png", "--tuning", "path-form=stages"});
    EXPECT_EQ(plain["samples_asked"], 2);
    EXPECT_EQ(plain["stopped"], false);
    EXPECT_EQ(plain["form"], "stages");
    EXPECT_EQ(plain["environment"], nullptr);
    ASSERT_EQ(plain["pictures"].size(), 1U);
    const nlohmann::json exposure = plain["pictures"][0]["exposure"];
    EXPECT_EQ(reported({"-o", "again.png", "--exposure", exposure.dump()})["pictures"][0]["exposure"], exposure);
    EXPECT_EQ(contentOf(m_dir.path() / "again.png"), contentOf(m_dir.path() / "plain.png"));
    const nlohmann::json radiance = reported(
        {"-o", "r.exr", "--seed", "7", "--environment", "sky.hdr", "--path-form", "kernel", "--aperture", "1"});
    EXPECT_EQ(radiance["pictures"][0]["exposure"], nullptr);
    EXPECT_EQ(radiance["seed"], 7);
    EXPECT_EQ(radiance["environment"], "sky.hdr");
    EXPECT_EQ(radiance["form"], "kernel");
    EXPECT_EQ(radiance["aperture"], 1.0);
    const nlohmann::json sequence = reported({"-o", "s_#.png", "--frames", "4..5"});
    ASSERT_EQ(sequence["pictures"].size(), 2U);
    EXPECT_EQ(sequence["pictures"][1]["frame"], 5);
    EXPECT_EQ(sequence["pictures"][1]["samples"], 2);
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

// A map as bright as a file holds, times 1e30.
TEST_F(CliPath, TheBrightestLightIsANumber)
{
    const HdrImage bright = {8, 4, std::vector(32, glm::vec3(1e38F))};
    m_dir.write("bright.hdr", encodeHdr(bright));
    const std::vector<std::string> options = {"--integrator", "path", "--environment", "bright.hdr",
                                              "--spp",        "2",    "--denoise",     "--environment-strength",
                                              "1e30",         "-o"};
    std::vector<std::string> radiance = options;
    radiance.emplace_back("bright_picture.hdr");
    const Outcome outcome = render(radiance);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_NE(outcome.err.find("32 texels"), std::string::npos) << outcome.err;
    std::vector<std::string> warnings;
    const HdrImage image =
        decodeHdrImage(readFile(m_dir.path() / "bright_picture.hdr"), "bright_picture.hdr", warnings);
    EXPECT_TRUE(warnings.empty() || warnings.front().find("no number") == std::string::npos);
    EXPECT_NEAR(image.texels.front().x / kRadianceMax, 1.0F, 5e-3F);
}

TEST_F(CliPath, OverexposedPicturesAreWhite)
{
    for (const std::string integrator : {"path", "primary"})
    {
        const Outcome outcome = render({"--integrator", integrator, "--exposure", "3e38", "-o", "white.png"});
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        const Image image = decodeImage(readFile(m_dir.path() / "white.png"), "picture", "white.png");
        for (std::size_t i = 0; i < image.rgba.size(); i += 4)
        {
            const auto sum = std::accumulate(&image.rgba[i], &image.rgba[i] + 3, 0);
            ASSERT_GE(sum, i == 0 ? 3 * 255 : 255) << "the sky is white, and no face is black";
        }
    }
}

TEST_F(CliPath, MapsThatAreRepairedAreToldOf)
{
    const Outcome outcome =
        render({"--integrator", "path", "--spp", "1", "--environment", "negative.exr", "-o", "picture.png"});
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_NE(outcome.err.find("warning: negative.exr: 1 texel has values that are negative"), std::string::npos)
        << outcome.err;
}

TEST_F(CliPath, TooLittleMemoryAsksForASmallerPicture)
{
    const std::vector<std::string> options = {
        "render", "cube.glb", "-f", "--size",        "640x360", "--resolution",   "16",  "--integrator", "path", "-o",
        "x.png",  "--spp",    "1",  "--environment", "none",    "--memory-limit", "20M", "--path-form"};
    std::vector<std::string> stages = options;
    stages.emplace_back("stages");
    expectErrorLine(runZvo(m_dir.path(), stages), 6, {"640 x 360", "smaller picture", "--path-form kernel"});
    std::vector<std::string> kernel = options;
    kernel.emplace_back("kernel");
    EXPECT_EQ(runZvo(m_dir.path(), kernel).exit_code, 0);
}

TEST_F(CliPath, DarknessIsToldOf)
{
    const auto warns = [&](const std::vector<std::string>& more)
    {
        std::vector<std::string> options = {"--integrator", "path", "--spp", "1", "-o", "picture.png"};
        options.insert(options.end(), more.begin(), more.end());
        const Outcome outcome = render(options);
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        return outcome.err.find("warning: nothing gives off light") != std::string::npos;
    };
    EXPECT_TRUE(warns({"--environment", "none"}));
    EXPECT_FALSE(warns({"--environment", "none", "--sun", "0,1,0"}));
    EXPECT_FALSE(warns({"--environment", "sky.hdr"}));
    EXPECT_FALSE(warns({}));
}

TEST_F(CliPath, TuningKeepsThePicture)
{
    EXPECT_EQ(render({"-o", "plain.png"}).exit_code, 0);
    EXPECT_EQ(render({"-o", "tuned.png", "--tuning", "row-columns=64,node-lanes=8"}).exit_code, 0);
    EXPECT_EQ(readFile(m_dir.path() / "tuned.png"), readFile(m_dir.path() / "plain.png"));
}

TEST_F(CliPath, ErrorsNameTheOption)
{
    expectErrorLine(render({"--spp", "3", "-o", "x.png"}), 2, {"--spp", "--integrator path"});
    expectErrorLine(render({"--environment", "sky.exr", "-o", "x.png"}), 2, {"--environment", "--integrator path"});
    expectErrorLine(render({"--path-form", "stages", "-o", "x.png"}), 2, {"--path-form", "--integrator path"});
    expectErrorLine(render({"--integrator", "path", "--path-form", "waves", "-o", "x.png"}), 2, {"--path-form"});
    expectErrorLine(render({"--integrator", "path", "--view", "normal", "-o", "x.png"}), 2, {"--view"});
    expectErrorLine(render({"--denoise", "-o", "x.png"}), 2, {"--denoise", "--integrator path"});
    expectErrorLine(render({"--integrator", "path", "--environment-turn", "90", "-o", "x.png"}), 2,
                    {"--environment-turn needs", "--environment FILE"});
    expectErrorLine(
        render({"--integrator", "path", "--environment", "none", "--environment-strength", "2", "-o", "x.png"}), 2,
        {"--environment-strength needs", "--environment FILE"});
    expectErrorLine(render({"--integrator", "path", "--focus", "2", "-o", "x.png"}), 2, {"--focus needs --aperture"});
    expectErrorLine(render({"--integrator", "path", "--aov", "-o", "x.png"}), 2, {"--aov", "x.png"});
    expectErrorLine(render({"--integrator", "light", "-o", "x.png"}), 2, {"--integrator", "light"});
    expectErrorLine(render({"--integrator", "path", "--spp", "0", "-o", "x.png"}), 2, {"--spp"});
    expectErrorLine(render({"--integrator", "path", "--bounces", "5000", "-o", "x.png"}), 2, {"--bounces"});
    expectErrorLine(render({"--integrator", "path", "--exposure", "inf", "-o", "x.png"}), 2, {"a finite number"});
    expectErrorLine(render({"--integrator", "path", "-o", "x.jpg"}), 2, {".exr"});
    expectErrorLine(render({"-o", "x.exr"}), 2, {".png"});
    expectErrorLine(render({"--integrator", "path", "--environment", "no.exr", "-o", "x.png"}), 3, {"no.exr"});
    expectErrorLine(render({"--integrator", "path", "--environment", "cube.glb", "-o", "x.png"}), 3, {"cube.glb"});
    expectErrorLine(render({"--integrator", "path", "--environment", "sky.exr", "-o", "sky.exr"}), 2, {"sky.exr"});
}

TEST_F(CliPath, NoPictureOfASequenceOverwritesAnInput)
{
    const std::string map = contentOf(m_dir.path() / "sky.exr");
    m_dir.write("sky_02.exr", std::string_view(map));
    m_dir.write("cube_1.png", std::string_view(contentOf(m_dir.path() / "cube.glb")));
    m_dir.write("path_2.png", std::string_view("{}"));
    const auto sequence = [&](std::vector<std::string> more)
    {
        more.insert(more.end(), {"--integrator", "path", "--spp", "1", "--frames", "1..2"});
        return render(more);
    };
    expectErrorLine(sequence({"--environment", "sky_02.exr", "-o", "sky_##.exr"}), 2,
                    {"sky_02.exr is an input and would be overwritten"});
    expectErrorLine(sequence({"cube_1.png", "-o", "./cube_#.png"}), 2, {"cube_1.png is an input"});
    expectErrorLine(sequence({"--camera-path", "path_2.png", "-o", "path_#.png"}), 2, {"path_2.png is an input"});
    expectErrorLine(sequence({"-o", "a_#.png", "--json", "./a_2.png"}), 2, {"a_2.png is named for two outputs"});
    EXPECT_EQ(contentOf(m_dir.path() / "sky_02.exr"), map);
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
    const Outcome outcome = interrupted({"-o", "x.png"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_NE(outcome.err.find("stopped after"), std::string::npos) << outcome.err;
    EXPECT_FALSE(contentOf(m_dir.path() / "x.png").empty());
}

TEST_F(CliPath, AnInterruptEndsASequenceWithItsPicture)
{
    const Outcome outcome = interrupted({"--frames", "3..9", "-o", "x_#.png", "--json", "-"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_NE(outcome.err.find("stopped after 1 of 7 pictures"), std::string::npos) << outcome.err;
    EXPECT_FALSE(contentOf(m_dir.path() / "x_3.png").empty());
    EXPECT_FALSE(std::filesystem::exists(m_dir.path() / "x_4.png"));
    const nlohmann::json report = nlohmann::json::parse(outcome.out);
    EXPECT_EQ(report["picture"]["count"], 1);
    EXPECT_EQ(report["paths"]["stopped"], true);
}

} // namespace
} // namespace zvo::test
