// SPDX-License-Identifier: MIT
// Exposure and tone of pictures: by a formula of radiance, and of whole scenes.
#include "core/path/develop.h"

#include "core/frame/frame_renderer.h"
#include "core/path/daylight.h"
#include "io/gltf/gltf_loader.h"
#include "runtime/trees.h"
#include "support/engine_device.h"
#include "support/scenes.h"

#include <glm/gtx/component_wise.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace zvo
{
namespace
{

using test::device;

constexpr std::uint32_t kDevelopedEdge = 40;

struct Developed
{
    std::vector<glm::ivec3> codes;
    double exposure;
};

std::vector<glm::ivec3> codesOf(const std::vector<gpu::uint>& image)
{
    std::vector<glm::ivec3> codes;
    for (const gpu::uint word : image)
    {
        codes.emplace_back(word & 255U, word >> 8 & 255U, word >> 16 & 255U);
    }
    return codes;
}

Developed developed(const std::vector<glm::vec3>& radiance, const Exposure& exposure = {})
{
    std::vector<gpu::PixelSum> sums;
    for (const glm::vec3& pixel : radiance)
    {
        sums.push_back({pixel, 0.0F});
    }
    const auto buffer = device().makeBuffer<gpu::PixelSum>("sums", sums);
    Developer developer(device().device());
    vk::BufferOf<gpu::uint> image(device().device(), "picture", sums.size());
    device().run(
        [&](vk::FrameGraph& graph) {
            developer.develop(graph, {buffer, kDevelopedEdge, kDevelopedEdge, 1}, TexelFormat::Rgba8, exposure, image);
        });
    return {codesOf(device().download(image)), device().download(developer.exposure()).front()};
}

// Pixels around a mean, of which so many in a hundred are brighter than the others by a factor.
std::vector<glm::vec3> litPixels(float mean, std::uint32_t bright_percent = 0, float factor = 1.0F)
{
    std::vector<glm::vec3> pixels;
    for (std::uint32_t i = 0; i < kDevelopedEdge * kDevelopedEdge; ++i)
    {
        pixels.emplace_back(mean * (i % 100 < bright_percent ? factor : 1.0F));
    }
    return pixels;
}

// The radiance that the mean of a picture has when it is exposed (G. Krawczyk et al., 2005), without bounds.
double greyFor(double mean)
{
    const auto key = [](double luminance) { return 1.03 - 2.0 / (2.0 + std::log10(luminance + 1.0)); };
    return 0.2 * key(400.0 * mean) / key(80.0);
}

// A bin of the meter is 1 / 6.4 stop.
void expectExposure(double exposure, double expected)
{
    EXPECT_NEAR(std::log2(exposure), std::log2(expected), 0.1);
}

TEST(AutomaticExposure, ShowsDarknessDark)
{
    for (const double mean : {0.0001, 0.002, 0.02, 0.15})
    {
        SCOPED_TRACE(mean);
        expectExposure(developed(litPixels(static_cast<float>(mean))).exposure, greyFor(mean) / mean);
    }
    EXPECT_LT(greyFor(0.002), 0.06) << "a night is more than a stop and a half darker than a day";
    EXPECT_GT(greyFor(0.05), 0.14) << "but what lies in the shade by day is not";
}

TEST(AutomaticExposure, IsOneForWhatIsBrightByDay)
{
    expectExposure(developed(litPixels(0.45F)).exposure, 1.0);
    expectExposure(developed(litPixels(0.45F, 4, 20.0F)).exposure, 3.0 / 9.0); // but for its highlights
    expectExposure(developed(litPixels(1000.0F)).exposure, greyFor(1000.0) / 1000.0 * std::exp2(1.5));
}

TEST(AutomaticExposure, KeepsTheColorsOfHighlights)
{
    const double by_mean = greyFor(0.1) / 0.1;
    expectExposure(developed(litPixels(0.1F, 1, 1000.0F)).exposure, by_mean); // a lamp
    expectExposure(developed(litPixels(0.1F, 4, 25.0F)).exposure, 3.0 / 2.5);
    expectExposure(developed(litPixels(0.1F, 4, 1000.0F)).exposure, by_mean / 4.0);
    expectExposure(developed(litPixels(0.1F, 4, 25.0F), {.factor = 3.0F}).exposure, 3.0 * 3.0 / 2.5);
}

TEST(AutomaticExposure, OfAPictureWithoutLightIsTheFactor)
{
    EXPECT_EQ(developed(litPixels(0.0F), {.factor = 3.0F}).exposure, 3.0);
}

// Colours as bright as lamps, and beyond the codes.
TEST(ToneMap, KeepsHuesUpToWhite)
{
    const Exposure fixed = {.automatic = false};
    for (const glm::vec3 hue :
         {glm::vec3(1.0F, 0.3F, 0.05F), glm::vec3(0.02F, 0.1F, 1.0F), glm::vec3(1.0F, 0.0F, 0.0F)})
    {
        std::vector<glm::vec3> ramp;
        for (std::uint32_t i = 0; i < kDevelopedEdge * kDevelopedEdge; ++i)
        {
            ramp.push_back(hue * std::exp2(static_cast<float>(i) / 160.0F - 2.0F));
        }
        const int first = static_cast<int>(std::max_element(&hue.x, &hue.x + 3) - &hue.x);
        const std::vector<glm::ivec3> codes = developed(ramp, fixed).codes;
        for (const glm::ivec3& code : codes)
        {
            EXPECT_GE(code[first], glm::compMax(code) - 1) << "another hue";
        }
        EXPECT_LT(glm::compMin(codes.front()), 100);
        EXPECT_GT(glm::compMin(codes.back()), 220) << "not almost white";
    }
    const float most = std::numeric_limits<float>::infinity();
    EXPECT_GE(glm::compMin(developed(std::vector(1600, glm::vec3(most, 1.0F, 0.0F)), fixed).codes.front()), 254);
    EXPECT_EQ(developed(litPixels(0.0F), fixed).codes.front(), glm::ivec3(0));
}

// Pixels that show nothing but white or black, or lack a part of their colour, as a part of all.
double clippedPart(const std::vector<glm::ivec3>& codes)
{
    const auto count =
        std::ranges::count_if(codes, [](const glm::ivec3& c) { return glm::compMax(c) == 255 || c == glm::ivec3(0); });
    return static_cast<double>(count) / static_cast<double>(codes.size());
}

TEST(DefaultPictures, HaveHalfAPercentOfClippedPixelsAtMost)
{
    for (const std::string name : {"atrium.glb", "cornell_box.glb"})
    {
        const Scene scene = loadGltf(test::ownScene(name));
        const DeviceTree tree =
            buildOctree(device(), uploadScene(device(), scene, true), Grid::around(scene.bounds(), 6), {}).octree;
        DeviceEnvironment day(device().device());
        day.setSun(daylight());
        const TraceCamera camera = traceCamera(ViewCamera::of(scene.cameras.front()), tree.grid, 36);
        for (const Integrator integrator : {Integrator::Path, Integrator::Cache})
        {
            SCOPED_TRACE(name + (integrator == Integrator::Path ? " by paths" : " by kept light"));
            FrameRenderer renderer(device().device());
            renderer.resize(64, 36);
            const FrameOptions options = {.integrator = integrator};
            for (int i = 0; i < (integrator == Integrator::Path ? 16 : 4); ++i) // fewer paths leave black pixels
            {
                device().run([&](vk::FrameGraph& graph) { renderer.addSample(graph, {tree, camera, &day}, options); });
            }
            device().run([&](vk::FrameGraph& graph) { renderer.develop(graph, options); });
            EXPECT_LE(clippedPart(codesOf(device().download(renderer.buffers().image))), 0.005);
        }
    }
}

} // namespace
} // namespace zvo
