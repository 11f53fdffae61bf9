// SPDX-License-Identifier: MIT
// A Vulkan in which a chosen call fails. It knows which objects were created and not destroyed.
#pragma once

#include "vk/functions.h"

#include <cstdint>
#include <string>
#include <vector>

namespace zvo::test
{

/// Returns vkGetInstanceProcAddr of the machine's Vulkan behind shims, for whatever loads functions. The shims count
/// calls that can fail: of every function of vk::Functions that returns a VkResult, and of those that make an instance,
/// submit or wait. The driver does not see a call that fails, except vkDeviceWaitIdle. The process has one state; it is
/// not thread safe.
PFN_vkGetInstanceProcAddr failingVulkan();

/// Forgets all counts, and lets the call with this number (from 0 on) fail with result; UINT64_MAX: none. All later
/// calls succeed again.
void failCall(std::uint64_t number, VkResult result = VK_ERROR_OUT_OF_DEVICE_MEMORY);

/// Like failCall(), but numbers only the calls of the function with this name.
void failCallOf(const std::string& function, std::uint64_t number);

/// Lets the call with this number and all later ones fail, as on a lost device.
void failAllFrom(std::uint64_t number, VkResult result);

/// Sets whether calls that name objects can fail and are counted, which is the default. The engine ignores their
/// failures.
void countNames(bool counts);

/// Calls that could have failed since failCall().
std::uint64_t fallibleCallCount();

/// How many of these calls are of the function with this name.
std::uint64_t callCount(const std::string& function);

/// How many of these calls submit or wait (vkQueueSubmit, vkQueueSubmit2, vkQueueWaitIdle, vkDeviceWaitIdle,
/// vkWaitForFences, vkWaitSemaphores). Recording into a host's command buffer makes none.
std::uint64_t submitOrWaitCount();

/// Name of the function whose call failed; empty if none has.
std::string failedFunction();

/// Objects that were created through the shims and not destroyed: for each, the function that made it, such as
/// "vkCreateBuffer". Memory counts as an object.
std::vector<std::string> liveObjects();

} // namespace zvo::test
