// SPDX-License-Identifier: MIT
#pragma once

#include <cstring>
#include <vector>

namespace zvo::test
{

/// Whether two arrays have the same bytes.
template <typename T> bool sameBytes(const std::vector<T>& a, const std::vector<T>& b)
{
    return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

} // namespace zvo::test
