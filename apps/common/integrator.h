// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace zvo::cli
{

/// How the light of a picture is computed.
enum class Integrator : std::uint8_t
{
    Primary, ///< primary rays, with rays to the sun and over the hemisphere (core/trace/trace.h)
    Path,    ///< path tracing, of one sample after the other (core/path/path_tracer.h)
    Cached,  ///< light that is kept on voxels (core/radiance/radiance_tracer.h)
    Cones,   ///< likewise, seen through cones
};

/// What options and settings call them.
inline constexpr std::array<std::string_view, 4> kIntegratorNames = {"primary", "path", "cached", "cones"};

inline constexpr const char* kIntegratorTypes = "primary|path|cached|cones";
inline constexpr const char* kIntegratorHelp =
    "light by a ray to the sun and a simple sky, by path tracing, kept on the voxels, or through cones that read "
    "that, to compare with (default primary)";

/// Whether light is kept on voxels.
constexpr bool keepsLight(Integrator integrator)
{
    return integrator == Integrator::Cached || integrator == Integrator::Cones;
}

constexpr std::string_view nameOf(Integrator integrator)
{
    return kIntegratorNames.at(static_cast<std::size_t>(integrator));
}

/// The value of an option. Throws Error{Usage}.
Integrator integratorOf(std::string_view option, std::string_view text);

} // namespace zvo::cli
