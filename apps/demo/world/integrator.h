// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <string_view>

namespace zvo::demo
{

/// The way in which the light of a pixel is computed. This is the only place where it is chosen.
enum class Integrator
{
    Primary, ///< primary rays, with rays to the sun and over the hemisphere (core/trace/trace.h)
    Path,    ///< path tracing, a sample a frame for as long as nothing changes (core/path/path_tracer.h)
};

inline constexpr std::array<std::string_view, 2> kIntegratorNames = {"primary rays", "paths"};

} // namespace zvo::demo
