// SPDX-License-Identifier: MIT
#pragma once

#include "edit/edit.h"
#include "zvo/types.h"

#include <cstdint>

namespace zvo
{

static_assert(static_cast<gpu::uint>(BrushShape::Sphere) == gpu::kBrushSphere);
static_assert(static_cast<gpu::uint>(BrushShape::Box) == gpu::kBrushBox);
static_assert(static_cast<gpu::uint>(BrushAction::Carve) == gpu::kBrushCarve);
static_assert(static_cast<gpu::uint>(BrushAction::Fill) == gpu::kBrushFill);
static_assert(static_cast<gpu::uint>(BrushAction::Paint) == gpu::kBrushPaint);

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

    bool operator==(const Brush&) const = default;

    /// Whether a voxel is under the brush.
    [[nodiscard]] bool covers(const gpu::ivec3& voxel) const
    {
        const gpu::ivec3 away = glm::abs(voxel - center);
        const auto reach = static_cast<int>(radius);
        const bool is_in_sphere = away.x * away.x + away.y * away.y + away.z * away.z <= reach * (reach + 1);
        return glm::max(away.x, glm::max(away.y, away.z)) <= reach && (shape == BrushShape::Box || is_in_sphere);
    }
};

} // namespace zvo
