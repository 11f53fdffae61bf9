// SPDX-License-Identifier: MIT
// Places of objects, as scene files and edit scripts write them (docs/input.md).
#pragma once

#include "io/file/json_cursor.h"
#include "io/scene/load_scene.h"

namespace zvo
{

inline constexpr double kDegreesOfTurn = 360.0;

/// An axis with a number of turns about it.
struct Rotation
{
    glm::dvec3 axis{0.0, 1.0, 0.0};
    double turns = 0.0;
};

/// Where an object is, which is scaled, then turned, then moved.
struct Place
{
    glm::dvec3 translation{0.0};
    glm::dmat3 linear{1.0}; // rotation * scale

    /// The transform of a scene whose files have that axis up.
    [[nodiscard]] glm::dmat4 transform(UpAxis up) const;
};

/// Read what JSON says. Throw as JsonCursor.
Rotation readRotation(const JsonCursor& rotation);
glm::dvec3 readScale(const JsonCursor& scale);
Place readPlace(const JsonCursor& json);
UpAxis readUpAxis(const JsonCursor& up);

} // namespace zvo
