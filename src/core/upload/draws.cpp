// SPDX-License-Identifier: MIT
#include "core/upload/draws.h"

#include "zvo/error.h"

#include <cassert>
#include <string>

namespace zvo
{

namespace
{

// Whether an array of a primitive is absent or as long as its positions.
template <typename T> [[maybe_unused]] bool isWhole(const std::vector<T>& values, const Primitive& primitive)
{
    return values.empty() || values.size() == primitive.positions.size();
}

void setTransform(gpu::Draw& draw, const glm::mat4& transform)
{
    const glm::dmat3 linear(transform);
    const double determinant = glm::determinant(linear);
    const double sign = determinant < 0 ? -1.0 : 1.0;
    draw.transform = gpu::mat4x3(transform);
    draw.normal_transform =
        gpu::mat3(glm::dmat3(glm::cross(linear[1], linear[2]) * sign, glm::cross(linear[2], linear[0]) * sign,
                             glm::cross(linear[0], linear[1]) * sign));
    draw.mirrored = determinant < 0 ? 1 : 0;
}

std::uint32_t packShift(const glm::ivec3& shift)
{
    const auto byte = [](int value) { return static_cast<std::uint32_t>(static_cast<std::uint8_t>(value)); };
    return byte(shift.x) | byte(shift.y) << 8U | byte(shift.z) << 16U;
}

gpu::Draw makeDraw(const Primitive& primitive, const PrimitiveOffsets& primitive_offsets, const Instance& instance)
{
    gpu::Draw draw{};
    draw.first_triangle = primitive_offsets.first_triangle;
    draw.triangle_count = checkedCount(primitive.triangles.size(), "triangles");
    draw.first_vertex = primitive_offsets.first_vertex;
    draw.first_normal = primitive_offsets.first_normal;
    draw.first_uv = primitive_offsets.first_uv;
    draw.first_emission_uv = primitive_offsets.first_emission_uv;
    draw.first_color = primitive_offsets.first_color;
    draw.material = primitive.material;
    draw.is_points = primitive.is_points ? 1 : 0;
    draw.point_shift = packShift(instance.point_shift);
    setTransform(draw, instance.transform);
    return draw;
}

} // namespace

std::uint32_t checkedCount(std::size_t count, const char* what)
{
    if (count >= gpu::kAbsent)
    {
        throw Error(ErrorCode::Input, std::string("the scene has too many ") + what + " for 32-bit numbers; split it");
    }
    return static_cast<std::uint32_t>(count);
}

std::vector<PrimitiveOffsets> primitiveOffsets(const Scene& scene)
{
    std::vector<PrimitiveOffsets> offsets;
    offsets.reserve(scene.primitives.size());
    std::uint64_t triangle_count = 0;
    std::uint64_t vertex_count = 0;
    std::uint64_t normal_count = 0;
    std::uint64_t uv_count = 0;
    std::uint64_t color_count = 0;
    for (const Primitive& primitive : scene.primitives)
    {
        assert(isWhole(primitive.normals, primitive) && isWhole(primitive.uvs, primitive) &&
               isWhole(primitive.emission_uvs, primitive) && isWhole(primitive.colors, primitive));
        const auto offsetOf = [](std::uint64_t first, std::size_t count, const char* what)
        { return count == 0 ? gpu::kAbsent : checkedCount(first, what); };
        PrimitiveOffsets primitive_offsets{};
        primitive_offsets.first_triangle = checkedCount(triangle_count, "triangles");
        primitive_offsets.first_vertex = checkedCount(vertex_count, "vertices");
        primitive_offsets.first_normal = offsetOf(normal_count, primitive.normals.size(), "normals");
        primitive_offsets.first_uv = offsetOf(uv_count, primitive.uvs.size(), "texture coordinates");
        primitive_offsets.first_emission_uv =
            primitive.emission_uvs.empty()
                ? primitive_offsets.first_uv
                : offsetOf(uv_count + primitive.uvs.size(), primitive.emission_uvs.size(), "texture coordinates");
        primitive_offsets.first_color = offsetOf(color_count, primitive.colors.size(), "colours");
        offsets.push_back(primitive_offsets);
        triangle_count += primitive.triangles.size();
        vertex_count += primitive.positions.size();
        normal_count += primitive.normals.size();
        uv_count += primitive.uvs.size() + primitive.emission_uvs.size();
        color_count += primitive.colors.size();
    }
    checkedCount(triangle_count, "triangles"); // the last ones have numbers, too
    checkedCount(vertex_count, "vertices");
    checkedCount(uv_count, "texture coordinates");
    return offsets;
}

std::vector<gpu::Draw> makeDraws(const Scene& scene)
{
    const std::vector<PrimitiveOffsets> offsets = primitiveOffsets(scene);
    std::vector<gpu::Draw> draws;
    draws.reserve(scene.instances.size());
    for (const Instance& instance : scene.instances)
    {
        draws.push_back(makeDraw(scene.primitives[instance.primitive], offsets[instance.primitive], instance));
    }
    return draws;
}

std::vector<gpu::Draw> makeDraws(const Scene& scene, std::span<const glm::mat4> transforms)
{
    std::vector<gpu::Draw> draws = makeDraws(scene);
    setTransforms(draws, transforms);
    return draws;
}

void setTransforms(std::span<gpu::Draw> draws, std::span<const glm::mat4> transforms)
{
    assert(transforms.size() == draws.size());
    for (std::size_t i = 0; i < draws.size(); ++i)
    {
        setTransform(draws[i], transforms[i]);
    }
}

} // namespace zvo
