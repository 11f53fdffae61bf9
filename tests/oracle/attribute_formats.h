// SPDX-License-Identifier: MIT
// Packed attributes as docs/attributes.md defines them, written the long way.
#pragma once

#include "shared/octree.h"

#include <array>
#include <cstdint>
#include <span>

namespace zvo::oracle
{

/// An attribute in 4 bytes, and what such a word stands for. Flags are lost.
std::uint32_t packAttribute4(const gpu::Attribute& attribute);
gpu::Attribute unpackAttribute4(std::uint32_t word);

/// A block of 16 attributes, and what it holds.
using Block = std::array<std::uint32_t, 6>;

/// attributes: 1 to 16; the last one stands for those that are missing.
Block packBlock(std::span<const gpu::Attribute> attributes);
gpu::Attribute unpackBlock(const Block& block, std::uint32_t voxel);

} // namespace zvo::oracle
