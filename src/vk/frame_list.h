// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

namespace zvo::vk
{

/// Who remembers what was recorded into frames until it is known what becomes of them.
class FrameParticipant
{
public:
    /// The frame that began last reaches the device, which cannot be taken back any more. Comes once or twice.
    virtual void frameSubmitted() {}

    /// A frame begins to be recorded. Its number is above those of the frames before it.
    virtual void beginFrame(std::uint64_t /*frame*/) {}

    /// The device is done with that frame and all before it.
    virtual void frameDone(std::uint64_t /*frame*/) {}

    /// The frame that began last does not reach the device, or not all of it: what it changed is taken back.
    virtual void frameLost() {}

protected:
    FrameParticipant() = default;
    ~FrameParticipant() = default;
    FrameParticipant(const FrameParticipant&) = default;
    FrameParticipant(FrameParticipant&&) = default;
    FrameParticipant& operator=(const FrameParticipant&) = default;
    FrameParticipant& operator=(FrameParticipant&&) = default;
};

/// Numbers frames and tells participants what becomes of them, all in one order: a participant that uses another one in
/// these calls stands before it.
class FrameList
{
public:
    /// participants outlive the list's calls.
    explicit FrameList(std::vector<FrameParticipant*> participants) : m_participants(std::move(participants)) {}

    /// Returns the frame's number: 1, 2, 3...
    std::uint64_t begin()
    {
        tell(&FrameParticipant::frameSubmitted);
        tell(&FrameParticipant::beginFrame, ++m_current);
        return m_current;
    }

    void done(std::uint64_t frame)
    {
        if (frame == m_current)
        {
            tell(&FrameParticipant::frameSubmitted);
        }
        tell(&FrameParticipant::frameDone, frame);
    }

    void lost() { tell(&FrameParticipant::frameLost); }

    /// The frame that began last; 0: none.
    [[nodiscard]] std::uint64_t current() const { return m_current; }

private:
    template <typename... Frame> void tell(void (FrameParticipant::*what)(Frame...), Frame... frame)
    {
        for (FrameParticipant* const participant : m_participants)
        {
            (participant->*what)(frame...);
        }
    }

    std::vector<FrameParticipant*> m_participants;
    std::uint64_t m_current = 0;
};

} // namespace zvo::vk
