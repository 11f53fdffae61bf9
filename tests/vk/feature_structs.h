// SPDX-License-Identifier: MIT
// Structs in which hosts enable features, and what zvo needs of these.
#pragma once

#include "zvo/device.h"

#include <set>
#include <string>

namespace zvo::test
{

/// A struct of this type that enables nothing.
template <typename Struct> Struct typed(VkStructureType type)
{
    Struct structure{};
    structure.sType = type;
    return structure;
}

/// One struct of each type that a host may chain.
struct FeatureStructs
{
    VkPhysicalDeviceFeatures enabled{};
    VkPhysicalDeviceFeatures2 core = typed<VkPhysicalDeviceFeatures2>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2);
    VkPhysicalDeviceVulkan11Features vulkan11 =
        typed<VkPhysicalDeviceVulkan11Features>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_1_FEATURES);
    VkPhysicalDeviceVulkan12Features vulkan12 =
        typed<VkPhysicalDeviceVulkan12Features>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES);
    VkPhysicalDeviceVulkan13Features vulkan13 =
        typed<VkPhysicalDeviceVulkan13Features>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES);
    VkPhysicalDeviceMultiviewFeatures multiview =
        typed<VkPhysicalDeviceMultiviewFeatures>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MULTIVIEW_FEATURES);
    VkPhysicalDeviceBufferDeviceAddressFeatures address = typed<VkPhysicalDeviceBufferDeviceAddressFeatures>(
        VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_BUFFER_DEVICE_ADDRESS_FEATURES);
    VkPhysicalDeviceScalarBlockLayoutFeatures scalar = typed<VkPhysicalDeviceScalarBlockLayoutFeatures>(
        VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SCALAR_BLOCK_LAYOUT_FEATURES);
    VkPhysicalDeviceTimelineSemaphoreFeatures timeline =
        typed<VkPhysicalDeviceTimelineSemaphoreFeatures>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_TIMELINE_SEMAPHORE_FEATURES);
    VkPhysicalDeviceHostQueryResetFeatures query_reset =
        typed<VkPhysicalDeviceHostQueryResetFeatures>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_HOST_QUERY_RESET_FEATURES);
    VkPhysicalDeviceSynchronization2Features synchronization2 =
        typed<VkPhysicalDeviceSynchronization2Features>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SYNCHRONIZATION_2_FEATURES);
    VkPhysicalDeviceMaintenance4Features maintenance4 =
        typed<VkPhysicalDeviceMaintenance4Features>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MAINTENANCE_4_FEATURES);
    VkPhysicalDeviceDynamicRenderingFeatures rendering =
        typed<VkPhysicalDeviceDynamicRenderingFeatures>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DYNAMIC_RENDERING_FEATURES);
    VkPhysicalDeviceSubgroupSizeControlFeatures subgroups = typed<VkPhysicalDeviceSubgroupSizeControlFeatures>(
        VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SUBGROUP_SIZE_CONTROL_FEATURES);
    VkPhysicalDeviceShaderAtomicInt64Features atomics = typed<VkPhysicalDeviceShaderAtomicInt64Features>(
        VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SHADER_ATOMIC_INT64_FEATURES);
    VkPhysicalDeviceCustomBorderColorFeaturesEXT border = typed<VkPhysicalDeviceCustomBorderColorFeaturesEXT>(
        VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_CUSTOM_BORDER_COLOR_FEATURES_EXT);
    VkDevicePrivateDataCreateInfo private_data =
        typed<VkDevicePrivateDataCreateInfo>(VK_STRUCTURE_TYPE_DEVICE_PRIVATE_DATA_CREATE_INFO);
};

/// Appends a struct to the chain.
template <typename Struct> void append(VkDeviceCreateInfo& info, Struct& structure)
{
    const void** end = &info.pNext;
    while (*end != nullptr)
    {
        end = const_cast<const void**>(
            reinterpret_cast<void**>(&static_cast<VkBaseOutStructure*>(const_cast<void*>(*end))->pNext));
    }
    *end = &structure;
}

/// The features that zvo needs.
inline const std::set<std::string> kRequiredFeatures = {"shaderInt64", "bufferDeviceAddress", "scalarBlockLayout",
                                                        "synchronization2", "maintenance4"};

} // namespace zvo::test
