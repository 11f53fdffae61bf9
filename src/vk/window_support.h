// SPDX-License-Identifier: MIT
#pragma once

#include "vk/functions.h"
#include "zvo/device.h"

#include <cstdint>
#include <functional>
#include <vector>

namespace zvo::vk
{

class Instance;

/// What a window needs of the device that shows it.
struct WindowSupport
{
    std::vector<const char*> instance_extensions; // of surfaces, as the window system names them

    /// Whether a queue family of a physical device can present to the window.
    std::function<bool(VkInstance, VkPhysicalDevice, std::uint32_t queue_family)> can_present;
};

/// Puts the first queue family that computes, draws and presents to the window into report; what the device lacks for
/// that becomes a reason against it.
void requireWindow(const WindowSupport& window, const Instance& instance, DeviceReport& report);

} // namespace zvo::vk
