// SPDX-License-Identifier: MIT
#pragma once

#include "core/frame/frame_options.h"
#include "vk/swapchain.h"

#include <optional>

namespace zvo::demo
{

/// How the world is shown: what the view panel changes and the settings keep.
struct ViewState
{
    FrameOptions frame;
    bool map_sun = false;                 // there is a sun beside an environment map
    std::optional<double> internal_scale; // of the window's edges; not given: as fast as the device allows
    vk::PresentMode present_mode = vk::PresentMode::Fifo;

    bool operator==(const ViewState&) const = default;
};

} // namespace zvo::demo
