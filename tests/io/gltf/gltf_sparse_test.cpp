// SPDX-License-Identifier: MIT
// Sparse accessors, compared with the same values in dense ones.
#include "io/gltf/gltf_loader.h"

#include "gltf_builder.h"

#include <gtest/gtest.h>

namespace zvo::test
{

namespace
{

/// Makes an accessor sparse, with values at the given indices.
template <typename Index, typename Value>
void addSparse(GltfBuilder& builder, std::size_t accessor, int index_type, const std::vector<Index>& indices,
               const std::vector<Value>& values)
{
    const std::size_t index_view = builder.addView(indices.data(), indices.size() * sizeof(Index));
    const std::size_t value_view = builder.addView(values.data(), values.size() * sizeof(Value));
    builder.document["accessors"][accessor]["sparse"] = {
        {"count", indices.size()},
        {"indices", {{"bufferView", index_view}, {"componentType", index_type}}},
        {"values", {{"bufferView", value_view}}}};
}

/// An accessor without data of its own.
std::size_t addZeros(GltfBuilder& builder, const std::string& type, int component_type, std::size_t count)
{
    return builder.add("accessors", {{"componentType", component_type}, {"count", count}, {"type", type}});
}

using Positions = std::vector<glm::vec3>;

TEST(GltfSparse, ValuesReplaceWhatTheViewHas)
{
    const auto positionsWith = [](int index_type, const auto& indices)
    {
        GltfBuilder builder = triangleDocument();
        addSparse(builder, 0, index_type, indices, std::vector<float>{7, 8, 9, -1, -2, -3});
        return builder.load().primitives.at(0).positions;
    };
    const Positions wanted = {{0, 0, 0}, {7, 8, 9}, {-1, -2, -3}};
    EXPECT_EQ(positionsWith(kU8, std::vector<std::uint8_t>{1, 2}), wanted);
    EXPECT_EQ(positionsWith(kU16, std::vector<std::uint16_t>{1, 2}), wanted);
    EXPECT_EQ(positionsWith(kU32, std::vector<std::uint32_t>{1, 2}), wanted);
}

TEST(GltfSparse, WithoutAViewTheOthersAreZero)
{
    GltfBuilder builder;
    const std::size_t positions = addZeros(builder, "VEC3", kF32, 3);
    addSparse(builder, positions, kU16, std::vector<std::uint16_t>{1}, std::vector<float>{1, 2, 3});
    builder.addMeshNode({{"attributes", {{"POSITION", positions}}}});
    EXPECT_EQ(builder.load().primitives.at(0).positions, (Positions{{0, 0, 0}, {1, 2, 3}, {0, 0, 0}}));
}

TEST(GltfSparse, InterleavedViewsKeepTheirOtherElements)
{
    GltfBuilder builder;
    const std::vector<float> vertices = {0, 0, 0, 99, 1, 0, 0, 99, 0, 1, 0, 99};
    const std::size_t positions = builder.addAccessor("VEC3", kF32, 3, vertices, false, 16);
    addSparse(builder, positions, kU8, std::vector<std::uint8_t>{0}, std::vector<float>{5, 6, 7});
    builder.addMeshNode({{"attributes", {{"POSITION", positions}}}});
    EXPECT_EQ(builder.load().primitives.at(0).positions, (Positions{{5, 6, 7}, {1, 0, 0}, {0, 1, 0}}));
}

TEST(GltfSparse, EveryAttributeMayBe)
{
    GltfBuilder builder;
    json primitive = trianglePrimitive(builder);
    const std::size_t colors = builder.addAccessor<std::uint8_t>("VEC4", kU8, 3, std::vector<std::uint8_t>(12), true);
    addSparse(builder, colors, kU8, std::vector<std::uint8_t>{2}, std::vector<std::uint8_t>{255, 51, 0, 102});
    const std::size_t uvs = addZeros(builder, "VEC2", kU16, 3);
    builder.document["accessors"][uvs]["normalized"] = true;
    addSparse(builder, uvs, kU32, std::vector<std::uint32_t>{1}, std::vector<std::uint16_t>{65535, 13107});
    const std::size_t normals = addZeros(builder, "VEC3", kF32, 3);
    addSparse(builder, normals, kU8, std::vector<std::uint8_t>{0, 2}, std::vector<float>{0, 0, 2, 0, 3, 4});
    const std::size_t indices = builder.addAccessor<std::uint16_t>("SCALAR", kU16, 6, {0, 1, 2, 0, 0, 0});
    addSparse(builder, indices, kU8, std::vector<std::uint8_t>{3, 5}, std::vector<std::uint16_t>{2, 1});
    primitive["attributes"]["COLOR_0"] = colors;
    primitive["attributes"]["TEXCOORD_0"] = uvs;
    primitive["attributes"]["NORMAL"] = normals;
    primitive["indices"] = indices;
    builder.addMeshNode(primitive);
    const Primitive loaded = builder.load().primitives.at(0);
    EXPECT_EQ(loaded.colors, (std::vector<glm::vec4>{glm::vec4(0), glm::vec4(0), {1, 0.2F, 0, 0.4F}}));
    EXPECT_EQ(loaded.uvs, (std::vector<glm::vec2>{{0, 0}, {1, 0.2F}, {0, 0}}));
    EXPECT_EQ(loaded.normals, (Positions{{0, 0, 1}, {0, 0, 0}, {0, 0.6F, 0.8F}}));
    EXPECT_EQ(loaded.triangles, (std::vector<glm::uvec3>{{0, 1, 2}, {2, 0, 1}}));
}

TEST(GltfSparse, QuantizedPositionsMayBe)
{
    GltfBuilder builder;
    builder.document["extensionsRequired"] = {"KHR_mesh_quantization"};
    const std::vector<std::int16_t> values = {0, 0, 0, 99, 32767, -32768, 0, 99, 0, 16384, 0};
    const std::size_t positions = builder.addAccessor("VEC3", kI16, 3, values, true, 8);
    addSparse(builder, positions, kU8, std::vector<std::uint8_t>{2}, std::vector<std::int16_t>{0, -32767, 16384});
    builder.addMeshNode({{"attributes", {{"POSITION", positions}}}});
    EXPECT_EQ(builder.load().primitives.at(0).positions,
              (Positions{{0, 0, 0}, {1, -1, 0}, {0, -1, 16384.0F / 32767.0F}}));
}

TEST(GltfSparse, WhatDoesNotFitIsRefused)
{
    const auto expectBroken = [](
                                  const std::vector<std::uint8_t>& indices, std::initializer_list<std::string> parts,
                                  const Change& change = [](GltfBuilder&) {})
    {
        GltfBuilder builder = triangleDocument();
        addSparse(builder, 0, kU8, indices, std::vector<float>(3 * indices.size()));
        expectInputError(builder, change, parts);
    };
    const std::string sparse = "/accessors/0/sparse/";
    expectBroken({3}, {"accessors[0] (POSITION of meshes[0].primitives[0]).sparse.indices contains 3", "below 3"});
    expectBroken({1, 1}, {"sparse.indices contains 1", "increase"});
    expectBroken({2, 1}, {"sparse.indices contains 1", "increase"});
    expectBroken({0, 1, 2, 3}, {"4 sparse values for 3 elements"});
    expectBroken({0, 1}, {"sparse.count is not a small whole number"}, set(sparse + "count", ~0ULL));
    expectBroken({0}, {"sparse.indices takes 2 elements of 1 bytes"}, set(sparse + "count", 2));
    expectBroken({0}, {"sparse.indices takes 1 elements of 1 bytes"}, set(sparse + "indices/byteOffset", 1));
    expectBroken({0}, {"sparse.values takes 1 elements"}, set(sparse + "values/byteOffset", 1));
    expectBroken({0}, {"byteOffset is not a small whole number"}, set(sparse + "values/byteOffset", ~0ULL));
    expectBroken({0}, {"sparse.indices has component type 5126"}, set(sparse + "indices/componentType", kF32));
    expectBroken({0}, {"bufferView is 9"}, set(sparse + "values/bufferView", 9));
    expectBroken({0}, {"sparse.indices has no bufferView"}, without(sparse + "indices/bufferView"));
    expectBroken({0}, {"sparse has no values"}, without(sparse + "values"));
}

TEST(GltfSparse, ZerosOutOfProportionToTheFileAreRefused)
{
    for (const auto& [count, reason] :
         {std::pair(200'000'000ULL, "accessors[0] (POSITION of meshes[0].primitives[0]) needs 2400000000 bytes"),
          std::pair(5'000'000'000ULL, "5e+09 vertices, more than 32-bit"), std::pair(~0ULL, "6.15e+18 triangles")})
    {
        GltfBuilder builder;
        const std::size_t positions = addZeros(builder, "VEC3", kF32, count);
        addSparse(builder, positions, kU8, std::vector<std::uint8_t>{0}, std::vector<float>{1, 2, 3});
        builder.addMeshNode({{"attributes", {{"POSITION", positions}}}});
        expectInputError(builder, {reason});
    }
}

} // namespace

} // namespace zvo::test
