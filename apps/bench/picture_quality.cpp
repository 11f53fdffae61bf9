// SPDX-License-Identifier: MIT
#include "bench/picture_quality.h"

#include "bench/flip.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <vector>

namespace zvo::cli
{

namespace
{

constexpr int kWindowRadius = 5; // pixels

double luminanceOf(const glm::dvec3& color)
{
    return glm::dot(color, glm::dvec3(0.2126, 0.7152, 0.0722));
}

// Makes the mean brightness, in stops, 0.2. Exposure and curve are the measure's own, so that its results can be
// compared with earlier ones, however pictures are developed.
double exposureFor(const HdrImage& picture)
{
    std::vector<double> stops; // of pixels with light
    for (const glm::vec3& texel : picture.texels)
    {
        if (const double light = luminanceOf(texel); light > 0)
        {
            stops.push_back(std::log2(light));
        }
    }
    std::ranges::sort(stops);
    const std::size_t first = stops.size() / 10;
    const std::size_t end = stops.size() - stops.size() / 20;
    const double sum = std::accumulate(stops.begin() + static_cast<std::ptrdiff_t>(first),
                                       stops.begin() + static_cast<std::ptrdiff_t>(end), 0.0);
    return stops.empty() ? 1.0 : 0.2 / std::exp2(sum / static_cast<double>(end - first));
}

// sRGB codes in [0, 1], by the curve of K. Narkowicz, ACES Filmic Tone Mapping Curve, 2015.
std::vector<glm::dvec3> codesOf(const HdrImage& picture, double exposure)
{
    std::vector<glm::dvec3> codes;
    codes.reserve(picture.texels.size());
    for (const glm::vec3& texel : picture.texels)
    {
        const glm::dvec3 x = 0.6 * exposure * glm::dvec3(texel);
        const glm::dvec3 mapped = glm::clamp(x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14), 0.0, 1.0);
        codes.push_back(glm::mix(mapped * 12.92, 1.055 * glm::pow(mapped, glm::dvec3(1 / 2.4)) - 0.055,
                                 glm::greaterThan(mapped, glm::dvec3(0.0031308))));
    }
    return codes;
}

/// Sums over a window, weighted.
struct Moments
{
    double a = 0;
    double b = 0;
    double aa = 0;
    double bb = 0;
    double ab = 0;
};

double ssimOf(const Moments& m)
{
    constexpr double kC1 = 0.01 * 0.01;
    constexpr double kC2 = 0.03 * 0.03;
    const double variance_a = m.aa - m.a * m.a;
    const double variance_b = m.bb - m.b * m.b;
    const double covariance = m.ab - m.a * m.b;
    return (2 * m.a * m.b + kC1) * (2 * covariance + kC2) /
           ((m.a * m.a + m.b * m.b + kC1) * (variance_a + variance_b + kC2));
}

double meanSsim(const std::vector<glm::dvec3>& a, const std::vector<glm::dvec3>& b, std::uint32_t width,
                std::uint32_t height)
{
    const auto lumaOf = [](const glm::dvec3& code) { return luminanceOf(code); };
    double sum = 0;
    for (int y = 0; y < static_cast<int>(height); ++y)
    {
        for (int x = 0; x < static_cast<int>(width); ++x)
        {
            Moments moments;
            double weights = 0;
            for (int dy = -kWindowRadius; dy <= kWindowRadius; ++dy)
            {
                for (int dx = -kWindowRadius; dx <= kWindowRadius; ++dx)
                {
                    const int at_x = x + dx;
                    const int at_y = y + dy;
                    if (at_x < 0 || at_y < 0 || at_x >= static_cast<int>(width) || at_y >= static_cast<int>(height))
                    {
                        continue;
                    }
                    const std::size_t i = static_cast<std::size_t>(at_y) * width + static_cast<std::size_t>(at_x);
                    const double weight = std::exp(-(dx * dx + dy * dy) / (2 * 1.5 * 1.5));
                    const double luma_a = lumaOf(a[i]);
                    const double luma_b = lumaOf(b[i]);
                    weights += weight;
                    moments.a += weight * luma_a;
                    moments.b += weight * luma_b;
                    moments.aa += weight * luma_a * luma_a;
                    moments.bb += weight * luma_b * luma_b;
                    moments.ab += weight * luma_a * luma_b;
                }
            }
            sum += ssimOf({moments.a / weights, moments.b / weights, moments.aa / weights, moments.bb / weights,
                           moments.ab / weights});
        }
    }
    return sum / (static_cast<double>(width) * height);
}

} // namespace

// Dark pixels count as brighter ones, so that they do not decide.
std::vector<double> relativeErrors(const HdrImage& reference, const HdrImage& picture)
{
    const std::vector<double> expected = luminancesOf(reference);
    const double least = std::max(0.01 * meanOf(expected), 1e-20);
    std::vector<double> errors = luminancesOf(picture);
    for (std::size_t i = 0; i < errors.size(); ++i)
    {
        errors[i] = std::abs(errors[i] - expected[i]) / (expected[i] + least);
    }
    return errors;
}

std::vector<double> luminancesOf(const HdrImage& picture)
{
    std::vector<double> luminances;
    luminances.reserve(picture.texels.size());
    for (const glm::vec3& texel : picture.texels)
    {
        luminances.push_back(luminanceOf(texel));
    }
    return luminances;
}

double meanOf(std::span<const double> values)
{
    return values.empty() ? 0.0
                          : std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

PictureQuality compareTo(const HdrImage& reference, const HdrImage& picture)
{
    const double exposure = exposureFor(reference);
    const std::vector<glm::dvec3> a = codesOf(reference, exposure);
    const std::vector<glm::dvec3> b = codesOf(picture, exposure);
    double squares = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
    {
        squares += glm::dot(a[i] - b[i], a[i] - b[i]) / 3;
    }
    const double mean_square = squares / static_cast<double>(a.size());
    return {-10 * std::log10(std::max(mean_square, 1e-12)), meanSsim(a, b, reference.width, reference.height),
            meanOf(flipOf(a, b, reference.width, reference.height)), meanOf(relativeErrors(reference, picture))};
}

} // namespace zvo::cli
