// SPDX-License-Identifier: MIT
#pragma once

#include "core/base/grid.h"
#include "distance/distance.h"

#include <cmath>
#include <cstdint>
#include <vector>

namespace zvo
{

/// DeviceDistances in the host's memory.
struct DistanceData
{
    Grid grid;
    std::uint32_t band = 0;            // voxels
    std::vector<gpu::BandLeaf> leaves; // in Morton order
    std::vector<gpu::uint> squared;    // [64 leaves.size()] in Morton order

    /// The distance of a cell's centre in world units, negative inside: the root in voxels as the nearest float, times
    /// the voxel size. The cell must be in the band. leaf: its number; cell: its number in the leaf, below 64.
    [[nodiscard]] float distanceAt(std::size_t leaf, std::uint32_t cell) const
    {
        constexpr double kUnits = gpu::kVoxelLattice << gpu::kDistanceBits / 2; // of a voxel
        const gpu::uint value = squared[leaf * gpu::kCentersInBand + cell];
        // The root in double precision is never so near the middle between two floats that it is rounded wrongly.
        const float distance = static_cast<float>(std::sqrt(static_cast<double>(value)) / kUnits) * grid.voxel_size;
        return value != 0 && isInside(leaf, cell) ? -distance : distance;
    }

    /// Whether a cell's centre is inside, in the band or not; of one on a triangle, either.
    [[nodiscard]] bool isInside(std::size_t leaf, std::uint32_t cell) const
    {
        const gpu::BandLeaf& of = leaves[leaf];
        return ((cell < 32 ? of.inside_lo : of.inside_hi) >> cell % 32 & 1U) != 0;
    }

    [[nodiscard]] bool isInBand(std::size_t leaf, std::uint32_t cell) const
    {
        return squared[leaf * gpu::kCentersInBand + cell] != gpu::kNoDistance;
    }
};

} // namespace zvo
