// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace zvo
{

/// A colour in a word is red | green << 8 | blue << 16. The upper byte is alpha, or an attribute's flags.
inline constexpr std::uint32_t kColorMask = 0xFFFFFFU; // as gpu::kColorMask
inline constexpr std::uint32_t kOpaque = ~kColorMask;

} // namespace zvo
