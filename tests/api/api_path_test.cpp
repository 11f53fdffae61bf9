// SPDX-License-Identifier: MIT
// Path-traced pictures, as a host makes them in the course of its frames.
#include "api_paths.h"
#include "api_scene.h"
#include "core/path/develop.h"
#include "core/path/path_tracer.h"
#include "support/engine_device.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <utility>

namespace zvo
{

namespace
{

using test::ApiPaths;
using test::device;
using test::engineSky;
using test::SpotMap;

// The same picture by the engine alone, on another device.
ApiPaths::Words enginePicture(const DeviceTree& tree, DeviceEnvironment& environment, const PathOptions& options,
                              std::uint32_t samples, const Exposure& exposure = {},
                              TexelFormat texels = TexelFormat::Rgba8)
{
    PathTracer tracer(device().device());
    Developer developer(device().device());
    tracer.resize(ApiPaths::kWidth, ApiPaths::kHeight);
    const ViewCamera view = ViewCamera::lookAt({22, 17, 25}, {5, 5, 5}, 0.6);
    vk::BufferOf<gpu::uint> image(device().device(), "picture",
                                  std::uint64_t{ApiPaths::kWidth} * ApiPaths::kHeight * texelWords(texels));
    device().run(
        [&](vk::FrameGraph& graph)
        {
            for (std::uint32_t i = 0; i < samples; ++i)
            {
                tracer.addSample(graph, tree, environment, traceCamera(view, tree.grid, ApiPaths::kHeight), options);
            }
            developer.develop(graph, tracer.picture(), texels, exposure, image);
        });
    return device().download(image);
}

TEST_F(ApiPaths, PicturesAreThoseOfTheEngineOfOctreesAndDags)
{
    Tree octree = this->octree();
    const DeviceTree expected = test::engineOctree(device(), test::apiScene(), test::apiGrid(5));
    ASSERT_GT(octree.info().emission_scale, 0.0F);
    Environment environment = sky();
    DeviceEnvironment engine_sky = engineSky();
    const Words picture = enginePicture(expected, engine_sky, {.bounces = 2, .smooth = true}, 3);
    EXPECT_EQ(newPaths(octree, environment, {.bounces = 2, .samples = 3}), picture);
    const PathInfo lens = {.bounces = 1,
                           .seed = 7,
                           .lens_radius = 0.5F,
                           .focus_distance = 30.0F,
                           .roulette = true,
                           .shading = Shading::Faces,
                           .automatic_exposure = false,
                           .exposure = 0.75F};
    EXPECT_EQ(newPaths(octree, environment, lens),
              enginePicture(expected, engine_sky,
                            {.bounces = 1, .seed = 7, .lens_radius = 0.5F, .focus_distance = 30.0F, .roulette = true},
                            1, {.automatic = false, .factor = 0.75F}));

    environment.setSun({.direction = {1, 2, 0}, .irradiance = {1, 2, 3}});
    engine_sky.setSun({.direction = {1, 2, 0}, .irradiance = {1, 2, 3}});
    EXPECT_EQ(newPaths(octree, environment), enginePicture(expected, engine_sky, {.bounces = 2, .smooth = true}, 1));
    EXPECT_NEAR(sunlight({-0.6, 0.75, 0.45}).irradiance[2], SunInfo().irradiance[2], 1e-6);
    EXPECT_LT(sunlight({-0.6, 0.05, 0.45}).irradiance[2], 0.1 * SunInfo().irradiance[2]);
    environment.setSun({.irradiance = {0, 0, 0}});
    engine_sky.setSun({.direction = {-0.6, 0.75, 0.45}});
    EXPECT_EQ(newPaths(octree, environment), enginePicture(expected, engine_sky, {.bounces = 2, .smooth = true}, 1));
    environment.setSun({});

    const Tree dag = m_host.compress(std::move(octree));
    EXPECT_EQ(newPaths(dag, environment, {.bounces = 2, .samples = 3}), picture);
}

TEST_F(ApiPaths, AMapLightsAsThatOfTheEngine)
{
    const Tree octree = this->octree();
    const DeviceTree expected = test::engineOctree(device(), test::apiScene(), test::apiGrid(5));
    SpotMap map;
    DeviceEnvironment engine_map(device().device(), map.picture, SpotMap::kTurn, double{SpotMap::kStrength});
    Environment environment = m_host.make<Environment>(map.info());
    map.texels.clear(); // was copied
    EXPECT_EQ(newPaths(octree, environment), enginePicture(expected, engine_map, {.bounces = 2, .smooth = true}, 1));
    environment.setSun({.direction = {1, 2, 0}, .irradiance = {1, 2, 3}});
    engine_map.setSun({.direction = {1, 2, 0}, .irradiance = {1, 2, 3}});
    EXPECT_EQ(newPaths(octree, environment), enginePicture(expected, engine_map, {.bounces = 2, .smooth = true}, 1));
}

TEST_F(ApiPaths, EveryKindOfImageGetsTheTexelsOfTheEngine)
{
    const Tree octree = this->octree(4);
    const DeviceTree expected = test::engineOctree(device(), test::apiScene(), test::apiGrid(4));
    Environment environment = sky();
    DeviceEnvironment engine_sky = engineSky();
    for (const auto& [format, texels] : {std::pair(VK_FORMAT_B8G8R8A8_SRGB, TexelFormat::Bgra8),
                                         std::pair(VK_FORMAT_A2B10G10R10_UNORM_PACK32, TexelFormat::Rgb10),
                                         std::pair(VK_FORMAT_R16G16B16A16_SFLOAT, TexelFormat::Half)})
    {
        Tracer tracer = this->tracer(format);
        test::TargetImage image(m_host.device, format, kWidth, kHeight);
        const auto trace = [&](Recorder& recorder, const ImageTarget& target)
        { tracer.tracePaths(recorder, octree, environment, test::apiCamera(), kFewBounces, target); };
        EXPECT_EQ(m_host.picture(image, trace),
                  enginePicture(expected, engine_sky, {.bounces = 2, .smooth = true}, 1, {}, texels))
            << format;
    }
}

TEST_F(ApiPaths, SamplesAddUpOverRecordersAndFramesInFlight)
{
    const Tree octree = this->octree();
    Environment environment = sky();
    Tracer tracer = this->tracer();
    EXPECT_EQ(tracer.sampleCount(), 0U);
    test::TargetImage image(m_host.device, kFormat, kWidth, kHeight);
    std::uint32_t expected = 0;
    for (int frame = 0; frame < 3; ++frame) // all of them are under way
    {
        VkCommandBuffer commands = m_host.device.begin();
        ++m_host.last_frame;
        for (const std::uint32_t samples : {1U, 2U})
        {
            Recorder recorder(m_host.context, commands, m_host.last_frame);
            image.beginCopies(commands);
            tracer.tracePaths(recorder, octree, environment, test::apiCamera(), {.bounces = 2, .samples = samples},
                              image.target());
            expected += samples;
            EXPECT_EQ(tracer.sampleCount(), expected);
        }
        image.read(commands);
        m_host.device.submit(commands);
    }
    m_host.device.wait();
    m_host.context.frameDone(m_host.last_frame);
    EXPECT_EQ(image.words(), newPaths(octree, environment, {.bounces = 2, .samples = 9}));

    // Another exposure is that of the same samples, and pictures of another kind leave them alone.
    const PathInfo darker = {.bounces = 2, .automatic_exposure = false, .exposure = 0.5F};
    const Words ray_traced = m_host.picture(octree, test::apiCamera());
    Tracer other(m_host.context, m_host.kWidth, m_host.kHeight, kFormat);
    test::TargetImage large(m_host.device, kFormat, m_host.kWidth, m_host.kHeight);
    for (std::uint32_t count = 1; count <= 2; ++count)
    {
        m_host.frame(
            [&](Recorder& recorder, VkCommandBuffer commands)
            {
                large.beginCopies(commands);
                other.tracePaths(recorder, octree, environment, test::apiCamera(), darker, large.target());
                large.beginCopies(commands);
                other.trace(recorder, octree, test::apiCamera(), {}, large.target());
                large.read(commands);
            });
        EXPECT_EQ(large.words(), ray_traced);
        EXPECT_EQ(other.sampleCount(), count);
    }
    (void)paths(tracer, octree, environment, darker);
    EXPECT_EQ(tracer.sampleCount(), 10U);
    EXPECT_EQ(paths(tracer, octree, environment), newPaths(octree, environment, {.bounces = 2, .samples = 11}));
}

TEST_F(ApiPaths, AnotherPictureBeginsAnew)
{
    const Tree octree = this->octree();
    const Tree smaller = this->octree(4);
    Environment environment = sky();
    Environment other_sky = sky();
    other_sky.setSun({.direction = {0, 1, 0}});
    CameraInfo camera = test::apiCamera();
    PathInfo info = kFewBounces;
    Tracer tracer = this->tracer();
    const auto expectAnew = [&](const Tree& tree, Environment& light, const char* what)
    {
        const Words picture = paths(tracer, tree, light, info, camera);
        EXPECT_EQ(tracer.sampleCount(), 1U) << what;
        EXPECT_EQ(picture, newPaths(tree, light, info, camera)) << what;
        EXPECT_NE(paths(tracer, tree, light, info, camera), picture) << what;
        EXPECT_EQ(tracer.sampleCount(), 2U) << what;
    };
    expectAnew(octree, environment, "the first");
    camera.position[0] += 1;
    expectAnew(octree, environment, "camera");
    camera.orthographic = true;
    camera.half_height = 8;
    expectAnew(octree, environment, "orthographic");
    info.bounces = 1;
    expectAnew(octree, environment, "bounces");
    info.seed = 5;
    expectAnew(octree, environment, "seed");
    environment.setSun({.irradiance = {1, 0, 0}});
    expectAnew(octree, environment, "sun");
    expectAnew(octree, other_sky, "environment");
    expectAnew(smaller, other_sky, "tree");
    tracer.forgetSamples();
    EXPECT_EQ(tracer.sampleCount(), 0U);
    expectAnew(smaller, other_sky, "forgotten");
}

TEST_F(ApiPaths, ADynamicTreeBeginsAnewWhereItChangesAndLooksAsIfBuiltAtOnce)
{
    const Model fixed_model = m_host.upload(test::pathModel().info());
    const test::HostModel ball(test::sphereScene(glm::vec3(0), 2.0F, 9));
    ModelInfo ball_info = ball.info();
    ball_info.emission_scale = fixed_model.emissionScale();
    const Model ball_model = m_host.upload(ball_info);
    Tree fixed = m_host.build(fixed_model, {.grid = test::apiGrid(5), .keep_sums = true});
    Environment environment = sky();
    Tracer tracer = this->tracer();
    const Words still = paths(tracer, fixed, environment);
    DynamicTree tree = m_host.make<DynamicTree>(
        std::move(fixed), DynamicTreeInfo{.merge = MergeRule::Average, .emission_scale = fixed_model.emissionScale()});
    EXPECT_EQ(paths(tracer, tree, environment), still);
    m_host.add(tree, ball_model, test::movedBy(8.25F, 5, 5));
    m_host.update(tree);

    Scene both = test::apiScene();
    both.append(test::sphereScene(glm::vec3(8.25F, 5, 5), 2.0F, 9));
    const test::HostModel both_model(both);
    const Tree rebuilt = m_host.build(m_host.upload(both_model.info()), {.grid = test::apiGrid(5)});
    const Words moved = paths(tracer, tree, environment);
    EXPECT_EQ(tracer.sampleCount(), 1U);
    EXPECT_NE(moved, still);
    EXPECT_EQ(moved, newPaths(rebuilt, environment));
    (void)paths(tracer, tree, environment);
    EXPECT_EQ(tracer.sampleCount(), 2U);
    m_host.frame([&](Recorder& recorder) { EXPECT_TRUE(tree.undo(recorder)); });
    EXPECT_EQ(paths(tracer, tree, environment), still);
    EXPECT_EQ(tracer.sampleCount(), 1U);
}

} // namespace

} // namespace zvo
