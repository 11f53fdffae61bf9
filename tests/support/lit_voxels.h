// SPDX-License-Identifier: MIT
// Trees of a few voxels with colours and emission of their own, for tests of light.
#pragma once

#include "core/tree/device_tree.h"
#include "vk/headless.h"

#include <array>
#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace zvo::test
{

struct LitVoxel
{
    glm::uvec3 cell{0U};
    glm::uvec3 color{255U};   // sRGB codes
    glm::vec3 emission{0.0F}; // radiance; must be a multiple of 2^-8 below 2
};

/// It reflects all light.
LitVoxel whiteVoxel();

/// Linear albedo of a voxel.
glm::dvec3 albedoOf(const LitVoxel& voxel);

/// The tree of voxels in any order. The grid has its corner at 0 and voxels of size 1. of_nodes: nodes have attributes,
/// the mean colour of the voxels below them and whether one of these emits.
DeviceTree litTree(vk::HeadlessDevice& device, std::vector<LitVoxel> voxels, std::uint32_t depth, bool of_nodes = true);

/// Gives the voxels of such a tree normals in turns: octahedral codes, or kNoNormal.
void setNormals(vk::HeadlessDevice& device, DeviceTree& tree, std::span<const gpu::uint> codes);

/// The octahedral codes of +z, of the diagonal (1, 1, 1), of one that leans away from places above, and none.
inline constexpr std::array<gpu::uint, 4> kObliqueNormals = {0, 0x2AAA2AAAU, 0xD5560000U, gpu::kNoNormal};

/// The voxels of a box for whose cells make() gives one: from low up to, but without, high.
void addBox(std::vector<LitVoxel>& voxels, const glm::uvec3& low, const glm::uvec3& high, const LitVoxel& voxel);

/// A closed room of edge * edge * edge voxels, whose walls are so many voxels thick.
std::vector<LitVoxel> roomOf(const LitVoxel& wall, std::uint32_t edge, std::uint32_t thickness = 1);

} // namespace zvo::test
