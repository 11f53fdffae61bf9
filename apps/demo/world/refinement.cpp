// SPDX-License-Identifier: MIT
#include "demo/world/refinement.h"

#include <algorithm>
#include <cmath>

namespace zvo::demo
{

void Refinement::show(const PictureState& state, bool moves, double seconds)
{
    if (moves || m_state != state)
    {
        m_state = state;
        m_quiet_seconds = 0;
        m_is_refused = false;
        return;
    }
    m_quiet_seconds += seconds;
}

void Refinement::noteInput(bool changes)
{
    m_quiet_seconds = changes || !isStill() ? 0 : m_quiet_seconds;
}

std::uint32_t Refinement::samplesOf(const FrameOptions& options)
{
    switch (options.shownIntegrator())
    {
    case Integrator::Primary:
        return options.hasSamples() ? kPrimarySamples : 1;
    case Integrator::Path:
        return kPathSamples;
    case Integrator::Cache:
    case Integrator::Cones:
        return kCacheFrames;
    }
    return 1;
}

std::uint32_t Refinement::samplesLike(std::uint32_t samples, double scale)
{
    return static_cast<std::uint32_t>(std::max(1.0, std::ceil(samples * scale * scale)));
}

} // namespace zvo::demo
