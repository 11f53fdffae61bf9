// SPDX-License-Identifier: MIT
#include "io/gltf/gltf_loader.h"

#include "core/scene/animation.h"
#include "gltf_builder.h"
#include "rig_documents.h"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <numbers>

namespace zvo::test
{

namespace
{

using Triangles = std::vector<glm::uvec3>;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

/// Loads five vertices as a primitive of that mode.
Scene fiveVertices(Mode mode)
{
    GltfBuilder builder;
    const std::size_t positions = builder.addPositions({0, 0, 0, 0, 1, 0, 1, 0, 0, 1, 1, 0, 2, 0, 0});
    builder.addMeshNode({{"attributes", {{"POSITION", positions}}}, {"mode", mode}});
    return builder.load();
}

template <typename T> Primitive withIndices(int component_type, const std::vector<T>& indices)
{
    GltfBuilder builder;
    json primitive = trianglePrimitive(builder);
    primitive["indices"] = builder.addAccessor("SCALAR", component_type, indices.size(), indices);
    builder.addMeshNode(primitive);
    return builder.load().primitives.at(0);
}

template <typename T>
Primitive withAttribute(const std::string& name, const std::string& type, int component_type,
                        const std::vector<T>& values, bool normalized, std::size_t stride = 0)
{
    GltfBuilder builder;
    json primitive = trianglePrimitive(builder);
    primitive["attributes"][name] = builder.addAccessor(type, component_type, 3, values, normalized, stride);
    builder.addMeshNode(primitive);
    return builder.load().primitives.at(0);
}

/// The world transform of a triangle in a chain of nodes, from the root to the one with the mesh.
glm::mat4 transformOf(const std::vector<json>& chain)
{
    GltfBuilder builder;
    builder.add("meshes", {{"primitives", json::array({trianglePrimitive(builder)})}});
    for (std::size_t i = 0; i < chain.size(); ++i)
    {
        json node = chain[i];
        if (i + 1 < chain.size())
        {
            node["children"] = {i + 1};
        }
        else
        {
            node["mesh"] = 0;
        }
        builder.add("nodes", node);
    }
    return builder.load().instances.at(0).transform;
}

TEST(GltfLoader, TriangleListComesAsItIs)
{
    const Scene scene = triangleDocument().load();
    ASSERT_EQ(scene.primitives.size(), 1U);
    EXPECT_EQ(scene.primitives[0].positions, (std::vector<glm::vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
    EXPECT_EQ(scene.primitives[0].triangles, (Triangles{{0, 1, 2}}));
    EXPECT_TRUE(scene.primitives[0].normals.empty());
    EXPECT_TRUE(scene.primitives[0].uvs.empty());
    EXPECT_TRUE(scene.primitives[0].colors.empty());
    EXPECT_EQ(scene.instances.size(), 1U);
    EXPECT_EQ(scene.instances[0].transform, glm::mat4(1.0F));
    EXPECT_TRUE(scene.warnings.empty());
}

TEST(GltfLoader, StripAlternatesItsWinding)
{
    EXPECT_EQ(fiveVertices(kStrip).primitives[0].triangles, (Triangles{{0, 1, 2}, {1, 3, 2}, {2, 3, 4}}));
}

TEST(GltfLoader, FanTurnsAroundItsFirstVertex)
{
    EXPECT_EQ(fiveVertices(kFan).primitives[0].triangles, (Triangles{{1, 2, 0}, {2, 3, 0}, {3, 4, 0}}));
}

TEST(GltfLoader, StripLeavesOutTheTrianglesThatOnlyJoinParts)
{
    GltfBuilder builder;
    const std::size_t positions = builder.addPositions(std::vector<float>(18));
    const std::vector<std::uint16_t> order = {0, 1, 2, 2, 3, 3, 4, 5};
    builder.addMeshNode({{"attributes", {{"POSITION", positions}}},
                         {"indices", builder.addAccessor("SCALAR", kU16, order.size(), order)},
                         {"mode", kStrip}});
    EXPECT_EQ(builder.load().primitives[0].triangles, (Triangles{{0, 1, 2}, {3, 5, 4}}));
}

TEST(GltfLoader, LinesAreLeftOutWithAWarning)
{
    GltfBuilder builder;
    const json triangle = trianglePrimitive(builder);
    json lines = triangle;
    lines["mode"] = kLines;
    builder.add("meshes", {{"primitives", {lines, triangle, lines}}});
    builder.add("nodes", {{"mesh", 0}});
    const Scene scene = builder.load();
    EXPECT_EQ(scene.triangleCount(), 1U);
    expectOneLine(scene.warnings, {"lines left out", "meshes[0].primitives[0] and 1 more"});
}

TEST(GltfLoader, PointsAreTheVerticesThatIndicesName)
{
    EXPECT_EQ(fiveVertices(kPoints).primitives[0].triangles.size(), 5U);
    GltfBuilder builder;
    const std::size_t positions = builder.addPositions({0, 0, 0, 0, 1, 0, 1, 0, 0, 1, 1, 0});
    const std::vector<std::uint16_t> order = {3, 1, 3, 0};
    builder.addMeshNode({{"attributes", {{"POSITION", positions}}},
                         {"indices", builder.addAccessor("SCALAR", kU16, order.size(), order)},
                         {"mode", kPoints}});
    const Scene scene = builder.load();
    EXPECT_TRUE(scene.primitives[0].is_points);
    EXPECT_EQ(scene.primitives[0].triangles, (Triangles{{3, 3, 3}, {1, 1, 1}, {3, 3, 3}, {0, 0, 0}}));
    EXPECT_TRUE(scene.warnings.empty());
}

TEST(GltfLoader, PointsHaveTheirMaterials)
{
    GltfBuilder builder = triangleDocument();
    builder.document["materials"] = {{{"name", "of triangles"}}, {{"name", "of points"}}};
    set("/meshes/0/primitives/0/material", 0)(builder);
    builder.addMeshNode({{"attributes", {{"POSITION", 0}}}, {"mode", kPoints}, {"material", 1}});
    builder.addMeshNode({{"attributes", {{"POSITION", 0}}}, {"mode", kPoints}});
    const Scene scene = builder.load();
    ASSERT_EQ(scene.primitives.size(), 3U);
    EXPECT_EQ(scene.materials.at(scene.primitives[1].material).name, "of points");
    EXPECT_NE(scene.materials.at(scene.primitives[2].material).name, "of triangles");
    EXPECT_EQ(sceneFault(fiveVertices(kPoints)), "");
}

TEST(GltfLoader, IndicesMayHaveEightSixteenOrThirtyTwoBits)
{
    const Triangles wanted = {{2, 0, 1}, {0, 1, 2}};
    EXPECT_EQ(withIndices<std::uint8_t>(kU8, {2, 0, 1, 0, 1, 2}).triangles, wanted);
    EXPECT_EQ(withIndices<std::uint16_t>(kU16, {2, 0, 1, 0, 1, 2}).triangles, wanted);
    EXPECT_EQ(withIndices<std::uint32_t>(kU32, {2, 0, 1, 0, 1, 2}).triangles, wanted);
}

TEST(GltfLoader, IncompleteTriangleIsLeftOutWithAWarning)
{
    GltfBuilder builder;
    json primitive = trianglePrimitive(builder);
    primitive["indices"] = builder.addAccessor<std::uint8_t>("SCALAR", kU8, 5, {0, 1, 2, 0, 1});
    builder.addMeshNode(primitive);
    const Scene scene = builder.load();
    EXPECT_EQ(scene.triangleCount(), 1U);
    EXPECT_EQ(scene.warnings.size(), 1U);
}

TEST(GltfLoader, TextureCoordinatesMayBeNormalizedIntegers)
{
    const std::vector<glm::vec2> wanted = {{0, 1}, {1, 0}, {0.2F, 0.4F}};
    EXPECT_EQ(withAttribute<float>("TEXCOORD_0", "VEC2", kF32, {0, 1, 1, 0, 0.2F, 0.4F}, false).uvs, wanted);
    EXPECT_EQ(withAttribute<std::uint8_t>("TEXCOORD_0", "VEC2", kU8, {0, 255, 255, 0, 51, 102}, true).uvs, wanted);
    EXPECT_EQ(withAttribute<std::uint16_t>("TEXCOORD_0", "VEC2", kU16, {0, 65535, 65535, 0, 13107, 26214}, true).uvs,
              wanted);
}

TEST(GltfLoader, VertexColorsMayHaveThreeOrFourComponentsOfThreeTypes)
{
    const std::vector<glm::vec4> opaque = {{0, 0.2F, 1, 1}, {1, 1, 1, 1}, {0.4F, 0, 0, 1}};
    EXPECT_EQ(withAttribute<float>("COLOR_0", "VEC3", kF32, {0, 0.2F, 1, 1, 1, 1, 0.4F, 0, 0}, false).colors, opaque);
    // Elements of three bytes, padded to four.
    const std::vector<std::uint8_t> bytes = {0, 51, 255, 99, 255, 255, 255, 99, 102, 0, 0};
    EXPECT_EQ(withAttribute("COLOR_0", "VEC3", kU8, bytes, true, 4).colors, opaque);
    const std::vector<std::uint16_t> words = {0, 13107, 65535, 9, 65535, 65535, 65535, 9, 26214, 0, 0};
    EXPECT_EQ(withAttribute("COLOR_0", "VEC3", kU16, words, true, 8).colors, opaque);

    const std::vector<glm::vec4> with_alpha = {{0, 0.2F, 1, 0.4F}, {1, 1, 1, 0}, {0.4F, 0, 0, 1}};
    const std::vector<float> floats = {0, 0.2F, 1, 0.4F, 1, 1, 1, 0, 0.4F, 0, 0, 1};
    EXPECT_EQ(withAttribute("COLOR_0", "VEC4", kF32, floats, false).colors, with_alpha);
    const std::vector<std::uint8_t> bytes4 = {0, 51, 255, 102, 255, 255, 255, 0, 102, 0, 0, 255};
    EXPECT_EQ(withAttribute("COLOR_0", "VEC4", kU8, bytes4, true).colors, with_alpha);
    const std::vector<std::uint16_t> words4 = {0, 13107, 65535, 26214, 65535, 65535, 65535, 0, 26214, 0, 0, 65535};
    EXPECT_EQ(withAttribute("COLOR_0", "VEC4", kU16, words4, true).colors, with_alpha);
}

TEST(GltfLoader, NormalsHaveUnitLengthOrAreZero)
{
    const Primitive primitive = withAttribute<float>("NORMAL", "VEC3", kF32, {0, 3, 4, 0, 0, 0, kNan, 1, 0}, false);
    EXPECT_EQ(primitive.normals, (std::vector<glm::vec3>{{0, 0.6F, 0.8F}, {0, 0, 0}, {0, 0, 0}}));
}

TEST(GltfLoader, InterleavedAttributesAreReadByTheirStride)
{
    GltfBuilder builder;
    const std::vector<float> vertices = {0, 0, 0, 9, 0, 1, 0, 0, 9, 1, 0, 1, 0, 9, 0};
    const std::size_t view = builder.addView(vertices.data(), vertices.size() * sizeof(float), 20);
    json accessor = {{"bufferView", view}, {"componentType", kF32}, {"count", 3}, {"type", "VEC3"}};
    const std::size_t positions = builder.add("accessors", accessor);
    accessor["type"] = "VEC2";
    accessor["byteOffset"] = 12;
    const std::size_t uvs = builder.add("accessors", accessor);
    builder.addMeshNode({{"attributes", {{"POSITION", positions}, {"TEXCOORD_0", uvs}}}});
    const Primitive primitive = builder.load().primitives.at(0);
    EXPECT_EQ(primitive.positions, (std::vector<glm::vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
    EXPECT_EQ(primitive.uvs, (std::vector<glm::vec2>{{9, 0}, {9, 1}, {9, 0}}));
}

TEST(GltfLoader, PositionsThatAreNotFiniteAreKept)
{
    GltfBuilder builder;
    builder.addMeshNode({{"attributes", {{"POSITION", builder.addPositions({0, 0, 0, kNan, 0, 0, 0, 1, 0})}}}});
    const Scene scene = builder.load();
    EXPECT_EQ(scene.triangleCount(), 1U);
    EXPECT_TRUE(std::isnan(scene.primitives[0].positions[1].x));
}

TEST(GltfLoader, QuantizedPositionsAreReadWithTheirExtension)
{
    GltfBuilder builder;
    builder.document["extensionsRequired"] = {"KHR_mesh_quantization"};
    const std::vector<std::int16_t> values = {0, 0, 0, 99, 32767, -32768, 0, 99, 0, 16384, 0};
    const std::size_t plain = builder.addAccessor("VEC3", kI16, 3, values, false, 8);
    const std::size_t normalized = builder.addAccessor("VEC3", kI16, 3, values, true, 8);
    builder.addMeshNode({{"attributes", {{"POSITION", plain}}}});
    builder.addMeshNode({{"attributes", {{"POSITION", normalized}}}});
    const Scene scene = builder.load();
    EXPECT_EQ(scene.primitives[0].positions[1], glm::vec3(32767, -32768, 0));
    EXPECT_EQ(scene.primitives[1].positions[1], glm::vec3(1, -1, 0));
    EXPECT_EQ(scene.primitives[1].positions[2].y, 16384.0F / 32767.0F);
}

TEST(GltfLoader, MatrixAndTranslationRotationScaleMeanTheSame)
{
    const double half = std::numbers::sqrt2 / 2;
    const glm::mat4 parts = transformOf(
        {{{"translation", {1, 2, 3}}, {"rotation", {0, 0, half, half}}, {"scale", {2, 3, 4}}}}); // 90 degrees about z
    const glm::mat4 matrix = transformOf({{{"matrix", {0, 2, 0, 0, -3, 0, 0, 0, 0, 0, 4, 0, 1, 2, 3, 1}}}});
    for (int i = 0; i < 16; ++i)
    {
        EXPECT_NEAR(parts[i / 4][i % 4], matrix[i / 4][i % 4], 1e-7F) << i;
    }
    EXPECT_EQ(matrix[0], glm::vec4(0, 2, 0, 0));
    EXPECT_EQ(matrix[3], glm::vec4(1, 2, 3, 1));
}

TEST(GltfLoader, QuaternionNeedNotHaveUnitLength)
{
    const glm::mat4 matrix = transformOf({{{"rotation", {0, 0, 3, 3}}}});
    EXPECT_NEAR(matrix[0].y, 1.0F, 1e-7F);
    EXPECT_EQ(transformOf({{{"rotation", {0, 0, 0, 0}}}}), glm::mat4(1.0F));
}

TEST(GltfLoader, TransformsMultiplyFromTheRootInDoublePrecision)
{
    const glm::mat4 matrix =
        transformOf({{{"scale", {2, 2, 2}}}, {{"translation", {1, 0, 0}}}, {{"scale", {1, 3, 1}}}});
    EXPECT_EQ(matrix[3], glm::vec4(2, 0, 0, 1));
    EXPECT_EQ(matrix[1], glm::vec4(0, 6, 0, 0));
    // In single precision, the small translation would be lost in the large one.
    const glm::mat4 far = transformOf(
        {{{"translation", {1e9, 0, 0}}}, {{"translation", {0.125, 0, 0}}}, {{"translation", {-1e9, 0, 0}}}});
    EXPECT_EQ(far[3].x, 0.125F);
}

TEST(GltfLoader, NegativeAndZeroScaleAreKept)
{
    EXPECT_EQ(transformOf({{{"scale", {-1, 2, 1}}}})[0].x, -1.0F);
    const glm::mat4 flat = transformOf({{{"scale", {1, 0, 1}}}});
    EXPECT_EQ(flat[1], glm::vec4(0.0F));
    EXPECT_EQ(flat[3].w, 1.0F);
}

TEST(GltfLoader, SharedMeshIsLoadedOnceAndInstancedTwice)
{
    GltfBuilder builder = triangleDocument();
    builder.add("nodes", {{"mesh", 0}, {"translation", {5, 0, 0}}});
    const Scene scene = builder.load();
    EXPECT_EQ(scene.primitives.size(), 1U);
    ASSERT_EQ(scene.instances.size(), 2U);
    EXPECT_EQ(scene.instances[1].primitive, 0U);
    EXPECT_EQ(scene.instances[1].transform[3].x, 5.0F);
    EXPECT_EQ(scene.triangleCount(), 2U);
}

constexpr const char* kInstancing = "EXT_mesh_gpu_instancing";

TEST(GltfLoader, InstancesOfANodeArePlacedInIt)
{
    GltfBuilder builder = triangleDocument();
    json& node = builder.document["nodes"][0];
    node["translation"] = {10, 0, 0};
    node["scale"] = {2, 2, 2};
    json& attributes = node["extensions"][kInstancing]["attributes"];
    attributes = {{"TRANSLATION", builder.addPositions({0, 0, 0, 1, 0, 0, 0, 3, 0})}, {"_ID", 0}};
    builder.document["extensionsRequired"] = {kInstancing};
    const Scene moved = builder.load();
    EXPECT_EQ(sceneFault(moved), "");
    EXPECT_TRUE(moved.warnings.empty());
    EXPECT_EQ(moved.primitives.size(), 1U);
    ASSERT_EQ(moved.instances.size(), 3U);
    EXPECT_EQ(moved.instances[1].transform * glm::vec4(0, 0, 0, 1), glm::vec4(12, 0, 0, 1));
    EXPECT_EQ(moved.instances[2].transform * glm::vec4(1, 0, 0, 1), glm::vec4(12, 6, 0, 1));
    // Half a turn about z as normalized bytes, and scales below 0, without translations.
    attributes = {{"ROTATION", builder.addAccessor<std::int8_t>("VEC4", kI8, 2, {0, 0, 127, 0, 0, 0, 0, 127})},
                  {"SCALE", builder.addPositions({1, 2, 3, -1, 1, 1})}};
    const Scene turned = builder.load();
    ASSERT_EQ(turned.instances.size(), 2U);
    EXPECT_EQ(turned.instances[0].transform * glm::vec4(1, 1, 1, 1), glm::vec4(8, -4, 6, 1));
    EXPECT_EQ(turned.instances[1].transform * glm::vec4(1, 1, 1, 1), glm::vec4(8, 2, 2, 1));
    attributes = {{"SCALE", builder.addPositions({})}};
    EXPECT_TRUE(builder.load().instances.empty());
}

TEST(GltfLoader, InstancesFollowTheAnimationOfTheirNode)
{
    GltfBuilder builder = triangleDocument();
    json& extension = builder.document["nodes"][0]["extensions"][kInstancing];
    extension["attributes"]["TRANSLATION"] = builder.addPositions({0, 0, 0, 1, 0, 0});
    addAnimation<float>(builder, 0, "scale", "STEP", {0}, "VEC3", kF32, 1, {3, 3, 3});
    const Scene scene = builder.load();
    EXPECT_EQ(scene.instances.at(1).transform[3], glm::vec4(1, 0, 0, 1));
    EXPECT_EQ(poseAt(scene, 0).transforms.at(1) * glm::vec4(1, 0, 0, 1), glm::vec4(6, 0, 0, 1));
}

TEST(GltfLoader, InstancesThatMakeNoSenseAreRefused)
{
    GltfBuilder builder = triangleDocument();
    json& extension = builder.document["nodes"][0]["extensions"][kInstancing];
    const std::size_t two = builder.addPositions({0, 0, 0, 1, 0, 0});
    const std::size_t three = builder.addPositions({0, 0, 0, 1, 0, 0, 2, 0, 0});
    const std::size_t bytes = builder.addAccessor<std::int8_t>("VEC3", kI8, 2, {1, 1, 1, 1, 1, 1});
    const json very_many = {{"componentType", kF32}, {"type", "VEC3"}, {"count", std::uint64_t{1} << 40}};
    for (const auto& [attributes, why] :
         {std::pair<json, std::string>({{"SCALE", two}, {"TRANSLATION", three}}, "count"),
          {{{"ROTATION", two}}, "does not allow"},
          {{{"SCALE", bytes}}, "does not allow"},
          {{{"SCALE", 99}}, "SCALE is 99"},
          {{{"SCALE", builder.add("accessors", very_many)}}, "shows 1099511627776 primitives"}})
    {
        extension["attributes"] = attributes;
        expectInputError(builder, {why});
    }
    GltfBuilder skinned = armDocument();
    skinned.document["nodes"][0]["extensions"][kInstancing]["attributes"]["SCALE"] = skinned.addPositions({1, 1, 1});
    expectOneLine(skinned.load().warnings, {"instances of a mesh with a skin left out"});
}

TEST(GltfLoader, HiddenNodesHideAllBelowThem)
{
    GltfBuilder builder = triangleDocument();
    json& nodes = builder.document["nodes"];
    const auto visibility = [](const json& visible) { return json{{"KHR_node_visibility", {{"visible", visible}}}}; };
    builder.add("nodes", {{"children", {2}}, {"extensions", visibility(false)}});
    builder.add("nodes", {{"mesh", 0}, {"children", {3}}, {"extensions", visibility(true)}});
    builder.add("nodes", {{"mesh", 0}});
    builder.add("nodes", {{"mesh", 0}, {"extensions", {{"KHR_node_visibility", json::object()}}}});
    for (const json& required : {json::array(), json::array({"KHR_node_visibility"})})
    {
        builder.document["extensionsRequired"] = required;
        const Scene scene = builder.load();
        EXPECT_EQ(sceneFault(scene), "");
        EXPECT_TRUE(scene.warnings.empty());
        ASSERT_EQ(scene.instances.size(), 2U);
        EXPECT_EQ(scene.nodes.at(scene.instances[1].node).parent, kNone) << "node 4, whose extension says nothing";
    }
    nodes[0]["extensions"] = nodes[4]["extensions"] = visibility(false);
    const Scene none = builder.load();
    EXPECT_TRUE(none.instances.empty());
    expectOneLine(none.warnings, {"nothing is shown", "KHR_node_visibility", "4 nodes"});
    // Hidden joints move their skin all the same, and what hides nothing by mistake is told.
    GltfBuilder arm = armDocument();
    arm.document["nodes"][1]["extensions"] = visibility(false);
    EXPECT_EQ(arm.load().instances.at(0).skin, 0U);
    nodes[0]["extensions"] = visibility("no");
    expectOneLine(builder.load().warnings, {"parts with faults", "KHR_node_visibility.visible"});
}

TEST(GltfLoader, DefaultSceneIsTheNamedOneOrTheFirstOrAllNodes)
{
    GltfBuilder builder = triangleDocument();
    builder.add("nodes", {{"mesh", 0}, {"translation", {1, 0, 0}}});
    builder.add("nodes", {{"mesh", 0}, {"translation", {2, 0, 0}}});
    EXPECT_EQ(builder.load().instances.size(), 3U);
    builder.document["scenes"] = {{{"nodes", {1}}}, {{"nodes", {2, 0}}}};
    ASSERT_EQ(builder.load().instances.size(), 1U);
    EXPECT_EQ(builder.load().instances[0].transform[3].x, 1.0F);
    builder.document["scene"] = 1;
    ASSERT_EQ(builder.load().instances.size(), 2U);
    EXPECT_EQ(builder.load().instances[0].transform[3].x, 2.0F);
}

TEST(GltfLoader, MeshesThatNoNodeShowsAreNotLoaded)
{
    GltfBuilder builder = triangleDocument();
    builder.add("meshes", {{"primitives", {{{"attributes", {{"POSITION", 0}}}}}}});
    EXPECT_EQ(builder.load().primitives.size(), 1U);
}

TEST(GltfLoader, CamerasHaveTheirWorldTransform)
{
    GltfBuilder builder = triangleDocument();
    builder.add("cameras",
                {{"type", "perspective"}, {"name", "eye"}, {"perspective", {{"yfov", 0.5}, {"znear", 0.1}}}});
    builder.add("cameras", {{"type", "orthographic"},
                            {"orthographic", {{"xmag", 3.0}, {"ymag", 2.0}, {"znear", 0.1}, {"zfar", 10.0}}}});
    builder.add("nodes", {{"translation", {1, 0, 0}}, {"children", {2, 3}}});
    builder.add("nodes", {{"translation", {0, 2, 0}}, {"camera", 0}});
    builder.add("nodes", {{"camera", 1}, {"name", "plan"}});
    const Scene scene = builder.load();
    ASSERT_EQ(scene.cameras.size(), 2U);
    EXPECT_EQ(scene.cameras[0].name, "eye");
    EXPECT_FALSE(scene.cameras[0].orthographic);
    EXPECT_EQ(scene.cameras[0].vertical_fov, 0.5F);
    EXPECT_EQ(scene.cameras[0].transform[3], glm::vec4(1, 2, 0, 1));
    EXPECT_EQ(scene.cameras[1].name, "plan");
    EXPECT_TRUE(scene.cameras[1].orthographic);
    EXPECT_EQ(scene.cameras[1].half_height, 2.0F);
}

TEST(GltfLoader, DocumentMayBeEmpty)
{
    EXPECT_EQ(GltfBuilder{}.load().triangleCount(), 0U);
}

} // namespace

} // namespace zvo::test
