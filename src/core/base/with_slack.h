// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace zvo
{

/// A quarter more than was needed: what moves needs a little more or less in every frame.
constexpr std::uint64_t withSlack(std::uint64_t needed)
{
    return needed + needed / 4 + 64;
}

} // namespace zvo
