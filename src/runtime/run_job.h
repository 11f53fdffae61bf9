// SPDX-License-Identifier: MIT
#pragma once

#include "core/base/step_job.h"
#include "vk/headless.h"

#include <concepts>
#include <utility>
#include <vector>

namespace zvo
{

/// Runs a job to its end, waiting after each step. Returns the passes of all steps. Throws what the steps throw.
inline std::vector<vk::PassTime> runSteps(vk::HeadlessDevice& device, StepJob& job)
{
    std::vector<vk::PassTime> passes;
    while (!job.isDone())
    {
        std::vector<vk::PassTime> more = device.run([&](vk::FrameGraph& graph) { job.record(graph); });
        passes.insert(passes.end(), more.begin(), more.end());
        job.resume(std::move(more));
    }
    return passes;
}

/// Runs a job to its end, waiting after each step, and returns the job's result. Throws what the steps throw.
template <std::derived_from<StepJob> AnyJob> auto runJob(vk::HeadlessDevice& device, AnyJob job)
{
    runSteps(device, job);
    return job.take();
}

} // namespace zvo
