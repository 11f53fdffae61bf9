// SPDX-License-Identifier: MIT
// EXT_meshopt_compression: data of meshoptimizer's encoders loads unchanged, or within the rounding of its filters.
#include "io/gltf/gltf_loader.h"

#include "gltf_builder.h"

#include <cmath>
#include <gtest/gtest.h>
#include <meshoptimizer.h>
#include <random>

namespace zvo::test
{

namespace
{

constexpr const char* kExtension = "EXT_meshopt_compression";

/// A grid of vertices with a little noise, and its triangles.
struct Terrain
{
    explicit Terrain(std::uint32_t edge)
    {
        std::mt19937 random(3); // NOLINT: the same terrain on every run
        for (std::uint32_t y = 0; y < edge; ++y)
        {
            for (std::uint32_t x = 0; x < edge; ++x)
            {
                const float height = static_cast<float>(random() % 1000) / 1000.0F;
                positions.emplace_back(x, height, y);
                const glm::vec3 normal(static_cast<float>(random() % 200) - 100.0F, 60.0F,
                                       static_cast<float>(random() % 200) - 100.0F);
                normals.push_back(glm::normalize(normal));
            }
        }
        for (std::uint32_t y = 0; y + 1 < edge; ++y)
        {
            for (std::uint32_t x = 0; x + 1 < edge; ++x)
            {
                const std::uint32_t corner = y * edge + x;
                for (const std::uint32_t offset : {0U, edge, 1U, 1U, edge, edge + 1})
                {
                    indices.push_back(corner + offset);
                }
            }
        }
    }

    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;
    std::vector<std::uint32_t> indices;
};

std::vector<std::uint8_t> packVertices(const void* vertices, std::size_t count, std::size_t stride)
{
    std::vector<std::uint8_t> packed(meshopt_encodeVertexBufferBound(count, stride));
    packed.resize(meshopt_encodeVertexBuffer(packed.data(), packed.size(), vertices, count, stride));
    return packed;
}

std::vector<std::uint8_t> packTriangles(const std::vector<std::uint32_t>& indices, std::size_t vertex_count)
{
    std::vector<std::uint8_t> packed(meshopt_encodeIndexBufferBound(indices.size(), vertex_count));
    packed.resize(meshopt_encodeIndexBuffer(packed.data(), packed.size(), indices.data(), indices.size()));
    return packed;
}

std::vector<std::uint8_t> packSequence(const std::vector<std::uint32_t>& indices, std::size_t vertex_count)
{
    std::vector<std::uint8_t> packed(meshopt_encodeIndexSequenceBound(indices.size(), vertex_count));
    packed.resize(meshopt_encodeIndexSequence(packed.data(), packed.size(), indices.data(), indices.size()));
    return packed;
}

/// Adds a view whose unpacked data lies in buffer 1, which has none, and an accessor for all of it.
std::size_t addPacked(GltfBuilder& builder, const std::vector<std::uint8_t>& packed, std::size_t count,
                      std::size_t stride, const char* mode, const char* filter, const json& accessor_type)
{
    const std::size_t packed_view = builder.addView(packed.data(), packed.size());
    const json place = builder.document["bufferViews"][packed_view];
    json extension = {{"buffer", 0},
                      {"byteOffset", place["byteOffset"]},
                      {"byteLength", packed.size()},
                      {"byteStride", stride},
                      {"count", count},
                      {"mode", mode}};
    if (filter != nullptr)
    {
        extension["filter"] = filter;
    }
    json view = {{"buffer", 1}, {"byteLength", count * stride}, {"extensions", {{kExtension, extension}}}};
    if (std::string(mode) == "ATTRIBUTES")
    {
        view["byteStride"] = stride;
    }
    json accessor = accessor_type;
    accessor["bufferView"] = builder.add("bufferViews", view);
    accessor["count"] = count;
    return builder.add("accessors", accessor);
}

/// Adds buffer 0 with the packed data, and buffer 1 without bytes.
void addBuffers(GltfBuilder& builder)
{
    builder.document["extensionsRequired"] = {kExtension, "KHR_mesh_quantization"};
    builder.document["buffers"] = {{{"byteLength", builder.bin.size()}},
                                   {{"byteLength", 1'000'000}, {"extensions", {{kExtension, {{"fallback", true}}}}}}};
}

const json kFloat3 = {{"componentType", kF32}, {"type", "VEC3"}};
const json kIndex16 = {{"componentType", kU16}, {"type", "SCALAR"}};
const json kIndex32 = {{"componentType", kU32}, {"type", "SCALAR"}};

GltfBuilder packedTerrain(const Terrain& terrain)
{
    const std::size_t count = terrain.positions.size();
    GltfBuilder builder;
    const std::size_t positions =
        addPacked(builder, packVertices(terrain.positions.data(), count, 12), count, 12, "ATTRIBUTES", "NONE", kFloat3);
    const std::size_t indices = addPacked(builder, packTriangles(terrain.indices, count), terrain.indices.size(), 4,
                                          "TRIANGLES", nullptr, kIndex32);
    builder.addMeshNode({{"attributes", {{"POSITION", positions}}}, {"indices", indices}});
    addBuffers(builder);
    return builder;
}

/// The positions that the loader reads from packed ones.
std::vector<glm::vec3> unpackPositions(const std::vector<std::uint8_t>& packed, std::size_t count, std::size_t stride,
                                       const char* filter, const json& type)
{
    GltfBuilder builder;
    builder.addMeshNode(
        {{"attributes", {{"POSITION", addPacked(builder, packed, count, stride, "ATTRIBUTES", filter, type)}}}});
    addBuffers(builder);
    return builder.load().primitives.at(0).positions;
}

/// The corners of triangles in a canonical order, as the codec may rotate triangles.
std::vector<glm::uvec3> rotated(const std::vector<std::uint32_t>& indices)
{
    std::vector<glm::uvec3> triangles;
    for (std::size_t i = 0; i + 2 < indices.size(); i += 3)
    {
        glm::uvec3 triangle(indices[i], indices[i + 1], indices[i + 2]);
        while (triangle.x > triangle.y || triangle.x > triangle.z)
        {
            triangle = {triangle.y, triangle.z, triangle.x};
        }
        triangles.push_back(triangle);
    }
    return triangles;
}

std::vector<std::uint32_t> indicesOf(const Primitive& primitive)
{
    std::vector<std::uint32_t> indices;
    for (const glm::uvec3& triangle : primitive.triangles)
    {
        indices.insert(indices.end(), {triangle.x, triangle.y, triangle.z});
    }
    return indices;
}

TEST(GltfMeshopt, PackedMeshEqualsThePlainOne)
{
    for (const std::uint32_t edge : {2U, 3U, 17U, 60U})
    {
        const Terrain terrain(edge);
        const Scene scene = packedTerrain(terrain).load();
        EXPECT_EQ(scene.primitives.at(0).positions, terrain.positions);
        EXPECT_EQ(rotated(indicesOf(scene.primitives[0])), rotated(terrain.indices));
        EXPECT_TRUE(scene.warnings.empty());
    }
}

TEST(GltfMeshopt, TheExtensionOfKhronosIsReadAsThatOfItsVendors)
{
    const Terrain terrain(17);
    GltfBuilder builder = packedTerrain(terrain);
    std::string text = builder.document.dump();
    for (std::size_t at = text.find(kExtension); at != std::string::npos; at = text.find(kExtension))
    {
        text.replace(at, 3, "KHR");
    }
    builder.document = json::parse(text);
    const Scene scene = builder.load();
    EXPECT_EQ(scene.primitives.at(0).positions, terrain.positions);
    EXPECT_EQ(rotated(indicesOf(scene.primitives[0])), rotated(terrain.indices));
    ++builder.bin[0]; // of the codec's version
    expectInputError(builder, {"bufferViews[1]", "later version than the 0 that is read"});
    builder.bin[0] = 0;
    expectInputError(builder, {"bufferViews[1]", "does not decode"});
}

TEST(GltfMeshopt, IndicesMayHaveSixteenBitsAndBeSequences)
{
    const Terrain terrain(17);
    const std::size_t vertex_count = terrain.positions.size();
    for (const bool sequence : {false, true})
    {
        const std::vector<std::uint8_t> packed =
            sequence ? packSequence(terrain.indices, vertex_count) : packTriangles(terrain.indices, vertex_count);
        for (const std::size_t stride : {2U, 4U})
        {
            GltfBuilder builder;
            const std::size_t positions = builder.addAccessor(
                "VEC3", kF32, vertex_count,
                std::vector<float>(&terrain.positions[0].x, &terrain.positions[0].x + 3 * vertex_count));
            const std::size_t indices =
                addPacked(builder, packed, terrain.indices.size(), stride, sequence ? "INDICES" : "TRIANGLES", nullptr,
                          stride == 2 ? kIndex16 : kIndex32);
            builder.addMeshNode({{"attributes", {{"POSITION", positions}}}, {"indices", indices}});
            addBuffers(builder);
            const Primitive primitive = builder.load().primitives.at(0);
            if (sequence)
            {
                EXPECT_EQ(indicesOf(primitive), terrain.indices);
            }
            EXPECT_EQ(rotated(indicesOf(primitive)), rotated(terrain.indices));
        }
    }
}

TEST(GltfMeshopt, QuantizedVerticesAreExact)
{
    const Terrain terrain(17);
    std::vector<std::int16_t> values;
    for (const glm::vec3& position : terrain.positions)
    {
        for (int i = 0; i < 3; ++i)
        {
            values.push_back(static_cast<std::int16_t>(position[i] * 1000.0F));
        }
        values.push_back(0);
    }
    const std::size_t count = terrain.positions.size();
    const std::vector<glm::vec3> loaded = unpackPositions(packVertices(values.data(), count, 8), count, 8, "NONE",
                                                          {{"componentType", kI16}, {"type", "VEC3"}});
    for (std::size_t i = 0; i < count; ++i)
    {
        EXPECT_EQ(loaded[i], glm::vec3(values[4 * i], values[4 * i + 1], values[4 * i + 2]));
    }
}

TEST(GltfMeshopt, ExponentialFilterKeepsTheMantissa)
{
    const Terrain terrain(17);
    const std::size_t count = terrain.positions.size();
    constexpr int kBits = 15;
    std::vector<std::uint32_t> filtered(3 * count);
    meshopt_encodeFilterExp(filtered.data(), count, 12, kBits, &terrain.positions[0].x);
    const std::vector<glm::vec3> loaded =
        unpackPositions(packVertices(filtered.data(), count, 12), count, 12, "EXPONENTIAL", kFloat3);
    for (std::size_t i = 0; i < count; ++i)
    {
        // A vector has one exponent, by its largest component; the error is half a step.
        const glm::vec3& wanted = terrain.positions[i];
        const float largest = std::max({wanted.x, wanted.y, wanted.z, 1e-6F});
        const float step = std::exp2(std::floor(std::log2(largest)) + 2.0F - kBits);
        for (int c = 0; c < 3; ++c)
        {
            EXPECT_NEAR(loaded[i][c], wanted[c], step) << i;
            // The extension's formula: mantissa * 2^exponent, 24 and 8 signed bits.
            const auto word = static_cast<std::int32_t>(filtered[3 * i + c]);
            const auto mantissa = static_cast<std::int32_t>(static_cast<std::uint32_t>(word) << 8U) >> 8;
            EXPECT_EQ(loaded[i][c], std::ldexp(static_cast<float>(mantissa), word >> 24)) << i;
        }
    }
}

TEST(GltfMeshopt, OctahedralFilterGivesUnitVectors)
{
    const Terrain terrain(17);
    const std::size_t count = terrain.normals.size();
    std::vector<glm::vec4> normals;
    for (std::size_t i = 0; i < count; ++i)
    {
        const glm::vec3 normal = i % 2 == 0 ? terrain.normals[i] : -terrain.normals[i]; // both halves of the octahedron
        normals.emplace_back(normal, 0.0F);
    }
    for (const std::size_t stride : {4U, 8U})
    {
        std::vector<std::uint8_t> filtered(count * stride);
        meshopt_encodeFilterOct(filtered.data(), count, stride, stride == 4 ? 8 : 12, &normals[0].x);
        GltfBuilder builder;
        const json type = {{"componentType", stride == 4 ? kI8 : kI16}, {"type", "VEC3"}, {"normalized", true}};
        const json attributes = {{"POSITION", builder.addPositions(std::vector<float>(3 * count))},
                                 {"NORMAL", addPacked(builder, packVertices(filtered.data(), count, stride), count,
                                                      stride, "ATTRIBUTES", "OCTAHEDRAL", type)}};
        builder.addMeshNode({{"attributes", attributes}});
        addBuffers(builder);
        const Primitive primitive = builder.load().primitives.at(0);
        for (std::size_t i = 0; i < count; ++i)
        {
            const float off = glm::distance(primitive.normals[i], glm::vec3(normals[i]));
            EXPECT_LT(off, stride == 4 ? 0.03F : 0.002F) << i;
        }
    }
}

TEST(GltfMeshopt, QuaternionFilterGivesUnitQuaternions)
{
    const std::vector<glm::vec4> quaternions = {
        {0.0F, 0.0F, 0.0F, 1.0F}, {0.5F, -0.5F, 0.5F, 0.5F}, {0.8F, 0.0F, -0.6F, 0.0F}, {0.1F, 0.7F, 0.1F, 0.7F}};
    std::vector<std::int16_t> filtered(4 * quaternions.size());
    meshopt_encodeFilterQuat(filtered.data(), quaternions.size(), 8, 16, &quaternions[0].x);
    const std::vector<glm::vec3> loaded =
        unpackPositions(packVertices(filtered.data(), quaternions.size(), 8), quaternions.size(), 8, "QUATERNION",
                        {{"componentType", kI16}, {"type", "VEC3"}, {"normalized", true}});
    for (std::size_t i = 0; i < quaternions.size(); ++i)
    {
        const glm::vec3 wanted(glm::normalize(quaternions[i]));
        const float off = std::min(glm::distance(loaded[i], wanted), glm::distance(loaded[i], -wanted));
        EXPECT_LT(off, 1e-3F) << i; // a quaternion and its negative are the same rotation
    }
}

TEST(GltfMeshopt, FallbackDataIsNotNeeded)
{
    GltfBuilder builder = packedTerrain(Terrain(3));
    builder.document["buffers"][1]["uri"] = "absent.bin";
    EXPECT_EQ(builder.load().triangleCount(), 8U);
    builder.document["bufferViews"].push_back({{"buffer", 1}, {"byteLength", 4}}); // not packed, so it is needed
    expectInputError(builder, {"buffers[1].uri", "absent.bin"});
    builder.document["buffers"][1].erase("uri");
    builder.document["accessors"][0]["bufferView"] = builder.document["bufferViews"].size() - 1;
    expectInputError(builder, {"bufferViews[4] takes 4 bytes", "has 0"});
}

TEST(GltfMeshopt, WhatContradictsItselfIsRefused)
{
    const auto expectBroken = [](const Change& change, std::initializer_list<std::string> parts)
    { expectInputError(packedTerrain(Terrain(9)), change, parts); };
    const auto extensionOf = [](std::size_t view)
    { return "/bufferViews/" + std::to_string(view) + "/extensions/" + kExtension + "/"; };
    const auto setIn = [&](std::size_t view, const char* member, const json& value)
    { return set(extensionOf(view) + member, value); };
    constexpr std::size_t kPositions = 1; // views 0 and 2 have the packed bytes
    constexpr std::size_t kIndices = 3;
    expectBroken(setIn(kPositions, "byteLength", 9999),
                 {"meshopt_compression of bufferViews[1]", "takes 9999 bytes at 0"});
    expectBroken(setIn(kPositions, "byteOffset", ~0ULL), {"bufferViews[1]", "takes"});
    expectBroken(setIn(kPositions, "buffer", 2), {"buffer is 2"});
    expectBroken(setIn(kPositions, "buffer", 1), {"takes", "buffers[1], which has 0"});
    expectBroken(setIn(kPositions, "count", 82), {"82 elements of 12 bytes, its view 972 bytes"});
    expectBroken(setIn(kPositions, "count", ~0ULL), {"which no view has"});
    expectBroken(setIn(kPositions, "byteStride", 0), {"which no view has"});
    expectBroken(setIn(kPositions, "byteStride", 260), {"which no view has"});
    expectBroken(setIn(kPositions, "byteStride", "12"), {"not a whole number"});
    expectBroken(setIn(kPositions, "mode", "POINTS"), {"the mode POINTS"});
    expectBroken(setIn(kPositions, "mode", "TRIANGLES"), {"indices of 12 bytes"});
    expectBroken(setIn(kPositions, "filter", "OCTAHEDRAL"), {"the filter OCTAHEDRAL"});
    expectBroken(setIn(kPositions, "filter", "QUATERNION"), {"the filter QUATERNION"});
    expectBroken(setIn(kPositions, "filter", "COLOR"), {"the filter COLOR"});
    expectBroken(setIn(kIndices, "filter", "EXPONENTIAL"), {"the filter EXPONENTIAL"});
    expectBroken(setIn(kPositions, "byteLength", 40), {"does not decode"});
    expectBroken(setIn(kPositions, "byteLength", 0), {"too few for any data"});
    expectBroken(setIn(kIndices, "byteLength", 130), {"does not decode"});
    expectBroken(setIn(kIndices, "byteLength", 10), {"too few for any data"});
    expectBroken(without(extensionOf(kPositions) + "mode"), {"has no mode"});
    const auto resized = [&](std::size_t view, std::size_t count, std::size_t stride)
    {
        return [=](GltfBuilder& b)
        {
            set("/bufferViews/" + std::to_string(view) + "/byteLength", count * stride)(b);
            setIn(view, "count", count)(b);
            setIn(view, "byteStride", stride)(b);
        };
    };
    expectBroken(resized(kIndices, 385, 4), {"385 indices, not whole triangles"});
    expectBroken(resized(kPositions, 2'000'000'000, 12), {"too few for any data"});
    expectBroken(resized(kPositions, 100, 6), {"not a multiple of 4"});
}

TEST(GltfMeshopt, ManyViewsOfTheSameBytesCannotUnpackToAnySize)
{
    GltfBuilder builder;
    const std::vector<std::uint8_t> equal(256 * 65536);
    const std::size_t count = equal.size() / 256;
    addPacked(builder, packVertices(equal.data(), count, 256), count, 256, "ATTRIBUTES", "NONE", kFloat3);
    builder.document["bufferViews"][1].erase("byteStride");
    builder.document["accessors"][0]["count"] = 3;
    for (int i = 0; i < 80; ++i) // of 16 MiB each, more than 1 GiB in all
    {
        json accessor = builder.document["accessors"][0];
        accessor["bufferView"] = builder.add("bufferViews", json(builder.document["bufferViews"][1]));
        builder.addMeshNode({{"attributes", {{"POSITION", builder.add("accessors", accessor)}}}});
    }
    addBuffers(builder);
    expectInputError(builder, {"bufferViews[", "out of proportion"});
}

TEST(GltfMeshopt, DamagedBytesGiveASceneOrAnInputError)
{
    EXPECT_GT(loadDamaged(packedTerrain(Terrain(12)), 400, 11), 0);
}

} // namespace

} // namespace zvo::test
