// SPDX-License-Identifier: MIT
#pragma once

#include "core/base/grid.h"
#include "core/scene/camera.h"
#include "shared/trace.h"

#include <cmath>
#include <cstdint>

namespace zvo::demo
{

/// The middle of a node in world space. cell: of the nodes of its level.
inline glm::dvec3 nodeCenter(const Grid& grid, const glm::ivec3& cell, std::uint32_t level)
{
    const double size = std::ldexp(double{grid.voxel_size}, 2 * static_cast<int>(grid.nodeLevels() - level));
    return glm::dvec3(grid.origin) + (glm::dvec3(cell) + 0.5) * size;
}

/// The middle of a voxel in world space.
inline glm::dvec3 voxelCenter(const Grid& grid, const glm::ivec3& voxel)
{
    return nodeCenter(grid, voxel, grid.nodeLevels());
}

/// The step from a voxel to its neighbour across the face that the camera sees. face: axis, as in Hit; 0 for a camera
/// inside of the voxel.
inline glm::ivec3 stepAcross(const ViewCamera& camera, const Grid& grid, const glm::ivec3& voxel, std::uint32_t face)
{
    glm::ivec3 step(0);
    if (face != gpu::kFaceInside)
    {
        const auto axis = static_cast<glm::length_t>(face);
        const glm::dvec3 to_camera = camera.orthographic ? -camera.forward : camera.position - voxelCenter(grid, voxel);
        step[axis] = to_camera[axis] < 0 ? -1 : 1;
    }
    return step;
}

} // namespace zvo::demo
