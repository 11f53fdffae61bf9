// SPDX-License-Identifier: MIT
// A path tracer of unit cubes by brute force, in double precision: it meets light only by chance.
#pragma once

#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <span>

namespace zvo::oracle
{

/// A unit cube that reflects diffusely and gives off light.
struct PathBox
{
    glm::dvec3 low{0.0};
    glm::dvec3 albedo{0.0};
    glm::dvec3 emission{0.0};
};

struct BoxPaths
{
    glm::dvec3 mean{0.0}; // radiance of all pixels
    double error = 0.0;   // standard error of its luminance
};

/// The mean over a square picture of edge x edge pixels, each with this many paths of at most `bounces` reflections.
/// sky: radiance from a direction of length 1.
BoxPaths traceBoxPaths(std::span<const PathBox> boxes, const std::function<glm::dvec3(const glm::dvec3&)>& sky,
                       const glm::dvec3& eye, const glm::dvec3& forward, const glm::dvec3& right, const glm::dvec3& up,
                       double vertical_fov, std::uint32_t edge, std::uint32_t paths, std::uint32_t bounces);

} // namespace zvo::oracle
