// SPDX-License-Identifier: MIT
#include "bench/flip.h"

#include "core/base/srgb.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>

namespace zvo::cli
{

namespace
{

/// One value for each pixel, row by row.
struct Plane
{
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::vector<double> values; // [width * height]
};

/// Y, red-green and blue-yellow.
struct OpponentPicture
{
    Plane y;
    Plane red_green;
    Plane blue_yellow;
};

using Weights = std::vector<double>; // from -radius to radius

// How blurred a channel looks, as sums of two Gaussians: factors, and widths in square degrees.
struct Sensitivity
{
    double factor_a;
    double width_a;
    double factor_b;
    double width_b;
};

constexpr Sensitivity kOfY = {1, 0.0047, 0, 1e-5};
constexpr Sensitivity kOfRedGreen = {1, 0.0053, 0, 1e-5};
constexpr Sensitivity kOfBlueYellow = {34.1, 0.04, 13.5, 0.025};
constexpr double kGreatestWidth = 0.04;
constexpr double kEdgeDegrees = 0.082;                         // between the extremes of what finds edges
constexpr double kColorExponent = 0.7;                         // of differences of colour
constexpr double kFeatureExponent = 0.5;                       // of differences of edges and points
constexpr double kLargeDifference = 0.4;                       // of the greatest: it counts as kLargeError
constexpr double kLargeError = 0.95;                           // what is left up to 1 is for larger ones
constexpr glm::dvec3 kWhite = {0.950428545, 1.0, 1.088900371}; // D65, in XYZ

// X, Y and Z of linear colours in the primaries of sRGB, a row each.
constexpr glm::dmat3 kXyzRows = {0.41238656, 0.35759149, 0.18045049, 0.21263682, 0.71518298,
                                 0.07218020, 0.01933062, 0.11919716, 0.95037259};

// Of linear colours, in parts of white.
glm::dvec3 xyzOf(const glm::dvec3& color)
{
    return color * kXyzRows / kWhite;
}

const glm::dmat3& colorOfXyz()
{
    static const glm::dmat3 inverse = glm::inverse(glm::dmat3(xyzOf({1, 0, 0}), xyzOf({0, 1, 0}), xyzOf({0, 0, 1})));
    return inverse;
}

// L*, a* and b*, of which the last two count less where it is dark: the Hunt effect.
glm::dvec3 labOf(const glm::dvec3& color)
{
    constexpr double kEdge = 6.0 / 29;
    const auto curve = [](double part)
    { return part > kEdge * kEdge * kEdge ? std::cbrt(part) : part / (3 * kEdge * kEdge) + 4.0 / 29; };
    const glm::dvec3 xyz = xyzOf(color);
    const double y = curve(xyz.y);
    const double lightness = 116 * y - 16;
    return {lightness, 0.01 * lightness * 500 * (curve(xyz.x) - y), 0.01 * lightness * 200 * (y - curve(xyz.z))};
}

// HyAB: lightness and hue apart.
double distanceOf(const glm::dvec3& a, const glm::dvec3& b)
{
    return std::abs(a.x - b.x) + std::hypot(a.y - b.y, a.z - b.z);
}

OpponentPicture opponentOf(std::span<const glm::dvec3> codes, std::uint32_t width, std::uint32_t height)
{
    const Plane empty = {width, height, std::vector<double>(codes.size())};
    OpponentPicture picture = {empty, empty, empty};
    for (std::size_t i = 0; i < codes.size(); ++i)
    {
        const glm::dvec3 xyz = xyzOf({srgbToLinear(codes[i].r), srgbToLinear(codes[i].g), srgbToLinear(codes[i].b)});
        picture.y.values[i] = 116 * xyz.y - 16;
        picture.red_green.values[i] = 500 * (xyz.x - xyz.y);
        picture.blue_yellow.values[i] = 200 * (xyz.y - xyz.z);
    }
    return picture;
}

glm::dvec3 colorOf(double y, double red_green, double blue_yellow)
{
    const double part = (y + 16) / 116;
    return colorOfXyz() * glm::dvec3(part + red_green / 500, part, part - blue_yellow / 200);
}

template <typename Function> Weights weightsOf(int radius, const Function& function)
{
    Weights weights;
    for (int i = -radius; i <= radius; ++i)
    {
        weights.push_back(function(static_cast<double>(i)));
    }
    return weights;
}

double sumOf(const Weights& weights)
{
    return std::accumulate(weights.begin(), weights.end(), 0.0);
}

Weights scaled(Weights weights, double factor)
{
    for (double& weight : weights)
    {
        weight *= factor;
    }
    return weights;
}

Plane filteredRows(const Plane& plane, const Weights& weights)
{
    const int radius = static_cast<int>(weights.size() / 2);
    const int last = static_cast<int>(plane.width) - 1;
    Plane filtered = plane;
    for (std::uint32_t y = 0; y < plane.height; ++y)
    {
        const double* const row = plane.values.data() + std::size_t{y} * plane.width;
        for (int x = 0; x <= last; ++x)
        {
            double sum = 0;
            for (int d = -radius; d <= radius; ++d)
            {
                sum += weights[static_cast<std::size_t>(d + radius)] * row[std::clamp(x + d, 0, last)];
            }
            filtered.values[std::size_t{y} * plane.width + static_cast<std::size_t>(x)] = sum;
        }
    }
    return filtered;
}

Plane turned(const Plane& plane)
{
    Plane other = {plane.height, plane.width, std::vector<double>(plane.values.size())};
    for (std::size_t i = 0; i < plane.values.size(); ++i)
    {
        other.values[i % plane.width * plane.height + i / plane.width] = plane.values[i];
    }
    return other;
}

Plane filtered(const Plane& plane, const Weights& along_rows, const Weights& along_columns)
{
    return turned(filteredRows(turned(filteredRows(plane, along_rows)), along_columns));
}

// A channel as it looks from afar.
Plane blurred(const Plane& plane, const Sensitivity& sensitivity, double pixels_per_degree)
{
    using std::numbers::pi;
    const int radius = static_cast<int>(std::ceil(3 * std::sqrt(kGreatestWidth / (2 * pi * pi)) * pixels_per_degree));
    const auto gaussian = [&](double width)
    {
        return weightsOf(radius,
                         [&](double i) { return std::exp(-pi * pi * std::pow(i / pixels_per_degree, 2.0) / width); });
    };
    const auto volume = [](double factor, double width, const Weights& weights)
    { return factor * std::sqrt(pi / width) * std::pow(sumOf(weights), 2.0); };
    const Weights a = gaussian(sensitivity.width_a);
    const Weights b = gaussian(sensitivity.width_b);
    const double volume_a = volume(sensitivity.factor_a, sensitivity.width_a, a);
    const double volume_b = volume(sensitivity.factor_b, sensitivity.width_b, b);
    const Weights unit_a = scaled(a, 1 / sumOf(a));
    Plane result = filtered(plane, unit_a, unit_a);
    if (volume_b == 0)
    {
        return result;
    }
    const Weights unit_b = scaled(b, 1 / sumOf(b));
    const Plane other = filtered(plane, unit_b, unit_b);
    for (std::size_t i = 0; i < result.values.size(); ++i)
    {
        result.values[i] = (volume_a * result.values[i] + volume_b * other.values[i]) / (volume_a + volume_b);
    }
    return result;
}

std::vector<glm::dvec3> seenColors(const OpponentPicture& picture, double pixels_per_degree)
{
    const Plane y = blurred(picture.y, kOfY, pixels_per_degree);
    const Plane red_green = blurred(picture.red_green, kOfRedGreen, pixels_per_degree);
    const Plane blue_yellow = blurred(picture.blue_yellow, kOfBlueYellow, pixels_per_degree);
    std::vector<glm::dvec3> labs;
    labs.reserve(y.values.size());
    for (std::size_t i = 0; i < y.values.size(); ++i)
    {
        labs.push_back(labOf(glm::clamp(colorOf(y.values[i], red_green.values[i], blue_yellow.values[i]), 0.0, 1.0)));
    }
    return labs;
}

// Parts above and below 0 weigh 1 each.
Weights balanced(Weights weights)
{
    double above = 0;
    double below = 0;
    for (const double weight : weights)
    {
        (weight > 0 ? above : below) += std::abs(weight);
    }
    for (double& weight : weights)
    {
        weight /= weight > 0 ? above : below;
    }
    return weights;
}

// How much each pixel is like what `profile` finds, a function of the distance in standard deviations.
template <typename Profile>
std::vector<double> featuresOf(const Plane& y, double pixels_per_degree, const Profile& profile)
{
    const double deviation = 0.5 * kEdgeDegrees * pixels_per_degree; // pixels
    const int radius = static_cast<int>(std::ceil(3 * deviation));
    const auto gaussian = [&](double i) { return std::exp(-i * i / (2 * deviation * deviation)); };
    const Weights along = balanced(weightsOf(radius, [&](double i) { return profile(i / deviation) * gaussian(i); }));
    const Weights plain = weightsOf(radius, gaussian);
    const Weights across = scaled(plain, 1 / sumOf(plain));
    const Plane by_x = filtered(y, along, across);
    const Plane by_y = filtered(y, across, along);
    std::vector<double> features;
    features.reserve(y.values.size());
    for (std::size_t i = 0; i < y.values.size(); ++i)
    {
        features.push_back(std::hypot(by_x.values[i], by_y.values[i]) / 116); // of Y from 0 to 1
    }
    return features;
}

// The error of a difference of colour, from 0 to 1.
double errorOf(double difference)
{
    static const double greatest =
        std::pow(distanceOf(labOf({0, 1, 0}), labOf({0, 0, 1})), kColorExponent); // of green and blue
    const double large = kLargeDifference * greatest;
    const double value = std::pow(difference, kColorExponent);
    return value < large ? value * kLargeError / large
                         : kLargeError + (value - large) / (greatest - large) * (1 - kLargeError);
}

} // namespace

std::vector<double> flipOf(std::span<const glm::dvec3> reference, std::span<const glm::dvec3> picture,
                           std::uint32_t width, std::uint32_t height, double pixels_per_degree)
{
    const auto edge = [](double distance) { return -distance; };
    const auto point = [](double distance) { return distance * distance - 1; };
    const OpponentPicture a = opponentOf(reference, width, height);
    const OpponentPicture b = opponentOf(picture, width, height);
    const std::vector<glm::dvec3> colors_a = seenColors(a, pixels_per_degree);
    const std::vector<glm::dvec3> colors_b = seenColors(b, pixels_per_degree);
    const std::vector<double> edges_a = featuresOf(a.y, pixels_per_degree, edge);
    const std::vector<double> edges_b = featuresOf(b.y, pixels_per_degree, edge);
    const std::vector<double> points_a = featuresOf(a.y, pixels_per_degree, point);
    const std::vector<double> points_b = featuresOf(b.y, pixels_per_degree, point);
    std::vector<double> errors;
    errors.reserve(reference.size());
    for (std::size_t i = 0; i < reference.size(); ++i)
    {
        const double feature = std::max(std::abs(edges_a[i] - edges_b[i]), std::abs(points_a[i] - points_b[i]));
        errors.push_back(std::pow(errorOf(distanceOf(colors_a[i], colors_b[i])),
                                  1 - std::pow(feature / std::numbers::sqrt2, kFeatureExponent)));
    }
    return errors;
}

} // namespace zvo::cli
