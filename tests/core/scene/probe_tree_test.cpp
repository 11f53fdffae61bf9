// SPDX-License-Identifier: MIT
#include "core/scene/probe_tree.h"

#include <gtest/gtest.h>
#include <numeric>
#include <random>

namespace zvo::test
{

namespace
{

TEST(ProbeTree, VisitsEachProbeWhoseBoxTouchesThatOfTheTriangleAndFewOthers)
{
    std::mt19937 random(1);
    std::uniform_real_distribution<double> place(-1.0, 1.0);
    const auto point = [&] { return glm::dvec3(place(random), place(random), place(random)); };
    for (const std::uint32_t count : {0U, 1U, 4U, 5U, 64U, 1000U})
    {
        std::vector<Probe> probes(count);
        for (std::uint32_t i = 0; i < count; ++i)
        {
            probes[i] = {.from = point(), .way = 0.1 * point(), .candidate = i};
        }
        ProbeTree tree(probes);
        int visit_count = 0; // of 100 triangles
        for (int i = 0; i < 100; ++i)
        {
            const glm::dvec3 centre = point();
            const Corners corners = {centre, centre + 0.3 * point(), centre + 0.3 * point()};
            const glm::dvec3 low = glm::min(glm::min(corners[0], corners[1]), corners[2]);
            const glm::dvec3 high = glm::max(glm::max(corners[0], corners[1]), corners[2]);
            std::vector<int> visits(count);
            tree.visitNear(corners, [&](const Probe& probe) { ++visits[probe.candidate]; });
            for (const Probe& probe : probes)
            {
                bool touches = true;
                for (int axis = 0; axis < 3; ++axis)
                {
                    touches = touches && low[axis] <= probe.high()[axis] && probe.low()[axis] <= high[axis];
                }
                ASSERT_LE(visits[probe.candidate], 1);
                ASSERT_GE(visits[probe.candidate], touches ? 1 : 0);
            }
            visit_count += std::accumulate(visits.begin(), visits.end(), 0);
        }
        EXPECT_LE(visit_count, count < 1000 ? 100 * static_cast<int>(count) : 100 * 100);
    }
}

TEST(Probe, MeetsATriangleOrDoesNot)
{
    const Corners corners = {glm::dvec3(0, 0, 0), glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0)};
    const auto at = [&](const glm::dvec3& from, const glm::dvec3& way)
    { return meets({.from = from, .way = way}, corners); };
    EXPECT_EQ(at({0.25, 0.25, 1}, {0, 0, -4}), 0.25);
    EXPECT_EQ(at({0.25, 0.25, -1}, {0, 0, 1}), 1.0);   // its end
    EXPECT_EQ(at({0, 0, 0}, {0, 0, 1}), 0.0);          // a corner, its beginning
    EXPECT_EQ(at({0.25, 0.25, 1}, {0, 0, -0.5}), 2.0); // too short
    EXPECT_EQ(at({0.25, 0.25, 1}, {0, 0, 4}), 2.0);    // away
    EXPECT_EQ(at({0.75, 0.75, 1}, {0, 0, -4}), 2.0);   // beside
    EXPECT_EQ(at({-1, 0.25, 0}, {4, 0, 0}), 2.0);      // in its plane
}

} // namespace

} // namespace zvo::test
