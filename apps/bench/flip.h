// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <numbers>
#include <span>
#include <vector>

namespace zvo::cli
{

/// Pixels in a degree of what an eye sees: those of a screen of 3840 pixels that is as far away as it is wide.
inline constexpr double kPixelsPerDegree = 3840 * std::numbers::pi / 180;

/// How much of each pixel changes for an eye while two pictures of a size are shown in turns, [width * height], from 0
/// to 1: FLIP, as in P. Andersson et al., FLIP: A Difference Evaluator for Alternating Images, 2020. Colours are
/// compared as they look from that far, and count more at edges and points that only one picture has. The outermost
/// pixels go on beyond the border. reference, picture: sRGB codes in [0, 1], [width * height] row by row.
std::vector<double> flipOf(std::span<const glm::dvec3> reference, std::span<const glm::dvec3> picture,
                           std::uint32_t width, std::uint32_t height, double pixels_per_degree = kPixelsPerDegree);

} // namespace zvo::cli
