// SPDX-License-Identifier: MIT
#include "demo/panels/frame_stats.h"

#include <algorithm>
#include <numeric>

namespace zvo::demo
{

namespace
{

// Whether a pass takes part in finding the hits of primary rays.
bool isPrimary(const std::string& pass)
{
    return pass == "trace/beam" || pass == "trace/primary" || pass == "trace/primary_ranks" || pass == "trace/ranks";
}

// Whether a pass takes part in following paths, up to the sums of their light.
bool isOfPaths(const std::string& pass)
{
    const bool develops = pass == "path/meter" || pass == "path/expose" || pass == "path/develop";
    return pass == "trace/rays" || pass == "trace/ranks" || (operationOf(pass) == "path" && !develops);
}

// Adds a frame to histories. Entries that the frame lacks get 0.
void addFrameTo(std::map<std::string, History>& histories, std::vector<std::string>& names,
                const std::map<std::string, double>& times, const std::vector<std::string>& in_order)
{
    for (const std::string& name : in_order)
    {
        if (histories.try_emplace(name).second)
        {
            names.push_back(name);
        }
    }
    for (auto& [name, history] : histories)
    {
        const auto found = times.find(name);
        history.add(found != times.end() ? found->second : 0.0);
    }
}

} // namespace

std::string operationOf(std::string_view pass)
{
    const std::size_t slash = pass.rfind('/');
    if (slash == std::string_view::npos)
    {
        return "other";
    }
    const std::size_t space = pass.rfind(' ', slash);
    const std::size_t first = space == std::string_view::npos ? 0 : space + 1;
    return std::string(pass.substr(first, slash - first));
}

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

void FrameStats::addPasses(std::span<const vk::PassTime> passes, const RaysOfFrame& rays)
{
    std::map<std::string, double> times;
    std::map<std::string, double> operation_times;
    std::vector<std::string> names;
    std::vector<std::string> operations;
    double all_ms = 0;
    double tracing_ms = 0;
    for (const vk::PassTime& pass : passes)
    {
        times[pass.name] += pass.ms;
        all_ms += pass.ms;
        const bool traces = rays.integrator == Integrator::Path ? isOfPaths(pass.name) : isPrimary(pass.name);
        tracing_ms += traces ? pass.ms : 0.0;
        names.push_back(pass.name);
        operations.push_back(operationOf(pass.name));
        operation_times[operations.back()] += pass.ms;
    }
    addFrameTo(m_passes, m_names, times, names);
    addFrameTo(m_operations, m_operation_names, operation_times, operations);
    m_gpu_ms.add(all_ms);
    if (m_integrator != rays.integrator)
    {
        m_integrator = rays.integrator;
        m_megarays = {};
    }
    if (tracing_ms > 0)
    {
        constexpr double kRaysPerMs = 1e3; // rays in a millisecond, for a megaray a second
        m_megarays.add(static_cast<double>(rays.count) / tracing_ms / kRaysPerMs);
    }
}

double FrameStats::framesPerSecond() const
{
    constexpr double kMsPerSecond = 1e3;
    const double ms = m_frame_ms.mean();
    return ms > 0 ? kMsPerSecond / ms : 0.0;
}

} // namespace zvo::demo
