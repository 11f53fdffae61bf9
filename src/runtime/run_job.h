// SPDX-License-Identifier: MIT
#pragma once

#include "core/base/step_job.h"
#include "vk/headless.h"

#include <concepts>

namespace zvo
{

/// Runs a job to its end, waiting after each step. Throws what the steps throw.
inline void runSteps(vk::HeadlessDevice& device, StepJob& job)
{
    while (!job.isDone())
    {
        job.resume(device.run([&](vk::FrameGraph& graph) { job.record(graph); }));
    }
}

/// The same; returns the job's result.
template <std::derived_from<StepJob> AnyJob> auto runJob(vk::HeadlessDevice& device, AnyJob job)
{
    runSteps(device, job);
    return job.take();
}

} // namespace zvo
