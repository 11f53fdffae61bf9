// SPDX-License-Identifier: MIT
// Malicious scenes give one line and exit code 3. Where parts of a scene can be used they are, with a warning.
#include "cli/cli_folder.h"

#include <functional>
#include <gtest/gtest.h>
#include <limits>
#include <ostream>
#include <string>

namespace zvo::test
{
namespace
{

struct BadScene
{
    const char* name;
    std::function<void(GltfBuilder&)> change; // changes the cube's document
    const char* word;                         // in the message
};

void PrintTo(const BadScene& scene, std::ostream* stream)
{
    *stream << scene.name;
}

/// Gives the cube a picture.
void texture(GltfBuilder& builder, const json& image)
{
    builder.document["meshes"][0]["primitives"][0]["material"] = 0;
    builder.add("images", image);
    builder.add("textures", {{"source", 0}});
    builder.add("materials", {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}});
}

void setBuffer(GltfBuilder& builder, const std::string& uri)
{
    builder.document["buffers"] = json::array({{{"byteLength", builder.bin.size()}, {"uri", uri}}});
}

const std::vector<BadScene>& badScenes()
{
    static const std::vector<BadScene> scenes = {
        {"IndexOutOfRange", [](GltfBuilder& b) { b.bin[b.bin.size() - 71] = 255; }, "is vertex"},
        {"Count", [](GltfBuilder& b) { b.document["accessors"][0]["count"] = 1ULL << 60U; }, "1152921504606846976"},
        {"OffsetThatOverflows", [](GltfBuilder& b) { b.document["accessors"][0]["byteOffset"] = ~0ULL; },
         "accessors[0]"},
        {"FileOutside", [](GltfBuilder& b) { setBuffer(b, "../../../../../../../../etc/passwd"); }, "leaves"},
        {"EncodedFileOutside", [](GltfBuilder& b) { setBuffer(b, "%2e%2e%2foutside.bin"); }, "leaves"},
        {"AbsoluteFile", [](GltfBuilder& b) { setBuffer(b, "/etc/passwd"); }, "leaves"},
        {"DeviceAsFile", [](GltfBuilder& b) { setBuffer(b, "/dev/zero"); }, "leaves"},
        {"DataUri", [](GltfBuilder& b) { setBuffer(b, "data:;base64,?"); }, "data URI"},
        {"DeepJson",
         [](GltfBuilder& b)
         {
             for (int i = 0; i < 300; ++i)
             {
                 b.document["extras"] = json{{"extras", b.document["extras"]}};
             }
         },
         "nested"},
    };
    return scenes;
}

class CliBadScene : public CliFolder, public testing::WithParamInterface<BadScene>
{
};
using CliBadInput = CliFolder;

INSTANTIATE_TEST_SUITE_P(Cli, CliBadScene, testing::ValuesIn(badScenes()),
                         [](const auto& test_case) { return std::string(test_case.param.name); });

TEST_P(CliBadScene, IsOneLineAndExitCodeThree)
{
    GltfBuilder builder = coloredCube();
    GetParam().change(builder);
    m_dir.write("cube.glb", builder.glb());
    expectError("voxelize cube.glb -o a.ply --resolution 8", 3, {GetParam().word});
    EXPECT_EQ(filesIn(m_dir.path()), std::vector<std::string>{"cube.glb"});
}

TEST_F(CliBadInput, TexturesThatCannotBeUsedAreLeftOutUnlessStrict)
{
    GltfBuilder builder = coloredCube();
    texture(builder, {{"uri", "absent.png"}});
    m_dir.write("scene.glb", builder.glb());
    const std::string told = run("voxelize scene.glb -o a.morton --resolution 8").err;
    EXPECT_TRUE(contains(told, "warning: scene.glb: texture left out: images[0].uri is absent.png")) << told;
    expectError("voxelize scene.glb -o a.morton --resolution 8 --strict -f", 3, {"absent.png", "strict"});
}

TEST_F(CliBadInput, EmptySceneRendersTheBackground)
{
    m_dir.write("empty.glb", GltfBuilder().glb());
    // The camera looks away from the cube, so that both pictures show only the background.
    const std::string options = " --size 40x30 --resolution 8 --camera 0.5,0.5,4,0.5,0.5,9";
    const std::string told = run("render empty.glb -o empty.png" + options).err;
    EXPECT_TRUE(contains(told, "warning: the scene has no triangles")) << told;
    run("render cube.glb -o cube.png" + options);
    EXPECT_EQ(pixels("empty.png").rgba.size(), 40U * 30 * 4);
    EXPECT_EQ(pixels("empty.png").rgba, pixels("cube.png").rgba);
}

/// A cube of which the rest of a document can be made, with a material.
json smallCube(GltfBuilder& builder, float from, float to, const json& material)
{
    const std::size_t corners =
        builder.addPositions({from, from, from, to, from, from, from, to, from, from, from, to});
    const std::size_t order =
        builder.addAccessor<std::uint8_t>("SCALAR", kU8, 12, {0, 1, 2, 0, 1, 3, 0, 2, 3, 1, 2, 3});
    return {
        {"attributes", {{"POSITION", corners}}}, {"indices", order}, {"material", builder.add("materials", material)}};
}

TEST_F(CliBadInput, NoVoxelsAreExplainedByCountsAndRefusedIfStrict)
{
    const json glass = {
        {"name", "glass"}, {"alphaMode", "BLEND"}, {"pbrMetallicRoughness", {{"baseColorFactor", {1, 1, 1, 0}}}}};
    const json net = {
        {"name", "net"}, {"alphaMode", "MASK"}, {"pbrMetallicRoughness", {{"baseColorFactor", {1, 1, 1, 0.1}}}}};
    GltfBuilder builder;
    builder.addMeshNode(smallCube(builder, 0.0F, 4.0F, glass));
    builder.addMeshNode(smallCube(builder, 0.0F, 4.0F, net));
    builder.addMeshNode(smallCube(builder, 20.0F, 24.0F, {{"name", "far"}}));
    builder.addMeshNode(smallCube(builder, 4.01F, 4.05F, {{"name", "speck"}}));
    m_dir.write("lost.glb", builder.glb());
    const std::string command = "voxelize lost.glb -o a.morton --json a.json --grid 0,0,0,1 --resolution 8 -f";
    const std::string told = run(command).err;
    EXPECT_TRUE(contains(told, "there are no voxels: of 16 triangles, 4 lie outside of the grid, 4 are transparent "
                               "(material \"glass\"), 4 are transparent (material \"net\"), 4 are too small or thin"))
        << told;
    const json report = jsonFile("a.json");
    EXPECT_EQ(report["voxels"], 0);
    EXPECT_EQ(report["scene"]["dropped"]["outside"], 4);
    EXPECT_EQ(report["scene"]["transparent"], (json{{"glass", 4}, {"net", 4}}));
    EXPECT_EQ(report["scene"]["parts"], 3);
    EXPECT_EQ(report["scene"]["parts_without_voxels"], 1);
    expectError(command + " --strict", 3, {"there are no voxels", "glass", "--strict refuses"});
    expectError("render lost.glb -o a.png --size 8x8 --strict --grid 0,0,0,1 --resolution 8 -f", 3, {"no voxels"});
    expectError("build lost.glb -o a.zvo --strict --grid 0,0,0,1 --resolution 8 -f", 3, {"no voxels"});
    EXPECT_FALSE(contains(run("voxelize lost.glb -o a.morton --grid 0,0,0,1 --resolution 8 -f --strict --coverage "
                              "conservative")
                              .err,
                          "warning"));
}

TEST_F(CliBadInput, PartsWithoutVoxelsAreCounted)
{
    GltfBuilder builder = coloredCube();
    const std::size_t rod = builder.addPositions({1.5F, 0.5F, 0.5F, 2.5F, 0.5F, 0.5F, 2.5F, 0.50001F, 0.5F});
    builder.addMeshNode({{"attributes", {{"POSITION", rod}}}});
    m_dir.write("rod.glb", builder.glb());
    const std::string lost =
        "warning: 1 of 2 parts has no voxel at this resolution; --coverage conservative keeps them";
    EXPECT_TRUE(contains(run("voxelize rod.glb -o a.morton --resolution 8").err, lost));
    EXPECT_TRUE(contains(run("build rod.glb -o a.zvo --resolution 8").err, lost));
    EXPECT_TRUE(contains(run("render rod.glb -o a.png --size 8x8 --resolution 8").err, lost));
    expectError("voxelize rod.glb -o a.morton -f --resolution 8 --strict", 3, {"1 of 2", "--strict refuses"});
    run("voxelize rod.glb -o b.morton --resolution 8 --strict --coverage conservative");
}

TEST_F(CliBadInput, TrianglesThatAreNotFiniteAreCountedAndTheRestIsUsed)
{
    GltfBuilder builder = coloredCube();
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const float infinite = std::numeric_limits<float>::infinity();
    const std::size_t positions =
        builder.addPositions({nan, 0,        0, 1,         0, 0, 0, 1,        0,   // not a number
                              0,   infinite, 0, 1,         0, 0, 0, 1,        0,   // infinite
                              0,   0,        0, -infinite, 0, 0, 0, infinite, 0,   // both ways
                              1,   1,        1, 1,         1, 1, 1, 1,        1}); // no area
    builder.addMeshNode({{"attributes", {{"POSITION", positions}}}});
    m_dir.write("odd.glb", builder.glb());
    EXPECT_FALSE(contains(run("voxelize cube.glb -o cube.morton --resolution 8").err, "warning"));
    EXPECT_TRUE(contains(run("voxelize odd.glb -o odd.morton --resolution 8").err,
                         "warning: 3 of 16 triangles left out (nonfinite)"));
    EXPECT_EQ(file("odd.morton"), file("cube.morton"));
}

} // namespace
} // namespace zvo::test
