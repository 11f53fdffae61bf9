// SPDX-License-Identifier: MIT
#pragma once

#include "baseline/slides.h"
#include "core/base/grid.h"
#include "vk/buffer.h"
#include "vk/headless.h"

#include <cstdint>
#include <span>
#include <vector>

namespace zvo::baseline
{

/// The words of a node.
enum class SlidesNodes : std::uint32_t
{
    Plain = gpu::kSlidesNodeWords,      // 36 bytes: a DAG's voxels have no numbers
    WithSums = gpu::kSlidesSumNodeWords // 68 bytes: a hit knows the number of its voxel, also in a DAG
};

/// An octree of nodes with eight pointers, or a DAG of such nodes (shaders/baseline/slides.h documents the layout).
struct SlidesTree
{
    Grid grid;
    SlidesNodes node_words = SlidesNodes::WithSums;
    bool is_dag = false;
    vk::BufferOf<gpu::uint> nodes; // [node_count * node_words]; the root is the last node
    /// The number of nodes of each level, from the parents of voxels to the root: [grid.depth], or none without voxels.
    std::vector<std::uint32_t> level_node_counts;
    std::uint32_t node_count = 0;
    std::uint32_t voxel_count = 0;
    vk::BufferOf<gpu::Attribute> attributes; // [voxel_count] in Morton order, or empty

    [[nodiscard]] std::uint32_t root() const { return node_count - 1; }

    /// Bytes of all nodes, as the slides count them.
    [[nodiscard]] std::uint64_t geometryBytes() const
    {
        return std::uint64_t{node_count} * static_cast<std::uint32_t>(node_words) * sizeof(gpu::uint);
    }
};

/// A place that a walk over all paths of a tree reaches: a voxel, with the number that its path gives it.
struct SlidesVoxel
{
    std::uint64_t code;  // Morton code
    std::uint32_t index; // sum of the numbers of voxels before the children of the path; 0 without sums
};

/// The voxels of downloaded nodes, in the order of their Morton codes. depth: levels of nodes. nodes: whole nodes of
/// node_words words, the root last, or none. Throws std::out_of_range for a child that is not there. Cost: voxels.
std::vector<SlidesVoxel> slidesVoxels(std::span<const gpu::uint> nodes, SlidesNodes node_words, std::uint32_t depth);

/// The same of a tree in device memory. Waits.
std::vector<SlidesVoxel> slidesVoxels(vk::HeadlessDevice& device, const SlidesTree& tree);

} // namespace zvo::baseline
