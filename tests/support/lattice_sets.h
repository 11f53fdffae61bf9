// SPDX-License-Identifier: MIT
// Voxel sets of lattice triangles, and symmetries of the grid.
#pragma once

#include "oracle/morton.h"
#include "runtime/trees.h"
#include "stress/lattice_triangles.h"
#include "support/octree_access.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace zvo::test
{

using LatticeTriangles = std::vector<stress::LatticeTriangle>;

/// Morton codes, sorted and unique.
using VoxelSet = std::vector<std::uint64_t>;

inline Grid latticeGrid(std::uint32_t depth)
{
    return {.origin = glm::vec3(0.0F), .voxel_size = 1.0F, .depth = depth};
}

/// The voxels that the device finds for triangles.
inline VoxelSet deviceVoxels(vk::HeadlessDevice& device, std::span<const stress::LatticeTriangle> triangles,
                             std::uint32_t depth, Coverage coverage)
{
    const GpuScene scene = uploadScene(device, stress::latticeScene(triangles, {}), false);
    const BuildResult result = buildOctree(device, scene, latticeGrid(depth), {coverage, false, {}});
    oracle::OctreeContents contents = contentsOf(device, result.octree);
    EXPECT_TRUE(contents.violations.empty()) << contents.violations.front();
    return std::move(contents.codes);
}

/// The images of voxels under place(). Those outside of the grid are left out.
inline VoxelSet mapped(const VoxelSet& voxels, std::uint32_t depth,
                       const std::function<glm::ivec3(const glm::ivec3&)>& place)
{
    VoxelSet result;
    const int resolution = 1 << depth;
    for (const std::uint64_t code : voxels)
    {
        const glm::ivec3 voxel = place(glm::ivec3(oracle::mortonDecode(code)));
        if (glm::all(glm::greaterThanEqual(voxel, glm::ivec3(0))) &&
            glm::all(glm::lessThan(voxel, glm::ivec3(resolution))))
            result.push_back(oracle::mortonEncode(glm::uvec3(voxel)));
    }
    std::sort(result.begin(), result.end());
    return result;
}

inline VoxelSet united(const VoxelSet& a, const VoxelSet& b)
{
    VoxelSet result;
    std::set_union(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(result));
    return result;
}

inline VoxelSet difference(const VoxelSet& a, const VoxelSet& b)
{
    VoxelSet result;
    std::set_symmetric_difference(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(result));
    return result;
}

/// A permutation of the axes with mirroring. Coordinate i of the image is coordinate axis[i] of the point.
struct Symmetry
{
    std::array<int, 3> axis{0, 1, 2};
    std::array<bool, 3> mirrored{};

    /// edge: of the cube that is mapped onto itself; in lattice units for points, resolution - 1 for voxels.
    [[nodiscard]] glm::ivec3 operator()(const glm::ivec3& p, int edge) const
    {
        glm::ivec3 image{};
        for (int i = 0; i < 3; ++i)
        {
            const auto k = static_cast<std::size_t>(i);
            image[axis[k]] = mirrored[k] ? edge - p[i] : p[i];
        }
        return image;
    }
};

/// All symmetries of the cube, the identity first.
inline std::vector<Symmetry> symmetries()
{
    std::vector<Symmetry> all;
    std::array<int, 3> axis{0, 1, 2};
    do
        for (std::uint32_t bits = 0; bits < 8; ++bits)
            all.push_back({axis, {(bits & 1) != 0, (bits & 2) != 0, (bits & 4) != 0}});
    while (std::next_permutation(axis.begin(), axis.end()));
    return all;
}

} // namespace zvo::test
