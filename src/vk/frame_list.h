// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

namespace zvo::vk
{

/// An object that has recorded something into frames, and must learn what becomes of them.
class FrameParticipant
{
public:
    /// The frame that began last will reach the device and can no longer be taken back. Called once or twice for a
    /// frame.
    virtual void frameSubmitted() {}

    /// The recording of a frame begins. Its number is higher than those of earlier frames.
    virtual void beginFrame(std::uint64_t /*frame*/) {}

    /// The device is done with a frame and all frames before it.
    virtual void frameDone(std::uint64_t /*frame*/) {}

    /// The frame that began last does not reach the device, or not all of it: its changes are to be taken back.
    virtual void frameLost() {}

protected:
    FrameParticipant() = default;
    ~FrameParticipant() = default;
    FrameParticipant(const FrameParticipant&) = default;
    FrameParticipant(FrameParticipant&&) = default;
    FrameParticipant& operator=(const FrameParticipant&) = default;
    FrameParticipant& operator=(FrameParticipant&&) = default;
};

/// Numbers frames and tells participants what becomes of them, always in the same order: a participant that uses
/// another one in these functions must stand before it.
class FrameList
{
public:
    /// participants must outlive the last call.
    explicit FrameList(std::vector<FrameParticipant*> participants) : m_participants(std::move(participants)) {}

    /// Begins a frame and returns its number: 1, 2, 3...
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
