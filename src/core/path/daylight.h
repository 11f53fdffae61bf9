// SPDX-License-Identifier: MIT
#pragma once

#include "core/light/environment.h"
#include "core/trace/trace.h"

namespace zvo
{

/// The sun of pictures with the simple sky, as strong as primary rays have it. to_sun: direction, any length.
inline Sun daylight(const glm::dvec3& to_sun = TraceOptions().to_sun)
{
    return {.direction = to_sun, .irradiance = double{TraceOptions().sun} * kSunColor};
}

} // namespace zvo
