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

/// Sets report.queue_family to the first queue family that computes, draws and presents to the window. If something is
/// missing for that, the reason is added to report.reasons.
void requireWindow(const WindowSupport& window, const Instance& instance, DeviceReport& report);

} // namespace zvo::vk
