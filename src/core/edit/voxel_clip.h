// SPDX-License-Identifier: MIT
#pragma once

#include "core/base/grid.h"
#include "core/edit/brush.h"
#include "core/edit/voxel_box.h"
#include "shared/octree.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace zvo
{

/// What a voxel of a clip looks like.
struct ClipVoxel
{
    gpu::Attribute look{};      // flags included
    std::uint32_t emission = 0; // of emissive ones, as in the tree's table

    bool operator==(const ClipVoxel& other) const
    {
        return look.color == other.look.color && look.normal == other.look.normal && emission == other.emission;
    }
};

/// Voxels that were copied out of a box of a tree. They can be placed anywhere in trees with the same emission scale.
class VoxelClip
{
public:
    static constexpr std::uint64_t kCellsMax = 1U << 23; // of a box

    VoxelClip() = default;

    /// A box of that size without voxels.
    explicit VoxelClip(const glm::ivec3& size);

    /// The voxels of a stamp.
    explicit VoxelClip(const Stamp& stamp);

    [[nodiscard]] const glm::ivec3& size() const { return m_size; }
    [[nodiscard]] std::size_t voxelCount() const { return m_count; }
    [[nodiscard]] const std::optional<ClipVoxel>& at(const glm::ivec3& cell) const { return m_cells[indexOf(cell)]; }
    void set(const glm::ivec3& cell, const std::optional<ClipVoxel>& voxel);

    /// Adds the voxels of another clip, with its first cell at a cell of this one.
    void add(const VoxelClip& other, const glm::ivec3& at);

    /// The clip as a mirror across an axis shows it.
    [[nodiscard]] VoxelClip mirrored(glm::length_t axis) const;

    /// A stamp with the clip's first cell at a voxel. Null if the grid has none of its voxels.
    [[nodiscard]] std::shared_ptr<const Stamp> stampAt(const glm::ivec3& voxel, const Grid& grid) const;

private:
    [[nodiscard]] std::size_t indexOf(const glm::ivec3& cell) const
    {
        const auto width = static_cast<std::size_t>(m_size.x);
        const auto height = static_cast<std::size_t>(m_size.y);
        return static_cast<std::size_t>(cell.x) +
               width * (static_cast<std::size_t>(cell.y) + height * static_cast<std::size_t>(cell.z));
    }

    glm::ivec3 m_size{0};
    std::size_t m_count = 0;
    std::vector<std::optional<ClipVoxel>> m_cells; // x first
};

/// What a flood from a voxel reaches.
struct Flood
{
    VoxelClip voxels;                                   // in the clip's box
    VoxelBox reached = {glm::ivec3(0), glm::ivec3(-1)}; // cells: the box around them
};

/// The voxels of a clip that are connected to a seed, by faces, edges or corners, through voxels whose channels of
/// colour differ from the seed's by at most `tolerance`. Empty where the seed is no voxel.
Flood floodFrom(const VoxelClip& clip, const glm::ivec3& seed, std::uint32_t tolerance);

} // namespace zvo
