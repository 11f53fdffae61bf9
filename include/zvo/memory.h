// SPDX-License-Identifier: MIT
// Device memory that a host hands out in place of the driver.
#pragma once

#include <vulkan/vulkan_core.h>

namespace zvo
{

/// Memory that zvo asks a host for: a block for many buffers and images, or what one big buffer takes.
struct MemoryRequest
{
    const char* name; // what it is for; lives for the call
    /// memoryTypeBits names one memory type: where a request is refused, zvo asks for the next one that will do. size
    /// and alignment are multiples of VkPhysicalDeviceLimits::bufferImageGranularity, so that buffers and images may
    /// lie in it beside what is not zvo's.
    VkMemoryRequirements requirements;
    VkMemoryPropertyFlags required;  // that the type has, for want of which zvo could not use it
    VkMemoryPropertyFlags preferred; // that zvo likes, and the type may have
    VkBool32 map;                    // the range must be mapped: the type is visible to the host
    VkBool32 device_address;         // allocate with VK_MEMORY_ALLOCATE_DEVICE_ADDRESS_BIT
};

/// What a host hands out for a request: as many bytes as that asks for.
struct MemoryRange
{
    VkDeviceMemory memory;
    VkDeviceSize offset; // bytes; a multiple of the request's alignment
    void* mapped;        // host address of the range, mapped until it is released; or null, see MemoryRequest::map
    void* cookie;        // the host's own
};

/// A host's allocator. zvo makes its own small ranges in the blocks that it gets, counts them against its memory
/// budget, and returns each as it got it. The functions are called on the thread that calls zvo; they must not throw,
/// nor call zvo.
struct MemoryCallbacks
{
    void* user = nullptr;
    /// Fills range and returns VK_SUCCESS. VK_ERROR_OUT_OF_DEVICE_MEMORY and VK_ERROR_OUT_OF_HOST_MEMORY: zvo tries
    /// less, or another type, and throws Error{Memory} in the end. Null: zvo asks the driver.
    VkResult (*allocate)(void* user, const MemoryRequest* request, MemoryRange* range) = nullptr;
    /// Nothing uses the range any more. May not be null where allocate is not.
    void (*release)(void* user, const MemoryRange* range) = nullptr;
};

} // namespace zvo
