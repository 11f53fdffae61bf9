// SPDX-License-Identifier: MIT
#pragma once

#include "vk/functions.h"

namespace zvo::vk
{

/// The name of a result, such as "VK_ERROR_DEVICE_LOST".
const char* resultName(VkResult result);

/// Throws zvo::Error for a failed call: Error{Memory} when memory ran out, Error{Other} for the rest. call is the call
/// as it is written in the source; file and line say where.
[[noreturn]] void throwFailedCall(VkResult result, const char* call, const char* file, int line);

} // namespace zvo::vk

/// Throws zvo::Error when a Vulkan call fails (a negative result), in every kind of build.
#define VK_CHECK(call)                                                                                                 \
    do                                                                                                                 \
    {                                                                                                                  \
        const VkResult vk_check_result = (call);                                                                       \
        if (vk_check_result < 0)                                                                                       \
            ::zvo::vk::throwFailedCall(vk_check_result, #call, __FILE_NAME__, __LINE__);                               \
    } while (false)
