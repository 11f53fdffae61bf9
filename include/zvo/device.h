// SPDX-License-Identifier: MIT
// What zvo requires of a Vulkan device that a host creates: questions before it is created, and features to enable.
#pragma once

#include "zvo/export.h"

#include <vulkan/vulkan_core.h>

#include <cstdint>
#include <string>
#include <vector>

namespace zvo
{

/// The properties of a physical device that matter to zvo, and the reasons why zvo would refuse it.
struct DeviceReport
{
    VkPhysicalDevice physical_device = VK_NULL_HANDLE;
    std::string name;
    std::string driver;                  // name and version, as the driver states them
    std::string type;                    // "discrete", "integrated", "virtual", "cpu" or "other"
    std::string api_version;             // "1.3.230"
    std::uint32_t subgroup_size = 0;     // the driver's own; kernels may take another (ContextInfo::subgroup_size)
    std::uint64_t memory_bytes = 0;      // largest device-local heap
    std::uint64_t max_buffer_bytes = 0;  // largest buffer, and largest allocation of memory
    std::uint32_t min_subgroup_size = 0; // the smallest subgroup size that a kernel can ask for; 0: none
    std::uint32_t max_subgroup_size = 0;
    std::uint32_t queue_family = 0;         // the compute queue family that zvo would use
    float timestamp_period_ns = 0;          // 0: no timestamps on that queue family
    std::uint32_t timestamp_valid_bits = 0; // of a timestamp on that queue family
    std::vector<std::string> present;       // required and optional features that the device has
    std::vector<std::string> missing;       // required and optional features that it lacks
    std::vector<std::string> reasons;       // why zvo cannot use it; empty: zvo can use it

    [[nodiscard]] bool usable() const { return reasons.empty(); }
};

/// Reports whether zvo can use a physical device, and if not, every reason. Creates nothing, and does not throw for a
/// device that zvo cannot use. instance_api_version: for which Vulkan the instance was created
/// (VkApplicationInfo::apiVersion), which Vulkan cannot be asked; a version before 1.3 is a reason. Throws Error{Usage}
/// for null.
ZVO_API DeviceReport query(PFN_vkGetInstanceProcAddr get_instance_proc_addr, VkInstance instance,
                           VkPhysicalDevice physical_device, std::uint32_t instance_api_version);

/// Features that zvo does not require, but uses where they are enabled. No result depends on them. Ask only for those
/// that are listed in DeviceReport::present.
struct OptionalFeatures
{
    bool pass_times = false;     // hostQueryReset: the device's time of each pass
    bool subgroup_sizes = false; // subgroupSizeControl: kernels in subgroups of a size that the host, or zvo, chooses
                                 // (ContextInfo::subgroup_size)
    bool int64_atomics = false;  // shaderBufferInt64Atomics: fewer atomics where attributes of voxels are summed up
};

/// Storage for the structs that patchFeatures() puts into a VkDeviceCreateInfo. It must stay where it is for as long as
/// the VkDeviceCreateInfo is used, and serves one VkDeviceCreateInfo at a time.
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
    VkPhysicalDeviceShaderAtomicInt64Features shader_atomic_int64{};
};

/// Adds the features that zvo requires, and the optional ones asked for, to what a host is about to give to
/// vkCreateDevice.
///
/// The structs of the host must be a chain that Vulkan allows, which the validation layers check in vkCreateDevice: no
/// struct twice, no VkPhysicalDeviceVulkan12Features or its like beside a struct of one of its features, no
/// pEnabledFeatures beside VkPhysicalDeviceFeatures2; and VK_EXT_buffer_device_address must not be enabled. Then it is
/// one afterwards, too.
///
/// Where the pNext chain has a struct with a feature's member, the member is set, so the chain must be writable.
/// pEnabledFeatures is replaced by a changed copy in storage. For the other features, structs of storage are put in
/// front of the chain: never VkPhysicalDeviceVulkan12Features and its like, which would also decide about features that
/// the host enables through extensions. Structs that zvo does not know are left alone, extensions are never added, and
/// a second call changes nothing.
///
/// Declare info.pNext and info.pEnabledFeatures to zvo. Whether the device supports the features is not checked here:
/// query() tells.
ZVO_API void patchFeatures(VkDeviceCreateInfo& info, FeatureStorage& storage, const OptionalFeatures& optional = {});

/// The same for hosts whose wrapper makes the VkDeviceCreateInfo, of a chain of feature structs and of core features
/// that it lets them set. chain, core: what the wrapper is to get as pNext and as *pEnabledFeatures. core: null: it
/// gives none. Declare both to zvo.
ZVO_API void patchFeatures(const void*& chain, FeatureStorage& storage, VkPhysicalDeviceFeatures* core = nullptr,
                           const OptionalFeatures& optional = {});

} // namespace zvo
