// SPDX-License-Identifier: MIT
#pragma once

#include "core/base/step_job.h"
#include "core/svdag/svdag_classes.h"
#include "core/tree/device_tree.h"
#include "vk/timer.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace zvo
{

/// How an octree is compressed.
struct CompressOptions
{
    std::uint64_t table_slots = 0; // of each level's table of classes at first; 0: as many as are likely to suffice
    bool ranks = false;            // before and voxels_before_leaf even without attributes
    // For tests: entries of a word of lists, at most (0: as many as fit), and bits of inner nodes' hashes: with fewer,
    // different nodes collide.
    std::uint32_t entries_per_word = 0;
    std::uint32_t hash_mask = UINT32_MAX;
};

/// A DAG and how it came about.
struct CompressResult
{
    DeviceTree dag;
    std::vector<vk::PassTime> passes;            // of the runs that succeeded
    std::vector<std::uint32_t> candidate_counts; // nodes that were compressed, by level, the root first
    std::uint32_t retry_count = 0;               // runs that were thrown away because a table was too small

    /// GPU time of all passes.
    [[nodiscard]] double ms() const;
};

/// Makes a DAG. On the device, from the leaves up (V. Kaempe, E. Sintorn, U. Assarsson, High Resolution Sparse Voxel
/// DAGs, 2013; by hash tables in place of sorting). Where a table turns out too small it grows, and the step comes
/// again: resume() throws Error{Memory} when the device's budget does not suffice, or for nodes and lists of about 2^29
/// words and more, and Error{Other} should the hashes of hundreds of different nodes be equal. Cost: nodes.
class SvdagBuilder final : public BuildJob<SvdagBuilder, CompressResult>
{
public:
    /// Of an octree: voxels keep their attributes and sums; attributes of nodes, which may have some where voxels have
    /// none if options ask for ranks, are put in depth-first order. Of a DAG in which equal nodes stand several times,
    /// such as several DAGs below common nodes: nodes of a level may stand in any order, which decides their order in
    /// the result, and their children be listed or direct; attributes only move over. A tree without nodes gives a DAG
    /// without. Throws Error{Usage} for a tree without levels, Error{Memory}.
    SvdagBuilder(vk::Device& device, DeviceTree source, const CompressOptions& options);

private:
    void classify(vk::FrameGraph& graph);
    void learnClasses();
    void write(vk::FrameGraph& graph);
    void endNodes();
    void order(vk::FrameGraph& graph);
    void end();

    vk::Device& m_device;
    CompressOptions m_options;
    DeviceTree m_source;
    Candidates m_candidates;
    bool m_has_ranks;
    std::vector<std::uint64_t> m_slot_counts;
    std::optional<ClassBuffers> m_classes;
    vk::BufferOf<gpu::BeforeChild> m_below;
    std::uint64_t m_sizes_offset = 0;
};

} // namespace zvo
