// SPDX-License-Identifier: MIT
// The radiance cache of a tree, and what kernels of hosts find of it.
#pragma once

#include "core/frame/frame_renderer.h"
#include "core/light/environment.h"
#include "core/radiance/device_radiance_cache.h"
#include "core/tree/device_tree.h"
#include "glsl/host_device.h"
#include "glsl/host_trees.h"
#include "support/radiance_cache.h"

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace zvo::test
{

/// An even sky with a sun, or without one.
inline DeviceEnvironment skyOf(const glm::vec3& radiance, const Sun& sun = {})
{
    DeviceEnvironment sky(deviceOfHosts().device(), {4, 2, std::vector(8, radiance)}, 0.0, 1.0);
    sky.setSun(sun);
    return sky;
}

/// The radiance cache of a tree after so many frames from a view.
struct HostLight
{
    HostLight(const DeviceTree& tree, DeviceEnvironment&& outside, const ViewCamera& view, std::uint32_t frames)
        : environment(std::move(outside)), tracer(deviceOfHosts().device())
    {
        tracer.resize(kEdge, kEdge);
        for (std::uint32_t i = 0; i < frames; ++i)
        {
            addSample(tree, view);
        }
    }

    void addSample(const DeviceTree& tree, const ViewCamera& view)
    {
        const TraceCamera camera = traceCamera(view, tree.grid, kEdge);
        deviceOfHosts().run(
            [&](vk::FrameGraph& graph) {
                tracer.addSample(graph, {tree, camera, &environment}, cachedOptions());
            });
    }

    [[nodiscard]] gpu::RadianceCacheTable table() { return tracer.cache().cacheTable(environment); }

    /// Runs a host's kernel with a thread for each of given. Its push constants are cache, tree, given, results, their
    /// number and more.
    template <typename Push, typename Result, typename Given, typename... More>
    std::vector<Result> run(const char* kernel, const DeviceTree& tree, const gpu::RadianceCacheTable& cache,
                            const std::vector<Given>& given, const More&... more)
    {
        const auto cache_table =
            deviceOfHosts().makeBuffer<gpu::RadianceCacheTable>("radiance cache", std::vector{cache});
        const vk::BufferOf<gpu::TreeTable> tree_table = tableOf(tree);
        const auto given_buffer = deviceOfHosts().makeBuffer("given", std::span<const Given>(given));
        vk::BufferOf<Result> results(deviceOfHosts().device(), "results", given.size());
        deviceOfHosts().run(
            [&](vk::FrameGraph& graph)
            {
                vk::UntypedPass pass = graph.addPass(kernel);
                readTree(pass, tree);
                pass.read(tracer.cache().faces());
                (void)environment.read(pass);
                pass.dispatch(given.size(), Push{pass.read(cache_table), pass.read(tree_table), pass.read(given_buffer),
                                                 pass.write(results), static_cast<gpu::uint>(given.size()), more...});
            });
        return deviceOfHosts().download(results);
    }

    static constexpr std::uint32_t kEdge = 64; // of the picture, in pixels
    DeviceEnvironment environment;
    FrameRenderer tracer;
};

} // namespace zvo::test
