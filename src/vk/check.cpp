// SPDX-License-Identifier: MIT
#include "vk/check.h"

#include "zvo/error.h"

#include <fmt/format.h>

#include <string_view>

namespace zvo::vk
{

const char* resultName(VkResult result)
{
    switch (result)
    {
#define ZVO_VK_NAME(name)                                                                                              \
    case name:                                                                                                         \
        return #name;
        ZVO_VK_NAME(VK_SUCCESS)
        ZVO_VK_NAME(VK_NOT_READY)
        ZVO_VK_NAME(VK_TIMEOUT)
        ZVO_VK_NAME(VK_INCOMPLETE)
        ZVO_VK_NAME(VK_ERROR_OUT_OF_HOST_MEMORY)
        ZVO_VK_NAME(VK_ERROR_OUT_OF_DEVICE_MEMORY)
        ZVO_VK_NAME(VK_ERROR_INITIALIZATION_FAILED)
        ZVO_VK_NAME(VK_ERROR_DEVICE_LOST)
        ZVO_VK_NAME(VK_ERROR_MEMORY_MAP_FAILED)
        ZVO_VK_NAME(VK_ERROR_LAYER_NOT_PRESENT)
        ZVO_VK_NAME(VK_ERROR_EXTENSION_NOT_PRESENT)
        ZVO_VK_NAME(VK_ERROR_FEATURE_NOT_PRESENT)
        ZVO_VK_NAME(VK_ERROR_INCOMPATIBLE_DRIVER)
        ZVO_VK_NAME(VK_ERROR_TOO_MANY_OBJECTS)
        ZVO_VK_NAME(VK_ERROR_FORMAT_NOT_SUPPORTED)
        ZVO_VK_NAME(VK_ERROR_FRAGMENTED_POOL)
        ZVO_VK_NAME(VK_ERROR_OUT_OF_POOL_MEMORY)
        ZVO_VK_NAME(VK_ERROR_INVALID_EXTERNAL_HANDLE)
        ZVO_VK_NAME(VK_ERROR_FRAGMENTATION)
        ZVO_VK_NAME(VK_ERROR_INVALID_OPAQUE_CAPTURE_ADDRESS)
        ZVO_VK_NAME(VK_ERROR_SURFACE_LOST_KHR)
        ZVO_VK_NAME(VK_ERROR_OUT_OF_DATE_KHR)
#undef ZVO_VK_NAME
    default:
        return "VK_ERROR_UNKNOWN";
    }
}

void throwFailedCall(VkResult result, const char* call, const char* file, int line)
{
    // For "m_device.fn().vkCreateBuffer(...)", the function is vkCreateBuffer.
    std::string_view function = call;
    const std::size_t start = function.find("vk");
    function.remove_prefix(start == std::string_view::npos ? 0 : start);
    function = function.substr(0, function.find('('));

    const bool memory = result == VK_ERROR_OUT_OF_HOST_MEMORY || result == VK_ERROR_OUT_OF_DEVICE_MEMORY;
    const char* advice = "";
    if (memory)
    {
        advice = ": close other programs that use the device, or ask for less";
    }
    else if (result == VK_ERROR_DEVICE_LOST)
    {
        advice = ": the driver stopped the device (a hang, a time limit or an unplugged GPU); restart the program, and "
                 "try a smaller input";
    }
    throw Error(memory ? ErrorCode::Memory : ErrorCode::Other,
                fmt::format("{} failed with {} ({}) at {}:{}{}", function, resultName(result), static_cast<int>(result),
                            file, line, advice));
}

} // namespace zvo::vk
