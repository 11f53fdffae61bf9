// SPDX-License-Identifier: MIT
#pragma once

#include "vk/features.h"
#include "vk/functions.h"
#include "vk/kernel.h"
#include "vk/memory.h"
#include "vk/overrides.h"
#include "vk/tuning.h"
#include "zvo/device.h"
#include "zvo/log.h"

#include <fmt/core.h>

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace zvo::vk
{

class DescriptorSets;

using zvo::DeviceReport;
using zvo::query;

/// Lowers what report says, and limits, to what overrides allow. Whatever zvo then lacks is added to report's reasons.
void applyOverrides(const DeviceOverrides& overrides, DeviceReport& report, VkPhysicalDeviceLimits& limits);

/// Threads of the largest workgroup that zvo cannot do without; every device has them.
inline constexpr std::uint32_t kGroupThreads = 128;

/// The size of subgroups that zvo's kernels take if nobody chooses one: 32 where the driver would take more and kernels
/// can ask for 32, which leaves each thread twice the registers; else 0, the driver's choice.
std::uint32_t usualSubgroupSize(const DeviceReport& report);

/// How kernels reach their buffers if nobody chooses. Software devices compile atomics on bound buffers to less code
/// than those on addresses; lavapipe of Mesa 22.3 also compiles loads from addresses to loops over the threads of a
/// subgroup. Never Auto.
LoadForm usualLoadForm(const DeviceReport& report);

/// What a host hands over. zvo creates none of these handles and destroys none of them. Vulkan cannot be asked what is
/// enabled, so the host declares it here.
struct DeviceHandles
{
    PFN_vkGetInstanceProcAddr get_instance_proc_addr = nullptr;
    VkInstance instance = VK_NULL_HANDLE;
    VkPhysicalDevice physical_device = VK_NULL_HANDLE;
    VkDevice device = VK_NULL_HANDLE;
    std::uint32_t queue_family = 0;
    std::uint32_t instance_api_version = 0;         // VkApplicationInfo::apiVersion that the instance was created with
    std::vector<std::string> instance_extensions{}; // enabled ones
    std::vector<std::string> device_extensions{};   // likewise
    const void* enabled_features = nullptr;         // VkDeviceCreateInfo::pNext
    const VkPhysicalDeviceFeatures* enabled_core_features = nullptr; // VkDeviceCreateInfo::pEnabledFeatures
    const VkAllocationCallbacks* allocation_callbacks = nullptr;     // may be null; must outlive the Device
    VkPipelineCache pipeline_cache = VK_NULL_HANDLE;                 // may be null
    std::uint64_t memory_budget_bytes = UINT64_MAX;                  // what zvo may allocate on this device
    std::string memory_budget_name = "the limit"; // the limit's name in messages, as known to whoever can raise it
    MemoryCallbacks memory{};                     // for blocks and big buffers; may be empty
    LogCallback log{};                            // may be empty
    TuningValues tuning{};                        // what the owner chooses in place of zvo
    DeviceOverrides overrides{};                  // for tests
    const Functions* functions = nullptr; // functions that an owner has loaded; null: Device loads what zvo calls
};

/// A Vulkan device that somebody else owns, with zvo's function table, memory and kernels on it. Not thread safe.
/// The handles must outlive it, and the host waits for the work that uses it before destroying it.
class Device
{
public:
    /// Reads what the declared features point to, and does not keep it. Throws Error{Usage} for null handles, and
    /// Error{Device} with every reason when zvo cannot use the physical device or a required feature was not enabled.
    Device(const DeviceHandles& handles, std::span<const EmbeddedKernel> kernels);
    ~Device();
    Device(const Device&) = delete;
    Device& operator=(const Device&) = delete;

    [[nodiscard]] const Functions& fn() const { return m_functions; }
    [[nodiscard]] VkDevice handle() const { return m_handles.device; }
    /// What the host handed over. Its feature structs are copies of this Device's own, as far as zvo knows the structs.
    [[nodiscard]] const DeviceHandles& handles() const { return m_handles; }
    [[nodiscard]] const VkAllocationCallbacks* allocationCallbacks() const { return m_handles.allocation_callbacks; }
    [[nodiscard]] const DeviceReport& report() const { return m_report; }

    /// Whether the host has enabled the feature; name: as in report().present.
    [[nodiscard]] bool isEnabled(std::string_view feature) const;

    /// Whether the instance has VK_EXT_debug_utils: objects and passes get names.
    [[nodiscard]] bool hasDebugUtils() const { return m_has_debug_utils; }

    [[nodiscard]] const VkPhysicalDeviceLimits& limits() const { return m_limits; }

    /// The size of subgroups that every kernel requires; 0: none.
    [[nodiscard]] std::uint32_t requiredSubgroupSize() const { return m_required_subgroup_size; }

    /// The capabilities of the queues of DeviceHandles::queue_family.
    [[nodiscard]] VkQueueFlags queueFlags() const { return m_queue_flags; }

    [[nodiscard]] MemoryAllocator& memory() { return *m_memory; }
    [[nodiscard]] const MemoryAllocator& memory() const { return *m_memory; }
    [[nodiscard]] DescriptorSets& descriptors() { return *m_descriptors; }
    [[nodiscard]] KernelCache& kernels() { return *m_kernels; }

    /// Names a Vulkan object for debuggers and validation messages; does nothing without VK_EXT_debug_utils, nor when
    /// the driver cannot.
    void setName(VkObjectType type, std::uint64_t object, const std::string& name) const noexcept;

    /// Sends a message to the host's log, if it has one.
    template <typename... Arguments>
    void log(LogSeverity severity, fmt::format_string<Arguments...> format, Arguments&&... arguments) const noexcept
    {
        if (m_handles.log.function != nullptr)
        {
            logText(severity, format, fmt::make_format_args(arguments...));
        }
    }

private:
    void takeDeclaration();
    void chooseSubgroupSize();
    void limitWorkgroups();
    [[nodiscard]] std::uint32_t tuned(const char* name) const;
    void tellWhatIsMissing() const;
    void logText(LogSeverity severity, fmt::string_view format, fmt::format_args arguments) const noexcept;

    DeviceHandles m_handles;
    Functions m_functions;
    DeviceReport m_report;
    FeatureChain m_features; // features that the host has enabled
    std::vector<std::string> m_enabled;
    bool m_has_debug_utils = false;
    VkPhysicalDeviceLimits m_limits{};
    VkQueueFlags m_queue_flags = 0;
    std::uint32_t m_required_subgroup_size = 0;
    std::unique_ptr<MemoryAllocator> m_memory;
    std::unique_ptr<DescriptorSets> m_descriptors;
    std::unique_ptr<KernelCache> m_kernels;
};

} // namespace zvo::vk
