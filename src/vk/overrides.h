// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace zvo::vk
{

/// Makes a device look less capable than it is, or like one of another type, so that tests meet the limits of other
/// devices and the kernels that run there. Never raises a limit.
struct DeviceOverrides
{
    std::uint64_t max_buffer_bytes = UINT64_MAX;                                       // maxBufferSize
    std::uint64_t max_allocation_bytes = UINT64_MAX;                                   // maxMemoryAllocationSize
    std::array<std::uint32_t, 3> max_group_counts{UINT32_MAX, UINT32_MAX, UINT32_MAX}; // maxComputeWorkGroupCount
    std::uint32_t max_texel_elements = UINT32_MAX;                                     // maxTexelBufferElements
    std::vector<std::string> features; // treated as missing, by their names in DeviceReport
    std::string type;                  // DeviceReport::type; empty: as the device says
    std::uint64_t buffer_slack = 0;    // extra bytes at the end of every VkBuffer
};

} // namespace zvo::vk
