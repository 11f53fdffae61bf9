// SPDX-License-Identifier: MIT
#include "core/file/attributes_check.h"

#include "core/base/divide_up.h"

#include <bit>
#include <cmath>
#include <fmt/format.h>
#include <span>

namespace zvo
{

namespace
{

using Fault = std::optional<std::string>;

constexpr std::uint32_t kFlagShift = 24; // of Attribute::color
constexpr std::uint32_t kByteMask = 0xffU;
constexpr std::uint32_t kBelowMinusOne = 0x80U; // as a snorm8

// Normals have no snorm8 below -1, or are missing.
Fault checkWords4(std::span<const gpu::uint> words, const char* whose)
{
    for (std::size_t i = 0; i < words.size(); ++i)
    {
        const std::uint32_t normal = words[i] >> gpu::kNormalShift4;
        const bool is_outside = (normal & kByteMask) == kBelowMinusOne || normal >> 8 == kBelowMinusOne;
        if (is_outside && normal != gpu::kNoNormal4)
        {
            return fmt::format("attribute {} of the {} has a normal outside of the unit square", i, whose);
        }
    }
    return std::nullopt;
}

// Scales end within the unit square.
Fault checkBlocks(std::span<const gpu::uint> words)
{
    for (std::size_t block = 0; block < words.size() / gpu::kBlockWords; ++block)
    {
        const std::uint32_t ends = words[block * gpu::kBlockWords + gpu::kBlockNormals];
        for (std::uint32_t i = 0; i < 4; ++i)
        {
            if ((ends >> (gpu::kEndBits * i) & ((1U << gpu::kEndBits) - 1)) > gpu::kEndMax)
            {
                return fmt::format("block {} of the voxels has a scale outside of the unit square", block);
            }
        }
    }
    return std::nullopt;
}

Fault checkPacked(const TreeData& tree)
{
    const PackedWords& packed = tree.packed;
    const bool is_packed = packed.format == AttributeFormat::Bytes4 || packed.format == AttributeFormat::Blocks;
    if (!is_packed && packed.format != AttributeFormat::None)
    {
        return "the attributes have an unknown format";
    }
    if (is_packed && (!tree.voxel_attributes.empty() || !tree.node_attributes.empty()))
    {
        return "there are attributes in two formats";
    }
    const std::uint64_t voxel_words = is_packed ? packedWords(packed.format, tree.voxel_count) : 0;
    const std::uint64_t node_words = is_packed ? packedWords(nodeFormat(packed.format), tree.octree_node_count) : 0;
    if (packed.voxels.size() != voxel_words || packed.nodes.size() != node_words)
    {
        return fmt::format("packed attributes of voxels and nodes take {} and {} words, where they must take {} and {}",
                           packed.voxels.size(), packed.nodes.size(), voxel_words, node_words);
    }
    const bool are_blocks = packed.format == AttributeFormat::Blocks;
    if (Fault fault = are_blocks ? checkBlocks(packed.voxels) : checkWords4(packed.voxels, "voxels"))
    {
        return fault;
    }
    return checkWords4(packed.nodes, "nodes");
}

Fault checkPlain(const TreeData& tree)
{
    const std::size_t voxels = tree.voxel_attributes.empty() ? 0 : tree.voxel_count;
    const std::size_t nodes = tree.voxel_attributes.empty() ? 0 : tree.octree_node_count;
    if (tree.voxel_attributes.size() != voxels || tree.node_attributes.size() != nodes)
    {
        return fmt::format("there are attributes of {} voxels and {} nodes, where there must be {} and {}",
                           tree.voxel_attributes.size(), tree.node_attributes.size(), voxels, nodes);
    }
    for (const auto* attributes : {&tree.voxel_attributes, &tree.node_attributes})
    {
        for (std::size_t i = 0; i < attributes->size(); ++i)
        {
            const std::uint32_t flags = (*attributes)[i].color >> kFlagShift;
            if ((flags & ~gpu::kAttributeEmissive) != 0)
            {
                return fmt::format("attribute {} of the {} has unknown flags {:#x}", i,
                                   attributes == &tree.voxel_attributes ? "voxels" : "nodes", flags);
            }
        }
    }
    return std::nullopt;
}

Fault checkEmission(const TreeData& tree)
{
    if (!std::isfinite(tree.emission_scale) || !(tree.emission_scale > 0.0F))
    {
        return "the scale of emission is not a finite number above 0";
    }
    if (!tree.emission_words.empty() && !tree.hasAttributes())
    {
        return "there is emission without attributes";
    }
    const std::uint64_t word_count =
        tree.emission_words.empty() ? 0 : divideUp(tree.voxel_count, gpu::kVoxelsPerEmissionWord);
    if (tree.emission_words.size() != word_count)
    {
        return fmt::format("there are {} words that tell what emits, where there must be {}",
                           tree.emission_words.size(), word_count);
    }
    for (std::size_t i = 0; i < tree.voxel_attributes.size(); ++i)
    {
        const bool flagged = (tree.voxel_attributes[i].color >> kFlagShift & gpu::kAttributeEmissive) != 0;
        const bool listed =
            !tree.emission_words.empty() &&
            (tree.emission_words[i / gpu::kVoxelsPerEmissionWord].x >> (i % gpu::kVoxelsPerEmissionWord) & 1U) != 0;
        if (flagged != listed)
        {
            return fmt::format("voxel {} emits by its {} alone", i,
                               flagged ? "attribute" : "bit in the emission table");
        }
    }
    std::uint64_t rank = 0;
    for (std::size_t i = 0; i < tree.emission_words.size(); ++i)
    {
        if (tree.emission_words[i].y != rank)
        {
            return fmt::format("word {} of the emission table counts {} voxels before it, where there are {}", i,
                               tree.emission_words[i].y, rank);
        }
        rank += static_cast<std::uint32_t>(std::popcount(tree.emission_words[i].x));
    }
    const std::uint32_t used_bits = tree.voxel_count % gpu::kVoxelsPerEmissionWord;
    if (!tree.emission_words.empty() && used_bits != 0 && tree.emission_words.back().x >> used_bits != 0)
    {
        return "the emission table has bits behind the last voxel";
    }
    if (rank != tree.emission.size())
    {
        return fmt::format("{} voxels emit, but there are {} emissions", rank, tree.emission.size());
    }
    return std::nullopt;
}

} // namespace

std::optional<std::string> checkAttributes(const TreeData& tree)
{
    if (Fault fault = checkPlain(tree))
    {
        return fault;
    }
    if (Fault fault = checkPacked(tree))
    {
        return fault;
    }
    return checkEmission(tree);
}

} // namespace zvo
