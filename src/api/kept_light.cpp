// SPDX-License-Identifier: MIT
#include "zvo/kept_light.h"

#include "api/camera.h"
#include "api/checked.h"
#include "api/dynamic_tree_impl.h"
#include "api/environment_impl.h"
#include "api/tree_impl.h"
#include "core/radiance/kept_light_table.h"
#include "core/radiance/radiance_cache.h"
#include "core/radiance/radiance_tracer.h"
#include "core/trace/tree_tracer.h"

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

// Which voxels the light is of.
struct Shown
{
    const void* tree;      // the host's
    std::uint64_t changes; // of it, but for what moves: that has voxels of its own
    Grid grid;
};

} // namespace

struct ZVO_LOCAL KeptLight::Impl
{
    Impl(Context::Impl& context_impl, const KeptLightInfo& light_info)
        : context(context_impl), info(checked(light_info)),
          tracer(std::make_unique<TreeTracer>(context.device, &context.deletion_queue)),
          cache(std::make_unique<RadianceCache>(context.device, &context.deletion_queue)),
          table(context.device, "kept light table", 1)
    {
        tracer->resize(info.width, info.height);
    }

    ~Impl()
    {
        context.deleteLater(std::move(tracer));
        context.deleteLater(std::move(cache));
        context.deleteLater(std::move(table));
        for (Report& report : reports)
        {
            context.deleteLater(std::move(report.counts));
        }
    }

    Impl(const Impl&) = delete;
    Impl& operator=(const Impl&) = delete;

    void update(Recorder& recorder, const DeviceTree& tree, const Shown& now, Environment::Impl& environment,
                const CameraInfo& camera_info, const KeptFrameInfo& frame_info)
    {
        const TraceCamera camera = traceCamera(viewOf(camera_info), tree.grid, info.height);
        const RadianceOptions options = {.faces = checked(frame_info).rays, .seed = frame_info.seed};
        recording(recorder,
                  [&](Recorder::Impl& impl)
                  {
                      learn();
                      if (frame && frame->is_lost)
                      {
                          tracer->forget();
                          cache->forget();
                      }
                      frame = impl.frame;
                      environment.enter(impl.frame);
                      try
                      {
                          follow(now);
                          addFrame(impl.graph, tree, environment.light, camera, options);
                          publish(impl.graph, keptLightTable(*cache, environment.light));
                          report(impl);
                      }
                      catch (...) // buffers may have been replaced, and hold no light that is complete
                      {
                          cache->forget();
                          publish(impl.graph, {});
                          throw;
                      }
                  });
    }

    // Tells the cache what it does not see itself.
    void follow(const Shown& now)
    {
        const std::optional<Shown> before = std::exchange(shown, now);
        if (before && !(before->grid == now.grid))
        {
            cache->forget(); // a cell is another place
        }
        else if (before && (before->tree != now.tree || before->changes != now.changes))
        {
            cache->noteChange();
        }
    }

    void addFrame(vk::FrameGraph& graph, const DeviceTree& tree, DeviceEnvironment& environment,
                  const TraceCamera& camera, const RadianceOptions& options)
    {
        if (info.faces != 0)
        {
            cache->reserveFaces(info.faces);
        }
        const TraceCamera through = shifted(camera, pointOfPixel(cache->frameCount()));
        tracer->tracePrimary(graph, tree, through, {});
        cache->update(graph, tree, environment, through, tracer->buffers(), options);
    }

    void publish(vk::FrameGraph& graph, const gpu::KeptLightTable& values)
    {
        graph.update(table, 0, std::span(&values, 1));
    }

    // Records the copy of the frame's counts to the host.
    void report(Recorder::Impl& recorder)
    {
        vk::BufferOf<gpu::uint> counts;
        if (!free_counts.empty())
        {
            counts = std::move(free_counts.back());
            free_counts.pop_back();
        }
        else
        {
            counts = {context.device, "kept light counts", kCounts, vk::MemoryKind::Readback};
        }
        recorder.graph.copy(cache->counters(), 0, counts, 0, counts.bytes());
        reports.push_back({recorder.frame, std::move(counts)});
    }

    // Takes the counts of frames that are done.
    void learn()
    {
        while (!reports.empty() && (reports.front().frame->is_done || reports.front().frame->is_lost))
        {
            Report& first = reports.front();
            if (first.frame->is_done)
            {
                const auto* const counts = first.counts.mappedData();
                newest = {counts[0], counts[1]};
            }
            free_counts.push_back(std::move(first.counts));
            reports.pop_front();
        }
    }

    // The counts of an update, in a frame that is not known to be done.
    struct Report
    {
        std::shared_ptr<FrameState> frame;
        vk::BufferOf<gpu::uint> counts; // [kCounts]
    };

    Context::Impl& context;
    KeptLightInfo info;
    std::unique_ptr<TreeTracer> tracer; // of the camera's rays
    std::unique_ptr<RadianceCache> cache;
    vk::BufferOf<gpu::KeptLightTable> table;
    std::shared_ptr<FrameState> frame = nullptr; // of the last update
    std::optional<Shown> shown = std::nullopt;   // by it
    std::deque<Report> reports = {};
    std::vector<vk::BufferOf<gpu::uint>> free_counts = {};
    KeptLightStats newest = {};
};

KeptLight::KeptLight(Context& context, const KeptLightInfo& info) : m_impl(std::make_unique<Impl>(context.impl(), info))
{
}

KeptLight::~KeptLight() = default;
KeptLight::KeptLight(KeptLight&&) noexcept = default;
KeptLight& KeptLight::operator=(KeptLight&&) noexcept = default;

void KeptLight::update(Recorder& recorder, const Tree& tree, Environment& environment, const CameraInfo& camera,
                       const KeptFrameInfo& info)
{
    Impl& light = contentOf(m_impl.get(), "kept light");
    const Tree::Impl& impl = usable(tree);
    Environment::Impl& outside = usable(environment);
    requireSame(light.context, impl.context);
    requireSame(light.context, outside.context);
    requireSame(light.context, recorder.impl().context);
    light.update(recorder, impl.fixed, {&impl, impl.fixed.version, impl.fixed.grid}, outside, camera, info);
}

void KeptLight::update(Recorder& recorder, DynamicTree& tree, Environment& environment, const CameraInfo& camera,
                       const KeptFrameInfo& info)
{
    Impl& light = contentOf(m_impl.get(), "kept light");
    DynamicTree::Impl& impl = usable(tree);
    Environment::Impl& outside = usable(environment);
    requireSame(light.context, impl.context);
    requireSame(light.context, outside.context);
    impl.enter(recorder.impl());
    const DeviceTree& shown = impl.octree->tree();
    light.update(recorder, shown, {&impl, impl.edit_count, shown.grid}, outside, camera, info);
}

std::uint64_t KeptLight::address() const
{
    return contentOf(m_impl.get(), "kept light").table.address();
}

void KeptLight::forget()
{
    contentOf(m_impl.get(), "kept light").cache->forget();
}

KeptLightStats KeptLight::stats()
{
    Impl& light = contentOf(m_impl.get(), "kept light");
    light.learn();
    return light.newest;
}

std::uint64_t KeptLight::bytes() const
{
    const Impl& light = contentOf(m_impl.get(), "kept light");
    return light.tracer->buffers().bytes() + light.cache->bytes() + light.table.bytes();
}

} // namespace zvo
