// SPDX-License-Identifier: MIT
#include "oracle/box_paths.h"

#include <cmath>
#include <limits>
#include <numbers>
#include <random>

namespace zvo::oracle
{

namespace
{

struct BoxHit
{
    const PathBox* box = nullptr;
    double t = std::numeric_limits<double>::infinity();
    int axis = 0;
};

// The first box in front of origin.
BoxHit firstBox(std::span<const PathBox> boxes, const glm::dvec3& origin, const glm::dvec3& direction)
{
    BoxHit first;
    for (const PathBox& box : boxes)
    {
        double in = 1e-9;
        double out = std::numeric_limits<double>::infinity();
        int axis = -1;
        for (int i = 0; i < 3; ++i)
        {
            const double a = (box.low[i] - origin[i]) / direction[i];
            const double b = (box.low[i] + 1.0 - origin[i]) / direction[i];
            if (std::min(a, b) > in)
            {
                in = std::min(a, b);
                axis = i;
            }
            out = std::min(out, std::max(a, b));
        }
        if (axis >= 0 && in < out && in < first.t)
        {
            first = {&box, in, axis};
        }
    }
    return first;
}

} // namespace

BoxPaths traceBoxPaths(std::span<const PathBox> boxes, const std::function<glm::dvec3(const glm::dvec3&)>& sky,
                       const glm::dvec3& eye, const glm::dvec3& forward, const glm::dvec3& right, const glm::dvec3& up,
                       double vertical_fov, std::uint32_t edge, std::uint32_t paths, std::uint32_t bounces)
{
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    const double height = std::tan(0.5 * vertical_fov);
    double squares = 0.0;
    glm::dvec3 sum{0.0};
    const std::uint64_t count = std::uint64_t{edge} * edge * paths;
    for (std::uint64_t i = 0; i < count; ++i)
    {
        const std::uint64_t pixel = i / paths;
        const double x = (2.0 * (static_cast<double>(pixel % edge) + uniform(random)) / edge - 1.0) * height;
        const double y = (1.0 - 2.0 * (static_cast<double>(pixel / edge) + uniform(random)) / edge) * height;
        glm::dvec3 origin = eye;
        glm::dvec3 direction = glm::normalize(forward + x * right + y * up);
        glm::dvec3 throughput{1.0};
        glm::dvec3 light{0.0};
        for (std::uint32_t bounce = 0;; ++bounce)
        {
            const BoxHit hit = firstBox(boxes, origin, direction);
            light += throughput * (hit.box != nullptr ? hit.box->emission : sky(direction));
            if (hit.box == nullptr || bounce == bounces)
            {
                break;
            }
            throughput *= hit.box->albedo;
            origin += hit.t * direction;
            // A point on the unit sphere around the tip of the normal has the direction's distribution.
            const double z = 1.0 - 2.0 * uniform(random);
            const double angle = 2.0 * std::numbers::pi * uniform(random);
            const double radius = std::sqrt(1.0 - z * z);
            glm::dvec3 next(radius * std::cos(angle), radius * std::sin(angle), z);
            next[hit.axis] += direction[hit.axis] < 0.0 ? 1.0 : -1.0;
            direction = glm::normalize(next);
        }
        sum += light;
        const double luminance = glm::dot(light, glm::dvec3(0.2126, 0.7152, 0.0722));
        squares += luminance * luminance;
    }
    BoxPaths result;
    result.mean = sum / static_cast<double>(count);
    const double mean = glm::dot(result.mean, glm::dvec3(0.2126, 0.7152, 0.0722));
    result.error = std::sqrt((squares / static_cast<double>(count) - mean * mean) / static_cast<double>(count));
    return result;
}

} // namespace zvo::oracle
