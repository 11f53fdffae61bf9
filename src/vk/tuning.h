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

/// Kernels that have a bound form (lib/bound.glsl) reach some buffers through descriptors in it.
enum class LoadForm : std::uint8_t
{
    Auto,       ///< zvo's choice, usualLoadForm()
    Addresses,  ///< no kernel runs in its bound form
    Atomics,    ///< those do in whose bound form atomics go through descriptors
    Descriptors ///< all do
};

} // namespace zvo::vk
