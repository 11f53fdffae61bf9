// SPDX-License-Identifier: MIT
#include "api/checked.h"

#include "api/camera.h"
#include "api/convert.h"
#include "core/path/path_tracer.h"
#include "core/radiance/device_radiance_cache.h"
#include "core/trace/trace.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace zvo
{

namespace
{

// Each frame in flight has its own buffers and memory.
constexpr std::uint32_t kFramesInFlightMax = 16;

// Environment maps have the limits of `zvo render --environment`.
constexpr std::uint32_t kMapEdgeMax = 16384;
constexpr std::uint64_t kMapTexelsMax = std::uint64_t{1} << 25;

constexpr std::uint32_t kSamplesMax = 1024; // of a call, so that a command buffer stays of a sensible size

constexpr std::uint64_t kCachedFacesMax = std::uint64_t{1} << 29; // of fewer than 2^30 slots

// The irradiance over pi of a sun whose radiance is far below the largest float.
constexpr double kSunMax = 1e30;

template <typename Values> bool areFinite(const Values& values)
{
    return std::ranges::all_of(values, [](auto value) { return std::isfinite(value); });
}

// Row 3 of a matrix of columns.
template <typename Number> std::array<Number, 4> lastRow(const std::array<Number, 16>& matrix)
{
    return {matrix[3], matrix[7], matrix[11], matrix[15]};
}

void requireOne(std::uint64_t count, const char* name)
{
    if (count == 0)
    {
        throw Error(ErrorCode::Usage, fmt::format("{} is 0: it must be at least 1", name));
    }
}

void requireDirection(const DVec3& direction, const char* name)
{
    if (!(std::abs(glm::length(glm::normalize(toGlm(direction))) - 1) < 0.5)) // also for NaN and 0
    {
        throw Error(ErrorCode::Usage, fmt::format("{} is ({}, {}, {}): that is no direction", name, direction[0],
                                                  direction[1], direction[2]));
    }
}

} // namespace

void requireAtMost(std::uint64_t count, std::uint64_t most, const char* name)
{
    if (count > most)
    {
        throw Error(ErrorCode::Usage, fmt::format("{} is {}: it must be at most {}", name, count, most));
    }
}

glm::dvec3 checkedUp(const DVec3& up, const char* name)
{
    requireDirection(up, name);
    return glm::normalize(toGlm(up));
}

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
    const std::array<float, 4> row = lastRow(transform);
    if (row != std::array{0.0F, 0.0F, 0.0F, 1.0F})
    {
        throw Error(ErrorCode::Usage, fmt::format("the transform of {} is not affine: its last row is ({}, {}, {}, {})",
                                                  what, row[0], row[1], row[2], row[3]));
    }
    return transform;
}

template <typename Number> Number checkedAmount(Number amount, const char* name)
{
    if (!std::isfinite(amount) || amount < 0)
    {
        throw Error(ErrorCode::Usage, fmt::format("{} is {}: it must be finite and 0 or more", name, amount));
    }
    return amount;
}

template float checkedAmount(float amount, const char* name);
template double checkedAmount(double amount, const char* name);

const TreeBuildInfo& checked(const TreeBuildInfo& info)
{
    checkedEnum(info.coverage, Coverage::Thin, "TreeBuildInfo::coverage");
    checkedEnum(info.format, AttributeFormat::Blocks, "TreeBuildInfo::format");
    checkedEnum(info.fill, Fill::Robust, "TreeBuildInfo::fill");
    checkedEnum(info.shell, Shell::None, "TreeBuildInfo::shell");
    if (info.keep_sums && info.format != AttributeFormat::Bytes8)
    {
        throw Error(ErrorCode::Usage, "sums are kept only beside attributes of 8 bytes");
    }
    return info;
}

const TreeAlgebraInfo& checked(const TreeAlgebraInfo& info)
{
    checkedEnum(info.operation, TreeOperation::Erode, "TreeAlgebraInfo::operation");
    requireOne(info.voxels, "TreeAlgebraInfo::voxels");
    requireOne(info.least_voxels, "TreeAlgebraInfo::least_voxels");
    return info;
}

const DynamicObjectInfo& checked(const DynamicObjectInfo& info)
{
    checkedEnum(info.fill, Fill::Robust, "DynamicObjectInfo::fill");
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
    for (const float channel : info.emission)
    {
        checkedAmount(channel, "BrushInfo::emission");
    }
    return info;
}

const TraceInfo& checked(const TraceInfo& info)
{
    checkedEnum(info.view, View::Origin, "TraceInfo::view");
    checkedEnum(info.shading, Shading::Faces, "TraceInfo::shading");
    if (info.occlusion_rays > kOcclusionRaysMax)
    {
        throw Error(ErrorCode::Usage, fmt::format("{} occlusion rays are more than the {} that there can be",
                                                  info.occlusion_rays, kOcclusionRaysMax));
    }
    checkedAmount(info.sun, "TraceInfo::sun");
    checkedAmount(info.exposure, "TraceInfo::exposure");
    checkedAmount(info.occlusion_reach, "TraceInfo::occlusion_reach");
    checkedAmount(info.detail_pixels, "TraceInfo::detail_pixels");
    if (info.view == View::Color)
    {
        requireDirection(info.to_sun, "TraceInfo::to_sun");
    }
    return info;
}

const PathInfo& checked(const PathInfo& info)
{
    requireAtMost(info.bounces, kBouncesMax, "PathInfo::bounces");
    checkedEnum(info.shading, Shading::Faces, "PathInfo::shading");
    checkedAmount(info.lens_radius, "PathInfo::lens_radius");
    if (!(checkedAmount(info.focus_distance, "PathInfo::focus_distance") > 0))
    {
        throw Error(ErrorCode::Usage, "PathInfo::focus_distance is 0: it must be more");
    }
    checkedAmount(info.exposure, "PathInfo::exposure");
    requireOne(info.samples, "PathInfo::samples");
    requireAtMost(info.samples, kSamplesMax, "PathInfo::samples");
    return info;
}

const CachedPictureInfo& checked(const CachedPictureInfo& info)
{
    checkedEnum(info.shading, Shading::Faces, "CachedPictureInfo::shading");
    checkedAmount(info.exposure, "CachedPictureInfo::exposure");
    return info;
}

const RadianceCacheInfo& checked(const RadianceCacheInfo& info)
{
    checkedEdge(info.width);
    checkedEdge(info.height);
    requireAtMost(info.faces, kCachedFacesMax, "RadianceCacheInfo::faces");
    return info;
}

const CachedFrameInfo& checked(const CachedFrameInfo& info)
{
    requireOne(info.rays, "CachedFrameInfo::rays");
    requireAtMost(info.rays, kRadianceFacesMax, "CachedFrameInfo::rays");
    return info;
}

const SunInfo& checked(const SunInfo& info)
{
    requireDirection(info.direction, "SunInfo::direction");
    for (const double irradiance : info.irradiance)
    {
        if (!(irradiance >= 0 && irradiance <= kSunMax))
        {
            throw Error(ErrorCode::Usage,
                        fmt::format("SunInfo::irradiance is ({}, {}, {}): it must be from 0 to {}", info.irradiance[0],
                                    info.irradiance[1], info.irradiance[2], kSunMax));
        }
    }
    return info;
}

const EnvironmentMapInfo& checked(const EnvironmentMapInfo& map)
{
    const std::uint64_t texel_count = std::uint64_t{map.width} * map.height;
    if (texel_count == 0 || std::max(map.width, map.height) > kMapEdgeMax || texel_count > kMapTexelsMax)
    {
        throw Error(ErrorCode::Usage,
                    fmt::format("an environment map has edges from 1 to {} texels, and at most {} texels in all, not "
                                "{} x {}",
                                kMapEdgeMax, kMapTexelsMax, map.width, map.height));
    }
    if (map.texels.size() != texel_count)
    {
        throw Error(ErrorCode::Usage, fmt::format("EnvironmentMapInfo::texels has {} elements, not {} x {}",
                                                  map.texels.size(), map.width, map.height));
    }
    if (!std::isfinite(map.turn))
    {
        throw Error(ErrorCode::Usage, fmt::format("EnvironmentMapInfo::turn is {}: it must be finite", map.turn));
    }
    checkedAmount(map.strength, "EnvironmentMapInfo::strength");
    if (!(map.background_blur >= 0.0F && map.background_blur <= std::numbers::pi_v<float>))
    {
        throw Error(ErrorCode::Usage, fmt::format("EnvironmentMapInfo::background_blur is {}: it must be from 0 to pi",
                                                  map.background_blur));
    }
    for (std::size_t i = 0; i < map.texels.size(); ++i)
    {
        const Vec3& texel = map.texels[i];
        if (!std::ranges::all_of(texel, [&](float value)
                                 { return value >= 0 && std::isfinite(std::max(value, value * map.strength)); }))
        {
            throw Error(ErrorCode::Usage,
                        fmt::format("texel ({}, {}) of an environment map is ({}, {}, {}), times {}: it must be finite "
                                    "and 0 or more",
                                    i % map.width, i / map.width, texel[0], texel[1], texel[2], map.strength));
        }
    }
    return map;
}

const DepthTarget& checked(const DepthTarget& target)
{
    if (!areFinite(target.view_projection) || lastRow(target.view_projection) == std::array<double, 4>{})
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
