// SPDX-License-Identifier: MIT
#include "demo/world/resolution_ladder.h"

#include <algorithm>
#include <cmath>
#include <string_view>

namespace zvo::demo
{

void ResolutionLadder::add(double scaling_ms)
{
    m_long_count = scaling_ms > kTooLongMs ? m_long_count + 1 : 0;
    const double growth = m_rung == 0 ? 1.0 : kScales[m_rung - 1] / kScales[m_rung];
    const bool has_time = m_rung != 0 && scaling_ms * growth * growth < kShortMs;
    m_short_count = has_time ? m_short_count + 1 : 0;
    if (m_long_count >= kFramesToLower && m_rung + 1 < kScales.size())
    {
        ++m_rung;
        m_long_count = 0;
        m_short_count = 0;
    }
    else if (m_short_count >= kFramesToRaise)
    {
        --m_rung;
        m_long_count = 0;
        m_short_count = 0;
    }
}

double scalingMs(std::span<const vk::PassTime> passes)
{
    constexpr std::array<std::string_view, 6> kScaling = {"trace/",        "path/",           "denoise/",
                                                          "radiance/view", "radiance/direct", "radiance/cones"};
    double ms = 0;
    for (const vk::PassTime& pass : passes)
    {
        const bool scales =
            std::ranges::any_of(kScaling, [&](std::string_view begin) { return pass.name.starts_with(begin); });
        ms += scales && pass.name != "trace/node_paths" ? pass.ms : 0.0;
    }
    return ms;
}

PictureSize scaledSize(PictureSize window, double scale)
{
    const auto edge = [scale](std::uint32_t length)
    { return std::min(length, static_cast<std::uint32_t>(std::max(1.0, std::round(length * scale)))); };
    return {edge(window.width), edge(window.height)};
}

} // namespace zvo::demo
