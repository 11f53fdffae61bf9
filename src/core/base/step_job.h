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

/// Work whose sizes only the device knows, in steps. A step is the piece of a job that is recorded into one frame; what
/// it came to is learnt when the device is done with it, and decides about the next one. A job never waits:
///
///     while (!job.isDone())
///     {
///         job.record(graph);  // submit
///         job.resume(passes); // once the device is done
///     }
///
/// runJob() does this and waits; JobRun (src/api) does it in frames of a host.
class StepJob
{
public:
    StepJob() = default;
    virtual ~StepJob() = default;
    StepJob(const StepJob&) = delete;
    StepJob& operator=(const StepJob&) = delete;

    [[nodiscard]] virtual bool isDone() const = 0;

    /// Records the next step. The device must be done with the one before, unless that never reached it: then this is
    /// the same one again. Throws Error{Memory} when the device's budget does not suffice, and what making a kernel
    /// throws; what was recorded may reach the device all the same, and the step can be recorded again.
    virtual void record(vk::FrameGraph& graph) = 0;

    /// The device is done with the step that was recorded last: learns what it came to. passes: its times, if they were
    /// taken. Where it throws, nothing comes of the job.
    virtual void resume(std::vector<vk::PassTime> passes) = 0;
};

/// A job that makes a Result, which has passes and retry_count. Builder has two functions for each of its steps: one
/// records it, and one learns what it came to and names the next step. Where that adds to retry_count the step is
/// thrown away, and comes again.
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

    /// What came of it, once.
    [[nodiscard]] Result take() { return std::move(m_result); }

protected:
    struct Step
    {
        void (Builder::*record)(vk::FrameGraph&) = nullptr; // null: there is none, the job is done
        void (Builder::*learn)() = nullptr;
    };

    void finish()
    {
        m_step = {};
        m_readback = {};
    }

    Step m_step; // that comes next
    Result m_result;
    vk::Readback m_readback; // what a step leaves for its end
};

} // namespace zvo
