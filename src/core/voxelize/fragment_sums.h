// SPDX-License-Identifier: MIT
// The attributes of voxels: means over the fragments in each.
#pragma once

#include "core/tree/device_tree.h"
#include "core/voxelize/voxelize.h"
#include "vk/frame_graph.h"

#include <cstdint>

namespace zvo
{

/// How fragments are added to the sums of their voxels. The sums do not depend on it.
struct SumForm
{
    bool int64 = false; // two words by one atomic; takes shaderBufferInt64Atomics
    bool mixed = false; // sums of mixed voxels alone (gpu::MixedVoxels), where nothing else needs them

    /// What suits a device.
    static SumForm on(const vk::Device& device);

    bool operator==(const SumForm&) const = default;
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

/// What fragments are added to.
struct FragmentTarget
{
    const vk::BufferOf<gpu::Node>& nodes; // of bricks and their leaves
    std::uint32_t first_leaf = 0;         // of nodes; 0: the octree is a leaf
    vk::BufferOf<gpu::VoxelSums>& sums;
    vk::BufferOf<gpu::uvec2>& emission_words; // empty unless something emits
    vk::BufferOf<gpu::EmissionSums>& emission_sums;
    std::uint32_t sum_shift = 0;
    bool int64 = false;                                       // two words by one atomic
    const vk::BufferOf<gpu::MixedVoxels>* mixed = nullptr;    // of the leaves: they alone have sums
    vk::BufferOf<gpu::Attribute>* voxel_attributes = nullptr; // [voxels] with mixed, of those that are not mixed
};

/// Records the passes that write beside each word how many bits are set in the words before it. x: the bits; y: the
/// number, which is set. partials: [ceil(words / kScanBlock)]; total: [1] gets the bits of all words. Cost: words.
void rankBits(vk::FrameGraph& graph, vk::BufferOf<gpu::uvec2>& words, vk::BufferOf<gpu::uint>& partials,
              vk::BufferOf<gpu::uint>& total);

/// Records the pass over items [first, first + count), of which there may be fewer, whose coverage has been recorded
/// and whose bricks' entries have the numbers of their nodes. RasterMode::Attributes adds colours and normals to the
/// sums of voxels, and sets the bits of emissive ones in emission_words; RasterMode::Emission adds emission to
/// emission_sums, at the indices that emission_words tells. Cost: items plus fragments.
void addFragments(vk::FrameGraph& graph, const VoxelizeJob& job, RasterMode mode, const FragmentTarget& sums,
                  std::uint64_t first, std::uint64_t count);

/// Records the passes that average colour and normal of each voxel's fragments into octree.voxel_attributes, and mark
/// emissive voxels in octree.emission_words. mixed: [leaves], empty unless they alone have sums; then nothing may emit.
/// Cost: items plus fragments plus voxels.
void voxelizeAttributes(vk::FrameGraph& graph, const VoxelizeJob& job, std::uint32_t item_count, bool int64,
                        const vk::BufferOf<gpu::MixedVoxels>& mixed, AttributeBuffers& attributes, DeviceTree& octree);

/// Records the passes that average emission into octree.emission. Runs after voxelizeAttributes, when the emissive
/// voxels have been counted and emission_sums and octree.emission are allocated. Cost: as voxelizeAttributes.
void voxelizeEmission(vk::FrameGraph& graph, const VoxelizeJob& job, std::uint32_t item_count,
                      AttributeBuffers& attributes, DeviceTree& octree);

} // namespace zvo
