// SPDX-License-Identifier: MIT
// Scenes in the style of toon shading: an inverted hull around each object, for its outline.
#pragma once

#include "support/scenes.h"

#include <cstdint>
#include <utility>

namespace zvo::test
{

/// Appends a primitive of a convex soup's triangles, with a single-sided material, and returns its number. turned: with
/// its back faces outside.
inline std::uint32_t addSurface(Scene& scene, const Scene& soup, const glm::vec4& color, bool turned = false)
{
    Primitive primitive = soup.primitives.at(0);
    const Bounds bounds = soup.bounds();
    const glm::vec3 centre = 0.5F * (bounds.min + bounds.max);
    for (glm::uvec3& triangle : primitive.triangles)
    {
        const glm::vec3 a = primitive.positions[triangle.x];
        const glm::vec3 b = primitive.positions[triangle.y];
        const glm::vec3 c = primitive.positions[triangle.z];
        const bool looks_out = glm::dot(glm::cross(b - a, c - a), a - centre) > 0.0F;
        triangle = looks_out == turned ? glm::uvec3(triangle.x, triangle.z, triangle.y) : triangle;
    }
    primitive.material = static_cast<std::uint32_t>(scene.materials.size());
    Material& material = scene.materials.emplace_back();
    material.name = turned ? "outline" : "surface";
    material.base_color = color;
    material.double_sided = false;
    scene.primitives.push_back(std::move(primitive));
    return static_cast<std::uint32_t>(scene.primitives.size() - 1);
}

/// Appends an instance.
inline Instance& place(Scene& scene, std::uint32_t primitive, const glm::vec3& where, float scale)
{
    Instance& instance = scene.instances.emplace_back();
    instance.primitive = primitive;
    instance.transform = glm::mat4(scale);
    instance.transform[3] = glm::vec4(where, 1.0F);
    return instance;
}

/// The size of a hull, in sizes of what is in it.
inline constexpr float kHullScale = 1.03F;

/// edge * edge balls and boxes on a floor of edge x edge units, in four colours, each in a hull. Materials: the
/// floor's, the four colours for balls and for boxes, and the hulls' two, which are nearly black.
inline Scene toonScene(std::uint32_t edge)
{
    const Scene ball = sphereScene(glm::vec3(0.0F), 0.22F, 12);
    const Scene box = boxScene(glm::vec3(-0.18F), glm::vec3(0.18F));
    const glm::vec4 colors[] = {
        {0.8F, 0.05F, 0.05F, 1.0F}, {0.05F, 0.6F, 0.05F, 1.0F}, {0.05F, 0.1F, 0.8F, 1.0F}, {0.8F, 0.6F, 0.02F, 1.0F}};
    Scene scene;
    const auto size = static_cast<float>(edge);
    place(scene, addSurface(scene, boxScene({0.0F, -0.1F, 0.0F}, {size, 0.0F, size}), glm::vec4(0.7F)), {}, 1.0F);
    std::uint32_t shapes[8] = {};
    for (std::uint32_t i = 0; i < 8; ++i)
    {
        shapes[i] = addSurface(scene, i < 4 ? ball : box, colors[i % 4]);
    }
    const glm::vec4 dark(0.01F, 0.01F, 0.01F, 1.0F);
    const std::uint32_t hulls[] = {addSurface(scene, ball, dark, true), addSurface(scene, box, dark, true)};
    for (std::uint32_t i = 0; i < edge * edge; ++i)
    {
        const glm::vec3 where(static_cast<float>(i % edge) + 0.5F, 0.4F, static_cast<float>(i / edge) + 0.5F);
        const std::uint32_t shape = (i + i / edge) % 8;
        place(scene, shapes[shape], where, 1.0F);
        place(scene, hulls[shape / 4], where, kHullScale);
    }
    return scene;
}

} // namespace zvo::test
