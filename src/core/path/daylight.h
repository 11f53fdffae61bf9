// SPDX-License-Identifier: MIT
#pragma once

#include "core/light/environment.h"
#include "core/scene/sky.h"
#include "core/trace/trace.h"

namespace zvo
{

/// The sun of pictures, as strong as primary rays have it, and none below the horizon. to_sun: direction, any length.
inline Sun daylight(const glm::dvec3& to_sun = TraceOptions().to_sun, const glm::dvec3& up = kUp)
{
    return {.direction = to_sun, .irradiance = double{TraceOptions().sun} * sunColor(to_sun, up)};
}

} // namespace zvo
