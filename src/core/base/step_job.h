// SPDX-License-Identifier: MIT
#pragma once

#include "vk/frame_graph.h"
#include "vk/readback.h"
#include "vk/timer.h"

#include <cstdint>
#include <iterator>
#include <utility>
#include <vector>

namespace zvo
{

/// Work on the device that is done in steps, because the sizes of its buffers are known only after earlier parts have
/// run. A step is the piece of a job that is recorded into one frame. Its results are read once the device is done with
/// it, and decide about the next step. A job never waits:
///
///     while (!job.isDone())
///     {
///         job.record(graph);  // submit
///         job.resume(passes); // once the device is done
///     }
///
/// runJob() runs this loop and waits after each step; TreeJob (src/api) spreads the steps over frames of a host.
class StepJob
{
public:
    StepJob() = default;
    virtual ~StepJob() = default;
    StepJob(const StepJob&) = delete;
    StepJob& operator=(const StepJob&) = delete;

    [[nodiscard]] virtual bool isDone() const = 0;

    /// Records the next step. The device must be done with the step before. If that step never reached the device, the
    /// same step is recorded again. Throws Error{Memory} when the device's budget does not suffice, and what making a
    /// kernel throws. Passes that were recorded before the exception may still be submitted, and the step can be
    /// recorded again.
    virtual void record(vk::FrameGraph& graph) = 0;

    /// Reads the results of the step that was recorded last. Call it once the device is done with that step. passes:
    /// the times of the step's passes, or empty if they were not taken. After an exception the job has failed and
    /// yields no result.
    virtual void resume(std::vector<vk::PassTime> passes) = 0;
};

/// A job that makes a Result, a type with the members `passes` and `retry_count`. For each of its steps, Builder has
/// two functions: one records the step, the other reads what it came to and sets m_step to the next one. If the second
/// one increases retry_count, the step's results are thrown away and the step is recorded again; its passes are not
/// listed.
template <typename Builder, typename Result> class BuildJob : public StepJob
{
public:
    [[nodiscard]] bool isDone() const final { return m_step.record == nullptr; }

    void record(vk::FrameGraph& graph) final
    {
        m_readback.clear();
        (static_cast<Builder&>(*this).*m_step.record)(graph);
        graph.releaseToHost();
    }

    void resume(std::vector<vk::PassTime> passes) final
    {
        const std::uint32_t retry_count = m_result.retry_count;
        (static_cast<Builder&>(*this).*m_step.learn)();
        if (m_result.retry_count == retry_count)
        {
            m_result.passes.insert(m_result.passes.end(), std::make_move_iterator(passes.begin()),
                                   std::make_move_iterator(passes.end()));
        }
    }

    /// Hands out the result. Call it once, after the job is done.
    [[nodiscard]] Result take() { return std::move(m_result); }

protected:
    struct Step
    {
        void (Builder::*record)(vk::FrameGraph&) = nullptr; // null: the job is done
        void (Builder::*learn)() = nullptr;
    };

    void finish()
    {
        m_step = {};
        m_readback = {};
    }

    Step m_step; // the next one
    Result m_result;
    vk::Readback m_readback; // what a step leaves for its learn()
};

} // namespace zvo
