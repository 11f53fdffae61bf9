// SPDX-License-Identifier: MIT
// What the tests of the slides' algorithms share.
#pragma once

#include "baseline/slides_builder.h"
#include "core/scene/camera.h"
#include "core/scene/scene.h"
#include "runtime/trees.h"
#include "vk/headless.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace zvo::test
{

/// The device that the tests of the binary share, with the kernels of zvo and of the baselines.
vk::HeadlessDevice& slidesDevice();

/// The names of the scenes that the slides' algorithms are compared with zvo on: zvo's own, and models that may be
/// absent (findScene()).
std::vector<std::string> slidesScenes();

/// Runs a SlidesBuilder to its end. Expects that no voxel's fragments were too many.
baseline::SlidesResult buildSlides(const PosedGpuScene& scene, const Grid& grid,
                                   const baseline::SlidesOptions& options);

/// The number of different subtrees of each level, from the parents of voxels to the root, of the octree of sorted,
/// unique Morton codes. Made with maps on the host.
std::vector<std::uint32_t> distinctSubtrees(std::span<const std::uint64_t> codes, std::uint32_t depth);

/// The number of nodes of each level, likewise.
std::vector<std::uint32_t> nodeCounts(std::span<const std::uint64_t> codes, std::uint32_t depth);

/// Expects that a tree has the voxels of codes, numbered in this order if it has sums, and levels of this many nodes.
void expectSlidesTree(const baseline::SlidesTree& tree, const std::vector<std::uint64_t>& codes,
                      const std::vector<std::uint32_t>& level_node_counts);

/// Expects that a tree's attributes are those of zvo's voxels, bit for bit, emission aside.
void expectSlidesAttributes(const baseline::SlidesTree& tree, const DeviceTree& expected);

} // namespace zvo::test
