// SPDX-License-Identifier: MIT
#pragma once

#include "vk/command_context.h"
#include "vk/frame_graph.h"
#include "vk/submission.h"
#include "vk/timer.h"

#include <cstdint>
#include <functional>

namespace zvo::vk
{

/// What one submission needs while it is under way: a command buffer, a fence and timers. Used for one submission after
/// another.
class Flight
{
public:
    Flight(Device& device, VkQueue queue, std::uint32_t timer_capacity);

    /// Waits for the last submission.
    ~Flight();
    Flight(const Flight&) = delete;
    Flight& operator=(const Flight&) = delete;

    /// Records with `record` and submits, without waiting. The last submission must be finished. Throws what `record`
    /// throws, and Error when a call fails; then nothing is under way.
    [[nodiscard]] Submission submit(const std::function<void(FrameGraph&)>& record, const SubmitSync& sync);

    /// Whether finish() would return without waiting.
    [[nodiscard]] bool done() const { return m_state == nullptr || m_commands.done(); }

    /// Waits for the last submission, if it is under way, and stores its pass times, or its failure, in the Submission.
    void finish() noexcept;

private:
    Device& m_device;
    CommandContext m_commands;
    TimerPool m_timers;
    Submission::State* m_state = nullptr; // of the submission that is under way
};

} // namespace zvo::vk
