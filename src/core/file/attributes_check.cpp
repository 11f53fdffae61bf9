// SPDX-License-Identifier: MIT
#include "core/file/attributes_check.h"

#include "core/base/divide_up.h"
#include "core/file/tree_fault.h"

#include <bit>
#include <cmath>
#include <span>

namespace zvo
{

namespace
{

constexpr std::uint32_t kFlagShift = 24; // of Attribute::color
constexpr std::uint32_t kByteMask = 0xffU;
constexpr std::uint32_t kBelowMinusOne = 0x80U; // as a snorm8

// Normals have no snorm8 below -1, or are missing.
void requireWords4(std::span<const gpu::uint> words, const char* whose)
{
    for (std::size_t i = 0; i < words.size(); ++i)
    {
        const std::uint32_t normal = words[i] >> gpu::kNormalShift4;
        const bool is_outside = (normal & kByteMask) == kBelowMinusOne || normal >> 8 == kBelowMinusOne;
        requireSound(!is_outside || normal == gpu::kNoNormal4,
                     "attribute {} of the {} has a normal outside of the unit square", i, whose);
    }
}

// Scales end within the unit square.
void requireBlocks(std::span<const gpu::uint> words)
{
    for (std::size_t block = 0; block < words.size() / gpu::kBlockWords; ++block)
    {
        const std::uint32_t ends = words[block * gpu::kBlockWords + gpu::kBlockNormals];
        for (std::uint32_t i = 0; i < 4; ++i)
        {
            requireSound((ends >> (gpu::kEndBits * i) & ((1U << gpu::kEndBits) - 1)) <= gpu::kEndMax,
                         "block {} of the voxels has a scale outside of the unit square", block);
        }
    }
}

void requirePacked(const TreeData& tree)
{
    const PackedWords& packed = tree.packed;
    const bool is_packed = packed.format == AttributeFormat::Bytes4 || packed.format == AttributeFormat::Blocks;
    requireSound(is_packed || packed.format == AttributeFormat::None, "the attributes have an unknown format");
    requireSound(!is_packed || (tree.voxel_attributes.empty() && tree.node_attributes.empty()),
                 "there are attributes in two formats");
    const std::uint64_t voxel_words = is_packed ? packedWords(packed.format, tree.voxel_count) : 0;
    const std::uint64_t node_words = is_packed ? packedWords(nodeFormat(packed.format), tree.octree_node_count) : 0;
    requireSound(packed.voxels.size() == voxel_words && packed.nodes.size() == node_words,
                 "packed attributes of voxels and nodes take {} and {} words, where they must take {} and {}",
                 packed.voxels.size(), packed.nodes.size(), voxel_words, node_words);
    packed.format == AttributeFormat::Blocks ? requireBlocks(packed.voxels) : requireWords4(packed.voxels, "voxels");
    requireWords4(packed.nodes, "nodes");
}

void requirePlain(const TreeData& tree)
{
    const std::size_t voxels = tree.voxel_attributes.empty() ? 0 : tree.voxel_count;
    const std::size_t nodes = tree.voxel_attributes.empty() ? 0 : tree.octree_node_count;
    requireSound(tree.voxel_attributes.size() == voxels && tree.node_attributes.size() == nodes,
                 "there are attributes of {} voxels and {} nodes, where there must be {} and {}",
                 tree.voxel_attributes.size(), tree.node_attributes.size(), voxels, nodes);
    for (const auto* attributes : {&tree.voxel_attributes, &tree.node_attributes})
    {
        for (std::size_t i = 0; i < attributes->size(); ++i)
        {
            const std::uint32_t flags = (*attributes)[i].color >> kFlagShift;
            requireSound((flags & ~gpu::kAttributeEmissive) == 0, "attribute {} of the {} has unknown flags {:#x}", i,
                         attributes == &tree.voxel_attributes ? "voxels" : "nodes", flags);
        }
    }
}

void requireEmission(const TreeData& tree)
{
    requireSound(std::isfinite(tree.emission_scale) && tree.emission_scale > 0.0F,
                 "the scale of emission is not a finite number above 0");
    requireSound(tree.emission_words.empty() || tree.hasAttributes(), "there is emission without attributes");
    const std::uint64_t word_count =
        tree.emission_words.empty() ? 0 : divideUp(tree.voxel_count, gpu::kVoxelsPerEmissionWord);
    requireSound(tree.emission_words.size() == word_count,
                 "there are {} words that tell what emits, where there must be {}", tree.emission_words.size(),
                 word_count);
    for (std::size_t i = 0; i < tree.voxel_attributes.size(); ++i)
    {
        const bool flagged = (tree.voxel_attributes[i].color >> kFlagShift & gpu::kAttributeEmissive) != 0;
        const bool listed =
            !tree.emission_words.empty() &&
            (tree.emission_words[i / gpu::kVoxelsPerEmissionWord].x >> (i % gpu::kVoxelsPerEmissionWord) & 1U) != 0;
        requireSound(flagged == listed, "voxel {} emits by its {} alone", i,
                     flagged ? "attribute" : "bit in the emission table");
    }
    std::uint64_t rank = 0;
    for (std::size_t i = 0; i < tree.emission_words.size(); ++i)
    {
        requireSound(tree.emission_words[i].y == rank,
                     "word {} of the emission table counts {} voxels before it, where there are {}", i,
                     tree.emission_words[i].y, rank);
        rank += static_cast<std::uint32_t>(std::popcount(tree.emission_words[i].x));
    }
    const std::uint32_t used_bits = tree.voxel_count % gpu::kVoxelsPerEmissionWord;
    requireSound(tree.emission_words.empty() || used_bits == 0 || tree.emission_words.back().x >> used_bits == 0,
                 "the emission table has bits behind the last voxel");
    requireSound(rank == tree.emission.size(), "{} voxels emit, but there are {} emissions", rank,
                 tree.emission.size());
}

} // namespace

void requireAttributes(const TreeData& tree)
{
    requirePlain(tree);
    requirePacked(tree);
    requireEmission(tree);
}

} // namespace zvo
