// SPDX-License-Identifier: MIT
// Reports which physical devices zvo can use, and why it cannot use the others.
#include "vk/device.h"
#include "zvo/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstdlib>
#include <string_view>

namespace zvo::vk
{

namespace
{

constexpr std::uint32_t kApiVersion = VK_API_VERSION_1_3;
constexpr std::uint32_t kPushConstantBytes = 128;  // of the largest kernel parameters
constexpr std::uint32_t kGroupSharedBytes = 16384; // shared memory of the largest workgroup

struct SubgroupOperation
{
    const char* name;
    VkSubgroupFeatureFlagBits bit;
};

constexpr SubgroupOperation kSubgroupOperations[] = {
    {"subgroup basic operations", VK_SUBGROUP_FEATURE_BASIC_BIT},
    {"subgroup arithmetic", VK_SUBGROUP_FEATURE_ARITHMETIC_BIT},
    {"subgroup ballot", VK_SUBGROUP_FEATURE_BALLOT_BIT},
    {"subgroup shuffle", VK_SUBGROUP_FEATURE_SHUFFLE_BIT},
};

std::string versionText(std::uint32_t version)
{
    return fmt::format("{}.{}.{}", VK_API_VERSION_MAJOR(version), VK_API_VERSION_MINOR(version),
                       VK_API_VERSION_PATCH(version));
}

const char* typeText(VkPhysicalDeviceType type)
{
    switch (type)
    {
    case VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU:
        return "discrete";
    case VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU:
        return "integrated";
    case VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU:
        return "virtual";
    case VK_PHYSICAL_DEVICE_TYPE_CPU:
        return "cpu";
    default:
        return "other";
    }
}

void note(DeviceReport& report, const std::string& name, bool present, bool required)
{
    (present ? report.present : report.missing).push_back(name);
    if (!present && required)
    {
        report.reasons.push_back("lacks " + name);
    }
}

void needAtLeast(DeviceReport& report, const char* name, std::uint32_t value, std::uint32_t least)
{
    if (value < least)
    {
        report.reasons.push_back(fmt::format("{} is {}, zvo needs {}", name, value, least));
    }
}

void queryMemory(DeviceReport& report, const Functions& fn)
{
    VkPhysicalDeviceMemoryProperties memory{};
    fn.vkGetPhysicalDeviceMemoryProperties(report.physical_device, &memory);
    for (std::uint32_t heap = 0; heap < memory.memoryHeapCount; ++heap)
    {
        if ((memory.memoryHeaps[heap].flags & VK_MEMORY_HEAP_DEVICE_LOCAL_BIT) != 0)
        {
            report.memory_bytes = std::max<std::uint64_t>(report.memory_bytes, memory.memoryHeaps[heap].size);
        }
    }
}

// The first queue family that supports compute; one with timestamps is preferred.
void queryQueueFamily(DeviceReport& report, const Functions& fn, float timestamp_period_ns)
{
    std::uint32_t count = 0;
    fn.vkGetPhysicalDeviceQueueFamilyProperties(report.physical_device, &count, nullptr);
    std::vector<VkQueueFamilyProperties> families(count);
    fn.vkGetPhysicalDeviceQueueFamilyProperties(report.physical_device, &count, families.data());

    bool found = false;
    for (std::uint32_t i = 0; i < count; ++i)
    {
        const bool computes = (families[i].queueFlags & VK_QUEUE_COMPUTE_BIT) != 0 && families[i].queueCount > 0;
        if (computes && (!found || (report.timestamp_valid_bits == 0 && families[i].timestampValidBits != 0)))
        {
            found = true;
            report.queue_family = i;
            report.timestamp_valid_bits = families[i].timestampValidBits;
        }
    }
    report.timestamp_period_ns = report.timestamp_valid_bits != 0 ? timestamp_period_ns : 0;
    if (!found)
    {
        report.reasons.emplace_back("has no compute queue");
    }
}

void queryFeatures(DeviceReport& report, const Functions& fn)
{
    FeatureChain features;
    fn.vkGetPhysicalDeviceFeatures2(report.physical_device, &features.core);
    for (const Feature& feature : knownFeatures())
    {
        note(report, std::string(feature.name), features[feature] == VK_TRUE, feature.use == FeatureUse::Required);
    }
}

void queryProperties(DeviceReport& report, const Functions& fn)
{
    VkPhysicalDeviceVulkan13Properties properties13{};
    properties13.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_PROPERTIES;
    VkPhysicalDeviceVulkan12Properties properties12{};
    properties12.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_PROPERTIES;
    properties12.pNext = &properties13;
    VkPhysicalDeviceVulkan11Properties properties11{};
    properties11.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_1_PROPERTIES;
    properties11.pNext = &properties12;
    VkPhysicalDeviceProperties2 properties{};
    properties.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2;
    properties.pNext = &properties11;
    fn.vkGetPhysicalDeviceProperties2(report.physical_device, &properties);

    report.driver = fmt::format("{} {}", properties12.driverName, properties12.driverInfo);
    report.subgroup_size = properties11.subgroupSize;
    report.max_buffer_bytes = std::min(properties13.maxBufferSize, properties11.maxMemoryAllocationSize);
    if ((properties13.requiredSubgroupSizeStages & VK_SHADER_STAGE_COMPUTE_BIT) != 0)
    {
        report.min_subgroup_size = properties13.minSubgroupSize;
        report.max_subgroup_size = properties13.maxSubgroupSize;
    }
    const bool in_compute = (properties11.subgroupSupportedStages & VK_SHADER_STAGE_COMPUTE_BIT) != 0;
    for (const SubgroupOperation& operation : kSubgroupOperations)
    {
        note(report, operation.name, in_compute && (properties11.subgroupSupportedOperations & operation.bit) != 0,
             true);
    }
    const VkPhysicalDeviceLimits& limits = properties.properties.limits;
    needAtLeast(report, "maxPushConstantsSize", limits.maxPushConstantsSize, kPushConstantBytes);
    needAtLeast(report, "maxComputeWorkGroupInvocations", limits.maxComputeWorkGroupInvocations, kGroupThreads);
    needAtLeast(report, "maxComputeWorkGroupSize[0]", limits.maxComputeWorkGroupSize[0], kGroupThreads);
    needAtLeast(report, "maxComputeSharedMemorySize", limits.maxComputeSharedMemorySize, kGroupSharedBytes);
}

} // namespace

void applyOverrides(const DeviceOverrides& overrides, DeviceReport& report, VkPhysicalDeviceLimits& limits)
{
    report.max_buffer_bytes =
        std::min({report.max_buffer_bytes, overrides.max_buffer_bytes, overrides.max_allocation_bytes});
    for (std::size_t axis = 0; axis < overrides.max_group_counts.size(); ++axis)
    {
        std::uint32_t& most = limits.maxComputeWorkGroupCount[axis];
        most = std::min(most, overrides.max_group_counts[axis]);
    }
    limits.maxTexelBufferElements = std::min(limits.maxTexelBufferElements, overrides.max_texel_elements);
    for (const std::string& name : overrides.features)
    {
        const auto present = std::find(report.present.begin(), report.present.end(), name);
        const auto feature = std::ranges::find(knownFeatures(), name, &Feature::name);
        if (present != report.present.end())
        {
            report.present.erase(present);
            note(report, name, false, feature == knownFeatures().end() || feature->use == FeatureUse::Required);
        }
    }
    report.type = overrides.type.empty() ? report.type : overrides.type;
}

LoadForm usualLoadForm(const DeviceReport& report)
{
    if (report.type != "cpu")
    {
        return LoadForm::Addresses;
    }
    constexpr std::string_view kLavapipe = "llvmpipe Mesa ";
    // Measured: 22.3 has slow loads, 25.0 has fast ones. What lies between is taken for slow.
    constexpr int kFastLoads = 25;
    const bool is_lavapipe = report.driver.starts_with(kLavapipe);
    const int version = is_lavapipe ? std::atoi(report.driver.c_str() + kLavapipe.size()) : kFastLoads;
    return version < kFastLoads ? LoadForm::Descriptors : LoadForm::Atomics;
}

std::uint32_t usualSubgroupSize(const DeviceReport& report)
{
    constexpr std::uint32_t kMost = 32;
    const bool can_choose = report.min_subgroup_size != 0 && report.min_subgroup_size <= kMost;
    return can_choose && report.subgroup_size > kMost ? kMost : 0;
}

} // namespace zvo::vk

namespace zvo
{

DeviceReport query(PFN_vkGetInstanceProcAddr get_instance_proc_addr, VkInstance instance,
                   VkPhysicalDevice physical_device, std::uint32_t instance_api_version)
{
    if (get_instance_proc_addr == nullptr || instance == VK_NULL_HANDLE || physical_device == VK_NULL_HANDLE)
    {
        throw Error(ErrorCode::Usage, "zvo::query() needs vkGetInstanceProcAddr, a VkInstance and a VkPhysicalDevice: "
                                      "one of them is null");
    }
    DeviceReport report;
    report.physical_device = physical_device;
    const vk::Functions fn = vk::Functions::ofInstance(get_instance_proc_addr, instance);

    VkPhysicalDeviceProperties properties{};
    fn.vkGetPhysicalDeviceProperties(physical_device, &properties);
    report.name = properties.deviceName;
    report.type = vk::typeText(properties.deviceType);
    report.api_version = vk::versionText(properties.apiVersion);
    vk::queryMemory(report, fn);
    vk::queryQueueFamily(report, fn, properties.limits.timestampPeriod);

    if (properties.apiVersion < vk::kApiVersion)
    {
        report.reasons.push_back("supports Vulkan " + report.api_version + " only, zvo needs 1.3");
    }
    if (instance_api_version < vk::kApiVersion)
    {
        report.reasons.push_back(fmt::format(
            "its instance was created for Vulkan {}.{}, zvo needs 1.3 (set VkApplicationInfo::apiVersion, and declare "
            "it)",
            std::max(VK_API_VERSION_MAJOR(instance_api_version), 1U), VK_API_VERSION_MINOR(instance_api_version)));
    }
    if (fn.vkGetPhysicalDeviceFeatures2 != nullptr && fn.vkGetPhysicalDeviceProperties2 != nullptr)
    {
        // Structs that an older driver does not know stay zero, so that their features are reported as missing.
        vk::queryFeatures(report, fn);
        vk::queryProperties(report, fn);
    }
    return report;
}

} // namespace zvo
