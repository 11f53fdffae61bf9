// SPDX-License-Identifier: MIT
#pragma once

#ifndef VK_NO_PROTOTYPES
#define VK_NO_PROTOTYPES
#endif
#include <vulkan/vulkan_core.h>

#include <string>

namespace zvo::vk
{

// clang-format off
// The functions that zvo calls on the devices of hosts.
#define ZVO_VK_INSTANCE_FUNCTIONS(X)       \
    X(vkGetDeviceProcAddr)                 \
    X(vkGetPhysicalDeviceFeatures2)        \
    X(vkGetPhysicalDeviceFormatProperties) \
    X(vkGetPhysicalDeviceMemoryProperties) \
    X(vkGetPhysicalDeviceProperties)       \
    X(vkGetPhysicalDeviceProperties2)      \
    X(vkGetPhysicalDeviceQueueFamilyProperties)

#define ZVO_VK_DEVICE_FUNCTIONS(X)   \
    X(vkAllocateDescriptorSets)      \
    X(vkAllocateMemory)              \
    X(vkBindBufferMemory)            \
    X(vkCmdBindDescriptorSets)       \
    X(vkCmdBindPipeline)             \
    X(vkCmdCopyBuffer)               \
    X(vkCmdCopyBufferToImage)        \
    X(vkCmdDispatch)                 \
    X(vkCmdDispatchBase)             \
    X(vkCmdDispatchIndirect)         \
    X(vkCmdFillBuffer)               \
    X(vkCmdPipelineBarrier2)         \
    X(vkCmdPushConstants)            \
    X(vkCmdUpdateBuffer)             \
    X(vkCmdWriteTimestamp2)          \
    X(vkCreateBuffer)                \
    X(vkCreateBufferView)            \
    X(vkCreateComputePipelines)      \
    X(vkCreateDescriptorPool)        \
    X(vkCreateDescriptorSetLayout)   \
    X(vkCreatePipelineLayout)        \
    X(vkCreateQueryPool)             \
    X(vkCreateShaderModule)          \
    X(vkDestroyBuffer)               \
    X(vkDestroyBufferView)           \
    X(vkDestroyDescriptorPool)       \
    X(vkDestroyDescriptorSetLayout)  \
    X(vkDestroyPipeline)             \
    X(vkDestroyPipelineLayout)       \
    X(vkDestroyQueryPool)            \
    X(vkDestroyShaderModule)         \
    X(vkFreeDescriptorSets)          \
    X(vkFreeMemory)                  \
    X(vkGetBufferDeviceAddress)      \
    X(vkGetBufferMemoryRequirements) \
    X(vkGetQueryPoolResults)         \
    X(vkMapMemory)                   \
    X(vkResetQueryPool)              \
    X(vkUpdateDescriptorSets)

// Functions of VK_EXT_debug_utils: null if the instance does not have it.
#define ZVO_VK_DEBUG_FUNCTIONS(X)   \
    X(vkCmdBeginDebugUtilsLabelEXT) \
    X(vkCmdEndDebugUtilsLabelEXT)   \
    X(vkSetDebugUtilsObjectNameEXT)

// Functions only for owners of an instance and a device (vk/owner_functions.h): zvo itself neither submits nor waits.
#define ZVO_VK_OWNER_INSTANCE_FUNCTIONS(X)  \
    X(vkCreateDevice)                       \
    X(vkDestroyInstance)                    \
    X(vkEnumerateDeviceExtensionProperties) \
    X(vkEnumeratePhysicalDevices)

#define ZVO_VK_OWNER_DEVICE_FUNCTIONS(X) \
    X(vkAllocateCommandBuffers)          \
    X(vkBeginCommandBuffer)              \
    X(vkBindImageMemory)                 \
    X(vkCreateCommandPool)               \
    X(vkCreateFence)                     \
    X(vkCreateImage)                     \
    X(vkCreateImageView)                 \
    X(vkCreatePipelineCache)             \
    X(vkDestroyCommandPool)              \
    X(vkDestroyDevice)                   \
    X(vkDestroyFence)                    \
    X(vkDestroyImage)                    \
    X(vkDestroyImageView)                \
    X(vkDestroyPipelineCache)            \
    X(vkDeviceWaitIdle)                  \
    X(vkEndCommandBuffer)                \
    X(vkGetDeviceQueue)                  \
    X(vkGetImageMemoryRequirements)      \
    X(vkGetPipelineCacheData)            \
    X(vkQueueSubmit2)                    \
    X(vkResetCommandPool)                \
    X(vkResetFences)                     \
    X(vkWaitForFences)

// Like ZVO_VK_DEBUG_FUNCTIONS.
#define ZVO_VK_OWNER_DEBUG_FUNCTIONS(X) \
    X(vkCreateDebugUtilsMessengerEXT)   \
    X(vkDestroyDebugUtilsMessengerEXT)

// Functions for windows and for drawing in them: null if the instance has no surfaces or the device no swapchains.
#define ZVO_VK_WINDOW_INSTANCE_FUNCTIONS(X)      \
    X(vkDestroySurfaceKHR)                       \
    X(vkGetPhysicalDeviceSurfaceCapabilitiesKHR) \
    X(vkGetPhysicalDeviceSurfaceFormatsKHR)      \
    X(vkGetPhysicalDeviceSurfacePresentModesKHR) \
    X(vkGetPhysicalDeviceSurfaceSupportKHR)

#define ZVO_VK_WINDOW_DEVICE_FUNCTIONS(X) \
    X(vkAcquireNextImageKHR)              \
    X(vkCmdBeginRenderPass)               \
    X(vkCmdBlitImage)                     \
    X(vkCmdCopyImageToBuffer)             \
    X(vkCmdEndRenderPass)                 \
    X(vkCreateFramebuffer)                \
    X(vkCreateRenderPass)                 \
    X(vkCreateSemaphore)                  \
    X(vkCreateSwapchainKHR)               \
    X(vkDestroyFramebuffer)               \
    X(vkDestroyRenderPass)                \
    X(vkDestroySemaphore)                 \
    X(vkDestroySwapchainKHR)              \
    X(vkGetSwapchainImagesKHR)            \
    X(vkQueuePresentKHR)
// clang-format on

/// The Vulkan functions of one instance and one device. Every context has its own table: nothing is global, so that two
/// devices work in one process and calls go to the driver without the loader's trampoline.
struct Functions
{
    /// Loads the instance functions that zvo calls. Those that the instance lacks stay null, as do all others.
    static Functions ofInstance(PFN_vkGetInstanceProcAddr get_instance_proc_addr, VkInstance instance);

    /// Loads the functions of an instance and a device that zvo calls. Throws Error{Device} naming those that are
    /// missing.
    static Functions ofDevice(PFN_vkGetInstanceProcAddr get_instance_proc_addr, VkInstance instance, VkDevice device);

    PFN_vkGetInstanceProcAddr vkGetInstanceProcAddr = nullptr;
#define ZVO_VK_MEMBER(name) PFN_##name name = nullptr;
    ZVO_VK_INSTANCE_FUNCTIONS(ZVO_VK_MEMBER)
    ZVO_VK_DEVICE_FUNCTIONS(ZVO_VK_MEMBER)
    ZVO_VK_DEBUG_FUNCTIONS(ZVO_VK_MEMBER)
    ZVO_VK_OWNER_INSTANCE_FUNCTIONS(ZVO_VK_MEMBER)
    ZVO_VK_OWNER_DEVICE_FUNCTIONS(ZVO_VK_MEMBER)
    ZVO_VK_OWNER_DEBUG_FUNCTIONS(ZVO_VK_MEMBER)
    ZVO_VK_WINDOW_INSTANCE_FUNCTIONS(ZVO_VK_MEMBER)
    ZVO_VK_WINDOW_DEVICE_FUNCTIONS(ZVO_VK_MEMBER)
#undef ZVO_VK_MEMBER
};

/// Throws Error{Device} if `missing` is not empty. missing: names, each with a space before it.
void requireFunctions(const std::string& missing);

} // namespace zvo::vk
