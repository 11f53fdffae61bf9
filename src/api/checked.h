// SPDX-License-Identifier: MIT
// Checks of what hosts hand over, before anything is recorded. All functions throw Error{Usage} for values that are not
// valid.
#pragma once

#include "core/base/grid.h"
#include "zvo/dynamic_tree.h"
#include "zvo/error.h"
#include "zvo/light.h"
#include "zvo/radiance_cache.h"
#include "zvo/tracer.h"
#include "zvo/tree.h"
#include "zvo/types.h"

#include <cstdint>
#include <string>

namespace zvo
{

/// A value of an enumeration that begins at 0 and has no gaps.
template <typename Enum> Enum checkedEnum(Enum value, Enum last, const char* name)
{
    if (value > last)
    {
        throw Error(ErrorCode::Usage,
                    std::string(name) + " has no value " + std::to_string(static_cast<std::uint32_t>(value)));
    }
    return value;
}

/// What is up, as a direction of length 1. Throws Error{Usage} for a direction without a length.
glm::dvec3 checkedUp(const DVec3& up, const char* name);

/// Checks that the depth exists, the far corner is finite, and the voxel size has a finite inverse.
Grid checkedGrid(const GridInfo& info);

/// Checks that a transform is finite and affine. what: the transform's name in messages.
const Mat4& checkedTransform(const Mat4& transform, const std::string& what);

/// Checks that a number, a float or a double, is finite and not negative.
template <typename Number> Number checkedAmount(Number amount, const char* name);

/// Checks that a number is not above the most that is allowed.
void requireAtMost(std::uint64_t count, std::uint64_t most, const char* name);

const TreeBuildInfo& checked(const TreeBuildInfo& info);
const TreeAlgebraInfo& checked(const TreeAlgebraInfo& info);
const DynamicObjectInfo& checked(const DynamicObjectInfo& info);
const DynamicTreeInfo& checked(const DynamicTreeInfo& info);
const BrushInfo& checked(const BrushInfo& info);
const TraceInfo& checked(const TraceInfo& info);
const PathInfo& checked(const PathInfo& info);
const CachedPictureInfo& checked(const CachedPictureInfo& info);
const SunInfo& checked(const SunInfo& info);
const RadianceCacheInfo& checked(const RadianceCacheInfo& info);
const CachedFrameInfo& checked(const CachedFrameInfo& info);

/// Looks at every texel.
const EnvironmentMapInfo& checked(const EnvironmentMapInfo& map);

/// Checks everything but the image, which core/present/image_target.h checks.
const DepthTarget& checked(const DepthTarget& target);

} // namespace zvo
