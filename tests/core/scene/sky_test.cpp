// SPDX-License-Identifier: MIT
// The simple sky and its sun by the hour, and maps that are blurred for the camera.
#include "core/scene/hdr_image.h"
#include "core/scene/sky.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace zvo
{
namespace
{

TEST(Sky, SunRisesInTheEastAndSetsInTheWest)
{
    EXPECT_LT(glm::distance(sunAtHour(6.0), glm::dvec3(1.0, 0.0, 0.0)), 1e-12);
    EXPECT_LT(glm::distance(sunAtHour(12.0), glm::dvec3(0.0, std::sqrt(0.5), std::sqrt(0.5))), 1e-12);
    EXPECT_LT(glm::distance(sunAtHour(18.0), glm::dvec3(-1.0, 0.0, 0.0)), 1e-12);
    EXPECT_LT(sunAtHour(0.5).y, -0.6);
    for (double hour = 0.25; hour < 24.0; hour += 0.5)
    {
        EXPECT_NEAR(hourOfSun(3.0 * sunAtHour(hour)), hour, 1e-9);
    }
}

TEST(Sky, LowSunsAreRedAndNightsDarkAndBlue)
{
    gpu::Sky higher = skyOf(sunAtHour(12.0));
    EXPECT_FLOAT_EQ(higher.sun.r, 1.0F) << "as zvo's pictures have it";
    for (const double hour : {15.0, 17.0, 17.7, 18.3, 19.0, 20.0})
    {
        const gpu::Sky sky = skyOf(sunAtHour(hour));
        EXPECT_LE(sky.sun.r, higher.sun.r) << hour;
        EXPECT_LE(sky.sun.b * higher.sun.r, sky.sun.r * higher.sun.b) << hour;
        EXPECT_LE(sky.zenith.g, higher.zenith.g) << hour;
        EXPECT_LE(sky.ground.g, higher.ground.g) << hour;
        const auto shown = [](const gpu::Sky& light, const glm::dvec3& to_sun)
        { return daylightExposure(to_sun) * (light.above.g + 1.1 * light.sun.g); };
        EXPECT_LT(shown(sky, sunAtHour(hour)), 1.001 * shown(higher, glm::dvec3(higher.to_sun))) << hour;
        EXPECT_GE(daylightExposure(sunAtHour(hour)), daylightExposure(glm::dvec3(higher.to_sun))) << hour;
        higher = sky;
    }
    EXPECT_EQ(higher.sun, gpu::vec3(0.0F));
    EXPECT_EQ(daylightExposure({-0.6, 0.75, 0.45}), 1.0);
    EXPECT_EQ(daylightExposure(sunAtHour(0.0)), 12.0);
    EXPECT_LT(higher.zenith.b, 0.05F);
    EXPECT_GT(higher.zenith.b, higher.zenith.r);
}

// A map is equally bright everywhere, or has one bright texel, also at a pole.
TEST(BlurredMap, KeepsItsLightAndSpreadsIt)
{
    constexpr std::uint32_t kWidth = 90;
    constexpr std::uint32_t kHeight = 45;
    const std::vector<glm::vec3> even(kWidth * kHeight, glm::vec3(0.5F, 1.0F, 2.0F));
    for (const glm::vec3& texel : blurredMap(kWidth, kHeight, even, 0.3).texels)
    {
        ASSERT_LT(glm::distance(texel, even.front()), 1e-4F);
    }

    const auto light = [](const HdrImage& map) // over all solid angles
    {
        double sum = 0;
        for (std::size_t i = 0; i < map.texels.size(); ++i)
        {
            const auto row = static_cast<double>(i / map.width);
            sum += double{map.texels[i].g} * std::sin(std::numbers::pi * (row + 0.5) / map.height);
        }
        return sum / static_cast<double>(map.texels.size());
    };
    for (const std::uint32_t row : {0U, 10U, 22U})
    {
        HdrImage sharp = {kWidth, kHeight, std::vector<glm::vec3>(even.size())};
        sharp.texels[row * kWidth + 1] = glm::vec3(100.0F);
        const HdrImage map = blurredMap(kWidth, kHeight, sharp.texels, 0.14);
        ASSERT_EQ(map.width, kWidth) << "a texel is half of the blur";
        EXPECT_NEAR(light(map), light(sharp), 0.02 * light(sharp)) << row;
        const auto at = [&](std::uint32_t y, std::uint32_t x) { return map.texels[y * kWidth + x].g; };
        EXPECT_NEAR(at(row, 0), at(row, 2), 1e-4F * at(row, 1)) << "both sides, across the edge of the map";
        EXPECT_LT(at(22, 46), 1e-6F) << "the other side of the world";
        if (row == 22) // two texels away is one standard deviation, times the step of a texel
        {
            const double angle = 2.0 * std::numbers::pi / kWidth * 2.0;
            EXPECT_NEAR(at(row, 3) / at(row, 1), std::exp((std::cos(angle) - 1.0) / (0.14 * 0.14)), 1e-3);
        }
        if (row == 0)
        {
            EXPECT_NEAR(at(0, 46) / at(0, 1), 1.0, 0.15) << "over the pole it is near";
        }
    }
    EXPECT_LT(blurredMap(2 * kWidth, 2 * kHeight, std::vector<glm::vec3>(4 * even.size()), 0.5).texels.size(),
              even.size())
        << "no more texels than the blur needs";
}

// Here a row stands exactly where the blur ends: its texels hardly count, whether or not they are in.
TEST(BlurredMap, IsTheMeanOfWhatIsNear)
{
    constexpr std::uint32_t kWidth = 32;
    constexpr std::uint32_t kHeight = 16;
    constexpr double kDeviation = std::numbers::pi / 8; // two rows
    std::vector<glm::vec3> texels;
    std::vector<glm::dvec3> directions;
    for (std::uint32_t i = 0; i < kWidth * kHeight; ++i)
    {
        texels.emplace_back(i * 7 % 16 < 8, i / kWidth % 2, i % 101 == 50);
        const double polar = std::numbers::pi * (i / kWidth + 0.5) / kHeight;
        const double turn = 2.0 * std::numbers::pi * (i % kWidth + 0.5) / kWidth;
        directions.emplace_back(std::sin(polar) * std::cos(turn), std::cos(polar), std::sin(polar) * std::sin(turn));
    }
    const HdrImage map = blurredMap(kWidth, kHeight, texels, kDeviation);
    ASSERT_EQ(map.texels.size(), texels.size());
    for (std::size_t i = 0; i < texels.size(); ++i)
    {
        glm::dvec3 sum(0.0);
        double total = 0;
        for (std::size_t j = 0; j < texels.size(); ++j)
        {
            const double angle = std::acos(std::clamp(glm::dot(directions[i], directions[j]), -1.0, 1.0));
            const double area = std::hypot(directions[j].x, directions[j].z);
            const double weight =
                angle > 3.0 * kDeviation ? 0.0 : area * std::exp((std::cos(angle) - 1.0) / (kDeviation * kDeviation));
            sum += weight * glm::dvec3(texels[j]);
            total += weight;
        }
        ASSERT_LT(glm::distance(glm::dvec3(map.texels[i]), sum / total), 5e-3) << "row " << i / kWidth;
    }
}

} // namespace
} // namespace zvo
