// SPDX-License-Identifier: MIT
#pragma once

#include "shared/sky.h"

#include <glm/glm.hpp>

namespace zvo
{

inline constexpr glm::dvec3 kUp = {0.0, 1.0, 0.0}; // of worlds, unless a host has another one

/// The rotation by the least angle that takes +y to another up (length 1); about x, if that is -y.
glm::dmat3 uprightTurn(const glm::dvec3& up);

/// The colours of the simple sky and of its sun, from day to night. The sun's light is what the air leaves of it (Beer
/// and Lambert's law over the air mass of F. Kasten, A. Young, Revised Optical Air Mass Tables and Approximation
/// Formula, 1989), so a low sun is red; below the horizon there is none. The sky is a fit by eye. to_sun: any length;
/// 0 counts as straight above. up: length 1.
gpu::Sky skyOf(const glm::dvec3& to_sun, const glm::dvec3& up = kUp);

/// Sky::sun, in double precision.
glm::dvec3 sunColor(const glm::dvec3& to_sun, const glm::dvec3& up = kUp);

/// By what factor pictures are made brighter when the sun is low or gone, so that dusk can be seen: 1 by day, and 12 by
/// night at most, when a lit surface is still darker than by day.
double daylightExposure(const glm::dvec3& to_sun, const glm::dvec3& up = kUp);

/// The direction to the sun at an hour of the day, from 0 to 24, at an equinox and 45 degrees north: it rises at 6 in
/// the east (+x), stands 45 degrees high in the south (+z) at 12, and sets at 18 in the west. Length 1.
glm::dvec3 sunAtHour(double hour);

/// The hour at which the sun comes closest to a direction of any length, from 0 to 24.
double hourOfSun(const glm::dvec3& to_sun);

} // namespace zvo
