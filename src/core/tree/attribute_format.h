// SPDX-License-Identifier: MIT
// Formats in which trees store the attributes of their voxels and nodes (docs/attributes.md).
#pragma once

#include "shared/attribute_formats.h"
#include "vk/buffer.h"
#include "zvo/types.h"

#include <cstdint>
#include <span>
#include <vector>

namespace zvo
{

static_assert(static_cast<gpu::uint>(AttributeFormat::None) == gpu::kFormatNone);
static_assert(static_cast<gpu::uint>(AttributeFormat::Bytes4) == gpu::kFormat4);
static_assert(static_cast<gpu::uint>(AttributeFormat::Bytes8) == gpu::kFormat8);
static_assert(static_cast<gpu::uint>(AttributeFormat::Blocks) == gpu::kFormatBlocks);

/// The name of a format in options and messages: "none", "4", "8", "block".
const char* formatName(AttributeFormat format);

/// Whether attributes in that format are words that a kernel has packed. These take fewer bytes than gpu::Attribute.
constexpr bool isPacked(AttributeFormat format)
{
    return format != AttributeFormat::None && format != AttributeFormat::Bytes8;
}

/// The format of the attributes of nodes in a tree whose voxels have `format`. Blocks are only for voxels: their code
/// uses that neighbours are similar, and the nodes of an octree and of its DAG stand in different orders but must look
/// the same.
constexpr AttributeFormat nodeFormat(AttributeFormat format)
{
    return format == AttributeFormat::Blocks ? AttributeFormat::Bytes4 : format;
}

/// Number of 32-bit words of `count` attributes in a packed format.
std::uint64_t packedWords(AttributeFormat format, std::uint64_t count);

/// Unpacks the attribute with that index from words in a packed format. It has no flags.
gpu::Attribute unpackAttribute(AttributeFormat format, std::span<const gpu::uint> words, std::uint64_t index);

/// The attributes of a tree in a packed format, in device memory.
struct PackedAttributes
{
    AttributeFormat format = AttributeFormat::None; // of voxels; None: there are none
    vk::BufferOf<gpu::uint> voxels;                 // [packedWords(format, voxels)]
    vk::BufferOf<gpu::uint> nodes;                  // [packedWords(nodeFormat(format), nodes)]

    [[nodiscard]] std::uint64_t bytes() const { return voxels.bytes() + nodes.bytes(); }
};

/// The same in the host's memory.
struct PackedWords
{
    AttributeFormat format = AttributeFormat::None;
    std::vector<gpu::uint> voxels;
    std::vector<gpu::uint> nodes;
};

} // namespace zvo
