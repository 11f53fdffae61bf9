// SPDX-License-Identifier: MIT
#include "api/checked.h"

#include "api/convert.h"
#include "core/trace/trace.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace zvo
{

namespace
{

// Each frame in flight has its own buffers and memory.
constexpr std::uint32_t kFramesInFlightMax = 16;

template <typename Values> bool areFinite(const Values& values)
{
    return std::ranges::all_of(values, [](auto value) { return std::isfinite(value); });
}

// Row 3 of a matrix of columns.
template <typename Matrix> typename Matrix::value_type lastRow(const Matrix& matrix, std::size_t column)
{
    return matrix[4 * column + 3];
}

template <typename Number> Number checkedNumber(Number amount, const char* name)
{
    if (!std::isfinite(amount) || amount < 0)
    {
        throw Error(ErrorCode::Usage, fmt::format("{} is {}: it must be finite and 0 or more", name, amount));
    }
    return amount;
}

void requireOne(std::uint64_t count, const char* name)
{
    if (count == 0)
    {
        throw Error(ErrorCode::Usage, fmt::format("{} is 0: it must be at least 1", name));
    }
}

} // namespace

Grid checkedGrid(const GridInfo& info)
{
    if (info.depth < 1 || info.depth > Grid::kDepthMax)
    {
        throw Error(ErrorCode::Usage, fmt::format("a grid of depth {} is out of range: 1 to {} (resolution 2 to {})",
                                                  info.depth, Grid::kDepthMax, 1U << Grid::kDepthMax));
    }
    if (!(info.voxel_size > 0) || !std::isfinite(info.voxel_size) || !std::isfinite(1 / info.voxel_size))
    {
        throw Error(ErrorCode::Usage,
                    fmt::format("a grid has voxels of a size that is finite and above 0, not {}", info.voxel_size));
    }
    const Grid grid = toGrid(info);
    const float edge = grid.voxel_size * static_cast<float>(grid.rootResolution());
    for (const float corner : info.origin)
    {
        if (!std::isfinite(corner) || !std::isfinite(corner + edge))
        {
            throw Error(ErrorCode::Usage,
                        fmt::format("a grid has corners that are finite, not from ({}, {}, {}) on with an edge of {}",
                                    info.origin[0], info.origin[1], info.origin[2], edge));
        }
    }
    return grid;
}

const Mat4& checkedTransform(const Mat4& transform, const std::string& what)
{
    if (!areFinite(transform))
    {
        throw Error(ErrorCode::Usage, fmt::format("the transform of {} has numbers that are not finite", what));
    }
    if (lastRow(transform, 0) != 0 || lastRow(transform, 1) != 0 || lastRow(transform, 2) != 0 ||
        lastRow(transform, 3) != 1)
    {
        throw Error(ErrorCode::Usage, fmt::format("the transform of {} is not affine: its last row is ({}, {}, {}, {})",
                                                  what, lastRow(transform, 0), lastRow(transform, 1),
                                                  lastRow(transform, 2), lastRow(transform, 3)));
    }
    return transform;
}

float checkedAmount(float amount, const char* name)
{
    return checkedNumber(amount, name);
}

double checkedAmount(double amount, const char* name)
{
    return checkedNumber(amount, name);
}

const TreeBuildInfo& checked(const TreeBuildInfo& info)
{
    checkedEnum(info.coverage, Coverage::Thin, "TreeBuildInfo::coverage");
    checkedEnum(info.format, AttributeFormat::Blocks, "TreeBuildInfo::format");
    if (info.keep_sums && info.format != AttributeFormat::Bytes8)
    {
        throw Error(ErrorCode::Usage, "sums are kept only beside attributes of 8 bytes");
    }
    return info;
}

const DynamicTreeInfo& checked(const DynamicTreeInfo& info)
{
    checkedEnum(info.coverage, Coverage::Thin, "DynamicTreeInfo::coverage");
    checkedEnum(info.merge, MergeRule::StaticWins, "DynamicTreeInfo::merge");
    if (info.frames_in_flight < 1 || info.frames_in_flight > kFramesInFlightMax)
    {
        throw Error(ErrorCode::Usage, fmt::format("DynamicTreeInfo::frames_in_flight is {}: it must be from 1 to {}",
                                                  info.frames_in_flight, kFramesInFlightMax));
    }
    requireOne(info.history_entries, "DynamicTreeInfo::history_entries");
    requireOne(info.strokes, "DynamicTreeInfo::strokes");
    checkedAmount(info.emission_scale, "DynamicTreeInfo::emission_scale");
    return info;
}

const BrushInfo& checked(const BrushInfo& info)
{
    checkedEnum(info.shape, BrushShape::Box, "BrushInfo::shape");
    checkedEnum(info.action, BrushAction::Paint, "BrushInfo::action");
    return info;
}

const TraceInfo& checked(const TraceInfo& info)
{
    checkedEnum(info.view, View::Origin, "TraceInfo::view");
    if (info.occlusion_rays > kOcclusionRaysMax)
    {
        throw Error(ErrorCode::Usage, fmt::format("{} occlusion rays are more than the {} that there can be",
                                                  info.occlusion_rays, kOcclusionRaysMax));
    }
    checkedAmount(info.sun, "TraceInfo::sun");
    checkedAmount(info.exposure, "TraceInfo::exposure");
    checkedAmount(info.occlusion_reach, "TraceInfo::occlusion_reach");
    checkedAmount(info.detail_pixels, "TraceInfo::detail_pixels");
    const glm::dvec3 direction = glm::normalize(toGlm(info.to_sun));
    if (info.view == View::Color && !(std::abs(glm::length(direction) - 1) < 0.5)) // also for NaN and 0
    {
        throw Error(ErrorCode::Usage, fmt::format("TraceInfo::to_sun is ({}, {}, {}): that is no direction",
                                                  info.to_sun[0], info.to_sun[1], info.to_sun[2]));
    }
    return info;
}

const DepthTarget& checked(const DepthTarget& target)
{
    const DMat4& matrix = target.view_projection;
    const bool divides =
        lastRow(matrix, 0) != 0 || lastRow(matrix, 1) != 0 || lastRow(matrix, 2) != 0 || lastRow(matrix, 3) != 0;
    if (!areFinite(matrix) || !divides)
    {
        throw Error(ErrorCode::Usage, "DepthTarget::view_projection must be finite, with a last row that is not 0: "
                                      "from world to clip space");
    }
    if (!(target.miss >= 0.0F && target.miss <= 1.0F))
    {
        throw Error(ErrorCode::Usage, fmt::format("DepthTarget::miss is {}: it must be in [0, 1]", target.miss));
    }
    return target;
}

} // namespace zvo
