// SPDX-License-Identifier: MIT
#include "core/edit/edit.h"
#include "core/overlay/overlay_arena.h"
#include "zvo/error.h"

#include <fmt/format.h>

#include <cstdint>
#include <optional>

namespace zvo
{

namespace
{

std::uint32_t levelCells(const gpu::EditBox& box, std::uint32_t level)
{
    const std::uint32_t shift = 2 * (box.level_count - level);
    const gpu::uvec3 size = (box.hi >> shift) - (box.lo >> shift) + 1U;
    return size.x * size.y * size.z;
}

} // namespace

std::optional<DabExtent> DabExtent::of(const Brush& brush, const Grid& grid, bool filled)
{
    if (brush.radius > gpu::kBrushRadiusMax)
    {
        throw Error(ErrorCode::Usage, fmt::format("a brush's radius is at most {} voxels", gpu::kBrushRadiusMax));
    }
    using Wide = glm::vec<3, std::int64_t>;
    const Wide last(grid.resolution() - 1);
    const Wide far = Wide(brush.center) + Wide(brush.span);
    Wide lo = glm::max(glm::min(Wide(brush.center), far) - std::int64_t{brush.radius}, Wide(0));
    Wide hi = glm::min(glm::max(Wide(brush.center), far) + std::int64_t{brush.radius}, last);
    if (brush.isStamp())
    {
        lo = glm::max(Wide(brush.box().lo), Wide(0));
        hi = glm::min(Wide(brush.box().hi), last);
    }
    if (brush.part)
    {
        lo = glm::max(lo, Wide(brush.part->lo));
        hi = glm::min(hi, Wide(brush.part->hi));
    }
    if (glm::any(glm::greaterThan(lo, hi)))
    {
        return std::nullopt;
    }
    if (glm::any(glm::greaterThanEqual(hi - lo, Wide(gpu::kDabEdgeMax))))
    {
        throw Error(ErrorCode::Usage, fmt::format("a dab is at most {} voxels long", gpu::kDabEdgeMax));
    }
    DabExtent extent;
    extent.exposes = filled && brush.action == BrushAction::Carve;
    for (glm::length_t axis = 0; axis < 3 && extent.exposes; ++axis)
    {
        extent.grown |= (lo[axis] != 0 ? 1U : 0U) << axis | (hi[axis] != last[axis] ? 8U : 0U) << axis;
        lo[axis] -= lo[axis] != 0 ? 1 : 0;
        hi[axis] += hi[axis] != last[axis] ? 1 : 0;
    }
    extent.box = {gpu::uvec3(lo), gpu::uvec3(hi), grid.nodeLevels()};
    for (std::uint32_t level = 0; level < extent.box.level_count; ++level)
    {
        extent.inner_count = extent.cell_count;
        extent.cell_count += levelCells(extent.box, level);
    }
    extent.node_bound = 64 * extent.inner_count;
    extent.voxel_bound = 64 * extent.leafCount() + kVoxelBlock - 1;
    return extent;
}

} // namespace zvo
