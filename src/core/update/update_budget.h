// SPDX-License-Identifier: MIT
#pragma once

#include "vk/frame_graph.h"
#include "vk/timer.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace zvo
{

/// A stage of an update. It is recorded at once, or in several slices if it is divisible.
struct UpdateStage
{
    std::string name;        // kind of work: stages of one name are assumed to cost the same per unit
    std::uint64_t units = 1; // what the cost is proportional to, such as triangles; 0: nothing to do
    bool divisible = false;  // may be cut between any two units
    /// Records some of the units into a frame.
    std::function<void(vk::FrameGraph&, std::uint64_t first_unit, std::uint64_t unit_count)> record = {};
};

using UpdateStages = std::vector<UpdateStage>;

/// A stage that is not divisible.
inline UpdateStage wholeStage(std::string name, std::uint64_t units, std::function<void(vk::FrameGraph&)> record)
{
    return {std::move(name), units, false,
            [record = std::move(record)](vk::FrameGraph& graph, std::uint64_t, std::uint64_t) { record(graph); }};
}

/// How far an update has come: the next stage, and the first of its units that is not recorded yet. At the end of an
/// update: the number of stages, and 0.
struct UpdateProgress
{
    std::size_t stage = 0;
    std::uint64_t unit = 0;

    bool operator==(const UpdateProgress&) const = default;
};

/// The units of a stage that one frame records.
struct UpdateSlice
{
    std::string name; // of the stage
    std::size_t stage = 0;
    std::uint64_t first_unit = 0;
    std::uint64_t unit_count = 0;
    // Set by whoever records the slice: its passes are those of the frame from first_pass up to, but without, pass_end
    // (FrameGraph::passCount() before and after).
    std::size_t first_pass = 0;
    std::size_t pass_end = 0;

    bool operator==(const UpdateSlice&) const = default;
};

/// Spreads updates over frames: decides, from the times of earlier frames, how much of an update goes into a frame
/// under a budget of GPU time. Host logic only, and deterministic: plans depend only on the arguments of the calls so
/// far. How an update is cut must not change its result; its stages guarantee that.
///
/// The predicted time of a stage is its number of units times the time of a unit of its kind. When a measured time is
/// higher than the prediction, the prediction rises to it at once, so that a frame that took too long is followed by
/// shorter ones. When it is lower, the prediction falls by kFall of the difference, so that one lucky frame does not
/// make the next one too long. A unit of a kind that was never measured counts with kGuessMsPerUnit.
///
/// A frame takes stages in order as long as the sum of their predicted times is within the budget. It takes at least
/// one stage or, of a divisible stage, at least the kParts-th part of all its units; so an update takes at most kParts
/// frames for each stage, however slow the device is. If a divisible stage's kind was never measured, what the frame
/// takes beyond that part is guessed to cost at most the kCaution-th part of the budget. Stages of 0 units cost
/// nothing.
class UpdateBudget
{
public:
    static constexpr double kGuessMsPerUnit = 1e-2 / 64; // a workgroup of 64 threads takes 10 us
    static constexpr double kFall = 0.25;
    static constexpr std::uint64_t kParts = 256;
    static constexpr double kCaution = 8;

    /// Returns what the next frame records of an update, and moves progress on. budget_ms: 0, less or NaN means no
    /// bound, and everything is recorded at once. No slice has 0 units; there are no slices when nothing is left.
    std::vector<UpdateSlice> plan(std::span<const UpdateStage> stages, UpdateProgress& progress,
                                  double budget_ms) const;

    /// Learns from a frame that is done. slices: what the frame recorded. passes: the times of all its passes. Slices
    /// whose passes were not timed, or have times that are negative or not finite, are ignored.
    void learn(std::span<const UpdateSlice> slices, std::span<const vk::PassTime> passes);

    /// Predicted time of so many units of stage's kind.
    [[nodiscard]] double predictMs(const UpdateStage& stage, std::uint64_t units) const;

    [[nodiscard]] bool measured(const std::string& name) const { return m_ms_per_unit.count(name) != 0; }

private:
    std::map<std::string, double> m_ms_per_unit; // by the name of the stage
};

} // namespace zvo
