// SPDX-License-Identifier: MIT
#pragma once

#include "vk/device.h"

#include <cstdint>

namespace zvo
{

/// The most threads that can share a node on this device.
std::uint32_t lanesMax(const vk::Device& device);

/// Threads that share the work of one node where kernels can share it (kLanes), a power of two: Tunable::NodeLanes,
/// as far as the device's workgroups allow.
std::uint32_t lanesOn(const vk::Device& device);

/// The same for a dispatch over node_count nodes; fewer where it would have more threads than a dispatch can have.
std::uint32_t lanesOn(const vk::Device& device, std::uint64_t node_count);

/// Nodes that a workgroup averages at a time when it has a dispatch to itself.
inline constexpr std::uint32_t kLoneNodes = 64;

/// Threads of a workgroup that has a dispatch to itself: lanesOn() for each of kLoneNodes.
std::uint32_t loneGroupOn(const vk::Device& device);

/// The most threads that can share a beam on this device: those of its smallest subgroup.
std::uint32_t beamLanesMax(const vk::Device& device);

/// Threads that share a beam of trace/beam, a power of two: Tunable::BeamLanes, as far as the device allows.
std::uint32_t beamLanesOn(const vk::Device& device);

} // namespace zvo
