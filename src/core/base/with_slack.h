// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace zvo
{

/// Capacity for something that needed `needed` elements: a quarter more, as the need of moving objects varies from
/// frame to frame.
constexpr std::uint64_t withSlack(std::uint64_t needed)
{
    return needed + needed / 4 + 64;
}

/// A capacity that suffices.
constexpr std::uint64_t enough(std::uint64_t capacity, std::uint64_t needed)
{
    return needed > capacity ? withSlack(needed) : capacity;
}

} // namespace zvo
