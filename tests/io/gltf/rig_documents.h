// SPDX-License-Identifier: MIT
// glTF documents that move, for the tests of what loads and evaluates them.
#pragma once

#include "gltf_builder.h"

#include <cmath>
#include <cstddef>
#include <numbers>
#include <string>
#include <vector>

namespace zvo::test
{

/// Key frames of one channel; its animation's index.
template <typename T>
std::size_t addAnimation(GltfBuilder& builder, std::size_t node, const std::string& path,
                         const std::string& interpolation, const std::vector<float>& times, const std::string& type,
                         int component_type, std::size_t count, const std::vector<T>& values)
{
    const bool normalized = component_type != kF32;
    const std::size_t input = builder.addAccessor("SCALAR", kF32, times.size(), times);
    const std::size_t output = builder.addAccessor(type, component_type, count, values, normalized);
    return builder.add("animations",
                       {{"name", path},
                        {"channels", {{{"sampler", 0}, {"target", {{"node", node}, {"path", path}}}}}},
                        {"samplers", {{{"input", input}, {"output", output}, {"interpolation", interpolation}}}}});
}

/// A flat arm along y in the plane z = 0: two triangles that hang on a shoulder at (0, 0, 0) and an elbow at (0, 1, 0).
/// In one second the elbow turns by 90 degrees around z, stays so for another one and jumps back. Nodes: 0 has the
/// mesh and stands where it must not matter, 1 is the shoulder, 2 the elbow below it.
inline GltfBuilder armDocument()
{
    GltfBuilder builder;
    const std::size_t positions = builder.addPositions({0, 0, 0, 0, 1, 0, 0, 2, 0, 1, 1, 0});
    const std::size_t joints =
        builder.addAccessor<std::uint8_t>("VEC4", kU8, 4, {0, 0, 0, 0, 0, 1, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0});
    const std::size_t weights =
        builder.addAccessor<float>("VEC4", kF32, 4, {1, 0, 0, 0, 0.5F, 0.5F, 0, 0, 1, 0, 0, 0, 0.25F, 0.75F, 0, 0});
    const std::size_t order = builder.addAccessor<std::uint8_t>("SCALAR", kU8, 6, {0, 3, 1, 1, 3, 2});
    builder.addMeshNode(
        {{"attributes", {{"POSITION", positions}, {"JOINTS_0", joints}, {"WEIGHTS_0", weights}}}, {"indices", order}});
    builder.document["nodes"][0].update({{"skin", 0}, {"name", "body"}, {"translation", {100, 0, 0}}});
    builder.add("nodes", {{"name", "shoulder"}, {"translation", {0, 0, 5}}, {"children", {2}}});
    builder.add("nodes", {{"name", "elbow"}, {"translation", {0, 1, 0}}});
    const std::vector<float> inverse_bind = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0,  -5, 1,
                                             1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, -1, -5, 1};
    builder.add("skins",
                {{"joints", {1, 2}}, {"inverseBindMatrices", builder.addAccessor("MAT4", kF32, 2, inverse_bind)}});
    const float half = std::numbers::sqrt2_v<float> / 2;
    addAnimation<float>(builder, 2, "rotation", "LINEAR", {0, 1, 2}, "VEC4", kF32, 3,
                        {0, 0, 0, 1, 0, 0, half, half, 0, 0, half, half});
    return builder;
}

/// A triangle (0, 0, 0), (1, 0, 0), (0, 1, 0) with normals along z. The first morph target lifts it by 1 along z and
/// leans its normals along x, the second moves only vertex 1, by 2 along x. weights: at rest, of the mesh.
inline GltfBuilder morphDocument(const std::vector<float>& weights)
{
    GltfBuilder builder;
    json primitive = trianglePrimitive(builder);
    primitive["attributes"]["NORMAL"] = builder.addPositions({0, 0, 1, 0, 0, 1, 0, 0, 1});
    const std::size_t lift = builder.addPositions({0, 0, 1, 0, 0, 1, 0, 0, 1});
    const std::size_t lean = builder.addPositions({1, 0, 0, 1, 0, 0, 1, 0, 0});
    const std::size_t pull = builder.addPositions({0, 0, 0, 2, 0, 0, 0, 0, 0});
    primitive["targets"] = {{{"POSITION", lift}, {"NORMAL", lean}}, {{"POSITION", pull}}};
    builder.addMeshNode(primitive);
    if (!weights.empty())
    {
        builder.document["meshes"][0]["weights"] = weights;
    }
    return builder;
}

} // namespace zvo::test
