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

/// A stage of an update, and the function that records some of its units into a frame.
struct RecordedStage
{
    UpdateStage stage;
    std::function<void(vk::FrameGraph&, std::uint64_t first_unit, std::uint64_t unit_count)> record;
};

using RecordedStages = std::vector<RecordedStage>;

inline void addStage(RecordedStages& stages, UpdateStage stage, decltype(RecordedStage::record) record)
{
    stages.push_back({std::move(stage), std::move(record)});
}

} // namespace zvo
