// SPDX-License-Identifier: MIT
// Voxels by bricks (shaders/voxelize/bricks.h): triangles are divided into items, each in one block of 16^3 cells; then
// a thread takes an item.
#pragma once

#include "core/base/grid.h"
#include "core/deform/dynamic_object.h"
#include "core/upload/gpu_scene.h"
#include "shared/bricks.h"
#include "vk/frame_graph.h"
#include "voxelize/bricks.h"
#include "zvo/types.h"

#include <cstdint>
#include <map>
#include <string>

namespace zvo
{

/// Whether the keys of the brick table for this grid take two words (shaders/shared/bricks.h): from depth 13 on.
inline bool hasWideKeys(const Grid& grid)
{
    return grid.nodeLevels() > gpu::kNarrowLevelsMax;
}

/// Lattice units a world unit.
inline float latticeScale(const Grid& grid)
{
    return static_cast<float>(gpu::kVoxelLattice / static_cast<double>(grid.voxel_size));
}

/// What becomes of a fragment.
enum class RasterMode : std::uint32_t
{
    Coverage = gpu::kModeCoverage,     // sets the voxel's bit
    Attributes = gpu::kModeAttributes, // adds its colour and normal to the voxel's sums
    Emission = gpu::kModeEmission      // adds its emission to the emissive voxel's sums
};

/// What a voxelization makes.
struct VoxelForm
{
    Coverage coverage = Coverage::Thin;
    bool attributes = true; // the fragments will be shaded
    bool emission = false;  // the fragments emit light; only with attributes
    bool mixed = false;     // the masks tell which voxels are mixed: several fragments share them
    Fill fill = Fill::None;
    Shell shell = Shell::Surface; // None: not with Fill::Robust

    bool operator==(const VoxelForm&) const = default;
};

/// The expected numbers for voxelizing a scene, from its surface area. They are neither rounded nor bounded.
struct VoxelizeEstimate
{
    static VoxelizeEstimate of(const GpuScene& scene, const Grid& grid, Coverage coverage);

    double leaves = 0; // of the octree, at most as many as the grid has
    double bricks = 0;
    double setups = 0;
    double items = 0;
    double large = 0;
};

/// The capacities of a voxelization's buffers.
struct VoxelizeCapacities
{
    std::uint64_t table = 0;  // entries of the brick table, a power of two
    std::uint64_t bricks = 0; // that triangles may touch
    std::uint64_t setups = 0; // of triangles that may have voxels
    std::uint64_t items = 0;
    std::uint64_t large = 0;       // blocks of large triangles
    std::uint32_t fill_planes = 1; // binary digits of the triangles that cross a voxel's line one way

    /// The most entries that the 32-bit numbers of the brick table allow.
    static constexpr std::uint64_t kTableMax = 1ULL << 31;

    /// A guess from the scene's surface area and the grid; it suffices in most cases.
    static VoxelizeCapacities estimate(const GpuScene& scene, const Grid& grid, Coverage coverage);

    /// What of a voxelization 32-bit numbers do not count, as its counters tell; null: nothing.
    [[nodiscard]] const char* uncountable(const gpu::BinCounters& counters) const;

    /// At least those of a voxelization, as its counters tell, and a table in which so many bricks and the nodes above
    /// them find room. Throws Error{Memory} for what is uncountable.
    [[nodiscard]] VoxelizeCapacities grownFor(const gpu::BinCounters& counters) const;

    /// The bytes of VoxelizeBuffers.
    [[nodiscard]] std::uint64_t bytes(const GpuScene& scene, const VoxelForm& form) const;

    bool operator==(const VoxelizeCapacities&) const = default;
};

/// The buffers by which triangles get into bricks, and what becomes of these.
struct VoxelizeBuffers
{
    VoxelizeBuffers(vk::Device& device, const VoxelizeCapacities& capacities, const GpuScene& scene,
                    const VoxelForm& voxel_form);

    /// For bricks whose masks are not those of triangles: capacities.table and capacities.bricks count.
    VoxelizeBuffers(vk::Device& device, const VoxelizeCapacities& capacities, const VoxelForm& voxel_form);

    VoxelForm form;
    vk::BufferOf<gpu::BrickEntry> table;     // [capacities.table] bricks; octree construction adds the nodes above them
    vk::BufferOf<gpu::TriangleSetup> setups; // [capacities.setups]
    vk::BufferOf<gpu::SurfaceSetup> surfaces; // as many, twice with emission; or empty: no textures, no vertex colours
    vk::BufferOf<gpu::BrickItem> items;       // [capacities.items] in the order of triangles, mostly
    vk::BufferOf<gpu::ItemVoxels> voxels;     // [capacities.items], twice as many with conservative coverage
    vk::BufferOf<gpu::LargeBlock> large;      // [capacities.large]
    vk::BufferOf<gpu::BrickRange> ranges;     // [capacities.bricks] in any order
    vk::BufferOf<gpu::uint> masks;           // gpu::kLeafMaskWords for each brick's leaves, and with form.mixed as many
                                             // for their mixed voxels
    std::uint32_t fill_planes = 0;           // of crossings; 0: nothing is filled
    vk::BufferOf<gpu::uint> crossings;       // fillWords() for each brick
    vk::BufferOf<gpu::BinCounters> counters; // [1]

    /// The words of a brick's crossings.
    [[nodiscard]] std::uint32_t fillWords() const
    {
        return gpu::fillWords(fill_planes, form.fill == Fill::Robust, form.shell == Shell::None);
    }
};

/// The triangles that a voxelization left out, by reason; only reasons that occurred.
std::map<std::string, std::uint64_t> droppedTriangles(const gpu::BinCounters& counters);

/// What is voxelized, and into which buffers.
struct VoxelizeJob
{
    PosedGpuScene scene;
    GridTile tile;
    VoxelizeBuffers& buffers;
    glm::ivec3 lattice_offset{0}; // is added to lattice positions: triangles lie elsewhere in the grid
};

/// The `window` of kernels for a tile (voxelize/window.h).
std::uint32_t windowOf(const GridTile& tile);

/// Records the passes that clear all buffers, before triangles are put into bricks.
void clearVoxels(vk::FrameGraph& graph, VoxelizeBuffers& buffers);

/// Records the passes that put the triangles of those chunks of a material class into bricks that group_count
/// workgroups take, from first_group on: at most one over whole chunks and one over single triangles (TriangleChunks).
void binTriangles(vk::FrameGraph& graph, const VoxelizeJob& job, MaterialClass material_class,
                  std::uint64_t first_group, std::uint64_t group_count);

/// Records the pass that lists the bricks of the table, with the arguments of dispatches over them. brick_lanes:
/// threads a brick of those by BinCounters::leaves.
void listBricks(vk::FrameGraph& graph, VoxelizeBuffers& buffers, std::uint32_t brick_lanes);

/// Records the passes that put what large triangles are left into bricks, and then set the bit of every covered voxel
/// in the masks of these. To be recorded after all triangles were put into bricks.
void coverBricks(vk::FrameGraph& graph, const VoxelizeJob& job);

/// Records the passes that turn the crossings of bricks into the masks of what is inside, where voxels are filled. To
/// be recorded after coverBricks().
void fillBricks(vk::FrameGraph& graph, const VoxelizeJob& job);

/// Records the passes of coverage: all of the above. What does not fit is counted, never written. For a tile of the
/// grid, the voxels are those of the whole grid that lie in it. Cost: triangles, items, fragments, and the capacities
/// of table and masks once, for clearing them.
void voxelizeCoverage(vk::FrameGraph& graph, const VoxelizeJob& job);

} // namespace zvo
