// SPDX-License-Identifier: MIT
#pragma once

#include "common/integrator.h"

#include <array>
#include <string_view>

namespace zvo::demo
{

using cli::Integrator;

/// What the view panel calls the values of Integrator.
inline constexpr std::array<std::string_view, 4> kLightNames = {"primary rays", "paths", "kept on voxels",
                                                                "through cones"};

} // namespace zvo::demo
