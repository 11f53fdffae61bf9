// SPDX-License-Identifier: MIT
#pragma once

#include "core/base/grid.h"
#include "core/scene/camera.h"
#include "demo/panels/panels.h"
#include "demo/world/tool.h"

#include <optional>

namespace zvo::demo
{

/// The pointer over the picture.
struct PointerView
{
    ViewCamera camera;
    glm::dvec2 size{1.0};    // of the window, in its units
    glm::dvec2 pointer{0.0}; // likewise
};

/// Where a brush is, as far as is known.
struct BrushPlace
{
    glm::ivec3 voxel{0};
    glm::ivec3 step{0}; // to the neighbour across the face that is seen; 0 from inside
};

/// The voxel under the pointer. found: what was found some frames ago, at another place of the pointer; the plane of
/// its face is taken to go on up to here. Nothing if no voxel was found.
std::optional<BrushPlace> brushPlace(const PointerView& view, const Grid& grid, const InspectedPixel& found);

/// Draws the outline of a box of voxels.
void drawVoxelBox(const PointerView& view, const Grid& grid, const VoxelBox& box);

/// Draws the planes of the mirror, as far as the grid goes.
void drawMirror(const PointerView& view, const Grid& grid, const Mirror& mirror);

/// Draws the face of a voxel.
void drawFace(const PointerView& view, const Grid& grid, const BrushPlace& place);

/// Draws the outline of the brush, and of its images in the mirror, at its place, and the voxel's face, between the
/// picture and the panels.
void drawBrush(const PointerView& view, const Grid& grid, const ToolState& tool, const BrushPlace& place);

} // namespace zvo::demo
