// SPDX-License-Identifier: MIT
#pragma once

#include "api/context_impl.h"
#include "core/dynamic/dynamic_objects.h"
#include "zvo/model.h"

#include <memory>
#include <utility>

namespace zvo
{

struct ZVO_LOCAL Model::Impl
{
    static constexpr const char* kName = "model"; // in messages

    Impl(Context::Impl& context_impl, std::shared_ptr<FrameState> frame)
        : context(context_impl), made_in(std::move(frame))
    {
    }
    ~Impl() { context.deleteLater(std::move(mesh)); }
    Impl(const Impl&) = delete;
    Impl& operator=(const Impl&) = delete;

    Context::Impl& context;
    std::shared_ptr<FrameState> made_in;
    std::shared_ptr<const DynamicMesh> mesh = nullptr;
    Bounds bounds = {};
};

} // namespace zvo
