// SPDX-License-Identifier: MIT
// What zvo asks of a Vulkan device that a host creates: before it exists, and when it is created.
#pragma once

#include "zvo/export.h"

#include <vulkan/vulkan_core.h>

#include <cstdint>
#include <string>
#include <vector>

namespace zvo
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

/// Whether zvo can use a physical device, and if not, every reason. Creates nothing, and throws for no device that will
/// not do. The instance must have been created for Vulkan 1.3 (VkApplicationInfo::apiVersion). Throws
/// Error{Usage} for null.
ZVO_API DeviceReport query(PFN_vkGetInstanceProcAddr get_instance_proc_addr, VkInstance instance,
                           VkPhysicalDevice physical_device);

/// Features that zvo does without, and uses where they are enabled. No result depends on them. Ask only for those that
/// are among DeviceReport::present.
struct OptionalFeatures
{
    bool pass_times = false;     // hostQueryReset: the device's time of each pass
    bool subgroup_sizes = false; // subgroupSizeControl: kernels in subgroups of a size that the host chooses
};

/// The structs that patchFeatures() may put into a VkDeviceCreateInfo. They must live where they are for as long as
/// that is used; a storage serves one VkDeviceCreateInfo at a time.
struct FeatureStorage
{
    FeatureStorage() = default;
    FeatureStorage(const FeatureStorage&) = delete;
    FeatureStorage& operator=(const FeatureStorage&) = delete;

    VkPhysicalDeviceFeatures enabled{}; // in place of VkDeviceCreateInfo::pEnabledFeatures
    VkPhysicalDeviceFeatures2 core{};
    VkPhysicalDeviceBufferDeviceAddressFeatures buffer_device_address{};
    VkPhysicalDeviceScalarBlockLayoutFeatures scalar_block_layout{};
    VkPhysicalDeviceHostQueryResetFeatures host_query_reset{};
    VkPhysicalDeviceSynchronization2Features synchronization2{};
    VkPhysicalDeviceMaintenance4Features maintenance4{};
    VkPhysicalDeviceSubgroupSizeControlFeatures subgroup_size_control{};
};

/// Adds the features that zvo requires, and those of optional, to what a host is about to give to vkCreateDevice.
///
/// Where the pNext chain has a struct with a feature's member, that is set (so the chain must be writable); of
/// pEnabledFeatures, a copy in storage takes its place. For the rest, structs of storage are put in front of the chain:
/// never VkPhysicalDeviceVulkan12Features and the like, which would also decide about features that the host enables by
/// extensions. So no mix arises that Vulkan forbids. Structs that zvo does not know are left alone, extensions are
/// never added, and a second call changes nothing.
///
/// Returns what keeps the host's own structs from becoming a legal chain: mixes that Vulkan forbids, such as
/// VkPhysicalDeviceVulkan12Features beside a struct of one of its features, and VK_EXT_buffer_device_address. Then
/// nothing is changed. Empty: done; info.pNext and info.pEnabledFeatures are what to declare to zvo. Whether the device
/// supports the features is not looked at: query() says it.
[[nodiscard]] ZVO_API std::vector<std::string> patchFeatures(VkDeviceCreateInfo& info, FeatureStorage& storage,
                                                             const OptionalFeatures& optional = {});

} // namespace zvo
