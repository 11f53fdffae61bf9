// SPDX-License-Identifier: MIT
#include "runtime/script_brush.h"

#include "core/base/input_error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <variant>

namespace zvo
{

namespace
{

constexpr double kFarthestVoxel = 1e9; // along an axis; beyond it nothing lies in a grid

// The voxel whose number along each axis is a position, rounded down, as far as numbers matter.
glm::ivec3 voxelOf(const glm::dvec3& position)
{
    return glm::ivec3(glm::clamp(glm::floor(position), -kFarthestVoxel, kFarthestVoxel));
}

} // namespace

std::optional<Brush> brushOf(const ScriptedEdit& edit, const Grid& grid, const std::filesystem::path& path)
{
    const double size = grid.voxel_size;
    const glm::dvec3 origin(grid.origin);
    Brush brush = {.action = edit.action, .color = edit.color, .emission = edit.emission};
    if (const auto* const sphere = std::get_if<EditSphere>(&edit.shape))
    {
        const double voxels = std::max(std::round(sphere->radius / size - 0.5), 0.0); // beside the centre
        if (voxels > gpu::kBrushRadiusMax)
        {
            throw inputError(path,
                             fmt::format("{}.sphere.radius is {:g}, {:.0f} voxels; expected at most {:g}", edit.where,
                                         sphere->radius, voxels, (gpu::kBrushRadiusMax + 0.5) * size));
        }
        brush.center = voxelOf((sphere->center - origin) / size);
        brush.radius = static_cast<std::uint32_t>(voxels);
        return brush;
    }
    const auto& box = std::get<EditSpan>(edit.shape);
    brush.shape = BrushShape::Box;
    brush.center = voxelOf((box.min - origin) / size + 0.5);              // whose centre is the first one inside
    brush.span = voxelOf((box.max - origin) / size - 0.5) - brush.center; // to the last one
    return glm::any(glm::lessThan(brush.span, glm::ivec3(0))) ? std::nullopt : std::optional(brush);
}

} // namespace zvo
