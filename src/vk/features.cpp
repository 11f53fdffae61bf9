// SPDX-License-Identifier: MIT
// Finds and sets features in a host's chain of structs.
#include "vk/features.h"

#include <cassert>

namespace zvo::vk
{

namespace
{

constexpr VkStructureType kCore = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2;
constexpr VkStructureType kVulkan12 = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES;
constexpr VkStructureType kVulkan13 = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES;
constexpr std::size_t kCoreOffset = offsetof(VkPhysicalDeviceFeatures2, features);

#define ZVO_CORE_FEATURE(use, member)                                                                                  \
    {                                                                                                                  \
#member, FeatureUse::use, kCore, kCoreOffset + offsetof(VkPhysicalDeviceFeatures, member), kCore,              \
            kCoreOffset + offsetof(VkPhysicalDeviceFeatures, member)                                                   \
    }
#define ZVO_FEATURE(use, version, member, struct_name, struct_type)                                                    \
    {                                                                                                                  \
#member, FeatureUse::use, kVulkan##version, offsetof(VkPhysicalDeviceVulkan##version##Features, member),       \
            VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_##struct_type##_FEATURES,                                                \
            offsetof(VkPhysicalDevice##struct_name##Features, member)                                                  \
    }
constexpr Feature kFeatures[] = {
    ZVO_CORE_FEATURE(Required, shaderInt64),
    ZVO_FEATURE(Required, 12, bufferDeviceAddress, BufferDeviceAddress, BUFFER_DEVICE_ADDRESS),
    ZVO_FEATURE(Required, 12, scalarBlockLayout, ScalarBlockLayout, SCALAR_BLOCK_LAYOUT),
    ZVO_FEATURE(Required, 13, synchronization2, Synchronization2, SYNCHRONIZATION_2),
    ZVO_FEATURE(Required, 13, maintenance4, Maintenance4, MAINTENANCE_4), // for workgroup sizes by constants
    ZVO_FEATURE(Optional, 12, hostQueryReset, HostQueryReset, HOST_QUERY_RESET),
    ZVO_FEATURE(Optional, 13, subgroupSizeControl, SubgroupSizeControl, SUBGROUP_SIZE_CONTROL),
    ZVO_CORE_FEATURE(Noted, shaderInt16),
    ZVO_FEATURE(Noted, 12, shaderInt8, ShaderFloat16Int8, SHADER_FLOAT16_INT8),
    ZVO_FEATURE(Optional, 12, shaderBufferInt64Atomics, ShaderAtomicInt64, SHADER_ATOMIC_INT64),
    ZVO_FEATURE(Noted, 12, shaderSubgroupExtendedTypes, ShaderSubgroupExtendedTypes, SHADER_SUBGROUP_EXTENDED_TYPES),
};
#undef ZVO_FEATURE
#undef ZVO_CORE_FEATURE

// The struct of that type in a chain, or null.
const VkBaseInStructure* find(const void* chain, VkStructureType type)
{
    const auto* link = static_cast<const VkBaseInStructure*>(chain);
    while (link != nullptr && link->sType != type)
    {
        link = link->pNext;
    }
    return link;
}

const VkBool32* memberAt(const void* base, std::size_t offset)
{
    return reinterpret_cast<const VkBool32*>(static_cast<const std::byte*>(base) + offset);
}

// The member for a feature in a chain, or null if no struct there has it.
const VkBool32* memberIn(const void* chain, const Feature& feature)
{
    if (const VkBaseInStructure* whole = find(chain, feature.whole))
    {
        return memberAt(whole, feature.whole_offset);
    }
    const VkBaseInStructure* single = find(chain, feature.single);
    return single != nullptr ? memberAt(single, feature.single_offset) : nullptr;
}

const VkBool32* memberIn(const VkPhysicalDeviceFeatures& core, const Feature& feature)
{
    return memberAt(&core, feature.whole_offset - kCoreOffset);
}

bool wants(const OptionalFeatures& optional, const Feature& feature)
{
    return feature.use == FeatureUse::Required || (feature.name == "hostQueryReset" && optional.pass_times) ||
           (feature.name == "subgroupSizeControl" && optional.subgroup_sizes) ||
           (feature.name == "shaderBufferInt64Atomics" && optional.int64_atomics);
}

// Puts a struct of storage, with all features disabled, in front of the chain.
template <typename Struct> void putInFront(VkDeviceCreateInfo& info, Struct& storage, VkStructureType type)
{
    storage = {};
    storage.sType = type;
    storage.pNext = const_cast<void*>(info.pNext);
    info.pNext = &storage;
}

void putInFront(VkDeviceCreateInfo& info, FeatureStorage& storage, VkStructureType type)
{
    switch (type)
    {
    case kCore:
        return putInFront(info, storage.core, type);
    case VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_BUFFER_DEVICE_ADDRESS_FEATURES:
        return putInFront(info, storage.buffer_device_address, type);
    case VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SCALAR_BLOCK_LAYOUT_FEATURES:
        return putInFront(info, storage.scalar_block_layout, type);
    case VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_HOST_QUERY_RESET_FEATURES:
        return putInFront(info, storage.host_query_reset, type);
    case VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SYNCHRONIZATION_2_FEATURES:
        return putInFront(info, storage.synchronization2, type);
    case VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MAINTENANCE_4_FEATURES:
        return putInFront(info, storage.maintenance4, type);
    case VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SUBGROUP_SIZE_CONTROL_FEATURES:
        return putInFront(info, storage.subgroup_size_control, type);
    case VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SHADER_ATOMIC_INT64_FEATURES:
        return putInFront(info, storage.shader_atomic_int64, type);
    default:
        assert(false && "a feature that wants() wants has a struct in FeatureStorage");
    }
}

void enable(VkDeviceCreateInfo& info, FeatureStorage& storage, const Feature& feature)
{
    const VkBool32* member = nullptr;
    if (feature.whole == kCore && info.pEnabledFeatures != nullptr)
    {
        member = memberIn(*info.pEnabledFeatures, feature);
        if (*member == VK_FALSE) // the host's struct may not be changed
        {
            storage.enabled = *info.pEnabledFeatures;
            info.pEnabledFeatures = &storage.enabled;
            member = memberIn(storage.enabled, feature);
        }
    }
    else
    {
        member = memberIn(info.pNext, feature);
        if (member == nullptr)
        {
            putInFront(info, storage, feature.single);
            member = memberIn(info.pNext, feature);
        }
    }
    if (*member == VK_FALSE) // an enabled one may be in constant memory, and needs no write
    {
        *const_cast<VkBool32*>(member) = VK_TRUE;
    }
}

} // namespace

std::span<const Feature> knownFeatures()
{
    return kFeatures;
}

FeatureChain::FeatureChain()
{
    core.sType = kCore;
    core.pNext = &vulkan12;
    vulkan12.sType = kVulkan12;
    vulkan12.pNext = &vulkan13;
    vulkan13.sType = kVulkan13;
}

VkBool32& FeatureChain::operator[](const Feature& feature)
{
    return const_cast<VkBool32&>(*memberIn(&core, feature));
}

std::vector<std::string> enabledFeatures(const void* chain, const VkPhysicalDeviceFeatures* core)
{
    std::vector<std::string> names;
    for (const Feature& feature : kFeatures)
    {
        const bool in_core = core != nullptr && feature.whole == kCore && *memberIn(*core, feature) == VK_TRUE;
        const VkBool32* member = memberIn(chain, feature);
        if (in_core || (member != nullptr && *member == VK_TRUE))
        {
            names.emplace_back(feature.name);
        }
    }
    return names;
}

} // namespace zvo::vk

namespace zvo
{

void patchFeatures(VkDeviceCreateInfo& info, FeatureStorage& storage, const OptionalFeatures& optional)
{
    for (const vk::Feature& feature : vk::kFeatures)
    {
        if (vk::wants(optional, feature))
        {
            vk::enable(info, storage, feature);
        }
    }
}

void patchFeatures(const void*& chain, FeatureStorage& storage, VkPhysicalDeviceFeatures* core,
                   const OptionalFeatures& optional)
{
    VkDeviceCreateInfo info{};
    info.pNext = chain;
    info.pEnabledFeatures = core;
    patchFeatures(info, storage, optional);
    chain = info.pNext;
    if (core != nullptr)
    {
        *core = *info.pEnabledFeatures;
    }
}

} // namespace zvo
