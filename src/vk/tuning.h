// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>

namespace zvo::vk
{

/// Values that the owner of a device chooses for it, by name, in place of zvo's own (core/base/tuning.h).
using TuningValues = std::map<std::string, std::uint32_t, std::less<>>;

/// The name of the value that makes every kernel run in subgroups of so many threads. 0: zvo's choice, which is the
/// driver's, but 32 where the driver would take more and the device can choose.
inline constexpr const char* kSubgroupSizeName = "subgroup-size";

/// The name of the value that says how kernels reach their buffers: a LoadForm.
inline constexpr const char* kLoadsName = "loads";

enum class LoadForm : std::uint8_t
{
    Addresses,  ///< all by their addresses; zvo's choice
    Descriptors ///< some through descriptors, in kernels that have that form (lib/bound.glsl)
};

} // namespace zvo::vk
