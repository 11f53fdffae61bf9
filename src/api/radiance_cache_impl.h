// SPDX-License-Identifier: MIT
#pragma once

#include "api/context_impl.h"
#include "api/environment_impl.h"
#include "core/frame/frame_renderer.h"
#include "zvo/radiance_cache.h"

#include <cstdint>
#include <memory>
#include <optional>

namespace zvo
{

struct ZVO_LOCAL RadianceCache::Impl
{
    static constexpr const char* kName = "radiance cache"; // in messages

    Impl(Context::Impl& context_impl, const RadianceCacheInfo& light_info);
    ~Impl();
    Impl(const Impl&) = delete;
    Impl& operator=(const Impl&) = delete;

    template <typename AnyTree>
    void update(Recorder& recorder, AnyTree& any_tree, Environment& any_environment, const CameraInfo& camera_info,
                const CachedFrameInfo& frame_info);

    /// Throws Error{Usage} unless the last update was of this tree, as it is.
    void requireShown(const DeviceTree& tree) const;

    /// Has the renderer forget what a lost frame has recorded.
    void forgetIfLost();

    Context::Impl& context;
    RadianceCacheInfo info;
    std::unique_ptr<FrameRenderer> renderer; // of the camera's rays; keeps the light
    vk::BufferOf<gpu::RadianceCacheTable> table;

private:
    // Which voxels the light is of.
    struct Shown
    {
        std::uint64_t tree;    // ShownTree::identity
        std::uint64_t changes; // of it, but for what moves: that has voxels of its own
        Grid grid;
        std::uint64_t version; // DeviceTree::version
    };

    void follow(const Shown& now);
    void publish(vk::FrameGraph& graph, const gpu::RadianceCacheTable& values);

    std::shared_ptr<FrameState> m_frame = nullptr; // of the last update
    std::optional<Shown> m_shown = std::nullopt;   // by it
};

} // namespace zvo
