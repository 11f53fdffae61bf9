// SPDX-License-Identifier: MIT
#pragma once

#include "core/trace/trace.h"
#include "demo/world/integrator.h"
#include "vk/swapchain.h"

#include <cstdint>
#include <optional>

namespace zvo::demo
{

/// How the world is shown: what the view panel changes and the settings keep.
struct ViewState
{
    View view = TraceOptions().view;
    Integrator integrator = Integrator::Primary;
    bool denoise = false; // of paths
    bool shadows = TraceOptions().shadows;
    std::uint32_t occlusion_rays = TraceOptions().occlusion_rays;
    glm::dvec3 to_sun = TraceOptions().to_sun;
    float exposure = TraceOptions().exposure;
    float detail_pixels = TraceOptions().detail_pixels; // 0: rays go on to voxels
    std::optional<double> internal_scale; // of the window's edges; not given: as fast as the device allows
    vk::PresentMode present_mode = vk::PresentMode::Fifo;

    bool operator==(const ViewState&) const = default;

    /// The integrator of the picture: views other than colour have no light.
    [[nodiscard]] Integrator shownIntegrator() const { return view == View::Color ? integrator : Integrator::Primary; }

    [[nodiscard]] TraceOptions traceOptions() const
    {
        TraceOptions options;
        options.view = view;
        options.shadows = shadows;
        options.occlusion_rays = occlusion_rays;
        options.to_sun = to_sun;
        options.exposure = exposure;
        options.detail_pixels = detail_pixels;
        return options;
    }
};

} // namespace zvo::demo
