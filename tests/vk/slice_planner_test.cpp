// SPDX-License-Identifier: MIT
// Simulations of submissions' durations. The planner knows neither device nor clock.
#include "vk/slice_planner.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <utility>
#include <vector>

namespace
{

using namespace zvo;
using vk::SlicePlanner;

/// Submits work whose units cost cost_ms, and notes how long submissions took.
class Simulation
{
public:
    explicit Simulation(const vk::SliceOptions& options) : m_planner(options) {}

    void run(const std::vector<std::pair<SlicePlanner::Key, std::uint64_t>>& passes, const std::vector<double>& cost_ms)
    {
        m_submissions.clear();
        m_planner.beginRun();
        for (const auto& [key, units] : passes)
        {
            for (std::uint64_t left = units; left != 0;)
            {
                const std::uint64_t admitted = m_planner.admit(key, left);
                ASSERT_LE(admitted, left);
                if (admitted == 0)
                {
                    ASSERT_FALSE(m_pass_ms.empty()) << "nothing fits an empty submission";
                    submit();
                    continue;
                }
                m_pass_ms.push_back(static_cast<double>(admitted) * cost_ms[key]);
                left -= admitted;
            }
        }
        submit();
    }

    [[nodiscard]] const std::vector<double>& submissions() const { return m_submissions; }
    [[nodiscard]] double longest() const { return *std::max_element(m_submissions.begin(), m_submissions.end()); }

private:
    void submit()
    {
        double total = 0;
        for (const double ms : m_pass_ms)
        {
            total += ms;
        }
        m_submissions.push_back(total);
        m_planner.endSubmission(m_pass_ms, total);
        m_pass_ms.clear();
    }

    SlicePlanner m_planner;
    std::vector<double> m_pass_ms;
    std::vector<double> m_submissions;
};

TEST(SlicePlanner, SmallWorkTakesOneSubmissionColdAndWarm)
{
    Simulation simulation({.submission_ms = 400});
    for (int round = 0; round < 3; ++round)
    {
        simulation.run({{0, 200}, {1, 1}, {2, 256}, {0, 30}}, {0.01, 0.001, 0.02});
        EXPECT_EQ(simulation.submissions().size(), 1U);
    }
}

TEST(SlicePlanner, LongWorkKeepsToTheTargetWhateverItsUnitsCost)
{
    for (const double cost : {1e-6, 1e-4, 0.01, 0.5, 1.5})
    {
        Simulation simulation({.submission_ms = 400});
        const auto units = static_cast<std::uint64_t>(20000 / cost); // 20 seconds
        for (int round = 0; round < 2; ++round)
        {
            simulation.run({{0, units}}, {cost});
            EXPECT_LT(simulation.longest(), 401) << cost;
            EXPECT_LT(simulation.submissions().size(), 70U) << cost;
        }
    }
}

TEST(SlicePlanner, WorkThatBecameFiftyTimesAsDearStaysBelowAWatchdog)
{
    Simulation simulation({.submission_ms = 400});
    simulation.run({{0, 1'000'000}}, {0.001});
    simulation.run({{0, 1'000'000}}, {0.05});
    EXPECT_LT(simulation.longest(), 2600);
    const std::vector<double>& submissions = simulation.submissions();
    EXPECT_TRUE(std::all_of(submissions.begin() + 1, submissions.end(), [](double ms) { return ms < 401; }));
}

TEST(SlicePlanner, AUnitThatTakesTooLongStillGoes)
{
    Simulation simulation({.submission_ms = 10});
    simulation.run({{0, 300}}, {25});
    EXPECT_LE(simulation.submissions().size(), 300U);
    simulation.run({{0, 300}}, {25});
    EXPECT_EQ(simulation.submissions().size(), 300U);
}

TEST(SlicePlanner, ZeroMillisecondsMeansWhole)
{
    Simulation simulation({.submission_ms = 0});
    simulation.run({{0, UINT32_MAX}, {1, 1'000'000}}, {1, 1});
    EXPECT_EQ(simulation.submissions().size(), 1U);
}

TEST(SlicePlanner, MostUnitsBoundsEverySubmission)
{
    Simulation simulation({.submission_ms = 0, .most_units = 3});
    simulation.run({{0, 7}, {1, 1}, {0, 2}}, {1, 1});
    EXPECT_EQ(simulation.submissions(), (std::vector<double>{3, 3, 3, 1}));
}

TEST(SlicePlanner, WithoutTimersTheClockIsShared)
{
    SlicePlanner planner({.submission_ms = 100});
    planner.beginRun();
    ASSERT_EQ(planner.admit(5, 200), 200U);
    planner.endSubmission({}, 1000); // 5 ms a unit
    planner.beginRun();
    EXPECT_EQ(planner.admit(5, 200), 2U) << "an eighth of the target at first";
}

TEST(SlicePlanner, UnseenWorkGoesWholeOnlyWhereItsBoundIsCheap)
{
    SlicePlanner planner({.submission_ms = 100});
    planner.beginRun();
    EXPECT_TRUE(planner.admitUnseen(1, SlicePlanner::kFirstUnits));
    EXPECT_FALSE(planner.admitUnseen(2, SlicePlanner::kFirstUnits + 1));
    planner.endSubmission({}, 1);
    planner.learnCount(2, 1'000'000, 100); // far below its bound
    ASSERT_EQ(planner.admit(2, 100), 100U);
    planner.endSubmission(std::vector<double>{1.0}, 1.0);
    planner.beginRun();
    EXPECT_TRUE(planner.admitUnseen(2, 1'000'000)) << "1 ms the last time";
    EXPECT_FALSE(planner.admitUnseen(2, 50'000'000)) << "50 ms";
}

TEST(SlicePlanner, CostsMeasuredByTheBoundAreForgottenWhenTheCountIsSeen)
{
    SlicePlanner planner({.submission_ms = 100});
    planner.beginRun();
    ASSERT_TRUE(planner.admitUnseen(1, 256));
    planner.endSubmission(std::vector<double>{10.0}, 10.0); // at most 256 units, perhaps one
    planner.beginRun();
    ASSERT_FALSE(planner.admitUnseen(1, 1'000'000));
    planner.learnCount(1, 1'000'000, 10'000);
    EXPECT_LE(planner.admit(1, 10'000), SlicePlanner::kFirstUnits);
}

} // namespace
