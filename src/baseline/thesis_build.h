// SPDX-License-Identifier: MIT
// The octree construction and the dynamic update of the thesis: Y. Pan, Dynamic Update of Sparse Voxel Octree Based on
// Morton Code, Purdue University, 2021.
#pragma once

#include "baseline/pointer_tree.h"
#include "baseline/thesis_voxelize.h"
#include "vk/frame_graph.h"
#include "vk/headless.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace zvo::baseline
{

/// How tiles of nodes get their numbers.
enum class TileNumbering
{
    Scan,  ///< by prefix sums, level by level and in Morton order: the same bytes on every run. Two more passes a level
    Atomic ///< by an atomic counter, as in the thesis: the order depends on that of threads
};

/// Options of a build.
struct ThesisBuildOptions
{
    TileNumbering numbering = TileNumbering::Scan;

    /// The codes between which voxels lie: only the cells between them are visited, which the thesis proposes as future
    /// work. By default, all 8^level cells of each level.
    std::optional<CodeRange> range = std::nullopt;
};

/// The dense cells of the levels above the voxels, which a build needs beside ThesisCells.
struct ThesisLevels
{
    /// Takes about 1.8 bytes a voxel cell. Throws Error{Memory} when the device's budget does not suffice.
    ThesisLevels(vk::Device& device, const Grid& grid);

    std::vector<vk::BufferOf<gpu::PointerNode>> cells; // [depth] of [8^level] cells, the root's first
    vk::BufferOf<gpu::uint> partials;                  // of the scan
    vk::BufferOf<gpu::uint> tiles;                     // [kThesisLevels] tiles below the cells of each level
};

/// Records the passes that build an octree of cells bottom-up (baseline/thesis_level, and with TileNumbering::Scan
/// baseline/thesis_count and octree/scan before it): a pass a level, a thread for each eight cells. The root is node
/// octree.root, the tiles stand behind it. What has no room in octree.nodes is only counted, in levels.tiles. Cost:
/// 8^depth cells, or those in options.range, and nodes.
void buildLevels(vk::FrameGraph& graph, const ThesisCells& cells, const ThesisBuildOptions& options,
                 ThesisLevels& levels, PointerOctree& octree);

/// Records the passes of a dynamic update: they build the octree of cells, the voxels of a dynamic object, behind the
/// static_count static nodes of octree, and merge it with these: static nodes beside those that the object touches are
/// copied (thesis_level with kMerge). The static nodes stay as they are. The new root is node static_count. Where both
/// have a voxel, the object's counts; the thesis does not tell. Cost: as buildLevels(), and depth loads a node.
void mergeLevels(vk::FrameGraph& graph, const ThesisCells& cells, const ThesisBuildOptions& options,
                 ThesisLevels& levels, PointerOctree& octree);

/// An octree, and how it came about.
struct ThesisBuild
{
    PointerOctree octree;
    std::vector<vk::PassTime> passes; // of the run that wrote the nodes
};

/// Builds twice, to count nodes and to write them, and waits after each. octree.static_count becomes that of all nodes.
/// Throws Error{Memory}.
ThesisBuild buildThesis(vk::HeadlessDevice& device, const ThesisCells& cells, const ThesisBuildOptions& options,
                        ThesisLevels& levels);

/// Merges cells with the static nodes of octree and waits; first makes octree.nodes large enough, which takes another
/// run. Replaces the update before. octree.root becomes the new root. Returns the times of the run that wrote the
/// nodes. Throws Error{Usage} for cells of another grid, Error{Memory}.
std::vector<vk::PassTime> updateThesis(vk::HeadlessDevice& device, const ThesisCells& cells,
                                       const ThesisBuildOptions& options, ThesisLevels& levels, PointerOctree& octree);

} // namespace zvo::baseline
