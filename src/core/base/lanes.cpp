// SPDX-License-Identifier: MIT
#include "core/base/lanes.h"

#include "core/base/tuning.h"

#include <algorithm>
#include <bit>

namespace zvo
{

std::uint32_t lanesMax(const vk::Device& device)
{
    const VkPhysicalDeviceLimits& limits = device.limits();
    return std::bit_floor(std::min(limits.maxComputeWorkGroupInvocations, limits.maxComputeWorkGroupSize[0])) /
           kLoneNodes;
}

std::uint32_t lanesOn(const vk::Device& device)
{
    return std::min(tunedValue(device, Tunable::NodeLanes), lanesMax(device));
}

std::uint32_t lanesOn(const vk::Device& device, std::uint64_t node_count)
{
    constexpr std::uint64_t kThreadsMax = 1ULL << 32;
    return node_count * lanesOn(device) <= kThreadsMax ? lanesOn(device) : 1;
}

std::uint32_t loneGroupOn(const vk::Device& device)
{
    return kLoneNodes * lanesOn(device);
}

std::uint32_t beamLanesMax(const vk::Device& device)
{
    const vk::DeviceReport& report = device.report();
    const bool varies = device.requiredSubgroupSize() == 0 && report.min_subgroup_size != 0;
    return std::bit_floor(varies ? report.min_subgroup_size : report.subgroup_size);
}

std::uint32_t beamLanesOn(const vk::Device& device)
{
    return std::min(tunedValue(device, Tunable::BeamLanes), beamLanesMax(device));
}

} // namespace zvo
