// SPDX-License-Identifier: MIT
// What zvo chooses by device: forms and sizes of kernels that give the same results, of which one suits GPUs and
// another software devices. All of these choices stand in one table, which the owner of a device can overrule
// (vk::DeviceHandles::tuning) and `zvo-bench tune` measures.
#pragma once

#include "vk/device.h"
#include "vk/tuning.h"

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace zvo
{

enum class Tunable : std::uint8_t
{
    NodeLanes,
    BlockLanes,
    BrickLanes,
    MixedSums,
    PathForm,
    BeamLanes,
    BandLanes,
    SubgroupSize,
    Loads
};

/// A value that a choice can have, with its name: a number or a word.
struct TuningValue
{
    std::string_view name;
    std::uint32_t value;
};

/// One choice. What it means in detail stands where it is used.
struct TuningRow
{
    Tunable tunable;
    std::string_view name;
    std::string_view meaning;
    std::uint32_t on_software; // of devices that run threads one after the other, and skip no branch
    std::uint32_t on_gpus;
    std::span<const TuningValue> values; // all possible ones
};

/// All choices, in the order of Tunable.
std::span<const TuningRow> tuningTable();

const TuningRow& tuningRow(Tunable tunable);

/// The value for this device: its owner's, or the table's for devices of its type.
std::uint32_t tunedValue(const vk::Device& device, Tunable tunable);

/// The table's value for devices of this type, as in vk::DeviceReport::type.
std::uint32_t tunedValue(std::string_view device_type, Tunable tunable);

/// The name of a value of a choice. Throws Error{Usage} if the choice cannot have it.
std::string_view valueName(const TuningRow& row, std::uint32_t value);

/// Reads `NAME=VALUE,...`; empty text gives none. Throws Error{Usage}, beginning with `option`, for unknown names and
/// values, which the message lists, and for names that come twice.
vk::TuningValues parseTuning(std::string_view option, std::string_view text);

/// The same text for values. Throws as valueName().
std::string tuningText(const vk::TuningValues& values);

} // namespace zvo
