// SPDX-License-Identifier: MIT
// Mutations of `.zvo` files, most of which have correct sizes and checksums, so that they reach the checks of the tree.
#pragma once

#include "support/zvo_parts.h"

#include <functional>
#include <random>

namespace zvo::test
{

/// Changes some of size bytes, whose number may grow up to size_max. Returns the new number.
using MutateBytes = std::function<std::size_t(std::uint8_t* data, std::size_t size, std::size_t size_max)>;

/// Changes fields of the header and of sections, numbers and bytes in sections, or whole sections. Sometimes the result
/// is another, valid tree; so it is if file cannot be split into parts.
Bytes mutateTree(std::span<const std::byte> file, std::mt19937& random, const MutateBytes& mutate);

} // namespace zvo::test
