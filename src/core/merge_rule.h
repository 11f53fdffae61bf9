// SPDX-License-Identifier: MIT
#pragma once

#include "update/update.h"

#include <cstdint>

namespace zvo
{

/// What a voxel looks like that both the static tree and a mover have.
enum class MergeRule : std::uint32_t
{
    Average = gpu::kMergeAverage,     ///< the mean over the fragments of both: as if they were one scene
    DynamicWins = gpu::kMergeDynamic, ///< the movers, the mean over their fragments
    StaticWins = gpu::kMergeStatic,   ///< the static tree
};

} // namespace zvo
