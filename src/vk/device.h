// SPDX-License-Identifier: MIT
#pragma once

#include "vk/functions.h"
#include "vk/kernel.h"
#include "vk/memory.h"
#include "vk/overrides.h"

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace zvo::vk
{

/// What zvo needs to know of a physical device, and why it would refuse it.
struct DeviceReport
{
    VkPhysicalDevice physical_device = VK_NULL_HANDLE;
    std::string name;
    std::string driver;      // name and version, as the driver states them
    std::string type;        // "discrete", "integrated", "virtual", "cpu" or "other"
    std::string api_version; // "1.3.230"
    std::uint32_t subgroup_size = 0;
    std::uint64_t memory_bytes = 0;      // largest device-local heap
    std::uint64_t max_buffer_bytes = 0;  // largest buffer, and largest allocation of memory
    std::uint32_t min_subgroup_size = 0; // of those that a kernel can ask for; 0: none
    std::uint32_t max_subgroup_size = 0;
    std::uint32_t queue_family = 0;         // the compute queue family that zvo would use
    float timestamp_period_ns = 0;          // 0: no timestamps on that queue family
    std::uint32_t timestamp_valid_bits = 0; // of a timestamp on that queue family
    std::vector<std::string> present;       // required and optional features that the device has
    std::vector<std::string> missing;       // required and optional features that it lacks
    std::vector<std::string> reasons;       // why zvo cannot use it; empty: it will do

    [[nodiscard]] bool usable() const { return reasons.empty(); }
};

/// Examines one physical device. Creates nothing and never throws for a device that will not do.
DeviceReport query(PFN_vkGetInstanceProcAddr get_instance_proc_addr, VkInstance instance,
                   VkPhysicalDevice physical_device);

/// Lowers what report says and limits allow. What overrides take away and zvo needs becomes a reason.
void applyOverrides(const DeviceOverrides& overrides, DeviceReport& report, VkPhysicalDeviceLimits& limits);

/// The feature structs of Vulkan 1.0 to 1.3, chained.
struct FeatureChain
{
    FeatureChain();
    FeatureChain(const FeatureChain&) = delete;
    FeatureChain& operator=(const FeatureChain&) = delete;

    VkPhysicalDeviceFeatures2 core{};
    VkPhysicalDeviceVulkan11Features vulkan11{};
    VkPhysicalDeviceVulkan12Features vulkan12{};
    VkPhysicalDeviceVulkan13Features vulkan13{};
};

/// The feature structs that zvo needs enabled, chained; give head() as pNext of VkDeviceCreateInfo.
class RequiredFeatures
{
public:
    RequiredFeatures();

    [[nodiscard]] const void* head() const { return &m_chain.core; }

    /// To enable more than zvo needs.
    [[nodiscard]] FeatureChain& chain() { return m_chain; }

private:
    FeatureChain m_chain;
};

/// Everything a host hands over: zvo creates none of these and destroys none of them.
struct DeviceHandles
{
    PFN_vkGetInstanceProcAddr get_instance_proc_addr = nullptr;
    VkInstance instance = VK_NULL_HANDLE;
    VkPhysicalDevice physical_device = VK_NULL_HANDLE;
    VkDevice device = VK_NULL_HANDLE;
    std::uint32_t queue_family = 0;
    const VkAllocationCallbacks* allocation_callbacks = nullptr; // may be null; must outlive the Device
    VkPipelineCache pipeline_cache = VK_NULL_HANDLE;             // may be null
    std::uint64_t memory_budget_bytes = UINT64_MAX;              // what zvo may allocate on this device
    std::string memory_budget_name = "the limit";                // as whoever can raise it knows it, for messages
    DeviceOverrides overrides;                                   // for tests; subgroup_size: enable subgroupSizeControl
    bool debug_utils = false; // VK_EXT_debug_utils is enabled on the instance: objects and passes get names
};

/// A Vulkan device that somebody else owns, with zvo's function table, memory and kernels on it. Not thread safe.
/// The handles must outlive it, and the host waits for the work that uses it before destroying it.
class Device
{
public:
    /// Throws Error{Device} with every reason when the physical device will not do.
    Device(const DeviceHandles& handles, std::span<const EmbeddedKernel> kernels);
    ~Device();
    Device(const Device&) = delete;
    Device& operator=(const Device&) = delete;

    [[nodiscard]] const Functions& fn() const { return m_functions; }
    [[nodiscard]] VkDevice handle() const { return m_handles.device; }
    [[nodiscard]] const DeviceHandles& handles() const { return m_handles; }
    [[nodiscard]] const VkAllocationCallbacks* allocationCallbacks() const { return m_handles.allocation_callbacks; }
    [[nodiscard]] const DeviceReport& report() const { return m_report; }
    [[nodiscard]] const VkPhysicalDeviceLimits& limits() const { return m_limits; }
    [[nodiscard]] MemoryAllocator& memory() { return *m_memory; }
    [[nodiscard]] const MemoryAllocator& memory() const { return *m_memory; }
    [[nodiscard]] KernelCache& kernels() { return *m_kernels; }

    /// Names a Vulkan object for debuggers and validation messages; does nothing without VK_EXT_debug_utils, nor when
    /// the driver cannot.
    void setName(VkObjectType type, std::uint64_t object, const std::string& name) const noexcept;

private:
    DeviceHandles m_handles;
    Functions m_functions;
    DeviceReport m_report;
    VkPhysicalDeviceLimits m_limits{};
    std::unique_ptr<MemoryAllocator> m_memory;
    std::unique_ptr<KernelCache> m_kernels;
};

} // namespace zvo::vk
