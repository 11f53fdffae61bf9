// SPDX-License-Identifier: MIT
#pragma once

#include "core/base/grid.h"
#include "core/scene/scene.h"
#include "zvo/types.h"

#include <cstdint>
#include <vector>

namespace zvo::oracle
{

/// The sums over the fragments of one voxel.
struct VoxelColor
{
    std::uint64_t code = 0;  // 64-bit Morton code, x in bit 0
    std::uint64_t sum_r = 0; // linear colour, fractions of 65535
    std::uint64_t sum_g = 0;
    std::uint64_t sum_b = 0;
    std::uint64_t count = 0; // existing fragments, at least 1

    friend bool operator==(const VoxelColor&, const VoxelColor&) = default;
};

/// The voxels of voxelize() with the sums over their fragments, in Morton order.
std::vector<VoxelColor> voxelColors(const Scene& scene, const Grid& grid, Coverage coverage);

} // namespace zvo::oracle
