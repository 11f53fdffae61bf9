// SPDX-License-Identifier: MIT
// Simulations of updates that are spread over frames. The budget knows neither device nor clock.
#include "core/update/update_budget.h"

#include "support/properties.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>
#include <map>
#include <numeric>
#include <tuple>

namespace
{

using zvo::UpdateBudget;
using zvo::UpdateProgress;
using zvo::UpdateSlice;
using zvo::UpdateStage;
using zvo::vk::PassTime;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

UpdateSlice slice(const std::string& name, std::size_t stage, std::uint64_t first, std::uint64_t count)
{
    return {name, stage, first, count};
}

// Reports to budget that units of name took ms.
void teach(UpdateBudget& budget, const std::string& name, std::uint64_t units, double ms)
{
    UpdateSlice measured = slice(name, 0, 0, units);
    measured.pass_end = 1;
    const PassTime pass{name, ms};
    budget.learn({&measured, 1}, {&pass, 1});
}

TEST(UpdateBudget, WithoutABudgetEverythingIsOneFrames)
{
    const std::vector<UpdateStage> stages{{"a", 1'000'000'000, true}, {"b", 5}, {"none", 0}, {"a", 7, true}};
    const std::vector<UpdateSlice> all{slice("a", 0, 0, 1'000'000'000), slice("b", 1, 0, 5), slice("a", 3, 0, 7)};
    UpdateBudget budget;
    for (const double bound : {0.0, -1.0, kNan, kInfinity})
    {
        UpdateProgress progress;
        EXPECT_EQ(budget.plan(stages, progress, bound == kInfinity ? 0 : bound), all);
        EXPECT_EQ(progress, (UpdateProgress{4, 0}));
        EXPECT_TRUE(budget.plan(stages, progress, bound).empty());
        teach(budget, "a", 1, 1e9);
    }
}

TEST(UpdateBudget, ANewUpdateGoesByItsGuesses)
{
    // The budget is for sixteen units. Divisible stages take what is guessed to fit an eighth of it.
    const std::vector<UpdateStage> stages{{"a", 3}, {"b", 100, true}, {"c", 6}, {"d", 1}};
    const UpdateBudget budget;
    UpdateProgress progress;
    const auto next = [&] { return budget.plan(stages, progress, 16 * UpdateBudget::kGuessMsPerUnit); };
    EXPECT_EQ(next(), (std::vector{slice("a", 0, 0, 3), slice("b", 1, 0, 2)}));
    for (std::uint64_t unit = 2; unit < 98; unit += 2)
    {
        EXPECT_EQ(next(), (std::vector{slice("b", 1, unit, 2)}));
    }
    EXPECT_EQ(next(), (std::vector{slice("b", 1, 98, 2), slice("c", 2, 0, 6), slice("d", 3, 0, 1)}));
    EXPECT_TRUE(next().empty());
}

TEST(UpdateBudget, MeasuredStepsFillTheBudget)
{
    const std::vector<UpdateStage> stages{{"a", 3}, {"b", 100, true}, {"c", 6}, {"d", 1}};
    UpdateBudget budget;
    teach(budget, "a", 1, 1.0);
    teach(budget, "b", 4, 2.0);
    teach(budget, "c", 2, 2.0);
    teach(budget, "d", 1, 9.0);
    UpdateProgress progress;
    const auto next = [&] { return budget.plan(stages, progress, 16.25); };
    EXPECT_EQ(next(), (std::vector{slice("a", 0, 0, 3), slice("b", 1, 0, 26)}));
    EXPECT_EQ(next(), (std::vector{slice("b", 1, 26, 32)}));
    EXPECT_EQ(next(), (std::vector{slice("b", 1, 58, 32)}));
    EXPECT_EQ(next(), (std::vector{slice("b", 1, 90, 10), slice("c", 2, 0, 6)}));
    EXPECT_EQ(next(), (std::vector{slice("d", 3, 0, 1)}));
}

TEST(UpdateBudget, ADeviceThatIsTooSlowStillGetsThere)
{
    const std::vector<UpdateStage> stages{{"a", 10}, {"b", 1000, true}, {"a", 10}, {"c", 3, true}};
    UpdateBudget budget;
    teach(budget, "a", 1, 1e6);
    teach(budget, "b", 1, 1e6);
    teach(budget, "c", 1, 1e6);
    UpdateProgress progress;
    std::vector<UpdateSlice> slices;
    while (progress.stage < stages.size())
    {
        const std::vector<UpdateSlice> frame = budget.plan(stages, progress, 1e-3);
        ASSERT_EQ(frame.size(), 1u);
        slices.push_back(frame[0]);
    }
    EXPECT_EQ(slices.size(), 1u + 250 + 1 + 3);
    EXPECT_EQ(slices[1].unit_count, 4u) << "a 256th of 1,000, rounded up";
}

TEST(UpdateBudget, StepsWithNothingToDoTakeNoFrameAndTeachNothing)
{
    std::vector<UpdateStage> stages(5, {"none", 0, true});
    stages.push_back({"a", 1});
    stages.push_back({"none", 0});
    UpdateBudget budget;
    UpdateProgress progress;
    const std::vector<UpdateSlice> only{slice("a", 5, 0, 1)};
    EXPECT_EQ(budget.plan(stages, progress, 1e-9), only);
    EXPECT_EQ(progress, (UpdateProgress{7, 0})) << "what follows and costs nothing is done, too";
    teach(budget, "none", 0, 5.0);
    EXPECT_FALSE(budget.measured("none"));
    EXPECT_EQ(budget.predictMs(stages[0], 0), 0.0);
    UpdateProgress nothing;
    EXPECT_TRUE(budget.plan({}, nothing, 1).empty());
    EXPECT_TRUE(budget.plan(std::vector<UpdateStage>(3, {"none", 0}), nothing, 1).empty());
    EXPECT_EQ(nothing.stage, 3u);
}

TEST(UpdateBudget, PredictionsRiseAtOnceAndFallSlowly)
{
    UpdateBudget budget;
    const UpdateStage stage{"a", 10};
    EXPECT_EQ(budget.predictMs(stage, 10), 10 * UpdateBudget::kGuessMsPerUnit);
    teach(budget, "a", 10, 1.0);
    EXPECT_DOUBLE_EQ(budget.predictMs(stage, 10), 1.0);
    teach(budget, "a", 100, 80.0);
    EXPECT_DOUBLE_EQ(budget.predictMs(stage, 10), 8.0);
    teach(budget, "a", 10, 4.0);
    EXPECT_DOUBLE_EQ(budget.predictMs(stage, 10), 7.0);
    teach(budget, "a", 10, 0.0);
    EXPECT_DOUBLE_EQ(budget.predictMs(stage, 10), 5.25);
}

TEST(UpdateBudget, SlicesOfOneKindInAFrameAreMeasuredTogether)
{
    UpdateBudget budget;
    std::vector<UpdateSlice> slices{slice("a", 0, 0, 1), slice("b", 1, 0, 10), slice("a", 2, 0, 9)};
    slices[0].first_pass = 1; // the first pass is not the budget's
    slices[0].pass_end = 3;
    slices[1].first_pass = 3; // recorded nothing
    slices[1].pass_end = 3;
    slices[2].first_pass = 4; // another foreign pass
    slices[2].pass_end = 5;
    budget.learn(slices, std::vector<PassTime>{{"x", 1000}, {"p", 1}, {"q", 2}, {"x", 1000}, {"p", 7}});
    EXPECT_DOUBLE_EQ(budget.predictMs({"a"}, 1), 1.0);
    EXPECT_TRUE(budget.measured("b"));
    EXPECT_EQ(budget.predictMs({"b"}, 10), 0.0);
}

TEST(UpdateBudget, WhatWasNotTimedTeachesNothing)
{
    UpdateBudget budget;
    UpdateSlice untimed = slice("a", 0, 0, 10);
    untimed.first_pass = 1;
    untimed.pass_end = 3;
    for (const std::vector<PassTime>& passes : std::vector<std::vector<PassTime>>{
             {},
             {{"p", 1}, {"p", 1}}, // the timers had no room for more
             {{"p", 1}, {"p", kNan}, {"p", 1}},
             {{"p", 1}, {"p", 1}, {"p", -1}},
             {{"p", 1}, {"p", kInfinity}, {"p", 1}},
         })
    {
        budget.learn({&untimed, 1}, passes);
    }
    std::swap(untimed.first_pass, untimed.pass_end);
    budget.learn({&untimed, 1}, std::vector<PassTime>(5, {"p", 1}));
    EXPECT_FALSE(budget.measured("a"));
}

TEST(UpdateBudget, WorkTooCheapToMeasureIsTakenWhole)
{
    UpdateBudget budget;
    teach(budget, "a", 1000, 0.0);
    const std::vector<UpdateStage> stages{{"a", UINT64_MAX, true}, {"a", 5, false}};
    UpdateProgress progress;
    EXPECT_EQ(budget.plan(stages, progress, 1).size(), 2u);
}

// The times of slices on a device.
struct Cost
{
    double fixed_ms = 0;
    double ms_per_unit = 0;
};

// Runs updates in a row on a device that reports its times some frames later.
class Simulation
{
public:
    explicit Simulation(std::size_t latency) : m_latency(latency) {}

    /// Runs one update. Returns the time of each of its frames.
    std::vector<double> update(const std::vector<UpdateStage>& stages, const std::map<std::string, Cost>& costs,
                               double budget_ms)
    {
        std::vector<double> frames;
        for (UpdateProgress progress; progress.stage < stages.size();)
        {
            Frame frame{m_budget.plan(stages, progress, budget_ms), {{"trace/primary", 3.0}}};
            double frame_ms = 0;
            for (UpdateSlice& slice : frame.slices)
            {
                const Cost& cost = costs.at(slice.name);
                const double ms = cost.fixed_ms + cost.ms_per_unit * static_cast<double>(slice.unit_count);
                frame_ms += ms;
                slice.first_pass = frame.passes.size();
                frame.passes.push_back({"first", 0.25 * ms});
                frame.passes.push_back({"second", 0.75 * ms});
                slice.pass_end = frame.passes.size();
                frame.passes.push_back({"trace/primary", 3.0});
            }
            frames.push_back(frame_ms);
            m_in_flight.push_back(std::move(frame));
            if (m_in_flight.size() > m_latency)
            {
                m_budget.learn(m_in_flight.front().slices, m_in_flight.front().passes);
                m_in_flight.pop_front();
            }
        }
        return frames;
    }

private:
    struct Frame
    {
        std::vector<UpdateSlice> slices;
        std::vector<PassTime> passes;
    };

    std::size_t m_latency;
    UpdateBudget m_budget;
    std::deque<Frame> m_in_flight;
};

// Two layers are voxelized and united, then the tree is made from the root down: 9.3 ms in all.
const std::vector<UpdateStage> kUpdate{
    {"voxelize", 40'000, true}, {"voxelize", 20'000, true}, {"union", 3'000, true},       {"expand", 64},
    {"expand", 2'000},          {"expand", 3'000},          {"attributes", 50'000, true}, {"finish", 1}};
const std::map<std::string, Cost> kCosts{{"voxelize", {0.01, 1e-4}},
                                         {"union", {0.01, 1e-4}},
                                         {"expand", {0.01, 1e-4}},
                                         {"attributes", {0.02, 4e-5}},
                                         {"finish", {0.005, 0.01}}};

std::map<std::string, Cost> times(std::map<std::string, Cost> costs, double factor)
{
    for (auto& [name, cost] : costs)
    {
        cost.fixed_ms *= factor;
        cost.ms_per_unit *= factor;
    }
    return costs;
}

std::size_t countOver(const std::vector<double>& frames, double ms)
{
    return static_cast<std::size_t>(std::count_if(frames.begin(), frames.end(), [&](double f) { return f > ms; }));
}

TEST(UpdateBudget, SteadyWorkKeepsToTheBudgetInAboutAsFewFramesAsThereCanBe)
{
    for (const std::size_t latency : {0u, 1u, 3u})
    {
        for (const double budget_ms : {0.5, 1.0, 2.0, 5.0})
        {
            Simulation simulation(latency);
            for (int i = 0; i < 20; ++i)
            {
                const std::vector<double> frames = simulation.update(kUpdate, kCosts, budget_ms);
                const double total = std::accumulate(frames.begin(), frames.end(), 0.0);
                if (i >= 10)
                {
                    EXPECT_LE(*std::max_element(frames.begin(), frames.end()), 1.1 * budget_ms);
                    EXPECT_LE(static_cast<double>(frames.size()), std::ceil(1.25 * total / budget_ms) + 1)
                        << total << " ms under a budget of " << budget_ms << " ms, latency " << latency;
                }
            }
        }
    }
}

TEST(UpdateBudget, AWrongGuessCostsEachKindOfWorkTheFramesUntilItIsMeasured)
{
    // All costs are 32 times as high as guessed. In "expand", slices of 10 and 15 ms exceed the budget in any case, as
    // they cannot be divided.
    std::map<std::string, Cost> slow = kCosts;
    for (auto& [name, cost] : slow)
    {
        cost.ms_per_unit *= 50;
    }
    for (const std::size_t latency : {0u, 1u, 3u})
    {
        Simulation simulation(latency);
        EXPECT_LE(countOver(simulation.update(kUpdate, slow, 2), 2.2), slow.size() * (latency + 1));
        const std::vector<double> frames = simulation.update(kUpdate, slow, 2);
        EXPECT_EQ(countOver(frames, 2.2), 2u);
        EXPECT_DOUBLE_EQ(*std::max_element(frames.begin(), frames.end()), 15.01);
    }
}

TEST(UpdateBudget, ASuddenlySlowDeviceGetsShorterFramesAsSoonAsItIsKnown)
{
    const std::vector<UpdateStage> stages{{"a", 100'000, true}};
    for (const std::size_t latency : {0u, 1u, 3u})
    {
        Simulation simulation(latency);
        const std::map<std::string, Cost> fast{{"a", {0, 1e-4}}};
        for (int i = 0; i < 5; ++i)
        {
            simulation.update(stages, fast, 2);
        }
        const std::vector<double> frames = simulation.update(stages, times(fast, 8), 2);
        EXPECT_EQ(countOver(frames, 2 * (1 + 1e-9)), latency + 1);
        EXPECT_LE(*std::max_element(frames.begin(), frames.end()), 16.0 * (1 + 1e-9));
        EXPECT_EQ(countOver(simulation.update(stages, times(fast, 8), 2), 2 * (1 + 1e-9)), 0u);
        // When the device is fast again, updates return to five frames within a few updates.
        std::vector<double> again;
        for (int i = 0; i < 3; ++i)
        {
            again = simulation.update(stages, fast, 2);
        }
        EXPECT_LE(again.size(), 6u);
        EXPECT_EQ(countOver(again, 2 * (1 + 1e-9)), 0u);
    }
}

TEST(UpdateBudget, OneLongFrameIsForgottenInTime)
{
    const std::vector<UpdateStage> stages{{"a", 100'000, true}};
    const std::map<std::string, Cost> usual{{"a", {0, 1e-4}}};
    Simulation simulation(0);
    simulation.update(stages, usual, 2);
    const std::size_t before = simulation.update(stages, usual, 2).size();
    simulation.update({{"a", 100, true}}, times(usual, 50), 2); // another program used the device
    EXPECT_GT(simulation.update(stages, usual, 2).size(), before);
    simulation.update(stages, usual, 2);
    EXPECT_LE(simulation.update(stages, usual, 2).size(), before + 1);
}

TEST(UpdateBudget, CostsThatSlicingCannotShortenDoNotMakeSlicesShrinkToNothing)
{
    // Every slice costs 3 ms, but the budget is 2.
    const std::vector<UpdateStage> stages{{"a", 1'000'000, true}};
    Simulation simulation(0);
    for (int i = 0; i < 10; ++i)
    {
        EXPECT_LE(simulation.update(stages, {{"a", {3, 1e-6}}}, 2).size(), UpdateBudget::kParts);
    }
}

TEST(UpdateBudget, CutsAnyUpdateIntoConsecutivePartsThatFit)
{
    zvo::test::checkProperty(
        400,
        []
        {
            const auto names =
                rc::gen::map(rc::gen::inRange(0, 5), [](int n) { return std::string(1, char('a' + n)); });
            // (kind, units, divisible)
            const auto drawn =
                *rc::gen::container<std::vector<std::tuple<std::string, std::uint64_t, bool>>>(rc::gen::tuple(
                    names,
                    rc::gen::weightedOneOf<std::uint64_t>({{1, rc::gen::just<std::uint64_t>(0)},
                                                           {4, rc::gen::inRange<std::uint64_t>(1, 200)},
                                                           {1, rc::gen::inRange<std::uint64_t>(1, 1'000'000)}}),
                    rc::gen::arbitrary<bool>()));
            const auto measured =
                *rc::gen::container<std::vector<std::tuple<std::string, std::uint64_t, double>>>(rc::gen::tuple(
                    names, rc::gen::inRange<std::uint64_t>(1, 1000), rc::gen::element(0.0, 1e-3, 0.125, 4.0, 300.0)));
            const auto budget_ms = *rc::gen::element(1e-4, 0.5, 2.0, 100.0);
            std::vector<UpdateStage> stages;
            for (const auto& [name, units, divisible] : drawn)
            {
                stages.push_back({name, units, divisible});
            }
            UpdateBudget budget;
            for (const auto& [name, units, ms] : measured)
            {
                teach(budget, name, units, ms);
            }

            UpdateProgress progress;
            UpdateProgress expected; // beginning of the next slice
            const auto skipEmpty = [&]
            {
                while (expected.stage < stages.size() && expected.unit == stages[expected.stage].units)
                {
                    expected = {expected.stage + 1, 0};
                }
            };
            std::size_t frames_max = 0;
            for (const UpdateStage& stage : stages)
            {
                frames_max += stage.divisible ? UpdateBudget::kParts : 1;
            }
            std::size_t frame_count = 0;
            for (skipEmpty(); expected.stage < stages.size(); skipEmpty())
            {
                RC_ASSERT(++frame_count <= frames_max);
                UpdateProgress same = progress;
                const std::vector<UpdateSlice> slices = budget.plan(stages, progress, budget_ms);
                RC_ASSERT(budget.plan(stages, same, budget_ms) == slices);
                RC_ASSERT(same == progress);
                RC_ASSERT(!slices.empty());
                double ms = 0;
                for (const UpdateSlice& slice : slices)
                {
                    skipEmpty();
                    const UpdateStage& stage = stages[slice.stage];
                    RC_ASSERT((UpdateProgress{slice.stage, slice.first_unit}) == expected);
                    RC_ASSERT(slice.name == stage.name);
                    RC_ASSERT(slice.unit_count > 0u);
                    RC_ASSERT(slice.unit_count <= stage.units - slice.first_unit);
                    RC_ASSERT(stage.divisible || slice.unit_count == stage.units);
                    expected.unit += slice.unit_count;
                    ms += budget.predictMs(stage, slice.unit_count);
                }
                const double within = budget_ms * (1 + 1e-9);
                RC_ASSERT(ms <= within || slices.size() == 1);
                skipEmpty();
                RC_ASSERT(progress == expected);
                if (expected.stage < stages.size())
                {
                    // The slice could not have been larger, except for the caution with new work.
                    const UpdateStage& next = stages[expected.stage];
                    const std::uint64_t parts = (next.units + UpdateBudget::kParts - 1) / UpdateBudget::kParts;
                    const std::uint64_t least = !next.divisible || expected.unit != 0 ? 1 : std::min(parts, next.units);
                    const double more =
                        next.divisible ? budget.predictMs(next, least) : budget.predictMs(next, next.units);
                    const bool cautious = next.divisible && !budget.measured(next.name);
                    RC_ASSERT(cautious || ms + more > budget_ms * (1 - 1e-9));
                }
            }
            RC_ASSERT(budget.plan(stages, progress, budget_ms).empty());
            RC_ASSERT(progress == (UpdateProgress{stages.size(), 0}));
        });
}

} // namespace
