// SPDX-License-Identifier: MIT
// The instances of a scene as the device sees them (shaders/shared/scene.h), on the host.
#pragma once

#include "core/scene/scene.h"
#include "shared/scene.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace zvo
{

/// count, if numbers below gpu::kAbsent suffice for so many. Throws Error{Input} that names what there is too much of.
std::uint32_t checkedCount(std::size_t count, const char* what);

/// Where a primitive's arrays start in the buffers of a GpuScene, in elements.
struct PrimitiveOffsets
{
    std::uint32_t first_triangle;
    std::uint32_t first_vertex;
    std::uint32_t first_normal; // gpu::kAbsent where the primitive has none; likewise below
    std::uint32_t first_uv;
    std::uint32_t first_color;
};

/// The offsets of all primitives of scene. Throws Error{Input} for more than 2^32 - 1 of anything.
std::vector<PrimitiveOffsets> primitiveOffsets(const Scene& scene);

/// The draws of scene's instances ([instances]), at rest, or with these transforms ([instances], object to world) in
/// place of their own. Throws as primitiveOffsets().
std::vector<gpu::Draw> makeDraws(const Scene& scene);
std::vector<gpu::Draw> makeDraws(const Scene& scene, std::span<const glm::mat4> transforms);

/// Gives each draw the transform of the same number. A transform that is not finite is kept: the voxelizer counts the
/// triangles.
void setTransforms(std::span<gpu::Draw> draws, std::span<const glm::mat4> transforms);

} // namespace zvo
