// SPDX-License-Identifier: MIT
#include "vk/flight.h"

#include <cassert>
#include <utility>

namespace zvo::vk
{

Flight::Flight(Device& device, VkQueue queue, std::uint32_t timer_capacity)
    : m_device(device), m_commands(device, queue), m_timers(device, timer_capacity)
{
}

Flight::~Flight()
{
    finish();
}

Submission Flight::submit(const std::function<void(FrameGraph&)>& record, const SubmitSync& sync)
{
    assert(m_state == nullptr);
    Submission submission;
    submission.m_state = std::make_unique<Submission::State>();
    m_timers.reset();
    FrameGraph graph(m_device, m_commands.begin(), &m_timers);
    record(graph);
    m_commands.submit(sync);
    m_state = submission.m_state.get();
    m_state->flight = this;
    return submission;
}

void Flight::finish() noexcept
{
    if (m_state == nullptr)
    {
        return;
    }
    Submission::State& state = *std::exchange(m_state, nullptr);
    state.flight = nullptr;
    try
    {
        m_commands.wait();
        state.times = m_timers.collect();
    }
    catch (...)
    {
        state.failure = std::current_exception();
    }
}

} // namespace zvo::vk
