// SPDX-License-Identifier: MIT
// Path-traced pictures on the command line.
#include "cli/cli_folder.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <numeric>
#include <string>
#include <thread>
#include <vector>

namespace zvo::test
{
namespace
{

const std::string kCube = "render cube.glb -f --size 40x30 --resolution 16 ";
const std::string kPath = kCube + "--integrator path ";

class CliPath : public CliFolder
{
protected:
    CliPath()
    {
        HdrImage sky = {8, 4, std::vector(32, glm::vec3(0.5F))};
        m_dir.write("sky.exr", encodeExr(sky));
        m_dir.write("sky.hdr", encodeHdr(sky));
        sky.texels[3].x = -1.0F;
        m_dir.write("negative.exr", encodeExr(sky));
    }

    // The picture that a run writes.
    [[nodiscard]] std::string picture(const std::string& options) const
    {
        run(kPath + "--spp 2 -o picture.png " + options);
        return file("picture.png");
    }

    // A run that is interrupted while it traces its first picture.
    [[nodiscard]] Outcome interrupted(const std::string& options) const
    {
        const auto begin = std::chrono::steady_clock::now();
        const Outcome whole = ZvoProcess(m_dir.path(), kPath + "--spp 2 -o picture.png").wait();
        EXPECT_EQ(whole.exit_code, 0) << whole.err;
        const auto whole_run = std::chrono::steady_clock::now() - begin;
        ZvoProcess process(m_dir.path(), kPath + "--spp 1000000 " + options);
        std::this_thread::sleep_for(3 * whole_run); // now paths are traced
        process.signal(SIGINT);
        return process.wait();
    }
};

TEST_F(CliPath, EachOptionChangesThePicture)
{
    const std::string plain = picture("");
    EXPECT_EQ(picture(""), plain);
    for (const char* options : {"--seed 1", "--bounces 0", "--exposure 3", "--aperture 0.2 --focus 3", "--sun 1,1,1",
                                "--shading faces", "--environment sky.exr", "--environment none",
                                "--structure svo --environment sky.hdr --environment-strength 2"})
    {
        EXPECT_NE(picture(options), plain) << options;
    }
    EXPECT_EQ(picture("--structure svdag"), plain);
    EXPECT_EQ(picture("--path-form stages"), plain);
    EXPECT_EQ(picture("--path-form kernel"), plain);
    EXPECT_EQ(picture("--environment sky.exr"), picture("--environment sky.hdr"));
    EXPECT_EQ(picture("--environment sky.exr"), picture("--environment sky.exr --environment-turn 360"))
        << "of a map that is the same all around";
}

// A cube in a sky of 0.5: what is behind it is 0.5, and nothing is brighter.
TEST_F(CliPath, RadianceIsWrittenAsItIs)
{
    for (const std::string name : {"picture.exr", "picture.hdr"})
    {
        const json report = printedBy(kPath + "--spp 64 --environment sky.exr --json - -o " + name);
        EXPECT_EQ(report["paths"]["samples"], 64);
        EXPECT_EQ(report["paths"]["bounces"], 8);
        EXPECT_EQ(report["capped_rays"], 0);
        const std::vector<glm::vec3> texels = radiance(name);
        ASSERT_EQ(texels.size(), 40U * 30U);
        EXPECT_NEAR(texels.front().x, 0.5F, 0.003F);
        const glm::vec3 middle = texels[15 * 40 + 20];
        EXPECT_LT(middle.x + middle.y, 0.05F) << "the face towards +z is blue";
        EXPECT_GT(middle.z, 0.3F);
    }
}

// A pixel of many samples is the mean of the pixels that a larger picture of one sample has in its place.
TEST_F(CliPath, SamplesOfPrimaryRaysSmoothEdges)
{
    constexpr std::uint32_t kFactor = 16;
    const std::string scene = "render cube.glb -f --resolution 16 --camera 3,2,6,0.5,0.5,0.5,30 --occlusion 0 -o ";
    const json report = printedBy(scene + "small.exr --size 20x15 --spp 512 --json -");
    EXPECT_EQ(report["primary"]["samples"], 512);
    EXPECT_EQ(report["capped_rays"], 0);
    run(scene + "large.exr --size 320x240 --spp 1");
    const std::vector<glm::vec3> small = radiance("small.exr");
    const std::vector<glm::vec3> large = radiance("large.exr");
    ASSERT_EQ(large.size(), kFactor * kFactor * small.size());
    for (std::uint32_t pixel = 0; pixel < small.size(); ++pixel)
    {
        const std::uint32_t corner = pixel / 20 * kFactor * 320 + pixel % 20 * kFactor;
        glm::vec3 mean(0.0F);
        for (std::uint32_t i = 0; i < kFactor * kFactor; ++i)
        {
            mean += large[corner + i / kFactor * 320 + i % kFactor] / float{kFactor * kFactor};
        }
        EXPECT_LT(glm::length(small[pixel] - mean), 0.03F) << pixel;
    }
}

TEST_F(CliPath, TheReportTellsHowPathsWereTraced)
{
    const auto reported = [this](const std::string& options)
    { return printedBy(kPath + "--spp 2 --json - " + options)["paths"]; };
    const json plain = reported("-o plain.png --tuning path-form=stages");
    EXPECT_EQ(plain["samples_asked"], 2);
    EXPECT_EQ(plain["stopped"], false);
    EXPECT_EQ(plain["form"], "stages");
    EXPECT_EQ(plain["environment"], nullptr);
    ASSERT_EQ(plain["pictures"].size(), 1U);
    const json exposure = plain["pictures"][0]["exposure"];
    EXPECT_EQ(reported("-o again.png --exposure " + exposure.dump())["pictures"][0]["exposure"], exposure);
    EXPECT_EQ(file("again.png"), file("plain.png"));
    const json radiance = reported("-o r.exr --seed 7 --environment sky.hdr --path-form kernel --aperture 1");
    EXPECT_EQ(radiance["pictures"][0]["exposure"], nullptr);
    EXPECT_EQ(radiance["seed"], 7);
    EXPECT_EQ(radiance["environment"], "sky.hdr");
    EXPECT_EQ(radiance["form"], "kernel");
    EXPECT_EQ(radiance["aperture"], 1.0);
    const json sequence = reported("-o s_#.png --frames 4..5");
    ASSERT_EQ(sequence["pictures"].size(), 2U);
    EXPECT_EQ(sequence["pictures"][1]["frame"], 5);
    EXPECT_EQ(sequence["pictures"][1]["exposure"], sequence["pictures"][0]["exposure"]) << "it would flicker";
    EXPECT_EQ(sequence["pictures"][1]["samples"], 2);
}

// The camera is 3 away from the face in front of it, and the grid's voxels are a 13th of the cube.
TEST_F(CliPath, WhatIsInTheMiddleIsInFocus)
{
    const std::string lens = kPath + "--spp 2 --json - --aperture 0.3 -o ";
    const json focus = printedBy(lens + "auto.png")["paths"]["focus"];
    EXPECT_NEAR(focus.get<double>(), 3.0, 1.0 / 13);
    EXPECT_EQ(printedBy(lens + "given.png --focus " + focus.dump())["paths"]["focus"], focus);
    EXPECT_EQ(file("auto.png"), file("given.png"));
    EXPECT_EQ(printedBy(lens + "far.png --focus 9")["paths"]["focus"], 9.0);
    EXPECT_NE(file("far.png"), file("auto.png"));
    EXPECT_TRUE(contains(run(lens + "sky.png --camera 0,0,4,0,9,0").err, "nothing is at the picture's middle"));
}

// Of a cube in even light, denoising keeps what the camera sees of the light, and makes the rest smoother.
TEST_F(CliPath, DenoisedPicturesAreSmoother)
{
    const auto radianceOf = [this](const std::string& options)
    {
        run(kPath + "--spp 2 -o picture.exr " + options);
        return radiance("picture.exr");
    };
    const std::vector<glm::vec3> plain = radianceOf("");
    const std::vector<glm::vec3> denoised = radianceOf("--denoise");
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
    EXPECT_EQ(radianceOf("--aov"), plain) << "channels beside the light do not change it";
    for (const char* channel :
         {"albedo.R", "albedo.G", "albedo.B", "normal.X", "normal.Y", "normal.Z", "depth.Z", "motion.X", "motion.Y"})
    {
        EXPECT_TRUE(contains(file("picture.exr"), channel)) << channel;
    }
}

// Each picture of a sequence has noise of its own, and knows of the ones before.
TEST_F(CliPath, SequencesAreDenoisedTogether)
{
    m_dir.write("still.json", std::string_view(R"({"schema": "zvo.camera_path/1", "keys": [
        {"time": 0, "eye": [2, 2, 3], "target": [0, 0, 0]}, {"time": 9, "eye": [2, 2, 3], "target": [0, 0, 0]}]})"));
    const auto last = [this](const std::string& frames, const std::string& name)
    {
        run(kPath + "--spp 1 --denoise --camera-path still.json -o frame_#.png --frames " + frames);
        return file(name);
    };
    EXPECT_NE(last("0..2", "frame_2.png"), last("2..2", "frame_2.png"));
    EXPECT_EQ(last("0..2", "frame_0.png"), last("0..0", "frame_0.png"));
}

// A map as bright as a file holds, times 1e30.
TEST_F(CliPath, TheBrightestLightIsANumber)
{
    m_dir.write("bright.hdr", encodeHdr({8, 4, std::vector(32, glm::vec3(1e38F))}));
    const std::string told =
        run(kPath + "--environment bright.hdr --spp 2 --denoise --environment-strength 1e30 -o picture.hdr").err;
    EXPECT_TRUE(contains(told, "32 texels")) << told;
    EXPECT_NEAR(radiance("picture.hdr").front().x / kRadianceMax, 1.0F, 5e-3F);
}

TEST_F(CliPath, OverexposedPicturesAreWhite)
{
    for (const std::string integrator : {"path", "primary"})
    {
        run(kCube + "--exposure 3e38 -o white.png --integrator " + integrator);
        const Image image = pixels("white.png");
        for (std::size_t i = 0; i < image.rgba.size(); i += 4)
        {
            const auto sum = std::accumulate(&image.rgba[i], &image.rgba[i] + 3, 0);
            ASSERT_GE(sum, i == 0 ? 3 * 254 : 255) << "the sky is white, and no face is black";
        }
    }
}

TEST_F(CliPath, MapsThatAreRepairedAreToldOf)
{
    const std::string told = run(kPath + "--spp 1 --environment negative.exr -o picture.png").err;
    EXPECT_TRUE(contains(told, "warning: negative.exr: 1 texel has values that are negative")) << told;
}

TEST_F(CliPath, TooLittleMemoryAsksForASmallerPicture)
{
    const std::string large = "render cube.glb -f --size 640x360 --resolution 16 --integrator path -o x.png --spp 1 "
                              "--environment none --memory-limit 20M --path-form ";
    expectError(large + "stages", 6, {"640 x 360", "smaller picture", "--path-form kernel"});
    run(large + "kernel");
}

TEST_F(CliPath, DarknessIsToldOf)
{
    const auto warns = [this](const std::string& options)
    { return contains(run(kPath + "--spp 1 -o picture.png " + options).err, "warning: nothing gives off light"); };
    EXPECT_TRUE(warns("--environment none"));
    EXPECT_FALSE(warns("--environment none --sun 0,1,0"));
    EXPECT_FALSE(warns("--environment sky.hdr"));
    EXPECT_FALSE(warns(""));
}

TEST_F(CliPath, TuningKeepsThePicture)
{
    run(kCube + "-o plain.png");
    run(kCube + "-o tuned.png --tuning block-lanes=8,node-lanes=8");
    EXPECT_EQ(file("tuned.png"), file("plain.png"));
}

TEST_F(CliPath, ErrorsNameTheOption)
{
    const std::string primary = kCube + "-o x.png ";
    expectError(primary + "--spp 3 --view normal", 2, {"--spp", "--view normal"});
    expectError(primary + "--environment sky.exr", 2, {"--environment", "--integrator path"});
    expectError(primary + "--path-form stages", 2, {"--path-form", "--integrator path"});
    expectError(primary + "--denoise", 2, {"--denoise", "--integrator path"});
    expectError(primary + "--integrator light", 2, {"--integrator", "light"});
    expectError(kCube + "-o x.exr --view normal", 2, {".png"});
    const std::string path = kPath + "-o x.png ";
    expectError(path + "--path-form waves", 2, {"--path-form"});
    expectError(path + "--view normal", 2, {"--view"});
    expectError(path + "--environment-turn 90", 2, {"--environment-turn needs", "--environment FILE"});
    expectError(path + "--environment none --environment-strength 2", 2,
                {"--environment-strength needs", "--environment FILE"});
    expectError(path + "--background-blur 5", 2, {"--background-blur needs", "--environment FILE"});
    expectError(path + "--environment sky.exr --background-blur 91", 2, {"--background-blur 91", "at most 90"});
    expectError(path + "--time-of-day 6", 2, {"--time-of-day 6", "23:59"});
    expectError(path + "--time-of-day 24:00", 2, {"--time-of-day 24:00"});
    expectError(path + "--time-of-day 6:00 --sun 1,1,1", 2, {"--time-of-day", "--sun"});
    expectError(path + "--focus 2", 2, {"--focus needs --aperture"});
    expectError(path + "--aov", 2, {"--aov", "x.png"});
    expectError(path + "--spp 0", 2, {"--spp"});
    expectError(path + "--bounces 5000", 2, {"--bounces"});
    expectError(path + "--exposure inf", 2, {"a finite number"});
    expectError(path + "--environment no.exr", 3, {"no.exr"});
    expectError(path + "--environment cube.glb", 3, {"cube.glb"});
    expectError(kPath + "-o x.bmp", 2, {".exr"});
    expectError(kPath + "-o sky.exr --environment sky.exr", 2, {"sky.exr"});
}

TEST_F(CliPath, NoPictureOfASequenceOverwritesAnInput)
{
    const std::string map = file("sky.exr");
    m_dir.write("sky_02.exr", std::string_view(map));
    m_dir.write("cube_1.png", std::string_view(file("cube.glb")));
    m_dir.write("path_2.png", std::string_view("{}"));
    const std::string sequence = kPath + "--spp 1 --frames 1..2 ";
    expectError(sequence + "--environment sky_02.exr -o sky_##.exr", 2,
                {"sky_02.exr is an input and would be overwritten"});
    expectError(sequence + "cube_1.png -o ./cube_#.png", 2, {"cube_1.png is an input"});
    expectError(sequence + "--camera-path path_2.png -o path_#.png", 2, {"path_2.png is an input"});
    expectError(sequence + "-o a_#.png --json ./a_2.png", 2, {"a_2.png is named for two outputs"});
    EXPECT_EQ(file("sky_02.exr"), map);
}

TEST_F(CliPath, ATimeLimitEndsThePicture)
{
    const std::string told = run(kPath + "--spp 1000000 --time-limit 0.2 -o x.png").err;
    EXPECT_TRUE(contains(told, "stopped after")) << told;
    EXPECT_FALSE(file("x.png").empty());
}

TEST_F(CliPath, AnInterruptWritesThePictureSoFar)
{
    const Outcome outcome = interrupted("-o x.png");
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_TRUE(contains(outcome.err, "stopped after")) << outcome.err;
    EXPECT_FALSE(file("x.png").empty());
}

TEST_F(CliPath, AnInterruptEndsASequenceWithItsPicture)
{
    const Outcome outcome = interrupted("--frames 3..9 -o x_#.png --json -");
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_TRUE(contains(outcome.err, "stopped after 1 of 7 pictures")) << outcome.err;
    EXPECT_FALSE(file("x_3.png").empty());
    EXPECT_FALSE(std::filesystem::exists(m_dir.path() / "x_4.png"));
    const json report = json::parse(outcome.out);
    EXPECT_EQ(report["picture"]["count"], 1);
    EXPECT_EQ(report["paths"]["stopped"], true);
}

} // namespace
} // namespace zvo::test
