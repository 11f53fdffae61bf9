// SPDX-License-Identifier: MIT
// Limits that all machines of random commands on a DynamicOctree share.
#pragma once

#include <cstdint>

namespace zvo::test
{

inline constexpr int kAttemptsMax = 64;
inline constexpr int kUpdatesPerFrame = 4; // limit of DynamicOctree
inline constexpr double kTinyBudgetMs = 1e-6;

} // namespace zvo::test
