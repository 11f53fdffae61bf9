// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdint>

namespace zvo
{

/// An estimated number as a count from low to high.
inline std::uint64_t clampedCount(double value, std::uint64_t low, std::uint64_t high)
{
    return static_cast<std::uint64_t>(std::clamp(value, static_cast<double>(low), static_cast<double>(high)));
}

} // namespace zvo
