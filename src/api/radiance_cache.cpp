// SPDX-License-Identifier: MIT
#include "zvo/radiance_cache.h"

#include "api/camera.h"
#include "api/checked.h"
#include "api/environment_impl.h"
#include "api/radiance_cache_impl.h"
#include "api/shown_tree.h"
#include "core/radiance/device_radiance_cache.h"

#include <cstdint>
#include <optional>
#include <span>
#include <utility>

namespace zvo
{

RadianceCache::Impl::Impl(Context::Impl& context_impl, const RadianceCacheInfo& light_info)
    : context(context_impl), info(checked(light_info)),
      renderer(std::make_unique<FrameRenderer>(context.device, &context.deletion_queue)),
      table(context.device, "radiance cache table", 1)
{
    renderer->resize(info.width, info.height);
    renderer->cache().setRoom(0, info.faces == 0 ? UINT64_MAX : info.faces);
}

RadianceCache::Impl::~Impl()
{
    context.deleteLater(std::move(renderer));
    context.deleteLater(std::move(table));
}

template <typename AnyTree>
void RadianceCache::Impl::update(Recorder& recorder, AnyTree& any_tree, Environment& any_environment,
                                 const CameraInfo& camera_info, const CachedFrameInfo& frame_info)
{
    Environment::Impl& environment = usable(any_environment);
    requireSame(context, recorder.impl().context, environment.context);
    const ShownTree shown = shownIn(recorder.impl(), any_tree);
    const DeviceTree& tree = shown.tree;
    const TraceCamera camera = traceCamera(viewOf(camera_info, {info.width, info.height}), tree.grid, info.height);
    FrameOptions options;
    options.integrator = Integrator::Cache;
    options.radiance = {.faces = checked(frame_info).rays, .seed = frame_info.seed};
    recording(
        recorder,
        [&](Recorder::Impl& impl)
        {
            forgetIfLost();
            m_frame = impl.frame;
            environment.enter(impl.frame);
            try
            {
                follow(
                    {.tree = shown.identity, .changes = shown.edit_count, .grid = tree.grid, .version = tree.version});
                renderer->settle(impl.graph, {tree, camera, &environment.light}, options);
                publish(impl.graph, renderer->cache().cacheTable(environment.light));
            }
            catch (...) // buffers may have been replaced, and hold no light that is complete
            {
                renderer->cache().forget();
                publish(impl.graph, {});
                throw;
            }
        });
}

// Tells the cache what it does not see itself.
void RadianceCache::Impl::follow(const Shown& now)
{
    const std::optional<Shown> before = std::exchange(m_shown, now);
    if (before && !(before->grid == now.grid))
    {
        renderer->cache().forget(); // a cell is another place
    }
    else if (before && (before->tree != now.tree || before->changes != now.changes))
    {
        renderer->cache().noteChange();
    }
}

void RadianceCache::Impl::publish(vk::FrameGraph& graph, const gpu::RadianceCacheTable& values)
{
    graph.update(table, 0, std::span(&values, 1));
}

void RadianceCache::Impl::forgetIfLost()
{
    if (m_frame && m_frame->is_lost)
    {
        renderer->forgetNodePaths();
        renderer->cache().forget();
    }
}

void RadianceCache::Impl::requireShown(const DeviceTree& tree) const
{
    if (!m_shown || m_shown->version != tree.version || (m_frame && m_frame->is_lost) ||
        renderer->cache().frameCount() == 0)
    {
        throw Error(ErrorCode::Usage, "no light is cached for this tree as it is: RadianceCache::update() comes first");
    }
}

RadianceCache::RadianceCache(Context& context, const RadianceCacheInfo& info)
    : m_impl(std::make_unique<Impl>(context.impl(), info))
{
}

RadianceCache::~RadianceCache() = default;
RadianceCache::RadianceCache(RadianceCache&&) noexcept = default;
RadianceCache& RadianceCache::operator=(RadianceCache&&) noexcept = default;

void RadianceCache::update(Recorder& recorder, const Tree& tree, Environment& environment, const CameraInfo& camera,
                           const CachedFrameInfo& info)
{
    usable(*this).update(recorder, tree, environment, camera, info);
}

void RadianceCache::update(Recorder& recorder, DynamicTree& tree, Environment& environment, const CameraInfo& camera,
                           const CachedFrameInfo& info)
{
    usable(*this).update(recorder, tree, environment, camera, info);
}

std::uint64_t RadianceCache::address() const
{
    return usable(*this).table.address();
}

void RadianceCache::forget()
{
    usable(*this).renderer->cache().forget();
}

RadianceCacheStats RadianceCache::stats()
{
    Impl& light = usable(*this);
    light.forgetIfLost();
    DeviceRadianceCache& cache = light.renderer->cache();
    const RadianceCounts counts = cache.counts();
    return {counts.faces, counts.refused, cache.room(), cache.isCrowded()};
}

std::uint64_t RadianceCache::bytes() const
{
    const Impl& light = usable(*this);
    return light.renderer->bytes() + light.table.bytes();
}

} // namespace zvo
