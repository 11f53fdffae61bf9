// SPDX-License-Identifier: MIT
#pragma once

#include "api/context_impl.h"
#include "core/base/step_job.h"

#include <memory>
#include <utility>
#include <vector>

namespace zvo
{

/// Runs a job in frames of the host, a step in each. The next step follows when the host says that the device is done
/// with the last one.
class JobRun
{
public:
    /// made_in: the frame in which the job's source was made; null: known to be done. source: what messages call it.
    JobRun(Context::Impl& context, StepJob& job, std::shared_ptr<FrameState> made_in, const char* source)
        : m_context(context), m_job(job), m_made_in(std::move(made_in)), m_source(source)
    {
    }

    /// As the functions of TreeBuild.
    bool record(Recorder& recorder)
    {
        requireSame(m_context, recorder.impl().context);
        if (isDone())
        {
            return false;
        }
        if (!m_frame)
        {
            recording(recorder, [&](Recorder::Impl& impl) { m_job.record(impl.graph); });
            m_frame = recorder.impl().frame;
        }
        return true;
    }

    bool isDone()
    {
        if (m_made_in)
        {
            requireUsable(*m_made_in, m_source);
            m_made_in = m_made_in->is_done ? nullptr : m_made_in;
        }
        if (m_is_broken)
        {
            throw Error(ErrorCode::Usage, "nothing comes of this any more: an earlier call has said why");
        }
        if (m_frame && m_frame->is_lost)
        {
            m_frame.reset();
        }
        if (m_frame && m_frame->is_done)
        {
            const std::shared_ptr<FrameState> frame = std::exchange(m_frame, nullptr);
            m_is_broken = true; // until the next line has succeeded
            m_job.resume(frame->times);
            m_is_broken = false;
        }
        return m_job.isDone();
    }

    [[nodiscard]] bool isBroken() const { return m_is_broken || (m_made_in && m_made_in->is_lost); }

private:
    Context::Impl& m_context;
    StepJob& m_job;
    std::shared_ptr<FrameState> m_made_in; // null: known to be done
    const char* m_source;
    std::shared_ptr<FrameState> m_frame; // of the step that is under way
    bool m_is_broken = false;
};

} // namespace zvo
