// SPDX-License-Identifier: MIT
// Changes `.zvo` files so that most of them get past sizes and checksums, to the checks of the tree.
#pragma once

#include "support/zvo_parts.h"

#include <functional>
#include <random>

namespace zvo::test
{

/// Changes some bytes of a text, whose length may change up to the second number.
using MutateBytes = std::function<std::size_t(std::uint8_t* data, std::size_t size, std::size_t size_max)>;

/// Changes fields of the header and of sections, numbers and bytes in sections, or sections as wholes; sometimes the
/// tree is another one altogether, that is sound. What no parts can be made of becomes a sound file.
Bytes mutateTree(std::span<const std::byte> file, std::mt19937& random, const MutateBytes& mutate);

} // namespace zvo::test
