// SPDX-License-Identifier: MIT
#pragma once

#include "core/tree/device_tree.h"
#include "vk/uploader.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace zvo
{

/// The name of a structure in options and messages: "svo" or "svdag".
const char* structureName(TreeStructure structure);

/// The colour in which voxels without attributes are shown: sRGB red | green << 8 | blue << 16.
inline constexpr std::uint32_t kPlainColor = 203 * 0x10101U;

/// A whole octree or DAG in the host's memory. The arrays are those of a DeviceTree, except that all leaves are nodes,
/// and that the nodes and the lists of a DAG's pool are separate (core/tree/leaf_words.h). In a filled tree, leaves
/// have the voxels of the surface, and a full node has an empty mask: of a DAG it has no list either, and the one
/// behind the leaves is not there.
struct TreeData
{
    TreeStructure structure = TreeStructure::Svo;
    Grid grid;
    std::uint32_t voxel_count = 0;
    std::uint32_t octree_node_count = 0; // nodes of the octree; for an octree, nodes.size()
    std::uint64_t long_entry_count = 0;  // entries of lists above the parents of leaves

    std::vector<DeviceTree::Level> levels;     // grid.nodeLevels() of them, or none without voxels
    std::vector<gpu::Node> nodes;              // the root first
    std::vector<std::uint64_t> occupied;       // [leaves] of a filled tree: the masks of surface and inside; else empty
    std::uint64_t interior_count = 0;          // voxels of a filled tree that are inside and not on the surface
    std::vector<gpu::uint> lists;              // [entries] node numbers; only in a DAG
    std::vector<gpu::BeforeChild> before;      // [long_entry_count] only in a DAG with attributes
    std::vector<gpu::uint> voxels_before_leaf; // [ceil((entries - long_entry_count) / 2)] likewise
    std::vector<gpu::Attribute> voxel_attributes; // [voxel_count] in Morton order, or empty
    std::vector<gpu::Attribute> node_attributes;  // [octree_node_count] in the structure's order, or empty
    PackedWords packed;                           // attributes in another format, in place of both arrays above
    std::vector<gpu::uvec2> emission_words;       // [ceil(voxel_count / 32)], or empty where nothing emits
    std::vector<gpu::uint> emission;              // [emissive voxels]
    float emission_scale = 1.0F;

    [[nodiscard]] AttributeFormat attributeFormat() const
    {
        return voxel_attributes.empty() ? packed.format : AttributeFormat::Bytes8;
    }
    [[nodiscard]] bool hasAttributes() const { return attributeFormat() != AttributeFormat::None; }
    [[nodiscard]] bool isFilled() const { return !occupied.empty(); }

    /// Voxels, those that are inside included.
    [[nodiscard]] std::uint64_t occupiedCount() const { return voxel_count + interior_count; }

    /// The attribute of a voxel. For a tree with attributes that checkTree accepts. Only the format Bytes8 has flags.
    [[nodiscard]] gpu::Attribute voxelAttribute(std::uint64_t voxel) const
    {
        return voxel_attributes.empty() ? unpackAttribute(packed.format, packed.voxels, voxel)
                                        : voxel_attributes[voxel];
    }

    /// The attribute of the voxels of a filled tree that are inside: the mean colour of the surface.
    [[nodiscard]] gpu::Attribute interiorAttribute() const
    {
        const std::uint32_t color =
            (node_attributes.empty() ? unpackAttribute(nodeFormat(packed.format), packed.nodes, 0)
                                     : node_attributes.front())
                .color;
        return {color & 0xffffffU, gpu::kNoNormal};
    }

    /// Bytes in device memory: of nodes, leaf groups and lists; of the arrays beside the lists from which ranks are
    /// summed up; of all attributes and emission, including those arrays.
    [[nodiscard]] std::uint64_t geometryBytes() const;
    [[nodiscard]] std::uint64_t rankBytes() const;
    [[nodiscard]] std::uint64_t attributeBytes() const;

    /// The rank-th child of an inner node. For a tree that checkTree accepts.
    [[nodiscard]] std::uint32_t child(const gpu::Node& node, std::uint32_t rank) const
    {
        return structure == TreeStructure::Svo
                   ? node.base_lo + rank
                   : lists[(node.base_lo & ~gpu::kChildList) - packing().firstEntry() + rank];
    }

    /// How the lists are packed in files, where all leaves are numbered as nodes.
    [[nodiscard]] ListPacking packing() const
    {
        return ListPacking::tightest(nodes.size(), ListPacking::kWordsOfNode * nodes.size(), lists.size());
    }
};

/// The occupied cells of a node, a bit for each.
inline std::uint64_t cellMask(const gpu::Node& node)
{
    return node.mask_lo | std::uint64_t{node.mask_hi} << 32;
}

/// Copies a tree that checkTree accepts to the device. Throws Error{Memory} when the device's budget does not
/// suffice.
DeviceTree uploadTree(vk::Uploader& device, const TreeData& tree);

/// Calls `what` with the Morton code of every voxel, in ascending order: the i-th call is for voxel i. Those of a
/// filled tree are the ones on the surface.
void forEachVoxel(const TreeData& tree, const std::function<void(std::uint64_t code)>& what);

/// Calls `what` with the Morton codes of all voxels in ascending order, and whether they are on the surface.
void forEachCell(const TreeData& tree, const std::function<void(std::uint64_t code, bool on_surface)>& what);

/// The voxels of a filled tree that are inside and not on the surface; 0 for other trees. For a tree that checkTree
/// accepts. Cost: nodes and entries of lists.
std::uint64_t interiorCount(const TreeData& tree);

/// The smallest box of cells that encloses all voxels: its lowest cell, and the cell one past the highest along each
/// axis.
struct CellBox
{
    glm::uvec3 min{UINT32_MAX};
    glm::uvec3 max{0U};
};
std::optional<CellBox> voxelBox(const TreeData& tree);

} // namespace zvo
