// SPDX-License-Identifier: MIT
// Path-traced pictures, with their mean and its error, on the device that the tests of a binary share.
#pragma once

#include "core/light/environment.h"
#include "core/path/path_tracer.h"

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace zvo::test
{

inline constexpr std::array kWays = {LightSampling::Both, LightSampling::Chance, LightSampling::Lights};

/// The mean of each pixel, row by row, and of the whole picture with its standard error.
struct PathPicture
{
    std::vector<glm::dvec3> pixels;
    glm::dvec3 mean{0.0};
    double luminance = 0.0;
    double error = 0.0; // standard error of luminance
};

double luminanceOf(const glm::dvec3& color);

/// A picture of size.x * size.y pixels, or of edge * edge. Expects that no ray is given up.
PathPicture pictureOf(const DeviceTree& tree, DeviceEnvironment& environment, const ViewCamera& view,
                      const glm::uvec2& size, std::uint32_t samples, const PathOptions& options);
PathPicture pictureOf(const DeviceTree& tree, DeviceEnvironment& environment, const ViewCamera& view,
                      std::uint32_t edge, std::uint32_t samples, const PathOptions& options);

/// The same radiance from everywhere.
DeviceEnvironment constantSky(const glm::vec3& radiance);

} // namespace zvo::test
