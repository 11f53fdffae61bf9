// SPDX-License-Identifier: MIT
// How an object moves as a whole: functions of time that come after its own transform, in double precision.
#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <variant>
#include <vector>

namespace zvo
{

/// Turns steadily about an axis through a centre. An object that circles but does not spin keeps its orientation; one
/// that spins but does not circle stays where it is.
struct OrbitMotion
{
    glm::dvec3 center{0.0};         // world units
    glm::dvec3 axis{0.0, 1.0, 0.0}; // length 1
    double turns_per_second = 0.0;  // counterclockwise as seen from where the axis points
    glm::dvec3 home{0.0};           // world position of the object's own origin, before it moves
    bool circles = true;            // home goes around the centre
    bool spins = true;              // the object turns about its home
};

/// Goes steadily along a line: an object whose origin is at the world's goes from one point to the other.
struct LineMotion
{
    glm::dvec3 from{0.0}; // world units
    glm::dvec3 to{0.0};
    double seconds = 1.0; // above 0; after it the motion begins anew
    bool returns = false; // goes back again in the second half of that time; else it is at its start at once
};

/// Key frames: between two of them a translation and a scale go straight, a rotation along the shorter arc (slerp);
/// before the first and after the last the object stands still.
struct KeyMotion
{
    std::vector<double> times;            // [keys] seconds, ascending, at least one
    std::vector<glm::dvec3> translations; // [keys] or empty: none
    std::vector<glm::dquat> rotations;    // [keys] or empty: none; length 1
    std::vector<glm::dvec3> scales;       // [keys] or empty: none
};

/// std::monostate: stands still.
using Motion = std::variant<std::monostate, OrbitMotion, LineMotion, KeyMotion>;

/// What the motion does at a time (seconds) to an object that has its own transform: world to world, affine, the last
/// row exactly (0, 0, 0, 1). For keys, translation * rotation * scale.
glm::dmat4 motionAt(const Motion& motion, double seconds);

/// The rotation about an axis of length 1 by turns, counterclockwise as seen from where it points. Quarter turns about
/// x, y or z are exact.
glm::dmat3 rotationAbout(const glm::dvec3& axis, double turns);

/// Where a motion leads: between neighbours of its transforms no point strays farther from the straight line than
/// stray + stray_per_distance * (the point's distance from pivot before the motion).
struct MotionSweep
{
    std::vector<glm::dmat4> transforms; // at least one
    glm::dvec3 pivot{0.0};
    double stray_per_distance = 0.0;
    double stray = 0.0; // world units
};

/// The sweep of a motion from 0 to seconds. A motion that bends has step_count steps at least.
MotionSweep sweepOf(const Motion& motion, double seconds, std::size_t step_count);

} // namespace zvo
