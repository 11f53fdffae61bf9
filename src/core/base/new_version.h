// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <cstdint>

namespace zvo
{

/// A number that no other call returns; never 0. By it, whoever has made something of a thing's contents knows that
/// they have changed since.
inline std::uint64_t newVersion()
{
    static std::atomic<std::uint64_t> last = 0;
    return ++last;
}

} // namespace zvo
