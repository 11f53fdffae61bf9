// SPDX-License-Identifier: MIT
// KHR_draco_mesh_compression: files of Draco's encoder load with the same triangles.
#include "io/gltf/gltf_loader.h"

#include "gltf_builder.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <draco/compression/decode.h>
#include <draco/compression/expert_encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>
#include <gtest/gtest.h>
#include <random>

namespace zvo::test
{

namespace
{

constexpr const char* kExtension = "KHR_draco_mesh_compression";

struct Corner
{
    glm::vec3 position{0.0F};
    glm::vec3 normal{0.0F};
    glm::vec2 uv{0.0F};
    glm::u8vec4 color{0};
};

using Soup = std::vector<std::array<Corner, 3>>;

/// A terrain of hills with seams: normals are those of faces, and every other square has its own texture coordinates.
Soup hills(std::uint32_t edge)
{
    std::mt19937 random(5); // NOLINT: the same hills on every run
    std::vector<float> heights;
    for (std::uint32_t i = 0; i < (edge + 1) * (edge + 1); ++i)
    {
        heights.push_back(static_cast<float>(random() % 8) / 8.0F);
    }
    Soup soup;
    for (std::uint32_t y = 0; y < edge; ++y)
    {
        for (std::uint32_t x = 0; x < edge; ++x)
        {
            const auto corner = [&](std::uint32_t i, std::uint32_t k)
            {
                Corner result;
                result.position = {x + i, heights[(y + k) * (edge + 1) + x + i], y + k};
                result.uv = glm::vec2(x + i, y + k) / 64.0F + ((x + y) % 2 == 0 ? 0.0F : 0.5F);
                result.color = {(x + i) * 5, (y + k) * 7, 99, 255 - (x + i)};
                return result;
            };
            for (std::array<Corner, 3> triangle : {std::array{corner(0, 0), corner(0, 1), corner(1, 0)},
                                                   std::array{corner(1, 0), corner(0, 1), corner(1, 1)}})
            {
                const glm::vec3 across = glm::cross(triangle[1].position - triangle[0].position,
                                                    triangle[2].position - triangle[0].position);
                for (Corner& c : triangle)
                {
                    c.normal = glm::normalize(across);
                }
                soup.push_back(triangle);
            }
        }
    }
    return soup;
}

struct Packing
{
    draco::MeshEncoderMethod method = draco::MESH_EDGEBREAKER_ENCODING;
    int submethod = draco::MESH_EDGEBREAKER_STANDARD_ENCODING;
    int quantization_bits = 0; // 0: none
};

struct Packed
{
    std::vector<std::uint8_t> bytes;
    std::uint32_t point_count = 0;
    json attribute_ids; // by glTF's names
};

Packed pack(const Soup& soup, const Packing& packing)
{
    draco::TriangleSoupMeshBuilder builder;
    builder.Start(static_cast<int>(soup.size()));
    const int positions = builder.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
    const int normals = builder.AddAttribute(draco::GeometryAttribute::NORMAL, 3, draco::DT_FLOAT32);
    const int uvs = builder.AddAttribute(draco::GeometryAttribute::TEX_COORD, 2, draco::DT_FLOAT32);
    const int colors = builder.AddAttribute(draco::GeometryAttribute::COLOR, 4, draco::DT_UINT8, true);
    for (std::uint32_t i = 0; i < soup.size(); ++i)
    {
        const draco::FaceIndex face(i);
        const auto& [a, b, c] = soup[i];
        builder.SetAttributeValuesForFace(positions, face, &a.position, &b.position, &c.position);
        builder.SetAttributeValuesForFace(normals, face, &a.normal, &b.normal, &c.normal);
        builder.SetAttributeValuesForFace(uvs, face, &a.uv, &b.uv, &c.uv);
        builder.SetAttributeValuesForFace(colors, face, &a.color, &b.color, &c.color);
    }
    const std::unique_ptr<draco::Mesh> mesh = builder.Finalize();
    draco::ExpertEncoder encoder(*mesh);
    encoder.SetEncodingMethod(packing.method);
    if (packing.method == draco::MESH_EDGEBREAKER_ENCODING)
    {
        encoder.SetEncodingSubmethod(packing.submethod);
    }
    for (const int attribute : {positions, normals, uvs})
    {
        encoder.SetAttributeQuantization(attribute, packing.quantization_bits);
    }
    draco::EncoderBuffer buffer;
    EXPECT_TRUE(encoder.EncodeToBuffer(&buffer).ok());
    Packed packed;
    packed.bytes.assign(buffer.data(), buffer.data() + buffer.size());
    draco::DecoderBuffer decoder_buffer;
    decoder_buffer.Init(buffer.data(), buffer.size());
    const auto decoded = draco::Decoder().DecodeMeshFromBuffer(&decoder_buffer);
    packed.point_count = decoded.ok() ? decoded.value()->num_points() : 0;
    packed.attribute_ids = {{"POSITION", mesh->attribute(positions)->unique_id()},
                            {"NORMAL", mesh->attribute(normals)->unique_id()},
                            {"TEXCOORD_0", mesh->attribute(uvs)->unique_id()},
                            {"COLOR_0", mesh->attribute(colors)->unique_id()}};
    return packed;
}

struct PackedAttribute
{
    const char* name;
    const char* type;
    int component_type;
};

/// A document whose only primitive is packed. Its accessors, one for each attribute, and then that of the indices, have
/// no buffer views.
GltfBuilder packedDocument(const Packed& packed, std::size_t triangle_count,
                           const std::vector<PackedAttribute>& packed_attributes = {{"POSITION", "VEC3", kF32},
                                                                                    {"NORMAL", "VEC3", kF32},
                                                                                    {"TEXCOORD_0", "VEC2", kF32},
                                                                                    {"COLOR_0", "VEC4", kU8}})
{
    GltfBuilder builder;
    builder.document["extensionsRequired"] = {kExtension};
    const auto add = [&](const char* type, int component_type, std::size_t count) {
        return builder.add("accessors", {{"componentType", component_type}, {"count", count}, {"type", type}});
    };
    json attributes;
    for (const auto& [name, type, component_type] : packed_attributes)
    {
        attributes[name] = add(type, component_type, packed.point_count);
    }
    const std::size_t indices = add("SCALAR", kU32, 3 * triangle_count);
    const json extension = {{"bufferView", builder.addView(packed.bytes.data(), packed.bytes.size())},
                            {"attributes", packed.attribute_ids}};
    builder.addMeshNode({{"attributes", attributes}, {"indices", indices}, {"extensions", {{kExtension, extension}}}});
    return builder;
}

Soup soupOf(const Primitive& primitive)
{
    Soup soup;
    for (const glm::uvec3& triangle : primitive.triangles)
    {
        std::array<Corner, 3> corners;
        for (int i = 0; i < 3; ++i)
        {
            const std::uint32_t vertex = triangle[i];
            corners[i] = {primitive.positions[vertex], primitive.normals[vertex], primitive.uvs[vertex],
                          glm::u8vec4(glm::round(primitive.colors[vertex] * 255.0F))};
        }
        soup.push_back(corners);
    }
    return soup;
}

/// The lattice point of a corner, which is the same after quantization.
std::array<int, 3> latticePoint(const Corner& corner)
{
    const glm::ivec3 point(glm::round(corner.position * 8.0F));
    return {point.x, point.y, point.z};
}

/// Sorts triangles and rotates their corners, independently of the codec's order.
Soup sorted(Soup soup)
{
    const auto less = [](const Corner& a, const Corner& b) { return latticePoint(a) < latticePoint(b); };
    for (std::array<Corner, 3>& triangle : soup)
    {
        std::rotate(triangle.begin(), std::min_element(triangle.begin(), triangle.end(), less), triangle.end());
    }
    std::sort(soup.begin(), soup.end(),
              [&](const auto& a, const auto& b)
              { return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end(), less); });
    return soup;
}

void expectSame(const Soup& loaded, const Soup& wanted, float tolerance)
{
    ASSERT_EQ(loaded.size(), wanted.size());
    const Soup a = sorted(loaded);
    const Soup b = sorted(wanted);
    for (std::size_t i = 0; i < a.size(); ++i)
    {
        for (std::size_t k = 0; k < 3; ++k)
        {
            EXPECT_LE(glm::distance(a[i][k].position, b[i][k].position), 40.0F * tolerance) << i;
            EXPECT_LE(glm::distance(a[i][k].uv, b[i][k].uv), 2.0F * tolerance) << i;
            // The loader normalizes in double precision.
            EXPECT_LE(glm::distance(a[i][k].normal, b[i][k].normal), std::max(4.0F * tolerance, 2e-7F)) << i;
            EXPECT_EQ(a[i][k].color, b[i][k].color) << i;
        }
    }
}

TEST(GltfDraco, PackedMeshHasTheSameTriangles)
{
    const Soup soup = hills(20);
    for (const Packing& packing : {Packing{draco::MESH_SEQUENTIAL_ENCODING}, Packing{},
                                   Packing{draco::MESH_EDGEBREAKER_ENCODING, draco::MESH_EDGEBREAKER_VALENCE_ENCODING}})
    {
        const Packed packed = pack(soup, packing);
        const Scene scene = packedDocument(packed, soup.size()).load();
        EXPECT_TRUE(scene.warnings.empty());
        expectSame(soupOf(scene.primitives.at(0)), soup, 0.0F);
    }
}

TEST(GltfDraco, QuantizedMeshHasThemWithinAStep)
{
    const Soup soup = hills(20);
    for (const draco::MeshEncoderMethod method : {draco::MESH_SEQUENTIAL_ENCODING, draco::MESH_EDGEBREAKER_ENCODING})
    {
        const Packed packed = pack(soup, {.method = method, .quantization_bits = 12});
        const Scene scene = packedDocument(packed, soup.size()).load();
        expectSame(soupOf(scene.primitives.at(0)), soup, 1.0F / 4095);
    }
}

TEST(GltfDraco, OneTriangleMayBePacked)
{
    const Soup soup = {hills(1)[0]};
    expectSame(soupOf(packedDocument(pack(soup, {}), 1).load().primitives.at(0)), soup, 0.0F);
}

TEST(GltfDraco, JointsAndWeightsMayBePacked)
{
    // Both identify the vertex, as Draco may renumber vertices.
    const auto jointsAt = [](const glm::vec3& place)
    { return glm::u16vec4(place.x, 300.0F + place.x, place.z, 1000.0F - place.z); };
    const auto weightsAt = [](const glm::vec3& place)
    { return glm::vec4(place.x + 1.0F, place.z + 1.0F, 2.0F, 11.0F - place.x - place.z) / 15.0F; };
    const Soup soup = hills(4);
    draco::TriangleSoupMeshBuilder mesh_builder;
    mesh_builder.Start(static_cast<int>(soup.size()));
    const int positions = mesh_builder.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
    const int joints = mesh_builder.AddAttribute(draco::GeometryAttribute::GENERIC, 4, draco::DT_UINT16);
    const int weights = mesh_builder.AddAttribute(draco::GeometryAttribute::GENERIC, 4, draco::DT_FLOAT32);
    for (std::uint32_t i = 0; i < soup.size(); ++i)
    {
        std::array<glm::u16vec4, 3> corner_joints;
        std::array<glm::vec4, 3> corner_weights;
        for (std::size_t k = 0; k < 3; ++k)
        {
            corner_joints[k] = jointsAt(soup[i][k].position);
            corner_weights[k] = weightsAt(soup[i][k].position);
        }
        const draco::FaceIndex face(i);
        mesh_builder.SetAttributeValuesForFace(positions, face, &soup[i][0].position, &soup[i][1].position,
                                               &soup[i][2].position);
        mesh_builder.SetAttributeValuesForFace(joints, face, &corner_joints[0], &corner_joints[1], &corner_joints[2]);
        mesh_builder.SetAttributeValuesForFace(weights, face, &corner_weights[0], &corner_weights[1],
                                               &corner_weights[2]);
    }
    const std::unique_ptr<draco::Mesh> mesh = mesh_builder.Finalize();
    draco::EncoderBuffer buffer;
    ASSERT_TRUE(draco::ExpertEncoder(*mesh).EncodeToBuffer(&buffer).ok());
    const std::size_t vertex_count = mesh->num_points();
    const Packed packed = {{buffer.data(), buffer.data() + buffer.size()},
                           mesh->num_points(),
                           {{"POSITION", mesh->attribute(positions)->unique_id()},
                            {"JOINTS_0", mesh->attribute(joints)->unique_id()},
                            {"WEIGHTS_0", mesh->attribute(weights)->unique_id()}}};
    const GltfBuilder builder = packedDocument(
        packed, soup.size(), {{"POSITION", "VEC3", kF32}, {"JOINTS_0", "VEC4", kU16}, {"WEIGHTS_0", "VEC4", kF32}});
    const Scene scene = builder.load();
    EXPECT_EQ(sceneFault(scene), "");
    EXPECT_TRUE(scene.warnings.empty());
    const Primitive& primitive = scene.primitives.at(0);
    ASSERT_EQ(primitive.joints.size(), vertex_count);
    for (std::size_t i = 0; i < vertex_count; ++i)
    {
        EXPECT_EQ(primitive.joints[i], jointsAt(primitive.positions[i])) << i;
        EXPECT_LT(glm::distance(primitive.weights[i], weightsAt(primitive.positions[i])), 1e-6F) << i;
    }
}

TEST(GltfDraco, AttributesMayStayOutside)
{
    const Soup soup = hills(4);
    const Packed packed = pack(soup, {});
    GltfBuilder builder = packedDocument(packed, soup.size());
    json& primitive = builder.document["meshes"][0]["primitives"][0];
    primitive["extensions"][kExtension]["attributes"].erase("COLOR_0");
    const std::vector<std::uint8_t> gray(4 * packed.point_count, 51);
    primitive["attributes"]["COLOR_0"] = builder.addAccessor("VEC4", kU8, packed.point_count, gray, true);
    const Scene scene = builder.load();
    EXPECT_EQ(scene.triangleCount(), soup.size());
    for (const glm::vec4& color : scene.primitives.at(0).colors)
    {
        EXPECT_EQ(color, glm::vec4(0.2F));
    }
}

TEST(GltfDraco, StripsAreUnpackedAsTriangles)
{
    const Soup soup = hills(3);
    GltfBuilder builder = packedDocument(pack(soup, {}), soup.size());
    builder.document["meshes"][0]["primitives"][0]["mode"] = kStrip;
    expectSame(soupOf(builder.load().primitives.at(0)), soup, 0.0F);
}

TEST(GltfDraco, WhatDoesNotGoTogetherIsRefused)
{
    const Soup soup = hills(4);
    const Packed packed = pack(soup, {});
    const auto expectBroken = [&](const Change& change, std::initializer_list<std::string> parts)
    { expectInputError(packedDocument(packed, soup.size()), change, parts); };
    const auto byte = [](std::size_t offset, std::uint8_t value)
    { return [=](GltfBuilder& b) { b.bin[offset] = value; }; };
    const auto strip = [](GltfBuilder& b)
    {
        set("/meshes/0/primitives/0/mode", kStrip)(b);
        set("/accessors/4/count", 31)(b);
    };
    const auto bytes = [](GltfBuilder& b)
    {
        set("/accessors/3/componentType", kF32)(b);
        set("/accessors/0/componentType", kU8)(b);
    };
    const std::string place = "meshes[0].primitives[0].extensions.KHR_draco_mesh_compression";
    const std::string extension = "/meshes/0/primitives/0/extensions/KHR_draco_mesh_compression";
    expectBroken(set(extension + "/bufferView", 7), {"bufferView is 7"});
    expectBroken(without(extension + "/attributes"), {place, "has no attributes"});
    expectBroken(set(extension + "/attributes/NORMAL", -1), {"NORMAL is not a small whole"});
    expectBroken(set(extension + "/attributes/NORMAL", 9),
                 {"NORMAL of meshes[0].primitives[0]", "is attribute 9 of Draco data that has none"});
    expectBroken(set(extension + "/attributes/NORMAL", packed.attribute_ids["TEXCOORD_0"]),
                 {"NORMAL", "of 3 components, its Draco data"});
    expectBroken(set("/accessors/0/count", packed.point_count + 1), {"POSITION", "elements"});
    expectBroken(set("/accessors/4/count", 3), {place, "32 triangles, accessors[4] 3 indices"});
    expectBroken(strip, {place, "32 triangles, accessors[4] 31 indices"});
    expectBroken(without("/meshes/0/primitives/0/indices"), {place, "indices is missing"});
    expectBroken(bytes, {"POSITION"});
    expectBroken(byte(0, 'X'), {place, "does not decode as a Draco mesh"});
    expectBroken(byte(6, 1), {place, "version 2.2"});     // an older minor version
    expectBroken(byte(7, 0), {place, "does not decode"}); // a point cloud
    expectBroken(byte(8, 7), {place, "does not decode"}); // no method
    expectBroken(set("/bufferViews/0/byteLength", 100), {place, "does not decode"});
    expectBroken(set("/bufferViews/0/byteLength", 3), {place, "does not decode"});
}

TEST(GltfDraco, CountsOutOfProportionToTheDataAreRefused)
{
    // Header, version 2.2, mesh, method, flags; then counts of 2^31 - 1, without the data.
    const std::vector<std::uint8_t> many = {0xFF, 0xFF, 0xFF, 0xFF, 0x07};
    const auto bomb = [&](std::uint8_t method, std::initializer_list<std::vector<std::uint8_t>> parts)
    {
        Packed packed;
        packed.bytes = {'D', 'R', 'A', 'C', 'O', 2, 2, 1, method, 0, 0};
        for (const std::vector<std::uint8_t>& part : parts)
        {
            packed.bytes.insert(packed.bytes.end(), part.begin(), part.end());
        }
        packed.attribute_ids = {{"POSITION", 0}};
        SCOPED_TRACE(testing::PrintToString(packed.bytes));
        expectInputError([&] { return packedDocument(packed, 1).load(); }, {kExtension, "out of proportion"});
    };
    const std::vector<std::uint8_t> one = {1};
    const std::vector<std::uint8_t> traversal = {0};
    bomb(0, {many, one});                           // faces
    bomb(0, {one, many});                           // points
    bomb(1, {traversal, many, one, one, one, one}); // vertices
    bomb(1, {traversal, one, many, one, one, one}); // faces
    bomb(1, {traversal, one, one, one, one, many}); // split vertices
    // 3,000 faces with 9,000 points, which have 100 attributes of 255 numbers each.
    const std::vector<std::uint8_t> face_count = {0xB8, 0x17};
    const std::vector<std::uint8_t> point_count = {0xA8, 0x46};
    std::vector<std::uint8_t> indices(1 + 3000 * 3 * 2, 0);
    indices[0] = 1; // not compressed, 16 bits
    std::vector<std::uint8_t> attributes = {1, 100};
    for (int i = 0; i < 100; ++i)
    {
        attributes.insert(attributes.end(), {4, draco::DT_FLOAT64, 255, 0, 0});
    }
    attributes.resize(attributes.size() + 100); // encodings of the attributes
    bomb(0, {face_count, point_count, indices, attributes});
}

TEST(GltfDraco, DamagedBytesGiveASceneOrAnInputError)
{
    const Soup soup = hills(6);
    int loaded_count = 0;
    for (const draco::MeshEncoderMethod method : {draco::MESH_SEQUENTIAL_ENCODING, draco::MESH_EDGEBREAKER_ENCODING})
    {
        const Packed packed = pack(soup, {.method = method, .quantization_bits = 10});
        loaded_count += loadDamaged(packedDocument(packed, soup.size()), 400, 13);
    }
    EXPECT_GT(loaded_count, 0);
}

} // namespace

} // namespace zvo::test
