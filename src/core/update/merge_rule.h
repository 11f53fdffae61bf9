// SPDX-License-Identifier: MIT
#pragma once

#include "update/update.h"
#include "zvo/types.h"

#include <cstdint>

namespace zvo
{

static_assert(static_cast<gpu::uint>(MergeRule::Average) == gpu::kMergeAverage);
static_assert(static_cast<gpu::uint>(MergeRule::DynamicWins) == gpu::kMergeDynamic);
static_assert(static_cast<gpu::uint>(MergeRule::StaticWins) == gpu::kMergeStatic);

} // namespace zvo
