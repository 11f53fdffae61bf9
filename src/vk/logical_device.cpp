// SPDX-License-Identifier: MIT
#include "vk/logical_device.h"

#include "vk/check.h"
#include "vk/owner_functions.h"

#include <algorithm>
#include <string_view>

namespace zvo::vk
{

namespace
{

bool has(const DeviceReport& report, std::string_view feature)
{
    return std::ranges::find(report.present, feature) != report.present.end();
}

std::vector<const char*> deviceExtensions(const HeadlessOptions& options)
{
    return options.window ? std::vector{VK_KHR_SWAPCHAIN_EXTENSION_NAME} : std::vector<const char*>();
}

// A device whose functions are not all there.
void destroyBare(const Instance& instance, VkDevice device)
{
    const auto destroy = reinterpret_cast<PFN_vkDestroyDevice>(
        instance.fn().vkGetInstanceProcAddr(instance.handle(), "vkDestroyDevice"));
    destroy(device, nullptr);
}

} // namespace

LogicalDevice::LogicalDevice(const Instance& instance, const DeviceReport& report, const HeadlessOptions& options)
{
    VkDeviceCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO;
    if (options.gpu_assisted_validation)
    {
        enableForInstrumentation(instance, report);
        info.pNext = &m_core_features;
    }
    const OptionalFeatures optional = {.pass_times = options.timer_capacity != 0 && has(report, "hostQueryReset"),
                                       .subgroup_sizes =
                                           has(report, "subgroupSizeControl") && report.min_subgroup_size != 0,
                                       .int64_atomics = has(report, "shaderBufferInt64Atomics")};
    patchFeatures(info, m_feature_storage, optional);
    m_features = info.pNext;
    const float priority = 1;
    VkDeviceQueueCreateInfo queue{};
    queue.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO;
    queue.queueFamilyIndex = report.queue_family;
    queue.queueCount = 1;
    queue.pQueuePriorities = &priority;
    info.queueCreateInfoCount = 1;
    info.pQueueCreateInfos = &queue;
    const std::vector<const char*> extensions = deviceExtensions(options);
    m_extensions.assign(extensions.begin(), extensions.end());
    info.enabledExtensionCount = static_cast<std::uint32_t>(extensions.size());
    info.ppEnabledExtensionNames = extensions.data();
    VK_CHECK(instance.fn().vkCreateDevice(report.physical_device, &info, nullptr, &m_handle));
    try
    {
        m_functions = ownerFunctions(instance.fn().vkGetInstanceProcAddr, instance.handle(), m_handle);
    }
    catch (...)
    {
        destroyBare(instance, m_handle);
        throw;
    }
    m_functions.vkGetDeviceQueue(m_handle, report.queue_family, 0, &m_queue);
}

LogicalDevice::~LogicalDevice()
{
    m_functions.vkDeviceWaitIdle(m_handle);
    m_functions.vkDestroyDevice(m_handle, nullptr);
}

// What the validation layer's own code in the kernels needs.
void LogicalDevice::enableForInstrumentation(const Instance& instance, const DeviceReport& report)
{
    VkPhysicalDeviceFeatures2 present{};
    present.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2;
    instance.fn().vkGetPhysicalDeviceFeatures2(report.physical_device, &present);
    VkPhysicalDeviceFeatures& features = m_core_features.features;
    m_core_features.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2;
    features.fragmentStoresAndAtomics = present.features.fragmentStoresAndAtomics;
    features.vertexPipelineStoresAndAtomics = present.features.vertexPipelineStoresAndAtomics;
}

} // namespace zvo::vk
