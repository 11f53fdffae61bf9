// SPDX-License-Identifier: MIT
// Packed attributes as docs/attributes.md defines them, computed step by step.
#pragma once

#include "shared/octree.h"

#include <array>
#include <cstdint>
#include <span>

namespace zvo::oracle
{

/// Packs an attribute into 4 bytes, and unpacks it. Flags are lost.
std::uint32_t packAttribute4(const gpu::Attribute& attribute);
gpu::Attribute unpackAttribute4(std::uint32_t word);

/// A block of 16 attributes.
using Block = std::array<std::uint32_t, 6>;

/// attributes: 1 to 16. The last one is repeated for missing ones.
Block packBlock(std::span<const gpu::Attribute> attributes);
gpu::Attribute unpackBlock(const Block& block, std::uint32_t voxel);

} // namespace zvo::oracle
