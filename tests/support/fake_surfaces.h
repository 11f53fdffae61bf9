// SPDX-License-Identifier: MIT
// A Vulkan in which a test controls surfaces and swapchains, so that it can resize, lose and delay windows.
#pragma once

#include "vk/window_support.h"

#include <deque>
#include <vector>

namespace zvo::test
{

/// How fake surfaces behave, and what was called on them. The process has one state; it is not thread safe.
struct FakeSurfaces
{
    // Results of the next calls. Once they are used up, calls succeed.
    std::deque<VkResult> acquire;
    std::deque<VkResult> present;
    std::deque<VkResult> create;
    std::deque<VkResult> capabilities;

    VkExtent2D extent = {UINT32_MAX, UINT32_MAX}; // of the surface; UINT32_MAX: the swapchain decides
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
    VkSwapchainCreateInfoKHR last{}; // of the last swapchain made
};

/// Resets the state and returns it.
FakeSurfaces& resetFakeSurfaces();
FakeSurfaces& fakeSurfaces();

/// The machine's Vulkan with fake surfaces: for HeadlessOptions::get_instance_proc_addr.
PFN_vkGetInstanceProcAddr vulkanWithFakeSurfaces();

/// For HeadlessOptions::window.
vk::WindowSupport fakeWindow();

VkSurfaceKHR makeFakeSurface(VkInstance instance);

} // namespace zvo::test
