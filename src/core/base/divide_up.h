// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace zvo
{

/// How many pieces of `size` elements hold `count` elements: the quotient, rounded up.
constexpr std::uint64_t divideUp(std::uint64_t count, std::uint64_t size)
{
    return (count + size - 1) / size;
}

} // namespace zvo
