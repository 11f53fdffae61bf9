// SPDX-License-Identifier: MIT
// What the machines that run random commands on a DynamicOctree have in common.
#pragma once

#include <cstdint>

namespace zvo::test
{

inline constexpr int kAttemptsMax = 64;
inline constexpr int kUpdatesPerFrame = 4; // that DynamicOctree takes
inline constexpr double kTinyBudgetMs = 1e-6;

} // namespace zvo::test
