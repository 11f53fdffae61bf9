// SPDX-License-Identifier: MIT
#pragma once

#include "core/update/update_budget.h"
#include "vk/frame_graph.h"

#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

namespace zvo
{

/// A step of an update that can be recorded on its own.
struct RecordedStep
{
    UpdateStep step;
    std::function<void(vk::FrameGraph&, std::uint64_t first_unit, std::uint64_t unit_count)> record;
};

using RecordedSteps = std::vector<RecordedStep>;

inline void addStep(RecordedSteps& steps, UpdateStep step, decltype(RecordedStep::record) record)
{
    steps.push_back({std::move(step), std::move(record)});
}

} // namespace zvo
