// SPDX-License-Identifier: MIT
// Motions of whole objects: functions of time, in double precision, that are applied after the object's own transform.
#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <variant>
#include <vector>

namespace zvo
{

/// A steady turn about an axis through a centre. An object that circles but does not spin keeps its orientation. One
/// that spins but does not circle turns about its home, which stays where it is.
struct OrbitMotion
{
    glm::dvec3 center{0.0};         // world units
    glm::dvec3 axis{0.0, 1.0, 0.0}; // length 1
    double turns_per_second = 0.0;  // counterclockwise as seen from where the axis points
    glm::dvec3 home{0.0};           // world position of the object's own origin, before it moves
    bool circles = true;            // home goes around the centre
    bool spins = true;              // the object turns about its home
};

/// A steady move along a line. It takes an object from `from` to `to`, if the object's origin was at the world's
/// origin.
struct LineMotion
{
    glm::dvec3 from{0.0}; // world units
    glm::dvec3 to{0.0};
    double seconds = 1.0; // above 0; after that time the motion begins anew
    bool returns = false; // true: moves back in the second half of that time; false: jumps back at its end
};

/// Key frames. Between two keys, translation and scale are interpolated linearly, the rotation along the shorter arc
/// (slerp). Before the first key and after the last one the object stands still.
struct KeyMotion
{
    std::vector<double> times;            // [keys] seconds, ascending, at least one key
    std::vector<glm::dvec3> translations; // [keys] or empty: no translation
    std::vector<glm::dquat> rotations;    // [keys] or empty: no rotation; length 1
    std::vector<glm::dvec3> scales;       // [keys] or empty: no scale
};

/// The motion of an object; std::monostate: the object stands still.
using Motion = std::variant<std::monostate, OrbitMotion, LineMotion, KeyMotion>;

/// The transform of a motion at a time in seconds, to be applied after the object's own transform: world to world,
/// affine, with (0, 0, 0, 1) as the exact last row. For keys it is translation * rotation * scale.
glm::dmat4 motionAt(const Motion& motion, double seconds);

/// The rotation about an axis of length 1 by turns, counterclockwise as seen from where it points. Quarter turns about
/// x, y or z are exact.
glm::dmat3 rotationAbout(const glm::dvec3& axis, double turns);

/// Where a motion leads: a row of its transforms, close enough together that between two neighbours no point strays
/// farther from the straight line than stray + stray_per_distance * (the point's distance from pivot before the
/// motion).
struct MotionSweep
{
    std::vector<glm::dmat4> transforms; // at least one
    glm::dvec3 pivot{0.0};
    double stray_per_distance = 0.0;
    double stray = 0.0; // world units
};

/// The sweep of a motion from time 0 to `seconds`. A motion along a curve is divided into at least part_count parts.
MotionSweep sweepOf(const Motion& motion, double seconds, std::size_t part_count);

} // namespace zvo
