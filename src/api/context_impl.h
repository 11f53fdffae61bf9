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
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace zvo
{

/// A frame of the host's, as what was recorded in it remembers it.
struct FrameState
{
    std::uint64_t number = 0;
    bool is_done = false; // the device is
    bool is_lost = false; // it never reached the device
    std::unique_ptr<vk::TimerPool> timers = nullptr;
    std::vector<PassTime> times = {}; // once it is done
    std::size_t pass_count = 0;       // recorded by earlier Recorders
};

struct ZVO_LOCAL Context::Impl
{
    explicit Impl(const ContextInfo& info);
    ~Impl();
    Impl(const Impl&) = delete;
    Impl& operator=(const Impl&) = delete;

    /// The frame with that number: the last one, or a new one. Throws Error{Usage} for one that is over.
    std::shared_ptr<FrameState> beginFrame(std::uint64_t number);

    /// The times of its passes, of a frame that is done, where they can be had.
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
    std::deque<std::shared_ptr<FrameState>> frames = {}; // that the device is not known to be done with
    std::optional<std::uint64_t> done = std::nullopt;    // number of the newest frame that is
    std::vector<std::unique_ptr<vk::TimerPool>> free_timers = {};
    std::vector<PassTime> times = {};
    bool is_recording = false;
    bool was_lost = false; // the frame that was begun last
};

struct ZVO_LOCAL Recorder::Impl
{
    Context::Impl& context;
    std::shared_ptr<FrameState> frame;
    vk::FrameGraph graph;
};

/// Does what records. If it throws, uploads that wait for being recorded are forgotten.
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

/// Throws Error{Usage} for what was made in a frame that was lost.
inline void requireUsable(const FrameState& made_in, const char* what)
{
    if (made_in.is_lost)
    {
        throw Error(ErrorCode::Usage, std::string("this ") + what +
                                          " was lost with its frame, which did not reach the device: make it again");
    }
}

/// What an object consists of. Throws Error{Usage} for one that is empty.
template <typename Impl> Impl& contentOf(Impl* impl, const char* what)
{
    if (impl == nullptr)
    {
        throw Error(ErrorCode::Usage, std::string("this ") + what + " was taken over or moved from: it is empty");
    }
    return *impl;
}

/// Throws Error{Usage} for objects of two contexts.
inline void requireSame(const Context::Impl& a, const Context::Impl& b)
{
    if (&a != &b)
    {
        throw Error(ErrorCode::Usage, "objects of two contexts cannot be used together");
    }
}

} // namespace zvo
