// SPDX-License-Identifier: MIT
#include "io/scene/load_scene.h"

#include "io/gltf/gltf_builder.h"
#include "io/gltf/rig_documents.h"
#include "io/scene/animated_scene.h"
#include "io/scene/scene_part.h"
#include "support/mesh_files.h"
#include "support/toon_scene.h"

#include <gtest/gtest.h>

namespace zvo::test
{

namespace
{

Scene loadNamed(const std::string& name, const std::string& content)
{
    const TempDir dir;
    const std::filesystem::path path = dir.write(name, content);
    return loadScene(std::span(&path, 1));
}

std::string glbText()
{
    const std::vector<std::uint8_t> glb = triangleDocument().glb();
    return {glb.begin(), glb.end()};
}

TEST(LoadScene, ContentTellsTheFormatWhereTheNameDoesNot)
{
    const FileMesh mesh = bentSheet(2);
    for (const char* name : {"mesh", "mesh.bin"})
    {
        EXPECT_EQ(loadNamed(name, glbText()).triangleCount(), 1U);
        EXPECT_EQ(loadNamed(name, asObj(mesh)).triangleCount(), 8U);
        EXPECT_EQ(loadNamed(name, asPly(mesh, PlyEncoding::LittleEndian)).triangleCount(), 8U);
        EXPECT_EQ(loadNamed(name, asTextStl(mesh)).triangleCount(), 8U);
        EXPECT_EQ(loadNamed(name, asBinaryStl(mesh)).triangleCount(), 8U);
        EXPECT_EQ(loadNamed(name, " \n{\"asset\": {\"version\": \"2.0\"}}").triangleCount(), 0U);
        expectInputError([&] { loadNamed(name, "Dear reader"); }, {name, "neither glTF 2.0 nor OBJ"});
        expectInputError([&] { loadNamed(name, ""); }, {name, "neither"});
    }
    // The content decides, even if the name differs; extensions may be upper case.
    EXPECT_EQ(loadNamed("mesh.obj", glbText()).triangleCount(), 1U);
    EXPECT_EQ(loadNamed("mesh.stl", asPly(mesh, PlyEncoding::Text)).triangleCount(), 8U);
    EXPECT_EQ(loadNamed("MESH.OBJ", asObj(mesh)).triangleCount(), 8U);
}

TEST(LoadScene, SeveralFormatsBecomeOneScene)
{
    const FileMesh mesh = bentSheet(2);
    const TempDir dir;
    const std::vector<std::filesystem::path> paths = {dir.write("a.glb", triangleDocument().glb()),
                                                      dir.write("b.obj", asObj(mesh)),
                                                      dir.write("c.stl", asTextStl(mesh))};
    const Scene scene = loadScene(paths);
    EXPECT_EQ(scene.triangleCount(), 17U);
    ASSERT_EQ(scene.instances.size(), 3U);
    EXPECT_EQ(scene.primitives.at(scene.instances[2].primitive).material, 2U);
}

TEST(LoadScene, StrictRefusesWhatWouldBeLeftOut)
{
    const TempDir dir;
    const std::filesystem::path whole = dir.write("whole.glb", triangleDocument().glb());
    EXPECT_EQ(loadScene(std::span(&whole, 1), {.strict = true}).triangleCount(), 1U);
    GltfBuilder builder = triangleDocument();
    builder.document["meshes"][0]["primitives"].push_back(trianglePrimitive(builder));
    builder.document["meshes"][0]["primitives"][1]["mode"] = kLines;
    const std::filesystem::path lines = dir.write("lines.glb", builder.glb());
    EXPECT_EQ(loadScene(std::span(&lines, 1)).warnings.size(), 1U);
    expectInputError([&] { return loadScene(std::span(&lines, 1), {.strict = true}); },
                     {"lines.glb: lines left out", "strict loading refuses the file"});
    const std::filesystem::path scene = dir.write("a.scene.json", R"({"objects": [{"file": "lines.glb"}]})");
    EXPECT_EQ(loadAnimatedScene(scene).warnings.size(), 1U);
    AnimatedSceneOptions strict;
    strict.load.strict = true;
    expectInputError([&] { return loadAnimatedScene(scene, strict); }, {"lines.glb: lines left out"});
}

TEST(LoadScene, UpTurnsTheAxisToYWithoutMirroring)
{
    const std::vector<std::pair<UpAxis, glm::vec3>> axes = {{UpAxis::X, {1, 0, 0}},       {UpAxis::Y, {0, 1, 0}},
                                                            {UpAxis::Z, {0, 0, 1}},       {UpAxis::MinusX, {-1, 0, 0}},
                                                            {UpAxis::MinusY, {0, -1, 0}}, {UpAxis::MinusZ, {0, 0, -1}}};
    for (const auto& [axis, up] : axes)
    {
        Scene scene;
        scene.instances.push_back({0, glm::mat4(1.0F)});
        applyLoadOptions(scene, {axis, 1.0F});
        const glm::mat4& turn = scene.instances[0].transform;
        EXPECT_EQ(transformPoint(turn, up), glm::vec3(0, 1, 0));
        EXPECT_EQ(glm::determinant(turn), 1.0F);
        for (int i = 0; i < 3; ++i) // a permutation of axes with signs, so nothing is rounded
        {
            EXPECT_EQ(glm::length(glm::vec3(turn[i])), 1.0F);
        }
    }
    // The usual convention: the front of a z-up model is the front of a y-up one.
    Scene scene;
    scene.instances.push_back({0, glm::mat4(1.0F)});
    applyLoadOptions(scene, {UpAxis::Z, 1.0F});
    EXPECT_EQ(transformPoint(scene.instances[0].transform, {1, 2, 3}), glm::vec3(1, 3, -2));
}

TEST(LoadScene, NodesArePlacedByOneAboveThemAll)
{
    Scene scene;
    scene.nodes.resize(3);
    scene.nodes[1].parent = 0;
    scene.nodes[1].name = "child";
    scene.skins.push_back({{1}, {glm::mat4(1.0F)}});
    scene.instances.push_back({0, glm::mat4(1.0F), 2, 0});
    applyLoadOptions(scene, {UpAxis::Z, 2.0F});
    ASSERT_EQ(scene.nodes.size(), 4U);
    EXPECT_EQ(scene.nodes[0].parent, kNone);
    EXPECT_EQ(transformPoint(scene.nodes[0].matrix.value(), {1, 2, 3}), glm::vec3(2, 6, -4));
    EXPECT_EQ(scene.nodes[1].parent, 0U);
    EXPECT_EQ(scene.nodes[2].parent, 1U);
    EXPECT_EQ(scene.nodes[2].name, "child");
    EXPECT_EQ(scene.nodes[3].parent, 0U);
    EXPECT_EQ(scene.skins.at(0).joints, (std::vector<std::uint32_t>{2}));
    EXPECT_EQ(scene.instances.at(0).node, 3U);
    EXPECT_EQ(scene.instances.at(0).skin, 0U);
    EXPECT_EQ(scene.instances.at(0).transform, scene.nodes[0].matrix.value());
}

TEST(LoadScene, ScaleMovesPointsAndCamerasButNotTheirAxes)
{
    Scene scene;
    scene.instances.push_back({0, glm::mat4(1.0F)});
    scene.instances[0].transform[3] = glm::vec4(1, 2, 3, 1);
    Camera camera;
    camera.orthographic = true;
    camera.half_height = 3.0F;
    camera.transform[3] = glm::vec4(4, 5, 6, 1);
    scene.cameras.push_back(camera);
    applyLoadOptions(scene, {UpAxis::Z, 0.5F});
    EXPECT_EQ(transformPoint(scene.instances[0].transform, {1, 0, 0}), glm::vec3(1, 1.5F, -1));
    EXPECT_EQ(scene.cameras[0].half_height, 1.5F);
    EXPECT_EQ(scene.cameras[0].transform[3], glm::vec4(2, 3, -2.5F, 1));
    EXPECT_EQ(scene.cameras[0].transform[2], glm::vec4(0, 1, 0, 0)); // looks along what was -z: now down
    scene.instances[0].transform[3].x = 1e38F;
    try
    {
        applyLoadOptions(scene, {UpAxis::Y, 100.0F});
        ADD_FAILURE() << "accepted";
    }
    catch (const Error& error)
    {
        EXPECT_EQ(error.code(), ErrorCode::Usage);
    }
}

// The primitives of a toon scene of one object, single-sided as glTF has them by default.
std::vector<std::uint8_t> toonGlb(bool double_sided)
{
    const Scene scene = toonScene(1);
    GltfBuilder builder;
    for (const char* name : {"floor", "ball", "outline"})
    {
        builder.add("materials", {{"name", name}, {"doubleSided", double_sided}});
    }
    for (std::size_t i = 0; i < scene.instances.size(); ++i)
    {
        const Primitive& primitive = scene.primitives[scene.instances[i].primitive];
        std::vector<float> positions;
        for (const glm::uvec3& triangle : primitive.triangles)
        {
            for (int corner = 0; corner < 3; ++corner)
            {
                const glm::vec3 p = transformPoint(scene.instances[i].transform, primitive.positions[triangle[corner]]);
                positions.insert(positions.end(), {p.x, p.y, p.z});
            }
        }
        const std::size_t accessor = builder.addPositions(positions);
        builder.addMeshNode({{"attributes", {{"POSITION", accessor}}}, {"material", i}});
    }
    builder.add("scenes", {{"nodes", {0, 1, 2}}});
    return builder.glb();
}

TEST(LoadScene, HullsAreLeftOutWithAWarning)
{
    const TempDir dir;
    const std::filesystem::path path = dir.write("toon.glb", toonGlb(false));
    const Scene scene = loadScene(std::span(&path, 1));
    EXPECT_EQ(scene.instances.size(), 2U);
    expectOneLine(scene.warnings, {"toon.glb", "1 inverted hull,", "material outline", "--keep-hulls"});
    const Scene kept = loadScene(std::span(&path, 1), {.keep_hulls = true});
    EXPECT_EQ(kept.instances.size(), 3U);
    EXPECT_TRUE(kept.warnings.empty());
    const std::filesystem::path double_sided = dir.write("both.glb", toonGlb(true));
    EXPECT_EQ(loadScene(std::span(&double_sided, 1)).instances.size(), 3U);
}

/// The corners of a file's triangles in the world, with its scene at rest or as modelled.
std::vector<glm::vec3> restingCorners(const GltfBuilder& builder, const LoadOptions& options = {})
{
    const TempDir dir;
    const std::filesystem::path path = dir.write("a.glb", builder.glb());
    const Scene scene = atRest(loadScene(std::span(&path, 1), options));
    EXPECT_TRUE(scene.warnings.empty());
    std::vector<glm::vec3> corners;
    for (const Instance& instance : scene.instances)
    {
        const Primitive& primitive = scene.primitives.at(instance.primitive);
        for (const glm::vec3& position : primitive.positions)
        {
            corners.push_back(transformPoint(instance.transform, position));
        }
    }
    return corners;
}

using Corners = std::vector<glm::vec3>;

TEST(LoadScene, SkinsAreAppliedAtRest)
{
    GltfBuilder arm = armDocument(); // with an animation, which does not count
    const Corners modelled = {{100, 0, 0}, {100, 1, 0}, {100, 2, 0}, {101, 1, 0}};
    EXPECT_EQ(restingCorners(arm), (Corners{{0, 0, 0}, {0, 1, 0}, {0, 2, 0}, {1, 1, 0}}));
    EXPECT_EQ(restingCorners(arm, {.bind_pose = true}), modelled);
    arm.document.erase("animations");
    arm.document["nodes"][1]["scale"] = {2, 2, 2};
    arm.document["nodes"][2]["translation"] = {0, 3, 0};
    const Corners joints = {{0, 0, -5}, {0, 4, -5}, {0, 8, -5}, {2, 3, -5}};
    EXPECT_EQ(restingCorners(arm), joints);
    EXPECT_EQ(restingCorners(arm, {.scale = 2}).at(3), glm::vec3(4, 6, -10));
    EXPECT_EQ(restingCorners(arm, {.up = UpAxis::Z}).at(3), glm::vec3(2, -5, -3));
    EXPECT_EQ(restingCorners(arm, {.bind_pose = true}), modelled);
    // A second mesh on the same joints, and one that has no skin, which stands at its node.
    arm.add("nodes", {{"mesh", 0}, {"skin", 0}});
    arm.add("nodes", {{"mesh", 0}});
    const Corners all = restingCorners(arm);
    ASSERT_EQ(all.size(), 12U);
    EXPECT_EQ(Corners(all.begin() + 4, all.begin() + 8), joints);
    EXPECT_EQ(all[11], glm::vec3(1, 1, 0));
}

TEST(LoadScene, MorphWeightsAreAppliedAtRest)
{
    GltfBuilder morphed = morphDocument({0.5F, 2});
    morphed.document["nodes"][0]["translation"] = {7, 0, 0};
    EXPECT_EQ(restingCorners(morphed), (Corners{{7, 0, 0.5F}, {12, 0, 0.5F}, {7, 1, 0.5F}}));
    EXPECT_EQ(restingCorners(morphed, {.bind_pose = true}).at(1), glm::vec3(8, 0, 0));
    addAnimation<float>(morphed, 0, "weights", "STEP", {0}, "SCALAR", kF32, 2, {1, 1});
    morphed.add("nodes", {{"mesh", 0}, {"weights", {0, -1}}});
    const Corners both = restingCorners(morphed);
    ASSERT_EQ(both.size(), 6U);
    EXPECT_EQ(both[1], glm::vec3(12, 0, 0.5F)) << "the weights of the mesh, not those of the animation";
    EXPECT_EQ(both[4], glm::vec3(-1, 0, 0)) << "the node's own";
    // Meshes that nothing deforms are shared.
    GltfBuilder still = morphDocument({0, 0});
    still.add("nodes", {{"mesh", 0}});
    const Scene scene = atRest(still.load());
    EXPECT_EQ(scene.primitives.size(), 1U);
    EXPECT_EQ(scene.instances.size(), 2U);
}

TEST(LoadScene, MaterialsAreSkippedByTheirNames)
{
    const TempDir dir;
    const std::filesystem::path paths[] = {dir.write("a.glb", toonGlb(true)), dir.write("b.glb", toonGlb(true))};
    const auto instanceCount = [&](std::vector<std::string> patterns)
    {
        const Scene scene = loadScene(paths, {.skip_materials = std::move(patterns)});
        EXPECT_TRUE(scene.warnings.empty());
        return scene.instances.size();
    };
    EXPECT_EQ(instanceCount({"outline"}), 4U);
    EXPECT_EQ(instanceCount({"out*"}), 4U);
    EXPECT_EQ(instanceCount({"[fb]*"}), 2U);
    EXPECT_EQ(instanceCount({"floor", "ball", "outline"}), 0U);
    const Scene whole = loadScene(paths, {.skip_materials = {"Outline"}});
    EXPECT_EQ(whole.instances.size(), 6U);
    EXPECT_EQ(whole.warnings, std::vector<std::string>{"--skip-material: no material has a name like \"Outline\""});
}

TEST(LoadScene, MaterialsAreSkippedBeforeHullsAreFoundAndWarningsRefused)
{
    const TempDir dir;
    const std::filesystem::path file = dir.write("toon.glb", toonGlb(false));
    const std::string objects = R"({"objects": [{"name": "a", "file": "toon.glb", "static": true}]})";
    const std::filesystem::path scene_file =
        dir.write("toon.scene.json", std::vector<std::uint8_t>(objects.begin(), objects.end()));
    AnimatedSceneOptions options;
    options.load = {.strict = true, .skip_materials = {"outline"}};
    for (const std::filesystem::path& path : {file, scene_file})
    {
        const AnimatedScene animated = loadAnimatedScene(path, options);
        EXPECT_EQ(animated.fixed.instances.size(), 2U) << path;
        EXPECT_TRUE(animated.warnings.empty()) << path;
    }
}

} // namespace

} // namespace zvo::test
