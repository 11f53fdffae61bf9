// SPDX-License-Identifier: MIT
#pragma once

#include "api/context_impl.h"
#include "core/light/environment.h"
#include "zvo/light.h"

#include <memory>
#include <utility>

namespace zvo
{

struct ZVO_LOCAL Environment::Impl
{
    static constexpr const char* kName = "environment"; // in messages

    Impl(Recorder::Impl& recorder, DeviceEnvironment&& environment)
        : context(recorder.context), made_in(recorder.frame), frame(recorder.frame), light(std::move(environment))
    {
    }
    ~Impl() { context.deleteLater(std::move(light)); }
    Impl(const Impl&) = delete;
    Impl& operator=(const Impl&) = delete;

    /// Tells that what is recorded next is part of this frame.
    void enter(const std::shared_ptr<FrameState>& now)
    {
        if (frame->is_lost)
        {
            light.forgetSun();
        }
        frame = now;
    }

    Context::Impl& context;
    std::shared_ptr<FrameState> made_in;
    std::shared_ptr<FrameState> frame; // the last one that uses it
    DeviceEnvironment light;
};

} // namespace zvo
