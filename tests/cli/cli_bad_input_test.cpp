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
                         "warning: 3 triangles left out (nonfinite)"));
    EXPECT_EQ(file("odd.morton"), file("cube.morton"));
}

} // namespace
} // namespace zvo::test
