// SPDX-License-Identifier: MIT
#include "core/scene/motion.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace zvo
{

namespace
{

constexpr double kTwoPi = 2.0 * std::numbers::pi;

glm::dmat4 affine(const glm::dmat3& linear, const glm::dvec3& translation)
{
    return {glm::dvec4(linear[0], 0.0), glm::dvec4(linear[1], 0.0), glm::dvec4(linear[2], 0.0),
            glm::dvec4(translation, 1.0)};
}

glm::dmat4 orbitAt(const OrbitMotion& orbit, double turns)
{
    const glm::dmat3 rotation = rotationAbout(orbit.axis, turns);
    const glm::dvec3 home = orbit.circles ? orbit.center + rotation * (orbit.home - orbit.center) : orbit.home;
    return orbit.spins ? affine(rotation, home - rotation * orbit.home) : affine(glm::dmat3(1.0), home - orbit.home);
}

glm::dmat4 lineAt(const LineMotion& line, double part)
{
    return affine(glm::dmat3(1.0), (1.0 - part) * line.from + part * line.to);
}

/// A value between two keys.
template <typename T, typename Mix>
T between(const std::vector<T>& keys, std::size_t first, double part, const T& none, const Mix& mix)
{
    return keys.empty() ? none : part == 0.0 ? keys[first] : mix(keys[first], keys[first + 1], part);
}

/// first + part in the numbering of the keys.
glm::dmat4 keysAt(const KeyMotion& keys, std::size_t first, double part)
{
    const auto straight = [](const glm::dvec3& a, const glm::dvec3& b, double t) { return (1.0 - t) * a + t * b; };
    const auto arc = [](const glm::dquat& a, const glm::dquat& b, double t) { return glm::slerp(a, b, t); };
    const glm::dvec3 translation = between(keys.translations, first, part, glm::dvec3(0.0), straight);
    const glm::dquat rotation = between(keys.rotations, first, part, glm::dquat(1.0, 0.0, 0.0, 0.0), arc);
    const glm::dvec3 scale = between(keys.scales, first, part, glm::dvec3(1.0), straight);
    glm::dmat3 linear = glm::mat3_cast(rotation);
    for (int column = 0; column < 3; ++column)
    {
        linear[column] *= scale[column];
    }
    return affine(linear, translation);
}

struct MotionTime
{
    double seconds;

    glm::dmat4 operator()(const std::monostate& /*still*/) const { return glm::dmat4(1.0); }

    glm::dmat4 operator()(const OrbitMotion& orbit) const
    {
        const double turns = orbit.turns_per_second * seconds;
        return orbitAt(orbit, turns - std::floor(turns));
    }

    glm::dmat4 operator()(const LineMotion& line) const
    {
        const double periods = seconds / line.seconds;
        const double part = periods - std::floor(periods);
        return lineAt(line, line.returns ? 1.0 - std::abs(1.0 - 2.0 * part) : part);
    }

    glm::dmat4 operator()(const KeyMotion& keys) const
    {
        const auto after = std::upper_bound(keys.times.begin(), keys.times.end(), seconds);
        const auto next = static_cast<std::size_t>(after - keys.times.begin());
        if (next == 0 || next == keys.times.size())
        {
            return keysAt(keys, next == 0 ? 0 : next - 1, 0.0);
        }
        const double start = keys.times[next - 1];
        return keysAt(keys, next - 1, (seconds - start) / (keys.times[next] - start));
    }
};

/// A curve strays from a chord by at most an eighth of its second derivative times the square of the time between the
/// chord's ends. On a circle of radius 1 that is an eighth of the angle's square.
double arcStray(double radians)
{
    return 0.125 * radians * radians;
}

struct Sweep
{
    double seconds;
    std::size_t part_count;

    MotionSweep operator()(const std::monostate& /*still*/) const { return {{glm::dmat4(1.0)}}; }

    MotionSweep operator()(const OrbitMotion& orbit) const
    {
        const double turns = std::min(std::abs(orbit.turns_per_second) * seconds, 1.0);
        MotionSweep sweep;
        for (std::size_t i = 0; i <= part_count; ++i)
        {
            const double turned = turns * static_cast<double>(i) / static_cast<double>(part_count);
            sweep.transforms.push_back(orbitAt(orbit, std::copysign(turned, orbit.turns_per_second)));
        }
        const double stray = arcStray(kTwoPi * turns / static_cast<double>(part_count));
        sweep.pivot = orbit.circles ? orbit.center : orbit.home;
        sweep.stray_per_distance = orbit.spins ? stray : 0.0;
        sweep.stray = orbit.spins || !orbit.circles ? 0.0 : stray * glm::length(orbit.home - orbit.center);
        return sweep;
    }

    MotionSweep operator()(const LineMotion& line) const { return {{lineAt(line, 0.0), lineAt(line, 1.0)}}; }

    // Rotation by angle a and scale from s to t at once: as functions of the fraction u of a part, the second
    // derivative of rotation(u) * scale(u) * point is at most (a^2 * scale + 2 * a * |t - s|) * |point|.
    MotionSweep operator()(const KeyMotion& keys) const
    {
        MotionSweep sweep;
        for (std::size_t key = 0; key + 1 < keys.times.size(); ++key)
        {
            const bool turns = !keys.rotations.empty() && keys.rotations[key] != keys.rotations[key + 1];
            const std::size_t parts = turns ? part_count : 1;
            for (std::size_t i = 0; i < parts; ++i)
            {
                sweep.transforms.push_back(keysAt(keys, key, static_cast<double>(i) / static_cast<double>(parts)));
            }
            if (turns)
            {
                const double part = 1.0 / static_cast<double>(parts);
                const double cosine = std::abs(glm::dot(keys.rotations[key], keys.rotations[key + 1]));
                const double angle = part * 2.0 * std::acos(std::min(cosine, 1.0));
                const glm::dvec3 from = keys.scales.empty() ? glm::dvec3(1.0) : keys.scales[key];
                const glm::dvec3 to = keys.scales.empty() ? glm::dvec3(1.0) : keys.scales[key + 1];
                const double scale = std::max(largest(from), largest(to));
                const double stray = scale * arcStray(angle) + 0.25 * angle * part * largest(to - from);
                sweep.stray_per_distance = std::max(sweep.stray_per_distance, stray);
            }
        }
        sweep.transforms.push_back(keysAt(keys, keys.times.size() - 1, 0.0));
        return sweep;
    }

    static double largest(const glm::dvec3& v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }
};

} // namespace

glm::dmat4 motionAt(const Motion& motion, double seconds)
{
    return std::visit(MotionTime{seconds}, motion);
}

// After Rodrigues: cos * v + sin * (axis x v) + (1 - cos) * (axis . v) * axis. The angle is reduced to an eighth of a
// turn on either side of a multiple of a quarter, so that multiples have no rounded sine and cosine.
glm::dmat3 rotationAbout(const glm::dvec3& axis, double turns)
{
    const double quarters = std::round(4.0 * turns);
    const double radians = kTwoPi * (turns - 0.25 * quarters);
    double sine = std::sin(radians);
    double cosine = std::cos(radians);
    const double quarter = quarters - 4.0 * std::floor(0.25 * quarters);
    if (quarter == 1.0 || quarter == 3.0)
    {
        std::swap(sine, cosine);
        cosine = -cosine;
    }
    if (quarter >= 2.0)
    {
        sine = -sine;
        cosine = -cosine;
    }
    glm::dmat3 rotation(0.0);
    for (int column = 0; column < 3; ++column)
    {
        glm::dvec3 basis(0.0);
        basis[column] = 1.0;
        rotation[column] = cosine * basis + sine * glm::cross(axis, basis) + (1.0 - cosine) * axis[column] * axis;
    }
    return rotation;
}

MotionSweep sweepOf(const Motion& motion, double seconds, std::size_t part_count)
{
    return std::visit(Sweep{seconds, part_count}, motion);
}

} // namespace zvo
