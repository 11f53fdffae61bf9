// SPDX-License-Identifier: MIT
#pragma once

#include "core/path/path_tracer.h"
#include "core/radiance/radiance_passes.h"
#include "core/trace/trace.h"

#include <cstdint>
#include <optional>

namespace zvo
{

/// How the light of a picture is computed.
enum class Integrator : std::uint8_t
{
    Primary, ///< primary rays, with rays to the sun and over the hemisphere (core/trace/trace.h)
    Path,    ///< path tracing (core/path/path_tracer.h)
    Cache,   ///< the radiance cache (core/radiance/device_radiance_cache.h)
    Cones,   ///< the same light, seen through cones (CacheView::Cones)
};

/// Whether light comes from the radiance cache.
constexpr bool usesCache(Integrator integrator)
{
    return integrator == Integrator::Cache || integrator == Integrator::Cones;
}

/// Options of a picture. Those of other integrators than its own have no effect.
struct FrameOptions
{
    Integrator integrator = Integrator::Primary;
    TraceOptions trace = {}; // Integrator::Primary, but for the shading; the view counts for all
    PathOptions path = {};   // Integrator::Path, but for PathOptions::smooth
    std::optional<PathForm> path_form = std::nullopt; // not given: pathFormOn() the device
    bool denoise = false;                             // Integrator::Path: filters the noise of few samples (Denoiser)
    std::uint32_t history_max = 16;                   // as in Denoiser::denoise()
    RadianceOptions radiance = {};                    // Integrator::Cache and Cones
    Shading shading = Shading::Smooth;                // of all integrators but Cones
    bool antialias = false; // Integrator::Primary: pictures are means of samples, each through another point of pixels
    /// Integrator::Primary: automatic is by the sun's height (daylightExposure()), not by pixels.
    Exposure exposure = {};

    bool operator==(const FrameOptions&) const = default;

    /// Whether the picture is developed of samples; otherwise one sample makes it.
    [[nodiscard]] bool hasSamples() const
    {
        return shownIntegrator() != Integrator::Primary || (antialias && trace.view == View::Color);
    }

    /// The integrator of the picture: views other than colour have no light.
    [[nodiscard]] Integrator shownIntegrator() const
    {
        return trace.view == View::Color ? integrator : Integrator::Primary;
    }
};

} // namespace zvo
