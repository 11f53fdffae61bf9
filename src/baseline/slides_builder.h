// SPDX-License-Identifier: MIT
#pragma once

#include "baseline/radix_sort.h"
#include "baseline/slides_tree.h"
#include "core/base/step_job.h"
#include "core/deform/dynamic_object.h"
#include "zvo/types.h"

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace zvo::baseline
{

/// Options of SlidesBuilder.
struct SlidesOptions
{
    Coverage coverage = Coverage::Thin;
    bool attributes = true;
    bool dag = false;
    SlidesNodes nodes = SlidesNodes::WithSums;
};

/// The parts of a build, in their order.
enum class SlidesStage : std::uint8_t
{
    Voxelize, // count and write fragments
    Sort,     // fragments by Morton code
    Unique,   // fragments to voxels, and the means of their attributes
    Build     // voxels to nodes
};

/// A tree and how it came about.
struct SlidesResult
{
    SlidesTree tree;
    std::map<std::string, std::uint64_t> dropped; // triangles left out, by reason, as BuildResult::dropped
    std::vector<vk::PassTime> passes;             // all of them, in order
    std::uint32_t retry_count = 0;                // always 0
    std::uint64_t fragment_count = 0;
    std::uint32_t capped_voxels = 0; // whose attributes are means of their first kSlidesVoxelFragments fragments

    /// GPU time of the passes of a stage, those of its scans, fills and copies included.
    [[nodiscard]] double stageMs(SlidesStage stage) const;

    /// GPU time of all passes.
    [[nodiscard]] double ms() const;
};

/// Makes an octree, or a DAG, of a scene by the algorithms of ushiostarfish's slides on ray tracing massive voxels
/// (2023; code: MassiveVoxelRayTracing), to be compared with zvo's. Five parts:
///
/// 1. Each triangle is walked twice by a thread, as shaders/baseline/slides_triangle.glsl has it: to count the voxels
///    that it covers, and to write their Morton codes with the fragments' attributes. The counts are scanned.
/// 2. The codes are sorted (radixSort()).
/// 3. Equal codes become one voxel, whose attributes are the means of its fragments'.
/// 4. Level by level from the voxels up, the first cell of each parent collects the others. For a DAG, equal nodes of a
///    level become one before the next level is made.
/// 5. Nodes have eight pointers, and prefix sums of their voxels, by which voxels of a DAG have attributes of their
/// own.
///
/// What differs from the original, and why:
/// - Coverage is exact: the conservative set is zvo's, bit for bit, and the thin one as well. The original decides in
///   floating point. Its 6-separating set takes both layers where the plane meets a column's centre between two, and
///   takes all columns' voxels without a test of the other two projections where a triangle's box has one layer; the
///   thin set takes the upper layer, and always tests.
/// - A thread walks a piece of a triangle: all of it if its box has up to 512 columns, which is the usual case. Loops
/// of
///   65,536 iterations end without a word on lavapipe, and one thread for a whole wall is slow everywhere.
/// - Places of fragments come from a scan, not from an atomic counter; so they do not depend on the order of threads.
///   Scans are reduce-then-scan: the original's blocks wait for the block before, which Vulkan does not promise to end.
/// - Fragments carry zvo's attributes, colour and normal of 16 bits a component in 12 bytes, so that means equal zvo's
///   bit for bit; the original has 8 bits a component of colour and emission, and no textures. Emission is left out. A
///   thread averages a voxel, where in the original the thread of its first fragment does.
/// - Nodes are numbered by level in Morton order, not by an atomic counter. Of equal nodes the first one stays. All
///   nodes of a level are written before equal ones are looked for, so that the table needs no locks
///   (shaders/baseline/slides_class_insert.comp); the original writes a node while its slot is locked. That is one pass
///   more a level, and room for the nodes of the largest level. No nodes of different levels are equal, as their
///   children are not.
/// - The original's last step, which copies the masks of children into the upper 8 bits of their pointers, is left out,
///   and with it the limit of 2^24 nodes.
///
/// The result is the same bytes on every device. Between steps the host reads counts and allocates what is needed.
/// resume() throws Error{Memory} for 2^31 fragments and more, and where the device's budget does not suffice, and
/// Error{Other} if many different nodes have neighbouring hashes. Cost: triangles, fragments times the digits of their
/// codes, nodes; 24 bytes a fragment, and 12 more with attributes.
class SlidesBuilder final : public BuildJob<SlidesBuilder, SlidesResult>
{
public:
    /// scene must outlive the builder. Throws Error{Usage} for a depth outside 1 to gpu::kSlidesDepthMax, and for
    /// attributes if the scene was uploaded without them.
    SlidesBuilder(vk::Device& device, const PosedGpuScene& scene, const Grid& grid, const SlidesOptions& options);

private:
    struct ScannedCounts
    {
        vk::BufferOf<gpu::uint> values;
        vk::BufferOf<gpu::uint> partials;
    };
    // A level of cells: voxels, or nodes.
    struct Cells
    {
        vk::BufferOf<uint64_t> codes;
        vk::BufferOf<gpu::uint> nodes;
        vk::BufferOf<gpu::uint> voxels;
    };
    // The merging of equal nodes.
    struct Classes
    {
        vk::BufferOf<gpu::uint> candidates;
        vk::BufferOf<gpu::uint> table;
        vk::BufferOf<gpu::uint> slots;
        vk::BufferOf<gpu::uint> numbers;
    };

    void countPieces(vk::FrameGraph& graph);
    void learnPieces();
    void countFragments(vk::FrameGraph& graph);
    void learnFragments();
    void makeVoxels(vk::FrameGraph& graph);
    void learnVoxels();
    void makeNodes(vk::FrameGraph& graph);
    void learnNodes();
    void trim(vk::FrameGraph& graph);
    void end();

    void walkTriangles(vk::FrameGraph& graph, bool list);
    void walkPieces(vk::FrameGraph& graph, bool emit);
    void makeUnique(vk::FrameGraph& graph);
    void average(vk::FrameGraph& graph);
    void makeLevel(vk::FrameGraph& graph, std::uint32_t level);
    void mergeLevel(vk::FrameGraph& graph, std::uint32_t level, Cells& parents);
    void readCounters(vk::FrameGraph& graph);
    [[nodiscard]] const gpu::SlidesCounters& counters() const;

    vk::Device& m_device;
    PosedGpuScene m_scene;
    SlidesOptions m_options;
    std::uint64_t m_triangle_slots = 0;
    vk::BufferOf<gpu::SlidesCounters> m_counters;
    ScannedCounts m_piece_counts;
    ScannedCounts m_fragment_counts;
    vk::BufferOf<gpu::SlidesPiece> m_pieces;
    vk::BufferOf<gpu::SlidesFragment> m_fragments;
    std::optional<RadixSortBuffers> m_sort;
    std::uint32_t m_sorted = 0; // half of m_sort
    vk::BufferOf<gpu::uint> m_unique_partials;
    vk::BufferOf<gpu::uint> m_firsts;
    std::array<Cells, 2> m_cells; // those of a level, and of the level above
    vk::BufferOf<gpu::uint> m_partials;
    Classes m_classes;
    vk::BufferOf<gpu::uint> m_trimmed;        // the nodes of a DAG
    std::vector<std::uint32_t> m_cell_counts; // of each level, voxels first
    std::uint64_t m_counters_offset = 0;
};

} // namespace zvo::baseline
