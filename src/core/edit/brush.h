// SPDX-License-Identifier: MIT
#pragma once

#include "core/base/grid.h"
#include "core/edit/voxel_box.h"
#include "edit/edit.h"
#include "zvo/types.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace zvo
{

struct DeviceTree;

static_assert(static_cast<gpu::uint>(BrushShape::Sphere) == gpu::kBrushSphere);
static_assert(static_cast<gpu::uint>(BrushShape::Box) == gpu::kBrushBox);
static_assert(static_cast<gpu::uint>(BrushAction::Carve) == gpu::kBrushCarve);
static_assert(static_cast<gpu::uint>(BrushAction::Fill) == gpu::kBrushFill);
static_assert(static_cast<gpu::uint>(BrushAction::Paint) == gpu::kBrushPaint);

inline constexpr int kLeafEdge = 4; // voxels

/// Voxels that have looks of their own, at a place of a grid (shaders/edit/edit.h).
struct Stamp
{
    VoxelBox box;                     // in the grid
    std::vector<std::uint32_t> words; // [gpu::kStampWords for each leaf that the box touches]
};

/// An octree in device memory whose voxels are a stamp: without DAG, with attributes of 8 bytes or none. It must
/// outlive the frame, and stand still in it.
struct TreeStamp
{
    const DeviceTree* tree = nullptr; // null: no stamp
    gpu::ivec3 offset{0};             // of its first voxel in the grid that is edited

    bool operator==(const TreeStamp&) const = default;

    /// The voxels of its grid. Only with a tree.
    [[nodiscard]] VoxelBox box() const;
};

/// A dab of a brush on the voxels of a grid.
struct Brush
{
    BrushShape shape = BrushShape::Sphere;
    BrushAction action = BrushAction::Carve;
    gpu::ivec3 center{0};     // voxel; may lie outside of the grid
    std::uint32_t radius = 0; // voxels beside the centre, at most kBrushRadiusMax
    std::uint32_t color = 0;  // Fill, Paint: sRGB red | green << 8 | blue << 16
    /// Fill, Paint: radiance, linear, at most 65408 times the tree's emission scale. Of trees without emission it has
    /// no effect.
    gpu::vec3 emission{0.0F};
    gpu::ivec3 span{0}; // BrushShape::Box: it reaches as far as a box around center + span does
    std::optional<VoxelBox> part = std::nullopt;  // only what is in it
    std::shared_ptr<const Stamp> stamp = nullptr; // in place of a shape: Fill makes its voxels, whatever was there,
                                                  // Carve takes voxels where it has some
    TreeStamp tree_stamp = {};                    // in place of both: does as a stamp

    bool operator==(const Brush&) const = default;

    /// The voxels that it may cover, in the grid or not.
    [[nodiscard]] VoxelBox box() const
    {
        const VoxelBox ends = VoxelBox::of(center, center + span);
        const auto reach = static_cast<int>(radius);
        return stamp != nullptr             ? stamp->box
               : tree_stamp.tree != nullptr ? tree_stamp.box()
                                            : VoxelBox{ends.lo - reach, ends.hi + reach};
    }

    [[nodiscard]] bool isStamp() const { return stamp != nullptr || tree_stamp.tree != nullptr; }

    /// Whether a voxel is under a brush without stamp and part.
    [[nodiscard]] bool covers(const gpu::ivec3& voxel) const
    {
        if (!box().contains(voxel)) // far away, squares would overflow
        {
            return false;
        }
        const gpu::ivec3 away = voxel - center;
        const auto reach = static_cast<int>(radius);
        return shape == BrushShape::Box || away.x * away.x + away.y * away.y + away.z * away.z <= reach * (reach + 1);
    }
};

/// The brush as parts that dabs take: each at most 2 * kBrushRadiusMax voxels long where the brush is longer than a dab
/// may be. Nothing where it does not reach the grid.
std::vector<Brush> partsOf(const Brush& brush, const Grid& grid);

} // namespace zvo
