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

/// Options of a compression.
struct CompressOptions
{
    std::uint64_t table_slots = 0; // first size of each level's table of classes; 0: an estimate
    bool ranks = false;            // makes ChildLists::before and voxels_before_leaf even without attributes
    // For tests: the most entries that share a word of lists (0: as many as fit), and the bits that are kept of inner
    // nodes' hashes (with fewer bits, different nodes collide).
    std::uint32_t entries_per_word = 0;
    std::uint32_t hash_mask = UINT32_MAX;
};

/// A DAG and how it came about.
struct CompressResult
{
    DeviceTree dag;
    std::vector<vk::PassTime> passes;            // of the runs that succeeded
    std::vector<std::uint32_t> candidate_counts; // number of nodes before compression, by level, the root's first
    std::uint32_t retry_count = 0;               // runs that were thrown away because a table was too small

    /// GPU time of all passes.
    [[nodiscard]] double ms() const;
};

/// Makes a DAG on the device, from the leaves up (V. Kaempe, E. Sintorn, U. Assarsson, High Resolution Sparse Voxel
/// DAGs, 2013; by hash tables in place of sorting). When a table is too small it grows, and the step is repeated.
/// resume() throws Error{Memory} when the device's budget does not suffice, or for nodes and lists of about 2^29 words
/// and more, and Error{Other} if hundreds of different nodes have equal hashes. Cost: nodes.
class SvdagBuilder final : public BuildJob<SvdagBuilder, CompressResult>
{
public:
    /// source may be one of two things:
    ///
    /// An octree. Voxels keep their attributes and sums. The attributes of nodes are put in depth-first order; if
    /// options ask for ranks, nodes may have attributes although voxels have none.
    ///
    /// A DAG in which equal nodes occur several times, such as several DAGs below common nodes. The nodes of a level
    /// may stand in any order, which decides their order in the result. Children may be listed or stand together.
    /// Attributes are kept as they are.
    ///
    /// A tree without nodes gives a DAG without nodes. Throws Error{Usage} for a tree without levels, and
    /// Error{Memory}.
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
