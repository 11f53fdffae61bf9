// SPDX-License-Identifier: MIT
#include "core/base/tuning.h"

#include "zvo/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <vector>

namespace zvo
{

namespace
{

constexpr TuningValue kNodeLanes[] = {{"1", 1}, {"2", 2}, {"4", 4}, {"8", 8}, {"16", 16}};
constexpr TuningValue kBeamLanes[] = {{"1", 1}, {"2", 2}, {"4", 4}, {"8", 8}, {"16", 16}};
constexpr TuningValue kBlockLanes[] = {{"1", 1}, {"2", 2}, {"4", 4}, {"8", 8}, {"16", 16}, {"32", 32}};
constexpr TuningValue kBrickLanes[] = {{"2", 2}, {"4", 4}, {"8", 8}};
constexpr TuningValue kBandLanes[] = {{"8", 8}, {"16", 16}, {"32", 32}, {"64", 64}};
constexpr TuningValue kSwitches[] = {{"off", 0}, {"on", 1}};
constexpr TuningValue kPathForms[] = {{"stages", 0}, {"kernel", 1}};
constexpr TuningValue kSubgroupSizes[] = {{"auto", 0}, {"4", 4},   {"8", 8},    {"16", 16},
                                          {"32", 32},  {"64", 64}, {"128", 128}};

constexpr TuningValue kLoads[] = {{"auto", static_cast<std::uint32_t>(vk::LoadForm::Auto)},
                                  {"addresses", static_cast<std::uint32_t>(vk::LoadForm::Addresses)},
                                  {"atomics", static_cast<std::uint32_t>(vk::LoadForm::Atomics)},
                                  {"descriptors", static_cast<std::uint32_t>(vk::LoadForm::Descriptors)}};

// A GPU wants many short threads: the slowest one sets a pass's time. On software devices idle threads and barriers
// cost as much as others, and threads share what they compute of a triangle. Measured on an H100: docs/performance.md.
constexpr std::array<TuningRow, 9> kTable = {{
    {Tunable::NodeLanes, "node-lanes", "threads that share a node", 1, 4, kNodeLanes},
    {Tunable::BlockLanes, "block-lanes", "threads that share a block of a large triangle", 1, 16, kBlockLanes},
    {Tunable::BrickLanes, "brick-lanes", "threads that share the leaves of a brick", 2, 8, kBrickLanes},
    {Tunable::MixedSums, "mixed-sums", "sums of voxels with several fragments alone", 1, 1, kSwitches},
    {Tunable::PathForm, "path-form", "paths in stages, or whole in one kernel", 0, 1, kPathForms},
    {Tunable::BeamLanes, "beam-lanes", "threads that share a beam", 1, 4, kBeamLanes},
    {Tunable::BandLanes, "band-lanes", "threads that measure distances to a piece of a triangle", 8, 32, kBandLanes},
    {Tunable::SubgroupSize, vk::kSubgroupSizeName, "threads of a subgroup", 0, 0, kSubgroupSizes},
    {Tunable::Loads, vk::kLoadsName, "how kernels that have both forms reach their buffers", 0, 0, kLoads},
}};

template <typename Named> std::string namesOf(std::span<const Named> all)
{
    std::vector<std::string_view> names;
    for (const Named& one : all)
    {
        names.push_back(one.name);
    }
    return fmt::format("{}", fmt::join(names, ", "));
}

} // namespace

std::span<const TuningRow> tuningTable()
{
    return kTable;
}

const TuningRow& tuningRow(Tunable tunable)
{
    return kTable[static_cast<std::size_t>(tunable)];
}

std::uint32_t tunedValue(std::string_view device_type, Tunable tunable)
{
    const TuningRow& row = tuningRow(tunable);
    return device_type == "cpu" ? row.on_software : row.on_gpus;
}

std::uint32_t tunedValue(const vk::Device& device, Tunable tunable)
{
    const vk::TuningValues& chosen = device.handles().tuning;
    const auto found = chosen.find(tuningRow(tunable).name);
    return found != chosen.end() ? found->second : tunedValue(device.report().type, tunable);
}

std::string_view valueName(const TuningRow& row, std::uint32_t value)
{
    const auto found = std::ranges::find(row.values, value, &TuningValue::value);
    if (found == row.values.end())
    {
        throw Error(ErrorCode::Usage, fmt::format("{} {}: expected one of {}", row.name, value, namesOf(row.values)));
    }
    return found->name;
}

vk::TuningValues parseTuning(std::string_view option, std::string_view text)
{
    vk::TuningValues values;
    for (bool ends = text.empty(); !ends;)
    {
        const std::string_view part = text.substr(0, text.find(','));
        ends = part.size() == text.size();
        text.remove_prefix(ends ? part.size() : part.size() + 1);
        const std::string_view name = part.substr(0, part.find('='));
        const auto row = std::ranges::find(kTable, name, &TuningRow::name);
        if (row == kTable.end() || name.size() == part.size())
        {
            throw Error(ErrorCode::Usage, fmt::format("{} {}: expected NAME=VALUE, with one of {}", option, part,
                                                      namesOf(tuningTable())));
        }
        const auto value = std::ranges::find(row->values, part.substr(name.size() + 1), &TuningValue::name);
        if (value == row->values.end())
        {
            throw Error(ErrorCode::Usage, fmt::format("{} {}: expected one of {}", option, part, namesOf(row->values)));
        }
        if (!values.emplace(name, value->value).second)
        {
            throw Error(ErrorCode::Usage, fmt::format("{} {}: {} was given before", option, part, name));
        }
    }
    return values;
}

std::string tuningText(const vk::TuningValues& values)
{
    std::vector<std::string> parts;
    for (const TuningRow& row : kTable)
    {
        if (const auto found = values.find(row.name); found != values.end())
        {
            parts.push_back(fmt::format("{}={}", row.name, valueName(row, found->second)));
        }
    }
    return fmt::format("{}", fmt::join(parts, ","));
}

} // namespace zvo
