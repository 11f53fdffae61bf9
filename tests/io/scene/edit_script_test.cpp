// SPDX-License-Identifier: MIT
#include "io/scene/edit_script.h"

#include "runtime/script_brush.h"
#include "zvo/error.h"

#include <gtest/gtest.h>

#include <string>

namespace zvo
{
namespace
{

std::vector<ScriptedEdit> parse(const std::string& edits)
{
    return parseEditScript(R"({"schema": "zvo.edits/1", "edits": [)" + edits + "]}", "folder/cut.json");
}

std::string failure(const std::string& edits)
{
    try
    {
        (void)parse(edits);
    }
    catch (const Error& error)
    {
        return error.what();
    }
    return "";
}

TEST(EditScript, BrushesCoverTheVoxelsThatTheirShapesSay)
{
    const Grid grid = {glm::vec3(10, 0, 0), 0.5F, 5};
    const auto edits = parse(R"(
        {"action": "carve", "sphere": {"centre": [12.1, 1, 1.49], "radius": 1.3}},
        {"action": "paint", "box": {"min": [10.3, 0, 0.2], "max": [11.3, 0.2, 1]}, "color": "#102030"},
        {"action": "fill", "box": {"min": [10.3, 0, 0.2], "max": [11.3, 0.25, 1]}, "emission": [1, 0, 2]})");
    const Brush sphere = brushOf(edits.at(0), grid, "a").value();
    EXPECT_EQ(sphere.action, BrushAction::Carve);
    EXPECT_EQ(sphere.center, gpu::ivec3(4, 2, 2));
    EXPECT_EQ(sphere.radius, 2U);
    EXPECT_FALSE(brushOf(edits.at(1), grid, "a")) << "no voxel's centre is that low";
    EXPECT_EQ(edits.at(1).color, 0x302010U);
    const Brush box = brushOf(edits.at(2), grid, "a").value();
    EXPECT_EQ(box.box(), (VoxelBox{{1, 0, 0}, {2, 0, 1}}));
    EXPECT_EQ(box.emission, gpu::vec3(1, 0, 2));
}

TEST(EditScript, MeshesArePlacedBesideTheScript)
{
    const auto edits = parse(R"({"action": "keep", "mesh": {"file": "a.obj", "up": "z", "fill": "parity",
                                                             "place": {"translation": [1, 2, 3], "scale": 2}}})");
    const auto& mesh = std::get<EditMesh>(edits.at(0).shape);
    EXPECT_TRUE(edits.at(0).outside);
    EXPECT_EQ(mesh.file, std::filesystem::path("folder/a.obj"));
    EXPECT_EQ(mesh.fill, Fill::Parity);
    EXPECT_EQ(glm::dvec3(mesh.transform * glm::dvec4(0, 0, 1, 1)), glm::dvec3(1, 4, 3));
}

TEST(EditScript, ErrorsNameThePlaceAndWhatIsExpected)
{
    const std::string sphere = R"("sphere": {"centre": [0, 0, 0], "radius": 1})";
    for (const auto& [edit, words] : std::initializer_list<std::pair<std::string, std::string>>{
             {R"({"action": "cut", )" + sphere + "}", "edits[0].action"},
             {R"({"action": "carve"})", "expected one of sphere, box, mesh"},
             {R"({"action": "carve", "box": {"min": [0, 0, 0], "max": [1, -1, 1]}})", "edits[0].box"},
             {R"({"action": "fill", )" + sphere + R"(, "color": "red"})", "edits[0].color"},
             {R"({"action": "fill", )" + sphere + R"(, "emission": [0, -1, 0]})", "edits[0].emission"},
             {R"({"action": "paint", "mesh": {"file": "a.obj"}})", "edits[0].mesh"},
             {R"({"action": "keep", )" + sphere + "}", "edits[0].action"}})
    {
        EXPECT_NE(failure(edit).find("folder/cut.json: "), std::string::npos) << edit;
        EXPECT_NE(failure(edit).find(words), std::string::npos) << failure(edit);
    }
    const Grid grid = {glm::vec3(0), 0.5F, 5};
    const auto large = parse(R"({"action": "carve", "sphere": {"centre": [0, 0, 0], "radius": 40}})");
    EXPECT_THROW((void)brushOf(large.at(0), grid, "a"), Error);
}

} // namespace
} // namespace zvo
