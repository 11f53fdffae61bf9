// SPDX-License-Identifier: MIT
#pragma once

#include "core/base/grid.h"
#include "core/deform/dynamic_object.h"
#include "core/tree/device_tree.h"
#include "core/upload/gpu_scene.h"
#include "shared/bricks.h"
#include "vk/frame_graph.h"
#include "zvo/types.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

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

/// How the work of big triangles is divided among threads. The voxels and their attributes do not depend on it. Devices
/// that do not skip branches want few threads, which share what they compute of a triangle; GPUs want short ones.
struct RowShape
{
    std::uint32_t block_columns = 256; // columns of a row block, a power of two from 4 to kBlockColumnsMax
    std::uint32_t strip_lanes = 1;     // threads that share a band of strips, a power of two up to gpu::kBandsGroup

    static constexpr std::uint32_t kBlockColumnsMax = 1024;
    static constexpr std::uint32_t kProductMin = 256; // of both: a thread lists at most 2^15 blocks of a band

    /// What is chosen for the device: Tunable::RowColumns, and Tunable::BandLanes, or as many threads as that needs.
    static RowShape on(const vk::Device& device);

    bool operator==(const RowShape&) const = default;
};

/// How fragments are added to the sums of their voxels. The sums do not depend on it.
struct SumForm
{
    bool int64 = false; // two words by one atomic; takes shaderBufferInt64Atomics
    bool mixed = false; // sums of mixed voxels alone (gpu::MixedVoxels), where nothing else needs them

    /// What suits a device.
    static SumForm on(const vk::Device& device);

    bool operator==(const SumForm&) const = default;
};

/// The expected numbers for voxelizing a scene, from its surface area. They are neither rounded nor bounded.
struct VoxelizeEstimate
{
    static VoxelizeEstimate of(const GpuScene& scene, const Grid& grid, RowShape shape);

    double leaves = 0;        // of the octree, at most as many as the grid has
    double big_triangles = 0; // bands of big triangles
    double row_blocks = 0;
};

/// The capacities of a voxelization's buffers.
struct VoxelizeCapacities
{
    std::uint64_t bricks = 0;        // entries of the brick table, a power of two
    std::uint64_t big_triangles = 0; // bands of big triangles, for each material class
    std::uint64_t row_blocks = 0;    // for each material class

    /// The most entries that the 32-bit numbers of the brick table allow.
    static constexpr std::uint64_t kBricksMax = 1ULL << 31;

    /// A guess from the scene's surface area and the grid; it suffices in most cases.
    static VoxelizeCapacities estimate(const GpuScene& scene, const Grid& grid, RowShape shape);

    bool operator==(const VoxelizeCapacities&) const = default;
};

/// The buffers that a voxelization writes. In the end the brick table holds the leaves of the octree; octree
/// construction adds the inner nodes to it.
struct VoxelizeBuffers
{
    /// The triangles of one material class that are rasterized by rows.
    struct RowWork
    {
        vk::BufferOf<gpu::BigTriangle> big_triangles; // [capacities.big_triangles]
        vk::BufferOf<gpu::RowBlock> row_blocks;       // [capacities.row_blocks]
        vk::BufferOf<gpu::RasterCounters> counters;   // [1]
    };

    /// shape: of the row blocks that all walks with these buffers list and use; sum_form: of their sums. By default,
    /// what suits the device, with sums of all voxels.
    VoxelizeBuffers(vk::Device& device, const VoxelizeCapacities& capacities, const GpuScene& scene,
                    std::optional<RowShape> shape = std::nullopt, std::optional<SumForm> sum_form = std::nullopt);

    /// The bytes of the brick table.
    static std::uint64_t brickBytes(std::uint64_t capacity, bool mixed);

    [[nodiscard]] std::uint64_t brickCapacity() const { return sum_form.mixed ? bricks.count() / 2 : bricks.count(); }

    RowWork& rowsOf(MaterialClass material_class) { return rows[static_cast<std::size_t>(material_class)]; }

    vk::BufferOf<gpu::BrickEntry> bricks;       // [capacities.bricks], and as many MixedVoxels with sum_form.mixed
    vk::BufferOf<gpu::BrickCounters> counters;  // [1]
    std::array<RowWork, gpu::kClassCount> rows; // of each MaterialClass; empty for those that the scene does not have
    RowShape shape;
    SumForm sum_form;
};

/// The buffers for averaging attributes: sums over the fragments of each voxel, and the numbering of emissive voxels.
struct AttributeBuffers
{
    /// sum_count: of all voxels, or of mixed ones.
    AttributeBuffers(vk::Device& device, std::uint32_t voxel_count, std::uint32_t sum_count, bool emission);

    vk::BufferOf<gpu::VoxelSums> sums;             // [sum_count]
    vk::BufferOf<gpu::uint> max_fragments;         // [1] most fragments of a voxel if too many for sum_shift, else 0
    vk::BufferOf<gpu::uint> partials;              // of the scan over emission_words
    vk::BufferOf<gpu::uint> emissive_count;        // [1]
    vk::BufferOf<gpu::EmissionSums> emission_sums; // [emissive voxels], allocated when their number is known
    std::uint32_t sum_shift = 0; // value bits dropped, so that sums of max_fragments >> sum_shift fragments fit
};

/// The buffers to which the second and third walk over the triangles add the attributes of fragments.
struct AttributeSums
{
    const vk::BufferOf<gpu::Node>& leaves; // of the octree, or of a layer
    vk::BufferOf<gpu::VoxelSums>& sums;
    vk::BufferOf<gpu::uvec2>& emission_words; // empty unless something emits
    vk::BufferOf<gpu::EmissionSums>& emission_sums;
    std::uint32_t sum_shift = 0;
    vk::BufferOf<gpu::Attribute>* attributes = nullptr; // of voxels that have no sums, with SumForm::mixed
};

/// What a walk over the triangles does with a fragment.
enum class RasterMode : std::uint32_t
{
    Coverage = gpu::kModeCoverage,     // sets the voxel's bit
    Attributes = gpu::kModeAttributes, // adds its colour and normal to the voxel's sums
    Emission = gpu::kModeEmission      // adds its emission to the emissive voxel's sums
};

/// What is voxelized, and into which buffers.
struct VoxelizeJob
{
    PosedGpuScene scene;
    GridTile tile;
    Coverage coverage;
    VoxelizeBuffers& buffers;
};

/// A walk over all triangles of a scene, and what it does with the voxels that they cover.
struct RasterWalk
{
    VoxelizeJob job;
    RasterMode mode = RasterMode::Coverage;
    const AttributeSums* sums = nullptr; // null in coverage mode
};

/// Records the passes over the chunks of a material class that group_count workgroups take, from first_group on: at
/// most one over whole chunks and one over single triangles (TriangleChunks).
///
/// In coverage mode it sets the bits of the voxels that small triangles cover, and lists big triangles. The buffers
/// must have been cleared.
///
/// In the other modes it adds the attributes of the fragments of small triangles: RasterMode::Attributes adds colours
/// and normals to sums->sums and sets the bits of emissive voxels in sums->emission_words; RasterMode::Emission adds
/// emission to sums->emission_sums, at the indices that emission_words tells. The brick table must hold the first voxel
/// of each leaf or, with wide keys, the leaf's index in sums->leaves.
void walkTriangles(vk::FrameGraph& graph, const RasterWalk& walk, MaterialClass material_class,
                   std::uint64_t first_group, std::uint64_t group_count);

/// Records the pass that lists the rows of a material class' big triangles; in coverage mode only, as later modes find
/// them listed. To be recorded after all its chunks.
void listRows(vk::FrameGraph& graph, const RasterWalk& walk, MaterialClass material_class);

/// Records the pass that does for these rows what walkTriangles() does for small triangles.
void walkRows(vk::FrameGraph& graph, const RasterWalk& walk, MaterialClass material_class);

/// Records the passes that clear all buffers, before a walk in coverage mode.
void clearCoverage(vk::FrameGraph& graph, VoxelizeBuffers& buffers);

/// Records the passes of coverage: they clear the buffers, then set the bit of every covered voxel in the brick table.
/// What does not fit is counted, never written. For a tile of the grid, the voxels are those of the whole grid that lie
/// in it. Cost: triangles plus covered voxels, and the capacity of the table once, for clearing it.
void voxelizeCoverage(vk::FrameGraph& graph, const VoxelizeJob& job);

/// Records the passes that average colour and normal of each voxel's fragments into octree.voxel_attributes, and
/// mark emissive voxels in octree.emission_words. The brick table must hold the first voxel of each leaf (numberNodes).
/// leaves: [leaves first] work items of octree construction. With sums of mixed voxels alone, nothing may emit. Cost:
/// triangles plus fragments plus voxels.
void voxelizeAttributes(vk::FrameGraph& graph, const VoxelizeJob& job, const vk::BufferOf<gpu::WorkItem>& leaves,
                        AttributeBuffers& attributes, DeviceTree& octree);

/// Records the pass that writes the attribute of each voxel, the mean of its sums.
void resolveVoxels(vk::FrameGraph& graph, const GpuScene& scene, AttributeBuffers& attributes, DeviceTree& octree);

/// Records the passes that average emission into octree.emission. Runs after voxelizeAttributes, when the emissive
/// voxels have been counted and emission_sums and octree.emission are allocated. Cost: as voxelizeAttributes.
void voxelizeEmission(vk::FrameGraph& graph, const VoxelizeJob& job, AttributeBuffers& attributes, DeviceTree& octree);

} // namespace zvo
