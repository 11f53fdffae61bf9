// SPDX-License-Identifier: MIT
// Pictures of the radiance cache, on the command line.
#include "cli/cli_folder.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace zvo::test
{
namespace
{

const std::string kCached = "render cube.glb -f --size 40x30 --resolution 16 --integrator cache ";
const std::string kFormerly = "render cube.glb -f --size 40x30 --resolution 16 --integrator cached ";

class CliCache : public CliFolder
{
protected:
    CliCache() { m_dir.write("sky.exr", encodeExr({8, 4, std::vector(32, glm::vec3(0.5F))})); }

    // The picture of a run that succeeds.
    [[nodiscard]] std::string picture(const std::string& options) const
    {
        run(kCached + options + " --spp 2 -o picture.png");
        return file("picture.png");
    }
};

TEST_F(CliCache, EachOptionChangesThePicture)
{
    const std::string plain = picture("--settle 12");
    EXPECT_EQ(picture("--settle 12"), plain);
    EXPECT_TRUE(picture("--settle 0") != plain);
    for (const std::string option : {"--seed 1", "--rays 5", "--exposure 3", "--sun 1,1,1", "--shading faces",
                                     "--environment sky.exr", "--environment none --sun 1,2,3"})
    {
        EXPECT_TRUE(picture("--settle 12 " + option) != plain) << option;
    }
    EXPECT_EQ(picture("--settle 12 --structure svdag"), plain) << "a DAG has its light in the same places";
}

// Cones show the same light in another way, the same in every run and of every structure.
TEST_F(CliCache, ConesShowTheLight)
{
    const auto cones = [this](const std::string& options)
    {
        run("render -f --size 40x30 --integrator cones --spp 2 -o cones.png " + options);
        return file("cones.png");
    };
    const std::string cube = "cube.glb --resolution 16 --settle ";
    const std::string plain = cones(cube + "12");
    EXPECT_TRUE(picture("--settle 12") != plain);
    EXPECT_TRUE(cones(cube + "12") == plain);
    for (const std::string options : {"12 --seed 1", "0", "12 --sun 1,1,1"})
    {
        EXPECT_TRUE(cones(cube + options) != plain) << options;
    }
    EXPECT_TRUE(cones(cube + "12 --structure svdag") == plain);
    for (const std::string format : {"4", "block"})
    {
        std::vector<std::string> pictures;
        for (const std::string structure : {"svo", "svdag"})
        {
            const Outcome built = runZvo(m_dir.path(), "build cube.glb -f -o cube.zvo --resolution 16 --structure " +
                                                           structure + " --attributes " + format);
            if (structure == "svo" && built.exit_code != 0)
            {
                continue; // packed formats are of DAGs
            }
            ASSERT_EQ(built.exit_code, 0) << built.err;
            pictures.push_back(cones("cube.zvo --settle 12"));
            EXPECT_TRUE(pictures.back() == pictures.front());
        }
        EXPECT_FALSE(pictures.empty());
    }
}

// A picture of radiance, and what the report says.
TEST_F(CliCache, ReportsWhatIsCached)
{
    const json cached =
        printedBy(kCached + "--settle 20 --spp 3 --rays 1000 --environment sky.exr -o picture.exr --json -")["cached"];
    EXPECT_EQ(cached["settle"], 20);
    EXPECT_EQ(cached["samples"], 3);
    EXPECT_EQ(cached["rays"], 1000);
    EXPECT_GT(cached["faces"], 150);
    EXPECT_EQ(cached["faces_refused"], 0);
    EXPECT_EQ(cached["crowded"], false);
    EXPECT_GE(cached["room"], cached["faces"]);
    EXPECT_GT(cached["bytes"], 35 * cached["room"].get<int>());
    EXPECT_EQ(radiance("picture.exr").front(), glm::vec3(0.5F)) << "the sky";
}

// Without memory for a larger table there is a picture, by the faces that the last one has room for.
TEST_F(CliCache, ReportsATableThatMustNotGrow)
{
    const std::string fine =
        "render cube.glb -f --size 160x120 --resolution 128 --integrator cache --settle 24 --spp 1 "
        "--rays 500 -o fine.png --json - ";
    const json most = printedBy(fine);
    EXPECT_EQ(most["cached"]["crowded"], false);
    json cached;
    for (std::uint64_t limit = most["bytes"]["peak_device"].get<std::uint64_t>() + 1000000; cached["crowded"] != true;)
    {
        limit -= 250000;
        const json report = printedBy(fine + "--memory-limit " + std::to_string(limit));
        ASSERT_TRUE(report.contains("cached")) << limit;
        cached = report["cached"];
    }
    EXPECT_LT(cached["room"], most["cached"]["room"]);
    EXPECT_LT(cached["bytes"], most["cached"]["bytes"]);
    EXPECT_GT(cached["faces"], 2000);
}

// A sequence has one cache: its light settles once. The integrator is asked for by its old name.
TEST_F(CliCache, SequencesSettleOnce)
{
    const json report = printedBy(kFormerly + "--frames 0..2 --settle 5 --spp 2 -o turn_#.png --json -");
    EXPECT_EQ(report["cached"]["pictures"].size(), 3U);
    EXPECT_EQ(report["capped_rays"], 0);
    EXPECT_NE(file("turn_0.png"), file("turn_1.png"));
}

// Without room for the light there is a picture by primary rays.
TEST_F(CliCache, TracesWithoutLightIfThereIsNoRoom)
{
    const std::string told = run(kCached + "-o small.png --memory-limit 14M").err;
    EXPECT_TRUE(contains(told, "warning: no radiance cache")) << told;
    EXPECT_TRUE(contains(told, "--memory-limit")) << told;
    run("render cube.glb --size 40x30 --resolution 16 -o primary.png --spp 1");
    EXPECT_TRUE(file("small.png") == file("primary.png"));
    EXPECT_EQ(runZvo(m_dir.path(), kCached + "-o small.exr --memory-limit 14M").exit_code, 6);
}

TEST_F(CliCache, ErrorsNameTheOption)
{
    expectError(kCached + "-o x.png --bounces 3", 2, {"--bounces", "--integrator path"});
    expectError(kCached + "-o x.png --denoise", 2, {"--denoise", "--integrator path"});
    expectError(kCached + "-o x.png --view normal", 2, {"--view", "--integrator cache"});
    expectError(kCached + "-o x.png --rays 0", 2, {"--rays"});
    const std::string render = "render cube.glb -o x.png --integrator ";
    expectError(render + "cones --denoise", 2, {"--denoise", "--integrator path"});
    expectError(render + "cone", 2, {"--integrator", "cache", "cones"});
    expectError(render + "path --settle 5", 2, {"--settle", "--integrator cache"});
    expectError(render + "path --rays 5", 2, {"--rays", "--integrator cache"});
}

} // namespace
} // namespace zvo::test
