// SPDX-License-Identifier: MIT
#include "support/path_pictures.h"

#include "core/path/strips.h"
#include "support/engine_device.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace zvo::test
{

double luminanceOf(const glm::dvec3& color)
{
    return glm::dot(color, glm::dvec3(0.2126, 0.7152, 0.0722));
}

PathPicture pictureOf(const DeviceTree& tree, DeviceEnvironment& environment, const ViewCamera& view,
                      const glm::uvec2& size, std::uint32_t samples, const PathOptions& options)
{
    PathTracer tracer(device().device());
    tracer.resize(size.x, size.y);
    const TraceCamera camera = traceCamera(view, tree.grid, size.y);
    for (std::uint32_t i = 0; i < samples; ++i)
    {
        device().run([&](vk::FrameGraph& graph) { tracer.addSample(graph, tree, environment, camera, options); });
    }
    const std::vector<gpu::PixelSum> sums = device().download(tracer.picture().sums);
    PathPicture picture;
    picture.pixels.resize(sums.size());
    double variance = 0.0;
    forEachPixel(size.x, size.y,
                 [&](std::size_t number, std::uint32_t x, std::uint32_t y)
                 {
                     const gpu::PixelSum& sum = sums[number];
                     const glm::dvec3 mean = glm::dvec3(sum.radiance) / static_cast<double>(samples);
                     picture.pixels[std::size_t{y} * size.x + x] = mean;
                     picture.mean += mean / static_cast<double>(sums.size());
                     const double light = luminanceOf(mean);
                     variance += std::max(double{sum.luminance_squared} / samples - light * light, 0.0) / samples;
                 });
    picture.luminance = luminanceOf(picture.mean);
    picture.error = std::sqrt(variance) / static_cast<double>(sums.size());
    EXPECT_EQ(device().download(tracer.status()).front().capped_rays, 0U);
    return picture;
}

PathPicture pictureOf(const DeviceTree& tree, DeviceEnvironment& environment, const ViewCamera& view,
                      std::uint32_t edge, std::uint32_t samples, const PathOptions& options)
{
    return pictureOf(tree, environment, view, glm::uvec2(edge), samples, options);
}

DeviceEnvironment constantSky(const glm::vec3& radiance)
{
    return {device().device(), {4, 2, std::vector(8, radiance)}, 0.0, 1.0};
}

} // namespace zvo::test
