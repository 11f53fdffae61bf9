// SPDX-License-Identifier: MIT
#include "vk/slice_planner.h"

#include <algorithm>
#include <cmath>

namespace zvo::vk
{

namespace
{

// The least part of a remembered cost that a cheaper measurement leaves. It falls slowly, as a kernel's cost changes
// with the data.
constexpr double kForgetting = 0.7;

constexpr double kUnitsMax = 4e18; // fits 64 bits

std::uint64_t wholeUnits(double units)
{
    return static_cast<std::uint64_t>(std::clamp(units, 0.0, kUnitsMax));
}

} // namespace

void SlicePlanner::beginRun()
{
    m_pieces.clear(); // a run that threw may have left some
    m_planned_ms = 0;
    m_units = 0;
    for (auto& [key, rate] : m_rates)
    {
        rate.trusted = 0;
        rate.admitted = 0;
    }
}

double SlicePlanner::unitCost(const Rate& rate) const
{
    return rate.ms_per_unit > 0 ? rate.ms_per_unit
                                : m_options.submission_ms / static_cast<double>(kCaution * kFirstUnits);
}

// Units that may be admitted before the next measurement.
std::uint64_t SlicePlanner::cautious(const Rate& rate) const
{
    const std::uint64_t first =
        rate.ms_per_unit > 0 ? wholeUnits(m_options.submission_ms / static_cast<double>(kCaution) / rate.ms_per_unit)
                             : kFirstUnits;
    return std::max({std::uint64_t{1}, first, kCaution * rate.trusted});
}

void SlicePlanner::add(Key key, double units)
{
    const double estimate = units * unitCost(m_rates[key]);
    m_pieces.push_back({key, units, estimate});
    m_planned_ms += estimate;
}

std::uint64_t SlicePlanner::admit(Key key, std::uint64_t units)
{
    Rate& rate = m_rates[key];
    std::uint64_t admitted = units;
    if (m_options.most_units != 0)
    {
        admitted = std::min(units, m_options.most_units - std::min(m_options.most_units, m_units));
    }
    else if (m_options.submission_ms > 0)
    {
        const double cost = unitCost(rate);
        const std::uint64_t in_time = wholeUnits((m_options.submission_ms - m_planned_ms) / cost);
        const std::uint64_t cautious_units = cautious(rate);
        const std::uint64_t wanted = std::min(units, cautious_units);
        const std::uint64_t unmeasured = cautious_units - std::min(cautious_units, rate.admitted);
        // The rest of a submission gets no small piece.
        admitted = m_pieces.empty() ? std::clamp<std::uint64_t>(in_time, 1, wanted)
                                    : (std::min(in_time, unmeasured) >= wanted ? wanted : 0);
    }
    if (admitted != 0)
    {
        add(key, static_cast<double>(admitted));
        rate.admitted += admitted;
        m_units += admitted;
    }
    return admitted;
}

bool SlicePlanner::admitUnseen(Key key, std::uint64_t bound)
{
    Rate& rate = m_rates[key];
    const double units = static_cast<double>(bound) * rate.part_of_bound;
    if (m_options.most_units != 0)
    {
        return false;
    }
    if (m_options.submission_ms > 0)
    {
        const double estimate = units * unitCost(rate);
        const auto unmeasured = static_cast<double>(cautious(rate) - std::min(cautious(rate), rate.admitted));
        if (units > unmeasured || m_planned_ms + estimate > m_options.submission_ms)
        {
            return false;
        }
    }
    add(key, units);
    rate.admitted += wholeUnits(std::ceil(units));
    return true;
}

void SlicePlanner::learnCount(Key key, std::uint64_t bound, std::uint64_t units)
{
    Rate& rate = m_rates[key];
    if (!rate.part_known)
    {
        rate.ms_per_unit = 0; // the rate was measured by the bound, not by the count
    }
    rate.part_known = true;
    rate.part_of_bound = static_cast<double>(std::max<std::uint64_t>(units, 1)) /
                         static_cast<double>(std::max<std::uint64_t>({bound, units, 1}));
}

void SlicePlanner::endSubmission(std::span<const double> pass_ms, double total_ms)
{
    const double scale = m_planned_ms > 0 ? total_ms / m_planned_ms : 0;
    for (std::size_t i = 0; i < m_pieces.size(); ++i)
    {
        const Piece& piece = m_pieces[i];
        Rate& rate = m_rates[piece.key];
        const double ms = i < pass_ms.size() ? pass_ms[i] : piece.estimate_ms * scale;
        if (piece.units > 0)
        {
            rate.ms_per_unit = std::max(ms / piece.units, kForgetting * rate.ms_per_unit);
        }
        rate.trusted = std::max(rate.trusted, wholeUnits(piece.units));
        rate.admitted = 0;
    }
    m_pieces.clear();
    m_planned_ms = 0;
    m_units = 0;
}

} // namespace zvo::vk
