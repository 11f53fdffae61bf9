// SPDX-License-Identifier: MIT
// FLIP against values that follow from its definition, and against sums over all weights at once.
#include "bench/flip.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <random>

namespace zvo::cli
{
namespace
{

using Codes = std::vector<glm::dvec3>;
using Values = std::vector<double>;

constexpr std::uint32_t kWidth = 33;
constexpr std::uint32_t kHeight = 19;

Codes even(const glm::dvec3& code)
{
    return Codes(std::size_t{kWidth} * kHeight, code);
}

// Shades between two colours, noise, and an edge.
Codes drawn(std::uint32_t seed)
{
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> part(0.0, 1.0);
    Codes codes;
    for (std::uint32_t y = 0; y < kHeight; ++y)
    {
        for (std::uint32_t x = 0; x < kWidth; ++x)
        {
            const glm::dvec3 shade = {x / 40.0, 0.5, y / 20.0};
            const glm::dvec3 noise = {part(random), part(random), part(random)};
            codes.push_back(glm::mix(x + seed > 20 ? 1.0 - shade : shade, noise, 0.4));
        }
    }
    return codes;
}

double meanOf(const Values& values)
{
    double sum = 0;
    for (const double value : values)
    {
        sum += value;
    }
    return sum / static_cast<double>(values.size());
}

double meanFlip(const Codes& reference, const Codes& picture)
{
    return meanOf(flipOf(reference, picture, kWidth, kHeight));
}

// What follows has the formulas of the paper as they stand there.

// L*, and a* and b* times L* / 100.
glm::dvec3 huntLab(const glm::dvec3& linear)
{
    const double xyz[3] = {
        (0.4123866 * linear.r + 0.3575915 * linear.g + 0.1804505 * linear.b) / 0.9504285,
        0.2126368 * linear.r + 0.7151830 * linear.g + 0.0721802 * linear.b,
        (0.0193306 * linear.r + 0.1191972 * linear.g + 0.9503726 * linear.b) / 1.0889004,
    };
    const auto f = [](double t) { return t > 216.0 / 24389 ? std::pow(t, 1.0 / 3) : (24389.0 / 27 * t + 16) / 116; };
    const double l = 116 * f(xyz[1]) - 16;
    return {l, l / 100 * 500 * (f(xyz[0]) - f(xyz[1])), l / 100 * 200 * (f(xyz[1]) - f(xyz[2]))};
}

double hyab(const glm::dvec3& a, const glm::dvec3& b)
{
    return std::abs(a.x - b.x) + std::sqrt((a.y - b.y) * (a.y - b.y) + (a.z - b.z) * (a.z - b.z));
}

double colorError(const glm::dvec3& linear_a, const glm::dvec3& linear_b)
{
    const double greatest = std::pow(hyab(huntLab({0, 1, 0}), huntLab({0, 0, 1})), 0.7);
    const double error = std::pow(hyab(huntLab(linear_a), huntLab(linear_b)), 0.7);
    const double limit = 0.4 * greatest;
    return error < limit ? 0.95 / limit * error : 0.95 + (error - limit) / (greatest - limit) * 0.05;
}

using Weight = std::function<double(int, int)>;

// The sum over all pixels within radius, with weights of a pixel's distance, for each pixel.
Values convolved(const Values& values, int radius, const Weight& weight)
{
    Values sums;
    for (int y = 0; y < static_cast<int>(kHeight); ++y)
    {
        for (int x = 0; x < static_cast<int>(kWidth); ++x)
        {
            double sum = 0;
            for (int dy = -radius; dy <= radius; ++dy)
            {
                for (int dx = -radius; dx <= radius; ++dx)
                {
                    const int at_x = std::clamp(x + dx, 0, static_cast<int>(kWidth) - 1);
                    const int at_y = std::clamp(y + dy, 0, static_cast<int>(kHeight) - 1);
                    sum += weight(dx, dy) * values[static_cast<std::size_t>(at_y) * kWidth + at_x];
                }
            }
            sums.push_back(sum);
        }
    }
    return sums;
}

// Divides weights above and below 0 by the sums of either.
Weight normalized(int radius, const Weight& weight)
{
    double above = 0;
    double below = 0;
    for (int dy = -radius; dy <= radius; ++dy)
    {
        for (int dx = -radius; dx <= radius; ++dx)
        {
            above += std::max(weight(dx, dy), 0.0);
            below -= std::min(weight(dx, dy), 0.0);
        }
    }
    return [=](int dx, int dy) { return weight(dx, dy) / (weight(dx, dy) > 0 ? above : below); };
}

// Linear colours after the eye's filters.
Codes seen(const Codes& codes, double pixels_per_degree)
{
    const int radius = static_cast<int>(std::ceil(3 * std::sqrt(0.04 / (2 * M_PI * M_PI)) * pixels_per_degree));
    std::array<Values, 3> channels;
    for (const glm::dvec3& code : codes)
    {
        const auto linear = [](double c) { return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4); };
        const glm::dvec3 color = {linear(code.r), linear(code.g), linear(code.b)};
        const double x = (0.4123866 * color.r + 0.3575915 * color.g + 0.1804505 * color.b) / 0.9504285;
        const double y = 0.2126368 * color.r + 0.7151830 * color.g + 0.0721802 * color.b;
        const double z = (0.0193306 * color.r + 0.1191972 * color.g + 0.9503726 * color.b) / 1.0889004;
        channels[0].push_back(116 * y - 16);
        channels[1].push_back(500 * (x - y));
        channels[2].push_back(200 * (y - z));
    }
    constexpr double kParameters[3][4] = {{1, 0.0047, 0, 1e-5}, {1, 0.0053, 0, 1e-5}, {34.1, 0.04, 13.5, 0.025}};
    for (int c = 0; c < 3; ++c)
    {
        const double* const p = kParameters[c];
        const Weight gaussians = [=](int dx, int dy)
        {
            const double square = (dx * dx + dy * dy) / (pixels_per_degree * pixels_per_degree);
            return p[0] * std::sqrt(M_PI / p[1]) * std::exp(-M_PI * M_PI * square / p[1]) +
                   p[2] * std::sqrt(M_PI / p[3]) * std::exp(-M_PI * M_PI * square / p[3]);
        };
        channels[c] = convolved(channels[c], radius, normalized(radius, gaussians));
    }
    Codes colors;
    for (std::size_t i = 0; i < codes.size(); ++i)
    {
        const double y = (channels[0][i] + 16) / 116;
        const double x = 0.9504285 * (y + channels[1][i] / 500);
        const double z = 1.0889004 * (y - channels[2][i] / 200);
        const glm::dvec3 color = {3.2410033 * x - 1.5373989 * y - 0.4986159 * z,
                                  -0.9692243 * x + 1.8759301 * y + 0.0415542 * z,
                                  0.0556394 * x - 0.2040112 * y + 1.0571489 * z};
        colors.push_back(glm::clamp(color, 0.0, 1.0));
    }
    return colors;
}

// The lengths of both directions' features, of edges (order 1) or points (order 2).
Values features(const Codes& codes, double pixels_per_degree, int order)
{
    Values y;
    for (const glm::dvec3& code : codes)
    {
        const auto linear = [](double c) { return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4); };
        y.push_back(0.2126368 * linear(code.r) + 0.7151830 * linear(code.g) + 0.0721802 * linear(code.b));
    }
    const double sigma = 0.5 * 0.082 * pixels_per_degree;
    const int radius = static_cast<int>(std::ceil(3 * sigma));
    const Weight weight = [=](int dx, int dy)
    {
        const double gaussian = std::exp(-(dx * dx + dy * dy) / (2 * sigma * sigma));
        return (order == 1 ? -dx : dx * dx / (sigma * sigma) - 1) * gaussian;
    };
    const Weight along_x = normalized(radius, weight);
    const Values by_x = convolved(y, radius, along_x);
    const Values by_y = convolved(y, radius, [&](int dx, int dy) { return along_x(dy, dx); });
    Values lengths;
    for (std::size_t i = 0; i < y.size(); ++i)
    {
        lengths.push_back(std::sqrt(by_x[i] * by_x[i] + by_y[i] * by_y[i]));
    }
    return lengths;
}

Values slowFlip(const Codes& reference, const Codes& picture, double pixels_per_degree)
{
    const Codes colors_a = seen(reference, pixels_per_degree);
    const Codes colors_b = seen(picture, pixels_per_degree);
    const Values edges_a = features(reference, pixels_per_degree, 1);
    const Values edges_b = features(picture, pixels_per_degree, 1);
    const Values points_a = features(reference, pixels_per_degree, 2);
    const Values points_b = features(picture, pixels_per_degree, 2);
    Values errors;
    for (std::size_t i = 0; i < reference.size(); ++i)
    {
        const double feature = std::max(std::abs(edges_a[i] - edges_b[i]), std::abs(points_a[i] - points_b[i]));
        errors.push_back(std::pow(colorError(colors_a[i], colors_b[i]), 1 - std::sqrt(feature / std::sqrt(2.0))));
    }
    return errors;
}

TEST(Flip, OfEqualPicturesIsZero)
{
    for (const double error : flipOf(drawn(1), drawn(1), kWidth, kHeight))
    {
        EXPECT_EQ(error, 0.0);
    }
}

TEST(Flip, IsTheSameBothWays)
{
    EXPECT_NEAR(meanFlip(drawn(1), drawn(2)), meanFlip(drawn(2), drawn(1)), 1e-12);
}

// The filters leave even pictures as they are, and there are no edges. Black and white are 100 L* apart, green and blue
// as far as colours can be: L*, and a* and b* times L* / 100, are 87.73, -75.6, 73.0 and 32.3, 25.6, -34.8.
TEST(Flip, OfEvenPicturesIsThatOfTheirColors)
{
    EXPECT_NEAR(meanFlip(even({0, 1, 0}), even({0, 0, 1})), 1.0, 1e-9);
    const double greatest = std::pow(55.43 + std::hypot(101.2, 107.8), 0.7);
    const double black_and_white = std::pow(100.0, 0.7);
    EXPECT_NEAR(meanFlip(even({0, 0, 0}), even({1, 1, 1})),
                0.95 + 0.05 * (black_and_white - 0.4 * greatest) / (0.6 * greatest), 1e-3);
    EXPECT_NEAR(meanFlip(even({0, 0, 0}), even({1, 1, 1})), 0.967, 1e-3);
    // L* of the sRGB code 0.5 is 53.39, of 0.6 63.22.
    EXPECT_NEAR(meanFlip(even(glm::dvec3(0.5)), even(glm::dvec3(0.6))),
                0.95 / (0.4 * greatest) * std::pow(63.22 - 53.39, 0.7), 1e-3);
}

TEST(Flip, IsThatOfSumsOverAllWeights)
{
    for (const double pixels_per_degree : {kPixelsPerDegree, 30.0})
    {
        const Values expected = slowFlip(drawn(1), drawn(2), pixels_per_degree);
        const Values actual = flipOf(drawn(1), drawn(2), kWidth, kHeight, pixels_per_degree);
        ASSERT_EQ(actual.size(), expected.size());
        for (std::size_t i = 0; i < expected.size(); ++i)
        {
            EXPECT_NEAR(actual[i], expected[i], 1e-4) << i;
        }
        EXPECT_GT(meanOf(actual), 0.05);
        EXPECT_LT(meanOf(actual), 0.95);
    }
}

// An edge that only one picture has is seen more than the same difference of colour over all of it.
TEST(Flip, CountsMoreAtEdges)
{
    Codes edge = even(glm::dvec3(0.5));
    Codes whole = even(glm::dvec3(0.6));
    for (std::size_t i = 0; i < edge.size(); ++i)
    {
        if (i % kWidth >= kWidth / 2)
        {
            edge[i] = glm::dvec3(0.6);
        }
    }
    const std::size_t beside = std::size_t{kHeight / 2} * kWidth + kWidth / 2 + 1;
    const Values errors = flipOf(even(glm::dvec3(0.5)), edge, kWidth, kHeight);
    EXPECT_GT(errors[beside], 1.1 * meanFlip(even(glm::dvec3(0.5)), whole));
    EXPECT_NEAR(errors[std::size_t{kWidth} - 1], meanFlip(even(glm::dvec3(0.5)), whole), 1e-3) << "far from it";
}

} // namespace
} // namespace zvo::cli
