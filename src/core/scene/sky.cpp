// SPDX-License-Identifier: MIT
#include "core/scene/sky.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace zvo
{

namespace
{

constexpr double kHigh = 45;     // degrees; the sky of a higher sun has the same colours
constexpr double kLatitude = 45; // degrees north
constexpr double kSunStrength = 2.2;

double smoothstep(double from, double to, double x)
{
    const double t = std::clamp((x - from) / (to - from), 0.0, 1.0);
    return t * t * (3.0 - 2.0 * t);
}

// How much more air the light of a body at this height comes through than that of one at the zenith.
double airMass(double degrees)
{
    const double above = std::max(degrees, 0.0);
    return 1.0 / (std::sin(glm::radians(above)) + 0.50572 * std::pow(above + 6.07995, -1.6364));
}

glm::dvec3 normalized(const glm::dvec3& to_sun, const glm::dvec3& up)
{
    const double length = glm::length(to_sun);
    return length > 0.0 ? to_sun / length : up;
}

// Above the horizon. direction, up: length 1.
double heightOf(const glm::dvec3& direction, const glm::dvec3& up)
{
    return glm::degrees(std::asin(std::clamp(glm::dot(direction, up), -1.0, 1.0)));
}

// How bright the sky is, over that of day.
double brightness(double degrees)
{
    constexpr double kSunset = 0.14;
    constexpr double kFades = 6; // degrees in which dusk loses nine tenths
    if (degrees < 0.0)
    {
        return kSunset * std::pow(10.0, degrees / kFades);
    }
    const double low = 1.0 - std::min(std::sin(glm::radians(degrees)) / std::sin(glm::radians(kHigh)), 1.0);
    return glm::mix(1.0, kSunset, low * low);
}

} // namespace

glm::dmat3 uprightTurn(const glm::dvec3& up)
{
    const double cosine = glm::dot(kUp, up);
    if (cosine <= -1.0)
    {
        return glm::dmat3(1.0, 0.0, 0.0, 0.0, -1.0, 0.0, 0.0, 0.0, -1.0);
    }
    glm::dmat3 turn(1.0);
    for (glm::length_t axis = 0; axis < 3; ++axis)
    {
        glm::dvec3& v = turn[axis];
        v += 2.0 * glm::dot(v, kUp) * up - glm::dot(v, kUp + up) / (1.0 + cosine) * (kUp + up);
    }
    return turn;
}

glm::dvec3 sunColor(const glm::dvec3& to_sun, const glm::dvec3& up)
{
    constexpr glm::dvec3 kHighColor(1.0, 0.93, 0.82);
    constexpr glm::dvec3 kDepth(0.07, 0.165, 0.33); // of the air, by colour
    const double degrees = heightOf(normalized(to_sun, up), up);
    const glm::dvec3 left = glm::exp(-kDepth * std::max(airMass(degrees) - airMass(kHigh), 0.0));
    return smoothstep(-1.0, 1.0, degrees) * kHighColor * left; // the disc goes down
}

gpu::Sky skyOf(const glm::dvec3& to_sun, const glm::dvec3& up)
{
    const glm::dvec3 direction = normalized(to_sun, up);
    const double degrees = heightOf(direction, up);
    const glm::dvec3 sun = sunColor(direction, up);
    const double day = brightness(degrees);
    const double dusk = 1.0 - smoothstep(0.0, 25.0, degrees);
    const double after = smoothstep(0.0, 8.0, -degrees); // sunset
    constexpr glm::dvec3 kNight(0.004, 0.0066, 0.012);

    const glm::dvec3 evening = glm::mix(glm::dvec3(1.1, 0.78, 0.66), glm::dvec3(0.5, 0.7, 1.1), after);
    const glm::dvec3 blue = glm::mix(glm::dvec3(0.16, 0.34, 0.70), glm::dvec3(0.22, 0.38, 0.80), dusk);
    const glm::dvec3 zenith = glm::max(day * blue, kNight);
    const glm::dvec3 horizon = glm::max(day * glm::mix(glm::dvec3(0.72, 0.80, 0.90), evening, dusk), 1.5 * kNight);
    const glm::dvec3 glow = day * glm::mix(glm::dvec3(0.55, 0.52, 0.46), glm::dvec3(9.0, 3.6, 1.0), dusk * dusk);

    // What the ground reflects, and what surfaces receive of the sky, by mixtures that give the day its values.
    const glm::dvec3 sky = 0.5 * (zenith + horizon);
    const glm::dvec3 ground =
        glm::dvec3(0.145, 0.138, 0.13) * (kSunStrength * std::max(glm::dot(direction, up), 0.0) * sun + sky);
    const glm::dvec3 above = glm::dvec3(0.40, 0.48, 0.62) / glm::dvec3(0.44, 0.57, 0.80) * sky;
    const glm::dvec3 below = 0.57 * ground;
    return {gpu::vec3(direction), gpu::vec3(up),     gpu::vec3(sun),   gpu::vec3(zenith), gpu::vec3(horizon),
            gpu::vec3(glow),      gpu::vec3(ground), gpu::vec3(above), gpu::vec3(below)};
}

double daylightExposure(const glm::dvec3& to_sun, const glm::dvec3& up)
{
    constexpr double kPart = 0.6; // of the stops that light loses
    constexpr double kMost = 12;
    constexpr glm::dvec3 kLuminance(0.2126, 0.7152, 0.0722);
    const auto light = [&](const glm::dvec3& direction) {
        return glm::dot(kLuminance,
                        0.5 * kSunStrength * sunColor(direction, up) + glm::dvec3(skyOf(direction, up).above));
    };
    return std::min(std::pow(light(up) / light(to_sun), kPart), kMost);
}

glm::dvec3 sunAtHour(double hour)
{
    const double angle = (hour / 12.0 - 1.0) * std::numbers::pi; // 0 at noon, when it is in the south
    const double latitude = glm::radians(kLatitude);
    return {-std::sin(angle), std::cos(angle) * std::cos(latitude), std::cos(angle) * std::sin(latitude)};
}

double hourOfSun(const glm::dvec3& to_sun)
{
    const double latitude = glm::radians(kLatitude);
    const double towards_noon = to_sun.y * std::cos(latitude) + to_sun.z * std::sin(latitude);
    return 12.0 * (1.0 + std::atan2(-to_sun.x, towards_noon) / std::numbers::pi);
}

} // namespace zvo
