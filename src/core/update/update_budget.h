// SPDX-License-Identifier: MIT
#pragma once

#include "vk/timer.h"

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace zvo
{

/// A part of an update, which is recorded at once, or in pieces where it is divisible.
struct UpdateStage
{
    /// Not measured yet: a workgroup of 64 threads in 10 us. A stage's author may know better.
    static constexpr double kGuessMsPerUnit = 1e-2 / 64;

    std::string name;        // kind of work: stages of one name cost the same per unit
    std::uint64_t units = 1; // of what the cost is proportional to, such as triangles; 0: nothing to do
    bool divisible = false;  // between any two units
    double guess_ms_per_unit = kGuessMsPerUnit;
};

/// How far an update has come: the stage that is next, and the first of its units that is left. At its end, the number
/// of stages and 0.
struct UpdateProgress
{
    std::size_t stage = 0;
    std::uint64_t unit = 0;

    bool operator==(const UpdateProgress&) const = default;
};

/// Units of a stage that one frame records.
struct UpdateSlice
{
    std::string name; // of the stage
    std::size_t stage = 0;
    std::uint64_t first_unit = 0;
    std::uint64_t unit_count = 0;
    // Set by who records it: the slice's passes are those of the frame from first_pass on and before pass_end
    // (FrameGraph::passCount() before and after).
    std::size_t first_pass = 0;
    std::size_t pass_end = 0;

    bool operator==(const UpdateSlice&) const = default;
};

/// Spreads updates over frames: decides how much of one goes into a frame under a budget of GPU time, from what earlier
/// frames took. Host logic only, and deterministic: plans depend on the arguments of the calls so far and on nothing
/// else. How an update is cut does not change its result; that is up to its stages.
///
/// A stage's predicted time is its units times the time a unit of its kind took. That rises at once with what is
/// measured, so that a frame that took too long is followed by shorter ones, and falls by kFall of the difference, so
/// that one lucky frame does not make the next one too long. A stage that was never measured counts with its guess.
///
/// A frame takes stages in order as long as the sum of their predicted times is within the budget, and always at least
/// one stage, or the kParts-th part of a divisible one. Of a divisible stage it takes what fits, but never less than
/// that part of all its units, so that an update takes at most kParts frames a stage however slow the device is. Before
/// its kind was measured, what it takes beyond that part is guessed to cost at most the kCaution-th part of the budget.
/// Steps of 0 units cost nothing.
class UpdateBudget
{
public:
    static constexpr double kFall = 0.25;
    static constexpr std::uint64_t kParts = 256;
    static constexpr double kCaution = 8;

    /// What the next frame records of an update that has come as far as progress, which moves on. budget_ms: 0 or less
    /// (or NaN) means no bound: everything at once. No slice has 0 units, and there is none when nothing is left.
    std::vector<UpdateSlice> plan(std::span<const UpdateStage> stages, UpdateProgress& progress,
                                  double budget_ms) const;

    /// Learns from a frame that is done: the slices it recorded, and its passes' times. Slices whose passes were not
    /// timed, or not to a finite time of at least 0, are left out.
    void learn(std::span<const UpdateSlice> slices, std::span<const vk::PassTime> passes);

    /// Predicted time of units of stage's kind.
    [[nodiscard]] double predictMs(const UpdateStage& stage, std::uint64_t units) const;

    [[nodiscard]] bool measured(const std::string& name) const { return m_ms_per_unit.count(name) != 0; }

private:
    std::map<std::string, double> m_ms_per_unit; // by the name of the stage
};

} // namespace zvo
