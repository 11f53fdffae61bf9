// SPDX-License-Identifier: MIT
// Malicious scenes give one line and exit code 3. Where parts of a scene can be used they are, with a warning.
#include "cli/cli_scene.h"
#include "cli/run_zvo.h"
#include "io/image/image_io.h"
#include "support/temp_dir.h"

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

class CliBadScene : public testing::TestWithParam<BadScene>
{
};

INSTANTIATE_TEST_SUITE_P(Cli, CliBadScene, testing::ValuesIn(badScenes()),
                         [](const auto& test_case) { return std::string(test_case.param.name); });

TEST_P(CliBadScene, IsOneLineAndExitCodeThree)
{
    const TempDir dir;
    GltfBuilder builder = coloredCube();
    GetParam().change(builder);
    dir.write("scene.glb", builder.glb());
    expectErrorLine(runZvo(dir.path(), {"voxelize", "scene.glb", "-o", "a.ply", "--resolution", "8"}), 3,
                    {GetParam().word});
    EXPECT_EQ(filesIn(dir.path()), std::vector<std::string>{"scene.glb"});
}

TEST(CliBadInput, TexturesThatCannotBeUsedAreLeftOutUnlessStrict)
{
    const TempDir dir;
    GltfBuilder builder = coloredCube();
    texture(builder, {{"uri", "absent.png"}});
    dir.write("scene.glb", builder.glb());
    const std::vector<std::string> arguments = {"voxelize", "scene.glb", "-o", "a.morton", "--resolution", "8"};
    const Outcome outcome = runZvo(dir.path(), arguments);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_TRUE(contains(outcome.err, "warning: scene.glb: texture left out: images[0].uri is absent.png"))
        << outcome.err;
    std::vector<std::string> strict = arguments;
    strict.insert(strict.end(), {"--strict", "-f"});
    expectErrorLine(runZvo(dir.path(), strict), 3, {"absent.png", "strict"});
}

TEST(CliBadInput, EmptySceneRendersTheBackground)
{
    const TempDir dir;
    dir.write("empty.glb", GltfBuilder().glb());
    dir.write("cube.glb", coloredCube().glb());
    const auto render = [&](const std::string& name)
    {
        // The camera looks away from the cube, so that both pictures show only the background.
        return runZvo(dir.path(), {"render", name + ".glb", "-o", name + ".png", "--size", "40x30", "--resolution", "8",
                                   "--camera", "0.5,0.5,4,0.5,0.5,9"});
    };
    const Outcome outcome = render("empty");
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_TRUE(contains(outcome.err, "warning: the scene has no triangles")) << outcome.err;
    EXPECT_EQ(render("cube").exit_code, 0);
    const auto pixels = [&](const char* name)
    {
        const std::string png = contentOf(dir.path() / name);
        return decodeImage(std::span(reinterpret_cast<const std::uint8_t*>(png.data()), png.size()), name, name).rgba;
    };
    EXPECT_EQ(pixels("empty.png").size(), 40U * 30 * 4);
    EXPECT_EQ(pixels("empty.png"), pixels("cube.png"));
}

TEST(CliBadInput, TrianglesThatAreNotFiniteAreCountedAndTheRestIsUsed)
{
    const TempDir dir;
    GltfBuilder builder = coloredCube();
    dir.write("cube.glb", builder.glb());
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const float infinite = std::numeric_limits<float>::infinity();
    const std::size_t positions =
        builder.addPositions({nan, 0,        0, 1,         0, 0, 0, 1,        0,   // not a number
                              0,   infinite, 0, 1,         0, 0, 0, 1,        0,   // infinite
                              0,   0,        0, -infinite, 0, 0, 0, infinite, 0,   // both ways
                              1,   1,        1, 1,         1, 1, 1, 1,        1}); // no area
    builder.addMeshNode({{"attributes", {{"POSITION", positions}}}});
    dir.write("odd.glb", builder.glb());
    const auto voxelize = [&](const std::string& name)
    {
        Outcome outcome = runZvo(dir.path(), {"voxelize", name + ".glb", "-o", name + ".morton", "--resolution", "8"});
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        return outcome.err;
    };
    EXPECT_FALSE(contains(voxelize("cube"), "warning"));
    EXPECT_TRUE(contains(voxelize("odd"), "warning: 3 triangles left out (nonfinite)"));
    EXPECT_EQ(contentOf(dir.path() / "odd.morton"), contentOf(dir.path() / "cube.morton"));
}

} // namespace
} // namespace zvo::test
