// SPDX-License-Identifier: MIT
// The instances of a scene, made on the host in the form that the device reads (shaders/shared/scene.h).
#pragma once

#include "core/scene/scene.h"
#include "shared/scene.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace zvo
{

/// Returns count, if it is below gpu::kAbsent. Otherwise throws Error{Input}; what: the name of the elements in its
/// message.
std::uint32_t checkedCount(std::size_t count, const char* what);

/// The first elements of a primitive's arrays in the buffers of a GpuScene.
struct PrimitiveOffsets
{
    std::uint32_t first_triangle;
    std::uint32_t first_vertex;
    std::uint32_t first_normal; // gpu::kAbsent where the primitive has none; likewise below
    std::uint32_t first_uv;
    std::uint32_t first_emission_uv; // first_uv where the primitive has no other coordinates for emission
    std::uint32_t first_color;
};

/// The offsets of all primitives of scene. Throws Error{Input} for more than 2^32 - 1 elements of any kind.
std::vector<PrimitiveOffsets> primitiveOffsets(const Scene& scene);

/// The draws of scene's instances, [instances]: at rest, or with the given transforms [instances], object to world, in
/// place of their own. Throws as primitiveOffsets().
std::vector<gpu::Draw> makeDraws(const Scene& scene);
std::vector<gpu::Draw> makeDraws(const Scene& scene, std::span<const glm::mat4> transforms);

/// Gives the i-th draw the i-th transform. Transforms that are not finite are kept; the voxelizer drops and counts
/// their triangles.
void setTransforms(std::span<gpu::Draw> draws, std::span<const glm::mat4> transforms);

} // namespace zvo
