// SPDX-License-Identifier: MIT
#pragma once

#include "core/svdag/svdag_classes.h"
#include "core/tree/svdag.h"
#include "vk/readback.h"
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
    Svdag dag;
    std::vector<vk::PassTime> passes;            // of the runs that succeeded
    std::vector<std::uint32_t> candidate_counts; // nodes that were compressed, by level, the root first
    std::uint32_t retry_count = 0;               // runs that were thrown away because a table was too small

    /// GPU time of all passes.
    [[nodiscard]] double ms() const;
};

/// Makes a DAG in steps, each of them recorded into a frame and never waited for: used as OctreeBuilder. On the device,
/// from the leaves up (V. Kaempe, E. Sintorn, U. Assarsson, High Resolution Sparse Voxel DAGs, 2013; by hash tables in
/// place of sorting). Where a table turns out too small it grows, and the step comes again. Cost: nodes.
class SvdagBuilder
{
public:
    /// Of an octree, which needs its levels. Voxels keep their attributes; those of nodes, which may have some where
    /// voxels have none if options ask for ranks, are put in depth-first order. An octree without nodes gives a DAG
    /// without. Throws Error{Usage} for an octree without levels, Error{Memory}.
    SvdagBuilder(vk::Device& device, Octree octree, const CompressOptions& options);

    /// Of a DAG in which equal nodes stand several times, such as several DAGs below common nodes. Nodes of a level may
    /// stand in any order, which decides their order in the result, and their children be listed or direct. Attributes
    /// are already as they are to be: they only move over.
    SvdagBuilder(vk::Device& device, Svdag dag, const CompressOptions& options);
    SvdagBuilder(const SvdagBuilder&) = delete;
    SvdagBuilder& operator=(const SvdagBuilder&) = delete;

    [[nodiscard]] bool isDone() const { return m_step == Step::Done; }

    /// Records the next step. The device must be done with the one before, unless that never reached it: then this is
    /// the same one again. Throws Error{Memory} when the device's budget does not suffice, and what making a kernel
    /// throws; what was recorded may reach the device all the same, and the step can be recorded again.
    void record(vk::FrameGraph& graph);

    /// The device is done with the step that was recorded last; passes: its times, if they were taken. Throws
    /// Error{Memory} when the device's budget does not suffice, or for nodes and lists of about 2^29 words and more,
    /// and Error{Other} should the hashes of hundreds of different nodes be equal; then nothing comes of it.
    void stepDone(std::vector<vk::PassTime> passes = {});

    /// What came of it, once.
    [[nodiscard]] CompressResult take() { return std::move(m_result); }

private:
    enum class Step
    {
        Classify,
        Write,
        Order,
        Done
    };

    SvdagBuilder(vk::Device& device, Svdag source, const CompressOptions& options, bool of_octree);
    void classify(vk::FrameGraph& graph);
    bool learnClasses();
    void write(vk::FrameGraph& graph);
    void endNodes();
    void order(vk::FrameGraph& graph);
    void finish();

    vk::Device& m_device;
    CompressOptions m_options;
    bool m_of_octree;
    Svdag m_source; // an octree is one without lists
    Candidates m_candidates;
    bool m_has_ranks;
    CompressResult m_result;
    Step m_step = Step::Classify;
    std::vector<std::uint64_t> m_slot_counts;
    std::optional<ClassBuffers> m_classes;
    vk::BufferOf<gpu::BeforeChild> m_below;
    vk::Readback m_readback;
    std::uint64_t m_sizes_place = 0;
};

} // namespace zvo
