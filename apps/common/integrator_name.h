// SPDX-License-Identifier: MIT
#pragma once

#include "core/frame/frame_options.h"

#include <array>
#include <cstddef>
#include <string_view>

namespace zvo::cli
{

/// What options and settings call the values of Integrator.
inline constexpr std::array<std::string_view, 4> kIntegratorNames = {"primary", "path", "cached", "cones"};

inline constexpr const char* kIntegratorTypes = "primary|path|cached|cones";
inline constexpr const char* kIntegratorHelp =
    "light by a ray to the sun and a simple sky, by path tracing, kept on the voxels, or through cones that read "
    "that, to compare with (default primary)";

constexpr std::string_view nameOf(Integrator integrator)
{
    return kIntegratorNames.at(static_cast<std::size_t>(integrator));
}

/// The value of an option. Throws Error{Usage}.
Integrator integratorOf(std::string_view option, std::string_view text);

} // namespace zvo::cli
