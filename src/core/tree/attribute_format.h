// SPDX-License-Identifier: MIT
// Formats in which trees store what their voxels and nodes look like (docs/attributes.md).
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

/// As options and messages call it: "none", "4", "8", "block".
const char* formatName(AttributeFormat format);

/// Whether attributes in that format are words that a kernel packed: of fewer bytes than gpu::Attribute.
constexpr bool isPacked(AttributeFormat format)
{
    return format != AttributeFormat::None && format != AttributeFormat::Bytes8;
}

/// The format of nodes beside that of voxels. Blocks are for neighbours; nodes stand in another order in an octree than
/// in a DAG, and both must show the same.
constexpr AttributeFormat nodeFormat(AttributeFormat format)
{
    return format == AttributeFormat::Blocks ? AttributeFormat::Bytes4 : format;
}

/// 32-bit words of count attributes in a packed format.
std::uint64_t packedWords(AttributeFormat format, std::uint64_t count);

/// The index-th of attributes that were packed into words. It has no flags.
gpu::Attribute unpackAttribute(AttributeFormat format, std::span<const gpu::uint> words, std::uint64_t index);

/// Attributes in a packed format, in device memory.
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
