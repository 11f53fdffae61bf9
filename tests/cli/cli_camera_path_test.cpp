// SPDX-License-Identifier: MIT
// Pictures along camera paths on the command line.
#include "cli/cli_scene.h"
#include "cli/run_zvo.h"
#include "support/device.h"
#include "support/temp_dir.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

namespace zvo::test
{
namespace
{

class CliCameraPath : public testing::Test
{
protected:
    void SetUp() override
    {
        m_dir.write("cube.glb", coloredCube().glb());
        m_dir.write("path.json", std::string_view(R"({"schema": "zvo.camera_path/1", "keys": [
            {"time": 0.1, "eye": [3, 2, 6], "target": [0.5, 0.5, 0.5], "fov": 50},
            {"time": 0.2, "eye": [0, 3, 7], "target": [0.5, 1, 0.5], "fov": 60}]})"));
    }

    Outcome render(std::vector<std::string> arguments)
    {
        arguments.insert(arguments.begin(), {"render"});
        arguments.insert(arguments.end(), {"-f", "--size", "80x60"});
        return runZvo(m_dir.path(), arguments);
    }

    std::string picture(std::vector<std::string> arguments)
    {
        arguments.insert(arguments.end(), {"-o", "picture.png"});
        const Outcome outcome = render(arguments);
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        EXPECT_EQ(outcome.err.find("warning"), std::string::npos) << outcome.err;
        return contentOf(m_dir.path() / "picture.png");
    }

    TempDir m_dir;
};

TEST_F(CliCameraPath, TimesAndFramesAreThoseOfThePath)
{
    const std::vector<std::string> scene = {"cube.glb", "--resolution", "32"};
    const auto with = [](std::vector<std::string> arguments, const std::vector<std::string>& more)
    {
        arguments.insert(arguments.end(), more.begin(), more.end());
        return arguments;
    };
    const std::string first = picture(with(scene, {"--camera", "3,2,6,0.5,0.5,0.5,50"}));
    const std::string last = picture(with(scene, {"--camera", "0,3,7,0.5,1,0.5,60"}));
    const std::vector<std::string> path = {"--camera-path", "path.json"};
    EXPECT_EQ(picture(with(with(scene, path), {"--time", "0.1"})), first);
    EXPECT_EQ(picture(with(scene, path)), first) << "at 0, before the first key";
    EXPECT_EQ(picture(with(with(scene, path), {"--time", "7"})), last);
    const Outcome frames = render(with(with(scene, path), {"--frames", "3..6", "-o", "frame_#.png"}));
    ASSERT_EQ(frames.exit_code, 0) << frames.err;
    EXPECT_EQ(contentOf(m_dir.path() / "frame_3.png"), first) << "at 3/30 seconds";
    EXPECT_EQ(contentOf(m_dir.path() / "frame_6.png"), last);
    EXPECT_NE(contentOf(m_dir.path() / "frame_4.png"), contentOf(m_dir.path() / "frame_5.png"));

    // A tree file has no time of its own.
    ASSERT_EQ(runZvo(m_dir.path(),
                     {"build", "cube.glb", "-o", "cube.zvo", "--resolution", "32", "--device", deviceOptions().device})
                  .exit_code,
              0);
    EXPECT_EQ(picture(with({"cube.zvo"}, with(path, {"--time", "0.1"}))), first);
}

TEST_F(CliCameraPath, WhatDoesNotGoWithItIsRefused)
{
    m_dir.write("broken.json", std::string_view("{\"keys\": []}"));
    const auto expectError = [&](const std::vector<std::string>& arguments, int code, const std::string& part)
    {
        const Outcome outcome = render(arguments);
        EXPECT_EQ(outcome.exit_code, code) << outcome.err;
        EXPECT_NE(outcome.err.find(part), std::string::npos) << outcome.err;
        EXPECT_EQ(std::ranges::count(outcome.err, '\n'), 1) << outcome.err;
    };
    expectError({"cube.glb", "-o", "a.png", "--camera-path", "path.json", "--camera", "auto"}, 2, "--camera");
    expectError({"cube.glb", "-o", "a.png", "--camera-path", "missing.json"}, 3, "missing.json");
    expectError({"cube.glb", "-o", "a.png", "--camera-path", "broken.json"}, 3, "broken.json");
    expectError({"cube.glb", "-o", "path.json", "--camera-path", "path.json"}, 2, "path.json");
}

} // namespace
} // namespace zvo::test
