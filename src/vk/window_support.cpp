// SPDX-License-Identifier: MIT
#include "vk/window_support.h"

#include "vk/check.h"
#include "vk/instance.h"

#include <algorithm>
#include <optional>
#include <string_view>

namespace zvo::vk
{

namespace
{

bool hasSwapchains(const Instance& instance, VkPhysicalDevice device)
{
    std::uint32_t count = 0;
    VK_CHECK(instance.fn().vkEnumerateDeviceExtensionProperties(device, nullptr, &count, nullptr));
    std::vector<VkExtensionProperties> extensions(count);
    VK_CHECK(instance.fn().vkEnumerateDeviceExtensionProperties(device, nullptr, &count, extensions.data()));
    return std::ranges::any_of(extensions,
                               [](const VkExtensionProperties& extension) {
                                   return std::string_view(extension.extensionName) == VK_KHR_SWAPCHAIN_EXTENSION_NAME;
                               });
}

std::optional<std::uint32_t> presentingFamily(const WindowSupport& window, const Instance& instance,
                                              VkPhysicalDevice device)
{
    constexpr VkQueueFlags kNeeded = VK_QUEUE_COMPUTE_BIT | VK_QUEUE_GRAPHICS_BIT;
    std::uint32_t count = 0;
    instance.fn().vkGetPhysicalDeviceQueueFamilyProperties(device, &count, nullptr);
    std::vector<VkQueueFamilyProperties> families(count);
    instance.fn().vkGetPhysicalDeviceQueueFamilyProperties(device, &count, families.data());
    for (std::uint32_t i = 0; i < count; ++i)
    {
        if ((families[i].queueFlags & kNeeded) == kNeeded && families[i].queueCount > 0 &&
            window.can_present(instance.handle(), device, i))
        {
            return i;
        }
    }
    return std::nullopt;
}

} // namespace

void requireWindow(const WindowSupport& window, const Instance& instance, DeviceReport& report)
{
    if (!hasSwapchains(instance, report.physical_device))
    {
        report.reasons.emplace_back("lacks " VK_KHR_SWAPCHAIN_EXTENSION_NAME);
        return;
    }
    const std::optional<std::uint32_t> family = presentingFamily(window, instance, report.physical_device);
    if (!family)
    {
        report.reasons.emplace_back("has no queue that computes, draws and presents to the window");
        return;
    }
    report.queue_family = *family;
}

} // namespace zvo::vk
