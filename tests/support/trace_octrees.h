// SPDX-License-Identifier: MIT
// Small octrees for tracing, which are made on the host from sets of voxels.
#pragma once

#include "core/tree/device_tree.h"
#include "vk/headless.h"

#include <cstdint>
#include <functional>
#include <random>
#include <span>
#include <vector>

namespace zvo::test
{

/// Morton codes, sorted and unique.
using Codes = std::vector<std::uint64_t>;

/// The voxels of a grid of this depth for which inside() holds.
Codes codesWhere(std::uint32_t depth, const std::function<bool(const glm::uvec3&)>& inside);

/// At most count random voxels: half of them anywhere, half of them in clusters.
Codes randomCodes(std::uint32_t depth, std::uint32_t count, std::mt19937& random);

/// The voxels whose distance from the grid's centre differs from radius (in voxels) by at most half a voxel. The shell
/// has no holes between face neighbours.
Codes sphereShell(std::uint32_t depth, double radius);

/// A Menger sponge in base 4: of every block of 4x4x4, the cells with two middle coordinates are left out.
Codes spongeCodes(std::uint32_t depth);

/// A set of voxels in a grid of this depth.
struct CodeSet
{
    std::uint32_t depth;
    Codes codes;
};

/// Sets of voxels that share much or little, with one or several levels of nodes.
std::vector<CodeSet> codeSets();

/// The octree of codes in device memory, without attributes. The grid has its corner at 0 and voxels of size 1.
DeviceTree octreeOf(vk::HeadlessDevice& device, std::span<const std::uint64_t> codes, std::uint32_t depth);

/// Gives every voxel and node of octree the attributes that addAttributes() gives in the host's memory
/// (support/tree_samples.h). emission_scale stays.
void addAttributes(vk::HeadlessDevice& device, DeviceTree& octree);

} // namespace zvo::test
