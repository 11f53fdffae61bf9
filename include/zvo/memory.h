// SPDX-License-Identifier: MIT
// Device memory that a host hands out in place of the driver. Both interfaces have these structs.
#pragma once

#include <vulkan/vulkan_core.h>

/// Memory that zvo asks a host for: a block for many buffers and images, or what one big buffer takes.
typedef struct ZvoMemoryRequest
{
    const char* name; // what it is for; lives for the call
    /// memoryTypeBits names one memory type; if the host refuses the request, zvo asks for the next suitable type. size
    /// and alignment are multiples of VkPhysicalDeviceLimits::bufferImageGranularity, so that the range may lie beside
    /// buffers and images of the host.
    VkMemoryRequirements requirements;
    VkMemoryPropertyFlags required;  // properties that the type has and zvo requires
    VkMemoryPropertyFlags preferred; // properties that zvo prefers, and the type may have
    VkBool32 map;                    // the range must be mapped: the type is visible to the host
    VkBool32 device_address;         // allocate with VK_MEMORY_ALLOCATE_DEVICE_ADDRESS_BIT
} ZvoMemoryRequest;

/// The range that a host hands out for a request, as large as requested.
typedef struct ZvoMemoryRange
{
    VkDeviceMemory memory;
    VkDeviceSize offset; // bytes; a multiple of the request's alignment
    void* mapped;        // host address of the range, mapped until it is released; or null, see ZvoMemoryRequest::map
    void* cookie;        // the host's own
} ZvoMemoryRange;

/// A host's allocator. zvo divides the blocks that it gets into its own small ranges, counts the blocks against its
/// memory budget, and returns each block as it got it. The functions are called on the thread that calls zvo; they must
/// not throw, unwind by longjmp, nor call zvo.
typedef struct ZvoMemoryCallbacks
{
    void* user;
    /// Fills range and returns VK_SUCCESS. After VK_ERROR_OUT_OF_DEVICE_MEMORY or VK_ERROR_OUT_OF_HOST_MEMORY zvo asks
    /// for less, or for another type, and in the end fails for lack of memory. A null pointer: zvo asks the driver.
    VkResult (*allocate)(void* user, const ZvoMemoryRequest* request, ZvoMemoryRange* range);
    /// Tells that nothing uses the range any more. Must not be null where allocate is not.
    void (*release)(void* user, const ZvoMemoryRange* range);
} ZvoMemoryCallbacks;

#ifdef __cplusplus

namespace zvo
{

// Structs of C: members have no defaults, so begin with {}.
using MemoryRequest = ZvoMemoryRequest;
using MemoryRange = ZvoMemoryRange;
using MemoryCallbacks = ZvoMemoryCallbacks;

} // namespace zvo

#endif
