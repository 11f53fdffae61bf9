// SPDX-License-Identifier: MIT
// Forms in which trees store what their voxels and nodes look like (docs/attributes.md).
#pragma once

#include "shared/attribute_forms.h"
#include "vk/buffer.h"
#include "zvo/types.h"

#include <cstdint>
#include <span>
#include <vector>

namespace zvo
{

static_assert(static_cast<gpu::uint>(AttributeForm::None) == gpu::kFormNone);
static_assert(static_cast<gpu::uint>(AttributeForm::Bytes4) == gpu::kForm4);
static_assert(static_cast<gpu::uint>(AttributeForm::Bytes8) == gpu::kForm8);
static_assert(static_cast<gpu::uint>(AttributeForm::Blocks) == gpu::kFormBlocks);

/// As options and messages call it: "none", "4", "8", "block".
const char* formName(AttributeForm form);

/// Whether attributes in that form are words that a kernel packed: of fewer bytes than gpu::Attribute.
constexpr bool isPacked(AttributeForm form)
{
    return form != AttributeForm::None && form != AttributeForm::Bytes8;
}

/// The form of nodes beside that of voxels. Blocks are for neighbours; nodes stand in another order in an octree than
/// in a DAG, and both must show the same.
constexpr AttributeForm nodeForm(AttributeForm form)
{
    return form == AttributeForm::Blocks ? AttributeForm::Bytes4 : form;
}

/// 32-bit words of count attributes in a packed form.
std::uint64_t packedWords(AttributeForm form, std::uint64_t count);

/// The index-th of attributes that were packed into words. It has no flags.
gpu::Attribute unpackAttribute(AttributeForm form, std::span<const gpu::uint> words, std::uint64_t index);

/// Attributes in a packed form, in device memory.
struct PackedAttributes
{
    AttributeForm form = AttributeForm::None; // of voxels; None: there are none
    vk::BufferOf<gpu::uint> voxels;           // [packedWords(form, voxels)]
    vk::BufferOf<gpu::uint> nodes;            // [packedWords(nodeForm(form), nodes)]

    [[nodiscard]] std::uint64_t bytes() const { return voxels.bytes() + nodes.bytes(); }
};

/// The same in the host's memory.
struct PackedWords
{
    AttributeForm form = AttributeForm::None;
    std::vector<gpu::uint> voxels;
    std::vector<gpu::uint> nodes;
};

} // namespace zvo
