// SPDX-License-Identifier: MIT
#pragma once

#include "core/base/step_job.h"
#include "vk/headless.h"

#include <concepts>

namespace zvo
{

/// Runs a job to its end, waiting after each step, and returns the job's result. Throws what the steps throw.
template <std::derived_from<StepJob> AnyJob> auto runJob(vk::HeadlessDevice& device, AnyJob job)
{
    while (!job.isDone())
    {
        job.resume(device.run([&](vk::FrameGraph& graph) { job.record(graph); }));
    }
    return job.take();
}

} // namespace zvo
