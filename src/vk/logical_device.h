// SPDX-License-Identifier: MIT
#pragma once

#include "vk/features.h"
#include "vk/functions.h"
#include "vk/headless.h"
#include "vk/instance.h"

#include <string>
#include <vector>

namespace zvo::vk
{

/// A logical device with one compute queue, which HeadlessDevice owns. The instance must outlive it.
class LogicalDevice
{
public:
    /// report: of a usable device. Throws Error when a call fails.
    LogicalDevice(const Instance& instance, const DeviceReport& report, const HeadlessOptions& options);

    /// Waits for the device.
    ~LogicalDevice();
    LogicalDevice(const LogicalDevice&) = delete;
    LogicalDevice& operator=(const LogicalDevice&) = delete;

    [[nodiscard]] VkDevice handle() const { return m_handle; }
    [[nodiscard]] VkQueue queue() const { return m_queue; }
    [[nodiscard]] const Functions& fn() const { return m_functions; }
    [[nodiscard]] const void* features() const { return m_features; } // the chain that it was created with
    [[nodiscard]] const std::vector<std::string>& extensions() const { return m_extensions; }

private:
    void enableForInstrumentation(const Instance& instance, const DeviceReport& report);

    VkPhysicalDeviceFeatures2 m_core_features{};
    FeatureStorage m_feature_storage;
    const void* m_features = nullptr;
    std::vector<std::string> m_extensions;
    VkDevice m_handle = VK_NULL_HANDLE;
    VkQueue m_queue = VK_NULL_HANDLE;
    Functions m_functions;
};

} // namespace zvo::vk
