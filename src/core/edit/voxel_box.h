// SPDX-License-Identifier: MIT
#pragma once

#include "core/base/grid.h"

#include <cstdint>

namespace zvo
{

/// A box of voxels; empty where lo is greater than hi.
struct VoxelBox
{
    glm::ivec3 lo{0};
    glm::ivec3 hi{0}; // the last voxel

    bool operator==(const VoxelBox&) const = default;

    /// The smallest box with two voxels.
    static VoxelBox of(const glm::ivec3& a, const glm::ivec3& b) { return {glm::min(a, b), glm::max(a, b)}; }

    static VoxelBox none() { return {glm::ivec3(0), glm::ivec3(-1)}; }

    [[nodiscard]] bool isEmpty() const { return glm::any(glm::greaterThan(lo, hi)); }
    [[nodiscard]] glm::ivec3 size() const { return hi - lo + 1; }
    [[nodiscard]] std::uint64_t volume() const
    {
        const glm::u64vec3 edges(glm::max(size(), glm::ivec3(0)));
        return edges.x * edges.y * edges.z;
    }
    [[nodiscard]] bool contains(const glm::ivec3& voxel) const
    {
        return glm::all(glm::greaterThanEqual(voxel, lo)) && glm::all(glm::lessThanEqual(voxel, hi));
    }

    /// What both boxes have.
    [[nodiscard]] VoxelBox within(const VoxelBox& other) const
    {
        return {glm::max(lo, other.lo), glm::min(hi, other.hi)};
    }
    [[nodiscard]] VoxelBox movedBy(const glm::ivec3& step) const { return {lo + step, hi + step}; }
};

/// Calls visit(cell) for the cells of a box, x first.
template <typename Visit> void forCells(const VoxelBox& box, Visit visit)
{
    glm::ivec3 cell(0);
    for (cell.z = box.lo.z; cell.z <= box.hi.z; ++cell.z)
    {
        for (cell.y = box.lo.y; cell.y <= box.hi.y; ++cell.y)
        {
            for (cell.x = box.lo.x; cell.x <= box.hi.x; ++cell.x)
            {
                visit(cell);
            }
        }
    }
}

} // namespace zvo
