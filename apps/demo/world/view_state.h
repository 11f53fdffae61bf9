// SPDX-License-Identifier: MIT
#pragma once

#include "core/frame/frame_options.h"
#include "vk/swapchain.h"

#include <optional>

namespace zvo::demo
{

/// Pictures of the window unless options or settings say otherwise.
inline FrameOptions usualFrame()
{
    FrameOptions frame;
    frame.trace.occlusion_rays = 4; // in other directions for each sample of a still picture
    return frame;
}

/// How the world is shown: what the view panel changes and the settings keep.
struct ViewState
{
    FrameOptions frame = usualFrame();
    bool map_sun = false;                 // there is a sun beside an environment map
    std::optional<double> internal_scale; // of the window's edges; not given: as fast as the device allows
    vk::PresentMode present_mode = vk::PresentMode::Fifo;

    static constexpr double kPositiveMax = 1000; // of exposures and pixels

    bool operator==(const ViewState&) const = default;
};

} // namespace zvo::demo
