// SPDX-License-Identifier: MIT
#pragma once

#include "vk/device.h"

#include <atomic>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace zvo::vk
{

/// vkGetInstanceProcAddr of the machine's Vulkan loader, which is loaded on the first call and stays loaded. Throws
/// Error{Device} when there is none.
PFN_vkGetInstanceProcAddr loadVulkan();

/// Options of an instance.
struct InstanceOptions
{
    bool validation = false;
    bool gpu_assisted_validation = false; // implies validation
    std::vector<const char*> extensions;  // such as those of a window
    /// Counts messages as well, until the instance is gone; may be null.
    std::atomic<std::uint32_t>* message_counter = nullptr;
    PFN_vkGetInstanceProcAddr get_instance_proc_addr = nullptr; // null: the machine's loader
};

/// Of the project's own instances.
inline constexpr std::uint32_t kInstanceApiVersion = VK_API_VERSION_1_3;

/// A Vulkan 1.3 instance of the project's own, with validation layers if asked for. Stays where it is made: the layers
/// keep its address.
class Instance
{
public:
    /// Throws Error{Device} when there is no Vulkan 1.3, no validation layer, or no such extension.
    explicit Instance(const InstanceOptions& options);
    ~Instance();
    Instance(const Instance&) = delete;
    Instance& operator=(const Instance&) = delete;

    [[nodiscard]] VkInstance handle() const { return m_handle; }
    [[nodiscard]] const Functions& fn() const { return m_functions; }
    [[nodiscard]] const std::vector<std::string>& extensions() const { return m_extensions; } // enabled ones

    /// Reports of all physical devices in the loader's order.
    [[nodiscard]] std::vector<DeviceReport> queryAll() const;

    /// Warnings and errors of the validation layers so far.
    [[nodiscard]] std::uint32_t validationMessageCount() const { return m_message_count; }

private:
    static VKAPI_ATTR VkBool32 VKAPI_CALL onMessage(VkDebugUtilsMessageSeverityFlagBitsEXT severity,
                                                    VkDebugUtilsMessageTypeFlagsEXT types,
                                                    const VkDebugUtilsMessengerCallbackDataEXT* data, void* instance);

    VkInstance m_handle = VK_NULL_HANDLE;
    VkDebugUtilsMessengerEXT m_messenger = VK_NULL_HANDLE;
    Functions m_functions;
    std::vector<std::string> m_extensions;
    std::atomic<std::uint32_t> m_message_count = 0;
    std::atomic<std::uint32_t>* m_message_counter = nullptr;
};

/// The usable device that `wanted` names: by its index, by a part of its name in any case, or "cpu" for the first
/// software device; if empty, the best one (in the order discrete, integrated, virtual, cpu). Throws Error{Device}
/// listing every device with every reason.
const DeviceReport& chooseDevice(std::span<const DeviceReport> reports, const std::string& wanted);

} // namespace zvo::vk
