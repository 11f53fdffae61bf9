// SPDX-License-Identifier: MIT
#include "demo/frame_stats.h"

#include <algorithm>
#include <numeric>

namespace zvo::demo
{

namespace
{

// What finds the hits of primary rays.
bool isPrimary(const std::string& pass)
{
    return pass == "trace/beam" || pass == "trace/primary" || pass == "trace/primary_ranks" || pass == "trace/ranks";
}

} // namespace

void History::add(double value)
{
    if (m_values.size() == kLength)
    {
        m_values.erase(m_values.begin());
    }
    m_values.push_back(static_cast<float>(value));
}

double History::mean() const
{
    const double sum = std::accumulate(m_values.begin(), m_values.end(), 0.0);
    return m_values.empty() ? 0.0 : sum / static_cast<double>(m_values.size());
}

double History::p95() const
{
    if (m_values.empty())
    {
        return 0;
    }
    std::vector<float> sorted = m_values;
    const std::size_t rank = (sorted.size() * 95 + 99) / 100 - 1;
    std::nth_element(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(rank), sorted.end());
    return double{sorted[rank]};
}

void FrameStats::addPasses(std::span<const vk::PassTime> passes, std::uint64_t ray_count)
{
    std::map<std::string, double> times;
    double all_ms = 0;
    double primary_ms = 0;
    for (const vk::PassTime& pass : passes)
    {
        times[pass.name] += pass.ms;
        all_ms += pass.ms;
        primary_ms += isPrimary(pass.name) ? pass.ms : 0.0;
        if (m_passes.try_emplace(pass.name).second)
        {
            m_names.push_back(pass.name);
        }
    }
    for (auto& [name, history] : m_passes)
    {
        const auto found = times.find(name);
        history.add(found != times.end() ? found->second : 0.0);
    }
    m_gpu_ms.add(all_ms);
    if (primary_ms > 0)
    {
        constexpr double kRaysPerMs = 1e3; // of a megaray a second
        m_megarays.add(static_cast<double>(ray_count) / primary_ms / kRaysPerMs);
    }
}

double FrameStats::framesPerSecond() const
{
    constexpr double kMsPerSecond = 1e3;
    const double ms = m_frame_ms.mean();
    return ms > 0 ? kMsPerSecond / ms : 0.0;
}

} // namespace zvo::demo
