// SPDX-License-Identifier: MIT
// What hosts hand over, looked at before anything is recorded. All throw Error{Usage} for what will not do; the C
// interface comes by here too.
#pragma once

#include "core/base/grid.h"
#include "zvo/dynamic_tree.h"
#include "zvo/error.h"
#include "zvo/tracer.h"
#include "zvo/tree.h"
#include "zvo/types.h"

#include <cstdint>
#include <string>

namespace zvo
{

/// A value of an enumeration that begins at 0 and has no gaps.
template <typename Enum> Enum checkedEnum(std::uint32_t value, Enum last, const char* name)
{
    if (value > static_cast<std::uint32_t>(last))
    {
        throw Error(ErrorCode::Usage, std::string(name) + " has no value " + std::to_string(value));
    }
    return static_cast<Enum>(value);
}

template <typename Enum> Enum checkedEnum(Enum value, Enum last, const char* name)
{
    return checkedEnum(static_cast<std::uint32_t>(value), last, name);
}

/// Of a depth that there is, with a finite far corner and voxels whose size has a finite inverse.
Grid checkedGrid(const GridInfo& info);

/// A transform that is finite and affine. what: whose it is.
const Mat4& checkedTransform(const Mat4& transform, const std::string& what);

/// A number that is finite and not negative.
float checkedAmount(float amount, const char* name);
double checkedAmount(double amount, const char* name);

const TreeBuildInfo& checked(const TreeBuildInfo& info);
const DynamicTreeInfo& checked(const DynamicTreeInfo& info);
const BrushInfo& checked(const BrushInfo& info);
const TraceInfo& checked(const TraceInfo& info);

/// All but its image: core/present/image_target.h.
const DepthTarget& checked(const DepthTarget& target);

} // namespace zvo
