// SPDX-License-Identifier: MIT
// .vox files in the program: render, inspect, validate and convert.
#include "cli/cli_folder.h"
#include "io/file/sha256.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <nlohmann/json.hpp>
#include <set>
#include <span>
#include <string>

namespace zvo::test
{
namespace
{

class CliVox : public CliFolder
{
protected:
    CliVox() { run("build cube.glb --resolution 32 -o svo.zvo --structure svo"); }

    [[nodiscard]] json inspected(const std::string& name) const { return printedBy("inspect --json " + name); }
};

TEST_F(CliVox, ComeBackWithTheirVoxelsAndColors)
{
    run("convert svo.zvo -o cube.vox");
    run("convert cube.vox -o back.zvo");
    run("validate back.zvo");
    run("convert back.zvo -o back.morton");
    run("convert svo.zvo -o svo.morton");
    EXPECT_EQ(file("back.morton"), file("svo.morton"));
    run("convert back.zvo -o back.vox");
    EXPECT_EQ(file("back.vox"), file("cube.vox"));
}

// A .vox file has no normals, so the only ones in the picture are those of the faces that the camera sees.
TEST_F(CliVox, AreShownByTheirFaces)
{
    run("convert svo.zvo -o cube.vox");
    const std::string camera = " --size 96x64 --camera 72,90,108,18,18,18 ";
    run("render cube.vox -o normals.png --view normal" + camera);
    const Image normals = pixels("normals.png");
    std::set<std::uint32_t> colors;
    for (std::size_t i = 0; i < normals.rgba.size(); i += 4)
    {
        colors.insert(normals.rgba[i] | normals.rgba[i + 1] << 8U | normals.rgba[i + 2] << 16U);
    }
    EXPECT_EQ(colors.size(), 4U); // of +x, +y, +z and the background
    run("render cube.vox -o vox.png" + camera);
    run("convert cube.vox -o back.zvo --structure svo");
    run("render back.zvo -o back.png" + camera);
    EXPECT_TRUE(file("vox.png") == file("back.png"));
}

TEST_F(CliVox, AreInspectedAndValidated)
{
    run("convert svo.zvo -o cube.vox");
    const json report = inspected("cube.vox");
    const json tree = inspected("svo.zvo");
    EXPECT_EQ(report["voxels"], tree["voxels"]);
    const std::string bytes = file("cube.vox");
    EXPECT_EQ(report["sha256"], sha256Hex(std::as_bytes(std::span(bytes))));
    EXPECT_EQ(report["grid"]["voxel_size"], 1.0);
    const std::string text = run("inspect cube.vox").out;
    EXPECT_TRUE(contains(text, "MagicaVoxel")) << text;
    EXPECT_FALSE(contains(text, "version")) << text;
    EXPECT_TRUE(contains(run("validate cube.vox").out, "sound"));
    run("build cube.glb -o empty.zvo --resolution 32 --bounds 5,5,5,6,6,6");
    run("convert empty.zvo -o empty.vox");
    EXPECT_TRUE(contains(run("render empty.vox -o empty.png --size 16x16").err, "no voxels"));
    EXPECT_EQ(inspected("empty.vox")["voxels"], 0);
}

} // namespace
} // namespace zvo::test
