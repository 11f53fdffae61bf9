// SPDX-License-Identifier: MIT
// A program that embeds zvo, with its own Vulkan objects. Of zvo it uses only the table of function pointers.
#pragma once

#include "support/device.h"
#include "vk/device.h"

#include <atomic>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace zvo::test
{

/// How a HostDevice is made, and what it declares to zvo.
struct HostOptions
{
    bool validation = deviceOptions().validation; // core and synchronization validation
    std::atomic<std::uint32_t>* message_counter =
        deviceOptions().message_counter;            // counts messages; with the default, the test fails on any
    bool debug_utils = true;                        // implied by validation
    std::uint32_t api_version = VK_API_VERSION_1_3; // of the instance
    std::vector<const char*> device_extensions;

    /// Changes the device's create info as a host would; empty: no features are enabled. Structs that it chains must
    /// live until the HostDevice is made, and for as long as zvo may read the declaration.
    std::function<void(VkDeviceCreateInfo&)> prepare;
    bool patch = true;         // zvo::patchFeatures adds what zvo needs
    OptionalFeatures optional; // for patchFeatures

    PFN_vkGetInstanceProcAddr zvo_functions = nullptr;           // for zvo, such as failingVulkan(); null: the loader's
    const VkAllocationCallbacks* allocation_callbacks = nullptr; // for what zvo creates
    VkPipelineCache pipeline_cache = VK_NULL_HANDLE;
    std::uint64_t memory_budget_bytes = UINT64_MAX;
    MemoryCallbacks memory{};
    LogCallback log{};
};

/// Whether the layer that HostOptions::validation needs is installed.
bool hasValidationLayer();

/// An instance, a device, a queue and command buffers. Before the HostDevice is destroyed, zvo's objects on it must be
/// destroyed and their work done.
class HostDevice
{
public:
    /// Takes the software device, or the one that ZVO_TEST_DEVICE names. Throws Error if anything fails.
    explicit HostDevice(const HostOptions& options = {});
    ~HostDevice();
    HostDevice(const HostDevice&) = delete;
    HostDevice& operator=(const HostDevice&) = delete;

    /// The host's declaration to zvo; it points to structs of this HostDevice.
    [[nodiscard]] vk::DeviceHandles handles() const;

    /// The declaration with functions that create devices, images and command buffers, for tests whose vk::Device takes
    /// the host's part. The functions come from HostOptions::zvo_functions.
    [[nodiscard]] vk::DeviceHandles ownerHandles() const;

    [[nodiscard]] VkInstance instance() const { return m_instance; }
    [[nodiscard]] VkPhysicalDevice physicalDevice() const { return m_physical_device; }
    [[nodiscard]] VkDevice device() const { return m_device; }
    [[nodiscard]] VkQueue queue() const { return m_queue; }
    [[nodiscard]] std::uint32_t queueFamily() const { return m_queue_family; }

    /// The host's own functions, without the wrappers of HostOptions::zvo_functions.
    [[nodiscard]] const vk::Functions& fn() const { return m_functions; }

    /// Begins a new command buffer. Command buffers live as long as the HostDevice.
    VkCommandBuffer begin();

    /// Ends the command buffer and submits it once. A barrier behind it makes its writes visible to the host and to
    /// later work.
    void submit(VkCommandBuffer commands);

    /// Waits for all submitted work.
    void wait();

    /// Calls begin(), record, submit() and wait().
    void run(const std::function<void(VkCommandBuffer)>& record);

    /// Number of messages from the validation layers of this instance.
    [[nodiscard]] std::uint32_t messageCount() const { return m_message_count; }

private:
    static VKAPI_ATTR VkBool32 VKAPI_CALL onMessage(VkDebugUtilsMessageSeverityFlagBitsEXT severity,
                                                    VkDebugUtilsMessageTypeFlagsEXT types,
                                                    const VkDebugUtilsMessengerCallbackDataEXT* data, void* host);

    void makeInstance();
    void choosePhysicalDevice();
    void makeDevice();
    void destroy() noexcept;
    template <typename Function> Function load(const char* name) const;

    HostOptions m_options;
    PFN_vkGetInstanceProcAddr m_get;
    std::vector<std::string> m_instance_extensions;
    std::atomic<std::uint32_t> m_message_count = 0;
    FeatureStorage m_feature_storage;
    VkDeviceCreateInfo m_info{}; // pNext and pEnabledFeatures are declared to zvo
    VkInstance m_instance = VK_NULL_HANDLE;
    VkDebugUtilsMessengerEXT m_messenger = VK_NULL_HANDLE;
    VkPhysicalDevice m_physical_device = VK_NULL_HANDLE;
    VkDevice m_device = VK_NULL_HANDLE;
    VkQueue m_queue = VK_NULL_HANDLE;
    std::uint32_t m_queue_family = 0;
    VkCommandPool m_pool = VK_NULL_HANDLE;
    vk::Functions m_functions;
    vk::Functions m_owner_functions; // as zvo's
    PFN_vkQueueSubmit m_submit = nullptr;
    PFN_vkQueueWaitIdle m_wait = nullptr;
};

} // namespace zvo::test
