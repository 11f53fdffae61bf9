// SPDX-License-Identifier: MIT
// Pictures along camera paths on the command line.
#include "cli/cli_folder.h"
#include "support/device.h"

#include <gtest/gtest.h>

#include <string>

namespace zvo::test
{
namespace
{

class CliCameraPath : public CliFolder
{
protected:
    CliCameraPath()
    {
        m_dir.write("path.json", std::string_view(R"({"schema": "zvo.camera_path/1", "keys": [
            {"time": 0.1, "eye": [3, 2, 6], "target": [0.5, 0.5, 0.5], "fov": 50},
            {"time": 0.2, "eye": [0, 3, 7], "target": [0.5, 1, 0.5], "fov": 60}]})"));
    }

    [[nodiscard]] std::string picture(const std::string& options) const
    {
        const std::string told = run("render -f --size 80x60 -o picture.png " + options).err;
        EXPECT_FALSE(contains(told, "warning")) << told;
        return file("picture.png");
    }
};

TEST_F(CliCameraPath, TimesAndFramesAreThoseOfThePath)
{
    const std::string cube = "cube.glb --resolution 32 ";
    const std::string first = picture(cube + "--camera 3,2,6,0.5,0.5,0.5,50");
    const std::string last = picture(cube + "--camera 0,3,7,0.5,1,0.5,60");
    const std::string flight = cube + "--camera-path path.json ";
    EXPECT_EQ(picture(flight + "--time 0.1"), first);
    EXPECT_EQ(picture(flight), first) << "at 0, before the first key";
    EXPECT_EQ(picture(flight + "--time 7"), last);
    run("render -f --size 80x60 -o frame_#.png --frames 3..6 " + flight);
    EXPECT_EQ(file("frame_3.png"), first) << "at 3/30 seconds";
    EXPECT_EQ(file("frame_6.png"), last);
    EXPECT_NE(file("frame_4.png"), file("frame_5.png"));

    // A tree file has no time of its own.
    run("build cube.glb -o cube.zvo --resolution 32 --device " + deviceOptions().device);
    EXPECT_EQ(picture("cube.zvo --camera-path path.json --time 0.1"), first);
}

TEST_F(CliCameraPath, WhatDoesNotGoWithItIsRefused)
{
    m_dir.write("broken.json", std::string_view("{\"keys\": []}"));
    expectError("render cube.glb -f -o a.png --camera-path path.json --camera auto", 2, {"--camera"});
    expectError("render cube.glb -f -o a.png --camera-path missing.json", 3, {"missing.json"});
    expectError("render cube.glb -f -o a.png --camera-path broken.json", 3, {"broken.json"});
    expectError("render cube.glb -f -o path.json --camera-path path.json", 2, {"path.json"});
}

} // namespace
} // namespace zvo::test
