// SPDX-License-Identifier: MIT
// A Vulkan in which one chosen call fails, and which knows what was created and not destroyed.
#pragma once

#include "vk/functions.h"

#include <cstdint>
#include <string>
#include <vector>

namespace zvo::test
{

/// vkGetInstanceProcAddr of the machine's Vulkan behind shims: give it to whatever loads functions. Every function of
/// vk::Functions that returns a VkResult, and those that make an instance, submit or wait, is counted and can fail; the
/// driver does not see a call that fails (but for vkDeviceWaitIdle). One state for the process; not thread safe.
PFN_vkGetInstanceProcAddr failingVulkan();

/// Forgets all counts, and lets the call with this number (from 0 on) fail with result. UINT64_MAX: none of them.
/// From then on everything else works again.
void failCall(std::uint64_t number, VkResult result = VK_ERROR_OUT_OF_DEVICE_MEMORY);

/// The same for calls of the function with this name alone.
void failCallOf(const std::string& function, std::uint64_t number);

/// Lets all calls from the failing one on fail, as on a device that is lost.
void failAllFrom(std::uint64_t number, VkResult result);

/// Whether names of objects count as calls that can fail, as they do at first: work goes on without them.
void countNames(bool counts);

/// Calls that could have failed since failCall().
std::uint64_t fallibleCallCount();

/// Calls of the function with this name among them.
std::uint64_t callCount(const std::string& function);

/// Calls among them that submit or wait (vkQueueSubmit, vkQueueSubmit2, vkQueueWaitIdle, vkDeviceWaitIdle,
/// vkWaitForFences, vkWaitSemaphores): recording into a host's command buffer makes none.
std::uint64_t submitOrWaitCount();

/// Name of the function that was made to fail; empty while none was.
std::string failedFunction();

/// Objects that were created through the shims and not destroyed, as "vkCreateBuffer" and so on: one for each. Memory
/// counts as an object.
std::vector<std::string> liveObjects();

} // namespace zvo::test
