// SPDX-License-Identifier: MIT
// A Vulkan whose surfaces and swapchains do what a test says, so that windows are resized, lost and late when it wants.
#pragma once

#include "vk/window_support.h"

#include <deque>
#include <vector>

namespace zvo::test
{

/// What fake surfaces do, and what was done with them. One state for the process; not thread safe.
struct FakeSurfaces
{
    // The results of the next calls, success once they are used up.
    std::deque<VkResult> acquire;
    std::deque<VkResult> present;
    std::deque<VkResult> create;
    std::deque<VkResult> capabilities;

    VkExtent2D extent = {UINT32_MAX, UINT32_MAX}; // of the surface; this: whatever its images have
    VkImageUsageFlags usage = VK_IMAGE_USAGE_TRANSFER_DST_BIT;
    bool supported = true;
    std::vector<VkPresentModeKHR> modes = {VK_PRESENT_MODE_FIFO_KHR};
    std::vector<VkSurfaceFormatKHR> formats = {{VK_FORMAT_B8G8R8A8_UNORM, VK_COLOR_SPACE_SRGB_NONLINEAR_KHR}};
    std::uint32_t max_image_count = 0; // 0: any number

    int surfaces_made = 0;
    int surfaces_alive = 0;
    int swapchains_made = 0;
    int swapchains_alive = 0;
    int presented = 0;
    VkSwapchainCreateInfoKHR last{}; // that was made
};

/// The state, as new.
FakeSurfaces& resetFakeSurfaces();
FakeSurfaces& fakeSurfaces();

/// The machine's Vulkan with such surfaces: for HeadlessOptions::get_instance_proc_addr.
PFN_vkGetInstanceProcAddr vulkanWithFakeSurfaces();

/// For HeadlessOptions::window.
vk::WindowSupport fakeWindow();

VkSurfaceKHR makeFakeSurface(VkInstance instance);

} // namespace zvo::test
