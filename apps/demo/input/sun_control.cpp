// SPDX-License-Identifier: MIT
#include "demo/input/sun_control.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <variant>

namespace zvo::demo
{

namespace
{

constexpr double kDegreesOfUnit = 0.25; // of the window

} // namespace

SunAngles sunAngles(const glm::dvec3& to_sun)
{
    const glm::dvec3 direction = glm::normalize(to_sun);
    const double azimuth = glm::degrees(std::atan2(direction.x, -direction.z));
    return {azimuth < 0 ? azimuth + 360 : azimuth, glm::degrees(std::asin(std::clamp(direction.y, -1.0, 1.0)))};
}

glm::dvec3 toSun(const SunAngles& angles)
{
    const double azimuth = glm::radians(angles.azimuth);
    const double elevation = glm::radians(angles.elevation);
    return {std::sin(azimuth) * std::cos(elevation), std::sin(elevation), -std::cos(azimuth) * std::cos(elevation)};
}

bool SunControl::handle(const InputEvent& event, glm::dvec3& to_sun)
{
    if (const auto* const key = std::get_if<KeyEvent>(&event); key != nullptr && key->key == Key::L)
    {
        m_is_held = key->pressed && !key->modifiers.control && !key->modifiers.alt;
    }
    const auto* const move = std::get_if<MouseMoveEvent>(&event);
    if (move == nullptr)
    {
        return false;
    }
    const std::optional<MouseMoveEvent> before = std::exchange(m_mouse, *move);
    if (!m_is_held || !before)
    {
        return false;
    }
    constexpr double kHighest = 89; // straight up there is no azimuth
    SunAngles angles = sunAngles(to_sun);
    angles.azimuth += kDegreesOfUnit * (move->x - before->x);
    angles.elevation = std::clamp(angles.elevation - kDegreesOfUnit * (move->y - before->y), -kHighest, kHighest);
    to_sun = toSun(angles);
    return true;
}

} // namespace zvo::demo
