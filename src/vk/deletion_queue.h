// SPDX-License-Identifier: MIT
#pragma once

#include "vk/frame_list.h"

#include <algorithm>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <type_traits>
#include <utility>

namespace zvo::vk
{

/// Objects that frames in flight may still use. Each is kept until the device is done with the frame in which it was
/// put into the queue. The caller numbers the frames in ascending order.
class DeletionQueue final : public FrameParticipant
{
public:
    /// Sets the current frame: objects that are kept from now on may be used by this frame and by earlier ones.
    /// A number that frameDone() has had, such as that of a frame which was lost, then stands for this frame.
    void beginFrame(std::uint64_t frame) override
    {
        m_frame = frame;
        if (m_done && *m_done >= frame)
        {
            m_done = frame == 0 ? std::nullopt : std::optional(frame - 1);
        }
    }

    [[nodiscard]] std::uint64_t frame() const { return m_frame; }

    /// Whether the device is done with a frame, as far as it was told.
    [[nodiscard]] bool isDone(std::uint64_t frame) const { return m_done && frame <= *m_done; }

    /// Puts an object into the queue. Returns a reference to it, valid until the device is done with the current frame.
    template <typename T> std::decay_t<T>& keep(T&& thing)
    {
        auto kept = std::make_shared<std::decay_t<T>>(std::forward<T>(thing));
        m_things.push_back({m_frame, kept});
        return *kept;
    }

    /// Tells that the device is done with a frame and all frames before it: destroys what only these may use.
    void frameDone(std::uint64_t frame) override
    {
        m_done = std::max(m_done.value_or(frame), frame);
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
    std::optional<std::uint64_t> m_done; // the newest frame that is
    std::deque<Thing> m_things;          // in order of frames
};

/// Puts `made` in the place of `old`, which queue keeps; without a queue it is destroyed at once.
template <typename T> void replace(DeletionQueue* queue, std::unique_ptr<T>& old, std::unique_ptr<T> made)
{
    std::swap(old, made);
    if (queue != nullptr && made != nullptr)
    {
        queue->keep(std::move(made));
    }
}

} // namespace zvo::vk
