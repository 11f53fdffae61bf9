// SPDX-License-Identifier: MIT
#include "core/update/update_budget.h"

#include "core/base/divide_up.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <optional>

namespace zvo
{

namespace
{

struct Sum
{
    double ms = 0;
    double units = 0;
};

// The time of the slice's passes; nothing if it was not measured.
std::optional<double> measuredMs(const UpdateSlice& slice, std::span<const vk::PassTime> passes)
{
    if (slice.first_pass > slice.pass_end || slice.pass_end > passes.size())
    {
        return std::nullopt;
    }
    double ms = 0;
    for (std::size_t i = slice.first_pass; i < slice.pass_end; ++i)
    {
        if (passes[i].ms < 0)
        {
            return std::nullopt;
        }
        ms += passes[i].ms;
    }
    return std::isfinite(ms) ? std::optional(ms) : std::nullopt;
}

// The most units that cost at most ms, of units.
std::uint64_t unitsWithin(double ms, double ms_per_unit, std::uint64_t units)
{
    const double fit = ms / ms_per_unit; // infinite, or not a number, for units that cost nothing
    return fit < static_cast<double>(units) ? static_cast<std::uint64_t>(std::max(fit, 0.0)) : units;
}

} // namespace

std::vector<UpdateSlice> UpdateBudget::plan(std::span<const UpdateStage> stages, UpdateProgress& progress,
                                            double budget_ms) const
{
    const bool bounded = budget_ms > 0;
    double left_ms = budget_ms;
    std::vector<UpdateSlice> slices;
    for (; progress.stage < stages.size(); ++progress.stage, progress.unit = 0)
    {
        const UpdateStage& stage = stages[progress.stage];
        assert(progress.unit <= stage.units);
        const std::uint64_t units = stage.units - progress.unit;
        if (units == 0)
        {
            continue;
        }
        std::uint64_t taken = units;
        if (bounded)
        {
            const std::uint64_t least = stage.divisible ? std::min(units, divideUp(stage.units, kParts)) : units;
            const bool cautious = stage.divisible && !measured(stage.name);
            const double allowed_ms = cautious ? std::min(left_ms, budget_ms / kCaution) : left_ms;
            taken = unitsWithin(allowed_ms, predictMs(stage, 1), units);
            if (taken < least)
            {
                if (!slices.empty())
                {
                    return slices;
                }
                taken = least;
            }
        }
        left_ms -= predictMs(stage, taken);
        slices.push_back({stage.name, progress.stage, progress.unit, taken});
        if (taken != units)
        {
            progress.unit += taken;
            return slices;
        }
    }
    return slices;
}

void UpdateBudget::learn(std::span<const UpdateSlice> slices, std::span<const vk::PassTime> passes)
{
    std::map<std::string, Sum> sums;
    for (const UpdateSlice& slice : slices)
    {
        const std::optional<double> ms = measuredMs(slice, passes);
        if (ms && slice.unit_count != 0)
        {
            Sum& sum = sums[slice.name];
            sum.ms += *ms;
            sum.units += static_cast<double>(slice.unit_count);
        }
    }
    for (const auto& [name, sum] : sums)
    {
        const double now = sum.ms / sum.units;
        const auto [rate, is_new] = m_ms_per_unit.try_emplace(name, now);
        rate->second = std::max(now, rate->second + kFall * (now - rate->second));
    }
}

double UpdateBudget::predictMs(const UpdateStage& stage, std::uint64_t units) const
{
    const auto rate = m_ms_per_unit.find(stage.name);
    return static_cast<double>(units) * (rate != m_ms_per_unit.end() ? rate->second : kGuessMsPerUnit);
}

} // namespace zvo
