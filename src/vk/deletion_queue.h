// SPDX-License-Identifier: MIT
#pragma once

#include "vk/frame_list.h"

#include <cstdint>
#include <deque>
#include <memory>
#include <type_traits>
#include <utility>

namespace zvo::vk
{

/// Things that frames in flight may still use: kept until the device is done with the frame in which they were put
/// away. Frames are numbered by the caller, upwards.
class DeletionQueue final : public FrameParticipant
{
public:
    /// What is kept from now on may be used by that frame and those before it.
    void beginFrame(std::uint64_t frame) override { m_frame = frame; }

    [[nodiscard]] std::uint64_t frame() const { return m_frame; }

    /// Where thing stands from now on, until the device is done with the frame.
    template <typename T> std::decay_t<T>& keep(T&& thing)
    {
        auto kept = std::make_shared<std::decay_t<T>>(std::forward<T>(thing));
        m_things.push_back({m_frame, kept});
        return *kept;
    }

    /// The device is done with that frame and all before it.
    void frameDone(std::uint64_t frame) override
    {
        while (!m_things.empty() && m_things.front().frame <= frame)
        {
            m_things.pop_front();
        }
    }

private:
    struct Thing
    {
        std::uint64_t frame;
        std::shared_ptr<void> thing;
    };

    std::uint64_t m_frame = 0;
    std::deque<Thing> m_things; // in order of frames
};

} // namespace zvo::vk
