// SPDX-License-Identifier: MIT
#pragma once

#include "demo/input/input_event.h"

#include <glm/glm.hpp>
#include <optional>

namespace zvo::demo
{

/// A direction to the sun by its angles, in degrees.
struct SunAngles
{
    double azimuth = 0;   // from north (-z) by east (+x), 0 to 360
    double elevation = 0; // over the horizon, -90 to 90
};

SunAngles sunAngles(const glm::dvec3& to_sun);
glm::dvec3 toSun(const SunAngles& angles);

/// The mouse as it moves the sun while L is held: right and left turn it around, up and down raise and lower it.
class SunControl
{
public:
    /// Takes an event. Returns whether it has moved the sun. to_sun: any length.
    bool handle(const InputEvent& event, glm::dvec3& to_sun);

    [[nodiscard]] bool isHeld() const { return m_is_held; }

private:
    bool m_is_held = false;
    std::optional<MouseMoveEvent> m_mouse;
};

} // namespace zvo::demo
