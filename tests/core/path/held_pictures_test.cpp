// SPDX-License-Identifier: MIT
// Path-traced pictures of whole scenes, compared with those that are held in tests/pictures.
#include "core/path/daylight.h"
#include "core/path/develop.h"
#include "core/path/path_tracer.h"
#include "io/gltf/gltf_loader.h"
#include "runtime/trees.h"
#include "support/engine_device.h"
#include "support/held_picture.h"
#include "support/path_pictures.h"
#include "support/scenes.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

namespace zvo
{
namespace
{

constexpr std::uint32_t kHeldWidth = 64;
constexpr std::uint32_t kHeldHeight = 36;
constexpr std::uint32_t kHeldSamples = 64;

/// A scene's voxels and its view.
struct Place
{
    DeviceTree tree;
    ViewCamera view;
};

Place placeOf(const std::string& name)
{
    const Scene scene = loadGltf(test::ownScene(name));
    const Grid grid = Grid::around(scene.bounds(), 7);
    const GpuScene uploaded = uploadScene(test::device(), scene, true);
    return {buildOctree(test::device(), uploaded, grid, {}).octree,
            scene.cameras.empty() ? ViewCamera::framing(scene.bounds(), double{kHeldWidth} / kHeldHeight)
                                  : ViewCamera::of(scene.cameras.front())};
}

// The exposure is fixed, so that brightness is compared, too.
void expectHeld(const std::string& name, const Place& place, DeviceEnvironment& light, float exposure)
{
    PathTracer tracer(test::device().device());
    tracer.resize(kHeldWidth, kHeldHeight);
    const TraceCamera camera = traceCamera(place.view, place.tree.grid, kHeldHeight);
    for (std::uint32_t i = 0; i < kHeldSamples; ++i)
    {
        test::device().run([&](vk::FrameGraph& graph) { tracer.addSample(graph, place.tree, light, camera, {}); });
    }
    Developer developer(test::device().device());
    vk::BufferOf<gpu::uint> developed(test::device().device(), "picture", std::uint64_t{kHeldWidth} * kHeldHeight);
    test::device().run(
        [&](vk::FrameGraph& graph)
        {
            const Exposure fixed = {.automatic = false, .factor = exposure};
            developer.develop(graph, tracer.picture(), TexelFormat::Rgba8, fixed, developed);
        });
    const std::vector<gpu::uint> texels = test::device().download(developed);
    Image picture = {name, kHeldWidth, kHeldHeight, {}};
    const auto* bytes = reinterpret_cast<const std::uint8_t*>(texels.data());
    picture.rgba.assign(bytes, bytes + 4 * texels.size());
    test::expectHeldPicture(name, picture);
}

// A dim sky, brighter above, with a window of light.
HdrImage windowMap()
{
    HdrImage map = {32, 16, std::vector(512, glm::vec3(0.05F, 0.06F, 0.1F))};
    for (std::uint32_t i = 0; i < 128; ++i)
    {
        map.texels[i] = {0.3F, 0.4F, 0.6F};
    }
    map.texels[3 * 32 + 21] = map.texels[3 * 32 + 22] = {60.0F, 45.0F, 25.0F};
    return map;
}

TEST(HeldPictures, CornellBox)
{
    DeviceEnvironment dark = test::constantSky(glm::vec3(0.0F));
    expectHeld("cornell_box", placeOf("cornell_box.glb"), dark, 4.0F);
}

TEST(HeldPictures, Atrium)
{
    const Place atrium = placeOf("atrium.glb");
    DeviceEnvironment day(test::device().device());
    day.setSun(daylight());
    expectHeld("atrium_day", atrium, day, 1.0F);
    DeviceEnvironment night = test::constantSky(glm::vec3(0.0F));
    expectHeld("atrium_night", atrium, night, 40.0F);
    DeviceEnvironment map(test::device().device(), windowMap(), 0.5, 1.0);
    expectHeld("atrium_map", atrium, map, 2.0F);
}

} // namespace
} // namespace zvo
