// SPDX-License-Identifier: MIT
#pragma once

#include "edit/edit.h"

#include <cstdint>

namespace zvo
{

enum class BrushShape : std::uint32_t
{
    Sphere = gpu::kBrushSphere, ///< voxels whose centres are less than radius + 1/2 voxels away
    Box = gpu::kBrushBox,       ///< voxels at most radius away along each axis
};

enum class BrushAction : std::uint32_t
{
    Carve = gpu::kBrushCarve, ///< takes voxels away
    Fill = gpu::kBrushFill,   ///< makes voxels where there are none; they face away from the brush's centre
    Paint =
        gpu::kBrushPaint, ///< gives voxels another colour, and takes their emission away; nothing without attributes
};

/// A dab of a brush on the voxels of a grid.
struct Brush
{
    BrushShape shape = BrushShape::Sphere;
    BrushAction action = BrushAction::Carve;
    gpu::ivec3 center{0};     // voxel; may lie outside of the grid
    std::uint32_t radius = 0; // voxels beside the centre, at most kBrushRadiusMax
    std::uint32_t color = 0;  // Fill, Paint: sRGB red | green << 8 | blue << 16

    bool operator==(const Brush&) const = default;
};

} // namespace zvo
