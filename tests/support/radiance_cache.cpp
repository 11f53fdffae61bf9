// SPDX-License-Identifier: MIT
#include "support/radiance_cache.h"

#include "core/path/strips.h"
#include "support/engine_device.h"

#include <gtest/gtest.h>

#include <cmath>

namespace zvo::test
{

std::map<FaceName, FaceLight> facesOf(DeviceRadianceCache& cache, std::uint32_t level)
{
    return facesOf(device().download(cache.faces()), level);
}

std::map<FaceName, FaceLight> facesOf(std::span<const gpu::CachedFace> table, std::uint32_t level)
{
    std::map<FaceName, FaceLight> faces;
    for (const gpu::CachedFace& kept : table)
    {
        if (kept.key.x == 0)
        {
            continue;
        }
        const std::uint64_t key = (kept.key.x & 0x7FFFFFFU) | (std::uint64_t{kept.key.y} << 27);
        const auto bits = [](std::uint64_t word, std::uint32_t first, std::uint32_t count)
        { return static_cast<std::uint32_t>((word >> first) & ((std::uint64_t{1} << count) - 1)); };
        if (bits(key, 57, 2) != level)
        {
            continue;
        }
        const std::uint64_t light = kept.light.x | (std::uint64_t{kept.light.y} << 32);
        const double unit = std::ldexp(1.0, static_cast<int>(bits(light, 48, 6)) - 37);
        const FaceName name = {{bits(key, 0, 18), bits(key, 18, 18), bits(key, 36, 18)}, bits(key, 54, 3) - 1};
        const FaceLight face = {unit * glm::dvec3(bits(light, 0, 16), bits(light, 16, 16), bits(light, 32, 16)),
                                bits(light, 54, 10),
                                {kept.light.x, kept.light.y}};
        EXPECT_TRUE(faces.emplace(name, face).second) << "twice in the table";
    }
    return faces;
}

FrameOptions cachedOptions(const RadianceOptions& radiance, CacheView kind)
{
    FrameOptions options;
    options.integrator = kind == CacheView::Cones ? Integrator::Cones : Integrator::Cache;
    options.radiance = radiance;
    options.shading = kind == CacheView::Smooth ? Shading::Smooth : Shading::Faces;
    return options;
}

void runFrames(FrameRenderer& tracer, const DeviceTree& tree, DeviceEnvironment& environment, const ViewCamera& view,
               std::uint32_t count, const RadianceOptions& options, CacheView kind)
{
    const TraceCamera camera = traceCamera(view, tree.grid, tracer.buffers().height);
    for (std::uint32_t i = 0; i < count; ++i)
    {
        device().run(
            [&](vk::FrameGraph& graph) {
                tracer.addSample(graph, {tree, camera, &environment}, cachedOptions(options, kind));
            });
    }
}

PathPicture pictureOf(FrameRenderer& tracer)
{
    const SampledPicture sampled = tracer.samples(cachedOptions());
    const std::vector<gpu::PixelSum> sums = device().download(sampled.sums);
    PathPicture picture;
    picture.pixels.resize(sums.size());
    forEachPixel(sampled.width, sampled.height,
                 [&](std::size_t number, std::uint32_t x, std::uint32_t y)
                 {
                     const glm::dvec3 mean =
                         glm::dvec3(sums[number].radiance) / static_cast<double>(sampled.sample_count);
                     picture.pixels[std::size_t{y} * sampled.width + x] = mean;
                     picture.mean += mean / static_cast<double>(sums.size());
                 });
    picture.luminance = luminanceOf(picture.mean);
    EXPECT_EQ(device().download(tracer.cache().status()).front().capped_rays, 0U);
    return picture;
}

PathPicture settledPicture(FrameRenderer& tracer, const DeviceTree& tree, DeviceEnvironment& environment,
                           const ViewCamera& view, std::uint32_t edge, std::uint32_t settle, std::uint32_t frames,
                           const RadianceOptions& options, CacheView kind)
{
    tracer.resize(edge, edge);
    runFrames(tracer, tree, environment, view, settle, options);
    tracer.beginPicture(cachedOptions(options));
    runFrames(tracer, tree, environment, view, frames, options, kind);
    return pictureOf(tracer);
}

} // namespace zvo::test
