// SPDX-License-Identifier: MIT
#pragma once

#include "vk/functions.h"
#include "zvo/device.h"

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace zvo::vk
{

/// How zvo uses a Vulkan feature.
enum class FeatureUse
{
    Required,
    Optional, ///< used where it is enabled; see OptionalFeatures
    Noted     ///< only reported; not used so far
};

/// A feature, and where its VkBool32 stands in Vulkan's structs.
struct Feature
{
    std::string_view name;
    FeatureUse use;
    VkStructureType whole;     // the struct with all features of its Vulkan version
    std::size_t whole_offset;  // bytes
    VkStructureType single;    // the struct with this feature; VkPhysicalDeviceFeatures2 has only one
    std::size_t single_offset; // bytes
};

/// All features that zvo knows of.
std::span<const Feature> knownFeatures();

/// The feature structs of Vulkan versions that have features known to zvo, chained.
struct FeatureChain
{
    FeatureChain();
    FeatureChain(const FeatureChain&) = delete;
    FeatureChain& operator=(const FeatureChain&) = delete;

    VkBool32& operator[](const Feature& feature);

    VkPhysicalDeviceFeatures2 core{};
    VkPhysicalDeviceVulkan12Features vulkan12{};
    VkPhysicalDeviceVulkan13Features vulkan13{};
};

/// The names of the known features that a host enables, in the order of knownFeatures(): chain and core are
/// VkDeviceCreateInfo's pNext and pEnabledFeatures; either may be null.
std::vector<std::string> enabledFeatures(const void* chain, const VkPhysicalDeviceFeatures* core);

} // namespace zvo::vk
