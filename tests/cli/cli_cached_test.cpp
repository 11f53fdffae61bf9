// SPDX-License-Identifier: MIT
// Pictures of light that is kept on voxels, on the command line.
#include "cli/cli_scene.h"
#include "cli/run_zvo.h"
#include "io/image/hdr_image_io.h"
#include "support/temp_dir.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
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
