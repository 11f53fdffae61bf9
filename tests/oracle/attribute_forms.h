// SPDX-License-Identifier: MIT
// Packed attributes as docs/attributes.md defines them, written the long way.
#pragma once

#include "shared/octree.h"

#include <cstdint>

namespace zvo::oracle
{

/// An attribute in 4 bytes, and what such a word stands for. Flags are lost.
std::uint32_t packAttribute4(const gpu::Attribute& attribute);
gpu::Attribute unpackAttribute4(std::uint32_t word);

} // namespace zvo::oracle
