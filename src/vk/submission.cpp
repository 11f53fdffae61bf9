// SPDX-License-Identifier: MIT
#include "vk/submission.h"

#include "vk/flight.h"

#include <utility>

namespace zvo::vk
{

Submission::~Submission()
{
    finish();
}

Submission& Submission::operator=(Submission&& other) noexcept
{
    if (this != &other)
    {
        finish();
        m_state = std::move(other.m_state);
    }
    return *this;
}

bool Submission::done() const
{
    return m_state == nullptr || m_state->flight == nullptr || m_state->flight->done();
}

std::vector<PassTime> Submission::wait()
{
    finish();
    if (m_state == nullptr)
    {
        return {};
    }
    if (m_state->failure)
    {
        std::rethrow_exception(m_state->failure);
    }
    return m_state->times;
}

void Submission::finish() noexcept
{
    if (m_state != nullptr && m_state->flight != nullptr)
    {
        m_state->flight->finish();
    }
}

} // namespace zvo::vk
