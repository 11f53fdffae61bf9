// SPDX-License-Identifier: MIT
#pragma once

#include "core/base/grid.h"
#include "core/base/new_version.h"
#include "core/tree/attribute_format.h"
#include "core/tree/list_packing.h"
#include "shared/octree.h"
#include "shared/svdag.h"
#include "vk/buffer.h"
#include "vk/frame_graph.h"
#include "voxelize/voxelize.h"
#include "zvo/types.h"

#include <cstdint>
#include <vector>

namespace zvo
{

/// What a DAG has besides nodes; shaders/shared/svdag.h documents the layout.
struct ChildLists
{
    std::uint32_t octree_node_count = 0; // nodes of the octree that the DAG stands for
    std::uint64_t entry_count = 0;      // those of the full node of a filled DAG included, here and in the next but one
    std::uint32_t entries_per_word = 2; // a word has 64 bits; compress() packs as ListPacking::tightest
    std::uint64_t long_entry_count = 0; // entries of nodes above the parents of leaves
    vk::BufferOf<gpu::BeforeChild> before;      // [long_entry_count], or empty without attributes
    vk::BufferOf<gpu::uint> voxels_before_leaf; // [ceil((entry_count - long_entry_count) / 2)], likewise

    /// Bytes of the arrays beside the lists, from which the ranks of voxels are summed up.
    [[nodiscard]] std::uint64_t rankBytes() const { return before.bytes() + voxels_before_leaf.bytes(); }
};

/// The room behind a tree for the overlays of dynamic updates (shaders/update/update.h;
/// core/overlay/overlay_buffers.h).
struct OverlayRoom
{
    std::uint32_t static_root = 0; // number of the node behind the static nodes and lists; 0: there is no room

    /// For each node behind static_root, the rank of the static octree's node at the same position, or 0 where there is
    /// none. Only a DAG with attributes has these.
    vk::BufferOf<gpu::BeforeChild> ranks;

    [[nodiscard]] bool hasRanks() const { return ranks.count() != 0; }

    /// Bytes of the elements that ranks would have for the nodes up to static_root, if it had elements for all nodes.
    [[nodiscard]] std::uint64_t ranksSkipped() const
    {
        return (std::uint64_t{static_root} + 1) * sizeof(gpu::BeforeChild);
    }
};

/// The sums of which the attributes of voxels were made.
struct FragmentSums
{
    vk::BufferOf<gpu::VoxelSums> sums;             // [voxel_count], or empty
    vk::BufferOf<gpu::EmissionSums> emission_sums; // [emissive voxels], or empty
    std::uint32_t sum_shift = 0;                   // value bits that were dropped

    [[nodiscard]] std::uint64_t bytes() const { return sums.bytes() + emission_sums.bytes(); }
};

/// A sparse voxel octree in device memory, or the DAG that it was compressed to; either may have room for overlays
/// behind it. shaders/shared/octree.h and svdag.h document the layout.
struct DeviceTree
{
    /// The nodes of one level (level 0 is the root) stand together, in Morton order.
    struct Level
    {
        std::uint32_t first_node = 0;
        std::uint32_t node_count = 0;
    };

    std::uint64_t version = newVersion(); // of the contents: whoever changes these sets a new version
    TreeStructure structure = TreeStructure::Svo;
    Grid grid;
    std::uint32_t node_count = 0;     // without overlays
    std::uint32_t leaf_words = 0;     // of the nodes, those that are leaf words: all leaves of a tree of several levels
    std::uint32_t voxel_count = 0;    // likewise; those with attributes, if the tree is filled
    bool filled = false;              // has surface masks and full nodes (shaders/shared/octree.h)
    std::uint64_t interior_count = 0; // voxels of a filled tree that are inside and not on the surface
    std::vector<Level> levels; // grid.nodeLevels() of them; empty without voxels, or if nodes do not stand by levels

    /// As many elements as nodes, leaf words and lists take. With room for overlays: a slot for the root that is
    /// traced, the other static nodes and the lists, the static root, then overlays.
    vk::BufferOf<gpu::Node> nodes;
    vk::BufferOf<gpu::uvec2> leaf_groups; // [kFirstLeafGroup + ceil((2 * innerCount() + leaf_words) / kLeafGroup)]
                                          // of an octree with leaf words
    vk::BufferOf<gpu::Attribute> voxel_attributes; // [voxel_count] in Morton order, then those of overlays; or empty
    /// [octreeNodeCount()] averages of the attributes below each node, or empty. Those of a DAG stand depth first: a
    /// node before its children, children in Morton order. With room for overlays: that of the slot, those of the other
    /// nodes, that of the static root, then those of overlays.
    vk::BufferOf<gpu::Attribute> node_attributes;
    PackedAttributes packed; // attributes in another format, in place of both arrays above
    /// [ceil(voxel_count / 32)] x: bits of emissive voxels; y: index of the first one's emission
    vk::BufferOf<gpu::uvec2> emission_words;
    vk::BufferOf<gpu::uint> emission; // [emissive voxels] radiance / emission_scale as RGB9E5
    float emission_scale = 1.0F;
    FragmentSums sums; // filled if BuildOptions::keep_sums asked for it

    ChildLists lists;     // of a DAG
    OverlayRoom overlays; // where there is room

    [[nodiscard]] bool isDag() const { return structure == TreeStructure::Svdag; }
    [[nodiscard]] bool hasOverlays() const { return overlays.static_root != 0; }

    [[nodiscard]] AttributeFormat attributeFormat() const
    {
        return voxel_attributes.count() != 0 ? AttributeFormat::Bytes8 : packed.format;
    }
    [[nodiscard]] bool hasAttributes() const { return attributeFormat() != AttributeFormat::None; }
    [[nodiscard]] bool hasNodeAttributes() const { return node_attributes.count() + packed.nodes.count() != 0; }

    /// Voxels, those that are inside included.
    [[nodiscard]] std::uint64_t occupiedCount() const { return voxel_count + interior_count; }

    /// Nodes that are no leaf words.
    [[nodiscard]] std::uint32_t innerCount() const { return node_count - leaf_words; }

    /// Words of 64 bits of nodes, leaf words, full nodes and surface masks, which the lists stand behind.
    [[nodiscard]] std::uint64_t nodeWords() const
    {
        if (filled && isDag())
        {
            return 2 * (std::uint64_t{node_count} + 1); // leaves have their surface masks; the full node is the last
        }
        const std::uint64_t words = std::uint64_t{2} * node_count - leaf_words;
        const std::uint64_t full_nodes = (words + 1) / 2 + gpu::kFullNodeCount;
        return filled ? 2 * full_nodes + leaf_words : words; // the surface masks end the pool
    }

    /// What, added to the number of a leaf, gives its reference (shaders/shared/octree.h). Not of a filled DAG, in
    /// which a leaf's word has twice the number of the leaf.
    [[nodiscard]] std::uint32_t leafReference() const { return leaf_words != 0 ? gpu::kLeafWords + innerCount() : 0; }

    /// How the lists of a DAG are packed.
    [[nodiscard]] ListPacking packing() const { return {nodeWords(), lists.entry_count, lists.entries_per_word}; }

    /// Number of nodes of the octree; for a DAG, of the octree that it stands for.
    [[nodiscard]] std::uint32_t octreeNodeCount() const { return isDag() ? lists.octree_node_count : node_count; }

    /// The value that kernels take: entries of a word of lists, with a flag if the DAG is filled, or 0 for an octree,
    /// which has no lists.
    [[nodiscard]] std::uint32_t entriesPerWord() const
    {
        return isDag() ? lists.entries_per_word | (filled ? gpu::kFilledDag : 0) : 0;
    }

    /// Entries of the full node of a filled DAG, which are the first ones, and long.
    [[nodiscard]] std::uint32_t fullEntries() const { return filled && isDag() ? gpu::kFullEntries : 0; }

    /// The number that, added to the number of the static root or of a node behind it, gives the index of the node's
    /// attributes; modulo 2^32.
    [[nodiscard]] std::uint32_t attributeOffset() const { return octreeNodeCount() - overlays.static_root; }

    /// Bytes of nodes, leaf groups and lists, without overlays.
    [[nodiscard]] std::uint64_t geometryBytes() const
    {
        return nodeWords() * sizeof(std::uint64_t) + leaf_groups.bytes() + (isDag() ? packing().bytes() : 0);
    }

    /// Bytes of all attributes and emission, overlays included; without ChildLists::rankBytes().
    [[nodiscard]] std::uint64_t attributeBytes() const
    {
        return voxel_attributes.bytes() + node_attributes.bytes() + packed.bytes() + emission_words.bytes() +
               emission.bytes();
    }
};

/// The arrays of a DAG with attributes from which ranks are summed up; of an octree, the leaf groups. Declares that
/// pass reads them.
gpu::RankSource rankSource(vk::AnyPass& pass, const DeviceTree& tree);

/// The same, without declaring any access.
gpu::RankSource rankSource(const DeviceTree& tree);

/// Declares that pass reads those arrays, and sets them in the parameters of a kernel that takes the pool apart from
/// the others.
template <typename Params> void readRankSource(vk::AnyPass& pass, const DeviceTree& tree, Params& params)
{
    const gpu::RankSource source = rankSource(pass, tree);
    params.before = source.before;
    params.voxels_before_leaf = source.voxels_before_leaf;
    params.first_short_entry = source.first_short_entry;
}

} // namespace zvo
