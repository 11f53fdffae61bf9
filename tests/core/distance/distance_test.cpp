// SPDX-License-Identifier: MIT
// Distances in a band against exact ones.
#include "support/distance_compare.h"
#include "support/engine_device.h"
#include "support/fill_compare.h"
#include "support/scenes.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <random>
#include <vector>

namespace zvo
{
namespace
{

using test::device;

test::DistanceComparison expectExact(const Scene& scene, const Grid& grid, std::uint32_t band, Fill fill = Fill::Solid)
{
    const test::DistanceComparison found = test::compareDistances(device(), scene, grid, {.band = band, .fill = fill});
    EXPECT_EQ(found.wrong_values, 0U) << found.in_band << " in the band";
    EXPECT_EQ(found.wrong_signs, 0U);
    EXPECT_TRUE(found.in_order);
    return found;
}

TEST(Distance, ToSpheresIsExact)
{
    for (const std::uint32_t depth : {3U, 4U, 5U})
    {
        const Grid grid = {glm::vec3(0), 1.0F, depth};
        const float half = static_cast<float>(grid.resolution()) / 2;
        const test::DistanceComparison found =
            expectExact(test::sphereScene(glm::vec3(half), 0.8F * half, 8), grid, depth == 3 ? 15 : 2);
        EXPECT_TRUE(found.is_closed);
        EXPECT_GT(found.inside, 0U);
        EXPECT_GT(found.in_band, found.inside);
    }
}

TEST(Distance, ToTrianglesOfAnyShapeIsExact)
{
    for (std::uint32_t seed = 0; seed < 4; ++seed)
    {
        const Grid grid = {glm::vec3(0), 1.0F, 4};
        expectExact(test::randomTriangles(seed, 12, 16.0F), grid, 1 + 3 * seed);
    }
}

} // namespace
} // namespace zvo
