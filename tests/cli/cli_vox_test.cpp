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
#include <vector>

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

std::string number(std::size_t value)
{
    const auto narrow = static_cast<std::uint32_t>(value);
    return {reinterpret_cast<const char*>(&narrow), sizeof(narrow)};
}

std::string chunk(const std::string& id, const std::string& content)
{
    return id + number(content.size()) + number(0) + content;
}

/// A file of three voxels in a row: of a lamp, of a material of that type, and of the first colour again.
std::vector<std::uint8_t> lampFile(const std::string& type)
{
    const auto material = [](std::size_t index, const std::vector<std::string>& words)
    {
        std::string content = number(index) + number(words.size() / 2);
        for (const std::string& word : words)
        {
            content += number(word.size()) + word;
        }
        return chunk("MATL", content);
    };
    const std::string chunks = chunk("SIZE", number(3) + number(1) + number(1)) +
                               chunk("XYZI", number(3) + std::string("\0\0\0\1\1\0\0\2\2\0\0\1", 12)) +
                               material(1, {"_type", "_emit", "_emit", "0.5", "_flux", "1"}) +
                               material(2, {"_type", type});
    const std::string file = "VOX " + number(150) + "MAIN" + number(0) + number(chunks.size()) + chunks;
    return {file.begin(), file.end()};
}

TEST_F(CliVox, LightIsKeptOrItsLossIsTold)
{
    m_dir.write("lamp.vox", lampFile("_diffuse"));
    EXPECT_FALSE(contains(run("convert lamp.vox -o lamp.zvo --strict").err, "warning"));
    EXPECT_TRUE(contains(run("inspect lamp.zvo").out, "emission of 2"));
    EXPECT_FALSE(contains(run("convert lamp.zvo -o back.vox --strict").err, "warning"));
    run("convert back.vox -o back.zvo");
    EXPECT_TRUE(contains(run("inspect back.zvo").out, "emission of 2"));
    EXPECT_FALSE(contains(run("convert lamp.zvo -o lamp.glb --strict").err, "warning"));
    run("build lamp.glb -o glb.zvo --resolution 8");
    EXPECT_TRUE(contains(run("inspect glb.zvo").out, "emission of"));
    for (const std::string format : {"ply", "morton", "nvdb"})
    {
        EXPECT_TRUE(contains(run("convert lamp.zvo -o lamp." + format).err,
                             "warning: the emission of 2 voxels left out, as a ." + format + " file has none"));
        expectError("convert lamp.zvo --strict -f -o lamp." + format, 3, {"emission of 2 voxels", "--strict"});
    }
}

TEST_F(CliVox, MaterialsThatAreLeftOutAreNamedOrRefused)
{
    m_dir.write("metal.vox", lampFile("_metal"));
    for (const std::string command : {"convert metal.vox -o a.zvo -f", "render metal.vox -o a.png --size 8x8 -f"})
    {
        EXPECT_TRUE(contains(run(command).err, "warning: metal.vox: materials of kind metal left out"));
        expectError(command + " --strict", 3, {"metal.vox: materials of kind metal", "--strict"});
    }
    EXPECT_TRUE(contains(run("inspect metal.vox").err, "metal.vox: materials of kind metal left out"));
}

TEST_F(CliVox, AreKnownByTheirFirstBytes)
{
    m_dir.write("lamp", lampFile("_diffuse"));
    EXPECT_EQ(inspected("lamp")["voxels"], 3);
    run("render lamp -o a.png --size 8x8");
    expectError("build lamp -o a.zvo", 3, {"lamp: it holds voxels", "zvo convert makes a .zvo file"});
    m_dir.write("teardown.vox", "VOX " + number(150) + "MAIN" + number(0) + number(13) + chunk("TDCZ", "x"));
    expectError("convert teardown.vox -o a.ply", 3, {"teardown.vox: ", "TDCZ", "Teardown"});
}

} // namespace
} // namespace zvo::test
