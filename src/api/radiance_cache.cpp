// SPDX-License-Identifier: MIT
#include "zvo/radiance_cache.h"

#include "api/camera.h"
#include "api/checked.h"
#include "api/environment_impl.h"
#include "api/radiance_cache_impl.h"
#include "api/shown_tree.h"
#include "core/radiance/radiance_cache_table.h"

#include <cstddef>
#include <deque>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace zvo
{

namespace
{

// The counts that begin gpu::RadianceCounters.
constexpr std::size_t kCounts = 2;

} // namespace

RadianceCache::Impl::Impl(Context::Impl& context_impl, const RadianceCacheInfo& light_info)
    : context(context_impl), info(checked(light_info)),
      renderer(std::make_unique<FrameRenderer>(context.device, &context.deletion_queue)),
      table(context.device, "radiance cache table", 1)
{
    renderer->resize(info.width, info.height);
}

RadianceCache::Impl::~Impl()
{
    context.deleteLater(std::move(renderer));
    context.deleteLater(std::move(table));
    for (Report& report : m_reports)
    {
        context.deleteLater(std::move(report.counts));
    }
}

template <typename AnyTree>
void RadianceCache::Impl::update(Recorder& recorder, AnyTree& any_tree, Environment& any_environment,
                                 const CameraInfo& camera_info, const CachedFrameInfo& frame_info)
{
    Environment::Impl& environment = usable(any_environment);
    requireSame(context, recorder.impl().context, environment.context);
    const ShownTree shown = shownIn(recorder.impl(), any_tree);
    const DeviceTree& tree = shown.tree;
    const TraceCamera camera = traceCamera(viewOf(camera_info), tree.grid, info.height);
    FrameOptions options;
    options.integrator = Integrator::Cache;
    options.radiance = {.faces = checked(frame_info).rays, .seed = frame_info.seed};
    recording(
        recorder,
        [&](Recorder::Impl& impl)
        {
            learn();
            if (m_frame && m_frame->is_lost)
            {
                renderer->forgetNodePaths();
                renderer->cache().forget();
            }
            m_frame = impl.frame;
            environment.enter(impl.frame);
            try
            {
                follow(
                    {.tree = shown.identity, .changes = shown.edit_count, .grid = tree.grid, .version = tree.version});
                if (info.faces != 0)
                {
                    renderer->cache().reserveFaces(info.faces);
                }
                renderer->settle(impl.graph, {tree, camera, &environment.light}, options);
                publish(impl.graph, radianceCacheTable(renderer->cache(), environment.light));
                report(impl);
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

// Records the copy of the frame's counts to the host.
void RadianceCache::Impl::report(Recorder::Impl& recorder)
{
    vk::BufferOf<gpu::uint> counts;
    if (!m_free_counts.empty())
    {
        counts = std::move(m_free_counts.back());
        m_free_counts.pop_back();
    }
    else
    {
        counts = {context.device, "radiance cache counts", kCounts, vk::MemoryKind::Readback};
    }
    recorder.graph.copy(renderer->cache().counters(), 0, counts, 0, counts.bytes());
    recorder.graph.releaseToHost(); // what learn() reads
    m_reports.push_back({recorder.frame, std::move(counts)});
}

// Takes the counts of frames that are done.
void RadianceCache::Impl::learn()
{
    while (!m_reports.empty() && (m_reports.front().frame->is_done || m_reports.front().frame->is_lost))
    {
        Report& first = m_reports.front();
        if (first.frame->is_done)
        {
            const auto* const counts = first.counts.mappedData();
            newest = {counts[0], counts[1]};
        }
        m_free_counts.push_back(std::move(first.counts));
        m_reports.pop_front();
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
    light.learn();
    return light.newest;
}

std::uint64_t RadianceCache::bytes() const
{
    const Impl& light = usable(*this);
    return light.renderer->bytes() + light.table.bytes();
}

} // namespace zvo
