// SPDX-License-Identifier: MIT
#pragma once

#include "vk/deletion_queue.h"
#include "vk/device.h"
#include "vk/frame_graph.h"
#include "vk/recorded_uploads.h"
#include "vk/timer.h"
#include "zvo/context.h"
#include "zvo/error.h"

#include <cstdint>
#include <deque>
#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace zvo
{

/// The state of a host's frame. Objects that were recorded in the frame keep a reference to it.
struct FrameState
{
    std::uint64_t number = 0;
    bool is_done = false; // the device is done with the frame
    bool is_lost = false; // the frame never reached the device
    std::unique_ptr<vk::TimerPool> timers = nullptr;
    std::vector<PassTime> times = {}; // of its passes, once it is done
    std::size_t pass_count = 0;       // recorded by earlier Recorders
};

struct ZVO_LOCAL Context::Impl
{
    explicit Impl(const ContextInfo& info);
    ~Impl();
    Impl(const Impl&) = delete;
    Impl& operator=(const Impl&) = delete;

    /// The frame with that number: the last one, or a new one. Throws Error{Usage} for a frame that is over.
    std::shared_ptr<FrameState> beginFrame(std::uint64_t number);

    /// The times of the passes of a frame that is done, if they are available.
    void takeTimes(FrameState& frame);

    /// Keeps thing until the device is done with all frames so far. It does not delete anything later when it goes.
    template <typename T> void deleteLater(T&& thing)
    {
        if (!frames.empty())
        {
            deletion_queue.keep(std::forward<T>(thing));
        }
    }

    vk::Device device;
    vk::DeletionQueue deletion_queue;
    vk::RecordedUploads uploads;
    std::uint32_t timed_passes;
    glm::dvec3 up;                                       // length 1
    std::deque<std::shared_ptr<FrameState>> frames = {}; // frames that are not known to be done
    std::optional<std::uint64_t> done = std::nullopt;    // number of the newest frame that is done
    std::vector<std::unique_ptr<vk::TimerPool>> free_timers = {};
    std::vector<PassTime> times = {};
    bool is_recording = false;
    bool has_told_waiting = false; // that frames are not known to be done
    bool was_lost = false;         // whether the frame that was begun last was lost
};

struct ZVO_LOCAL Recorder::Impl
{
    Context::Impl& context;
    std::shared_ptr<FrameState> frame;
    vk::FrameGraph graph;
};

/// Calls `record`. If it throws, uploads that wait to be recorded are dropped.
template <typename Work> auto recording(Recorder& recorder, const Work& work)
{
    Recorder::Impl& impl = recorder.impl();
    try
    {
        if constexpr (std::is_void_v<decltype(work(impl))>)
        {
            work(impl);
            impl.context.uploads.flush();
        }
        else
        {
            auto result = work(impl);
            impl.context.uploads.flush();
            return result;
        }
    }
    catch (...)
    {
        impl.context.uploads.discard();
        throw;
    }
}

/// Throws Error{Usage} for an object that was made in a lost frame.
inline void requireUsable(const FrameState& made_in, const char* what)
{
    if (made_in.is_lost)
    {
        throw Error(ErrorCode::Usage, std::string("this ") + what +
                                          " was lost with its frame, which did not reach the device: make it again");
    }
}

/// The implementation of an object. Throws Error{Usage} for an object that is empty.
template <typename Impl> Impl& contentOf(Impl* impl, const char* what)
{
    if (impl == nullptr)
    {
        throw Error(ErrorCode::Usage, std::string("this ") + what + " was taken over or moved from: it is empty");
    }
    return *impl;
}

/// The implementation of an object. Throws Error{Usage} for an object that was lost with its frame, taken over or moved
/// from.
template <typename Object> auto& usable(const Object& object)
{
    auto& impl = contentOf(std::to_address(object.impl()), Object::Impl::kName);
    if constexpr (requires { impl.made_in; })
    {
        if (impl.made_in)
        {
            requireUsable(*impl.made_in, Object::Impl::kName);
        }
    }
    return impl;
}

/// Throws Error{Usage} if objects belong to different contexts.
template <typename... Contexts> void requireSame(const Context::Impl& first, const Contexts&... others)
{
    if ((... || (&first != &others)))
    {
        throw Error(ErrorCode::Usage, "objects of two contexts cannot be used together");
    }
}

} // namespace zvo
