// SPDX-License-Identifier: MIT
// Path-traced pictures, as a host makes them in the course of its frames.
#include "api_scene.h"
#include "core/denoise/denoiser.h"
#include "core/path/path_tracer.h"
#include "expect_usage.h"
#include "support/engine_device.h"
#include "support/failing_vulkan.h"
#include "zvo/error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace zvo
{

namespace
{

using test::device;
using test::expectUsage;
using Words = std::vector<std::uint32_t>;

constexpr std::uint32_t kWidth = 41;
constexpr std::uint32_t kHeight = 27;
constexpr VkFormat kFormat = VK_FORMAT_R8G8B8A8_UNORM;
constexpr PathInfo kFewBounces = {.bounces = 2};
constexpr PathInfo kDenoised = {.bounces = 2, .denoise = true};

const test::HostModel& pathModel()
{
    static const test::HostModel model(test::apiScene());
    return model;
}

// A map with a bright spot, with the numbers that hosts and the engine take.
struct SpotMap
{
    static constexpr double kTurn = 0.7;
    static constexpr float kStrength = 1.5F;

    SpotMap()
    {
        picture = {16, 8, std::vector(128, glm::vec3(0.25F, 0.5F, 1.0F))};
        picture.texels[37] = glm::vec3(40.0F, 30.0F, 10.0F);
        for (const glm::vec3& texel : picture.texels)
        {
            texels.push_back({texel.x, texel.y, texel.z});
        }
    }

    [[nodiscard]] EnvironmentMapInfo info() const { return {16, 8, texels, kTurn, kStrength}; }

    HdrImage picture;
    std::vector<Vec3> texels;
};

// The same picture by the engine alone, on another device.
Words enginePicture(const DeviceTree& tree, DeviceEnvironment& environment, const PathOptions& options,
                    std::uint32_t samples, const Exposure& exposure = {}, TexelFormat texels = TexelFormat::Rgba8)
{
    PathTracer tracer(device().device());
    Developer developer(device().device());
    tracer.resize(kWidth, kHeight);
    const ViewCamera view = ViewCamera::lookAt({22, 17, 25}, {5, 5, 5}, 0.6);
    vk::BufferOf<gpu::uint> image(device().device(), "picture", std::uint64_t{kWidth} * kHeight * texelWords(texels));
    device().run(
        [&](vk::FrameGraph& graph)
        {
            for (std::uint32_t i = 0; i < samples; ++i)
            {
                tracer.addSample(graph, tree, environment, traceCamera(view, tree.grid, kHeight), options);
            }
            developer.develop(graph, tracer.picture(), texels, exposure, image);
        });
    return device().download(image);
}

/// Denoised pictures by the engine alone, one after the other.
class DenoisingEngine
{
public:
    DenoisingEngine()
    {
        m_tracer.resize(kWidth, kHeight);
        m_denoiser.resize(kWidth, kHeight);
    }

    Words picture(const DeviceTree& tree, DeviceEnvironment& environment, const DVec3& eye, std::uint32_t history_max)
    {
        const PathOptions options = {.bounces = 2, .reseeds = true, .features = true};
        const ViewCamera view = ViewCamera::lookAt({eye[0], eye[1], eye[2]}, {5, 5, 5}, 0.6);
        vk::BufferOf<gpu::uint> image(device().device(), "picture", std::uint64_t{kWidth} * kHeight);
        device().run(
            [&](vk::FrameGraph& graph)
            {
                m_tracer.addSample(graph, tree, environment, traceCamera(view, tree.grid, kHeight), options);
                m_denoiser.denoise(graph, m_tracer.guided(), history_max);
                m_developer.develop(graph, m_denoiser.picture(), TexelFormat::Rgba8, {}, image);
            });
        return device().download(image);
    }

    void forget()
    {
        m_tracer.forget();
        m_denoiser.forget();
    }

private:
    PathTracer m_tracer{device().device()};
    Denoiser m_denoiser{device().device()};
    Developer m_developer{device().device()};
};

constexpr DVec3 kEye = {22, 17, 25}; // of test::apiCamera()
constexpr DVec3 kNextEye = {21, 17.5, 25};

CameraInfo cameraAt(const DVec3& eye)
{
    return CameraInfo::lookAt(eye, {5, 5, 5}, 0.6);
}

DeviceEnvironment engineSky()
{
    DeviceEnvironment sky(device().device());
    const TraceOptions plain;
    sky.setSun({.direction = plain.to_sun, .irradiance = double{plain.sun} * kSunColor}); // as `zvo render`
    return sky;
}

// All of these tests have one host, because path tracing takes many kernels.
class ApiPaths : public testing::Test
{
protected:
    static void SetUpTestSuite()
    {
        test::failCall(UINT64_MAX);
        test::HostOptions options;
        options.zvo_functions = test::failingVulkan();
        options.optional.pass_times = true;
        s_host = std::make_unique<test::EmbeddingHost>(options,
                                                       [](ContextInfo& info) { info.timed_passes_per_frame = 300; });
    }

    static void TearDownTestSuite() { s_host.reset(); }

    ~ApiPaths() override
    {
        test::failCall(UINT64_MAX);
        m_host.submits_failed = false;
    }

    Tree octree(std::uint32_t depth = 5)
    {
        return m_host.build(m_host.upload(pathModel().info()), {.grid = test::apiGrid(depth)});
    }

    Environment sky()
    {
        std::optional<Environment> result;
        m_host.frame([&](Recorder& recorder, VkCommandBuffer) { result.emplace(recorder); });
        return std::move(*result);
    }

    Tracer tracer(VkFormat format = kFormat) { return {m_host.context, kWidth, kHeight, format}; }

    [[nodiscard]] std::uint64_t used() { return m_host.context.memory().used; }

    // Adds samples in a frame of its own. Returns the picture.
    template <typename AnyTree>
    Words paths(Tracer& tracer, AnyTree& tree, Environment& environment, const PathInfo& info = kFewBounces,
                const CameraInfo& camera = test::apiCamera())
    {
        test::TargetImage image(m_host.device, kFormat, kWidth, kHeight);
        m_host.frame(
            [&](Recorder& recorder, VkCommandBuffer commands)
            {
                image.beginCopies(commands);
                tracer.tracePaths(recorder, tree, environment, camera, info, image.target());
                image.read(commands);
            });
        return image.words();
    }

    Environment spotMap()
    {
        std::optional<Environment> result;
        m_host.frame([&](Recorder& recorder, VkCommandBuffer) { result.emplace(recorder, SpotMap().info()); });
        return std::move(*result);
    }

    // The first picture of a new tracer.
    template <typename AnyTree>
    Words newPaths(AnyTree& tree, Environment& environment, const PathInfo& info = kFewBounces,
                   const CameraInfo& camera = test::apiCamera())
    {
        Tracer tracer = this->tracer();
        return paths(tracer, tree, environment, info, camera);
    }

    static std::unique_ptr<test::EmbeddingHost> s_host;
    test::EmbeddingHost& m_host = *s_host;
};

std::unique_ptr<test::EmbeddingHost> ApiPaths::s_host;

TEST_F(ApiPaths, PicturesAreThoseOfTheEngineOfOctreesAndDags)
{
    Tree octree = this->octree();
    const DeviceTree expected = test::engineOctree(device(), test::apiScene(), test::apiGrid(5));
    ASSERT_GT(octree.info().emission_scale, 0.0F);
    Environment environment = sky();
    DeviceEnvironment engine_sky = engineSky();
    const Words picture = enginePicture(expected, engine_sky, {.bounces = 2}, 3);
    EXPECT_EQ(newPaths(octree, environment, {.bounces = 2, .samples = 3}), picture);
    const PathInfo lens = {.bounces = 1,
                           .seed = 7,
                           .lens_radius = 0.5F,
                           .focus_distance = 30.0F,
                           .roulette = true,
                           .automatic_exposure = false,
                           .exposure = 0.75F};
    EXPECT_EQ(newPaths(octree, environment, lens),
              enginePicture(expected, engine_sky,
                            {.bounces = 1, .seed = 7, .lens_radius = 0.5F, .focus_distance = 30.0F, .roulette = true},
                            1, {.automatic = false, .factor = 0.75F}));

    environment.setSun({.direction = {1, 2, 0}, .irradiance = {1, 2, 3}});
    engine_sky.setSun({.direction = {1, 2, 0}, .irradiance = {1, 2, 3}});
    EXPECT_EQ(newPaths(octree, environment), enginePicture(expected, engine_sky, {.bounces = 2}, 1));
    environment.setSun({.irradiance = {0, 0, 0}});
    engine_sky.setSun({});
    EXPECT_EQ(newPaths(octree, environment), enginePicture(expected, engine_sky, {.bounces = 2}, 1));
    environment.setSun({});

    TreeCompression compression(m_host.context, std::move(octree));
    m_host.finish(compression);
    const Tree dag = compression.take();
    EXPECT_EQ(newPaths(dag, environment, {.bounces = 2, .samples = 3}), picture);
}

TEST_F(ApiPaths, AMapLightsAsThatOfTheEngine)
{
    const Tree octree = this->octree();
    const DeviceTree expected = test::engineOctree(device(), test::apiScene(), test::apiGrid(5));
    SpotMap map;
    DeviceEnvironment engine_map(device().device(), map.picture, SpotMap::kTurn, double{SpotMap::kStrength});
    std::optional<Environment> environment;
    m_host.frame(
        [&](Recorder& recorder, VkCommandBuffer)
        {
            environment.emplace(recorder, map.info());
            map.texels.clear(); // was copied
        });
    EXPECT_EQ(newPaths(octree, *environment), enginePicture(expected, engine_map, {.bounces = 2}, 1));
    environment->setSun({.direction = {1, 2, 0}, .irradiance = {1, 2, 3}});
    engine_map.setSun({.direction = {1, 2, 0}, .irradiance = {1, 2, 3}});
    EXPECT_EQ(newPaths(octree, *environment), enginePicture(expected, engine_map, {.bounces = 2}, 1));
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
        m_host.frame(
            [&](Recorder& recorder, VkCommandBuffer commands)
            {
                image.beginCopies(commands);
                tracer.tracePaths(recorder, octree, environment, test::apiCamera(), kFewBounces, image.target());
                image.read(commands);
            });
        EXPECT_EQ(image.words(), enginePicture(expected, engine_sky, {.bounces = 2}, 1, {}, texels)) << format;
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

TEST_F(ApiPaths, DenoisedPicturesAreThoseOfTheEngineAndEarlierOnesCount)
{
    const Tree octree = this->octree();
    const DeviceTree expected = test::engineOctree(device(), test::apiScene(), test::apiGrid(5));
    Environment environment = sky();
    DeviceEnvironment engine_sky = engineSky();
    std::vector<Words> seconds;
    for (const std::uint32_t history_max : {PathInfo().history_max, 0U})
    {
        Tracer tracer = this->tracer();
        DenoisingEngine engine;
        PathInfo info = kDenoised;
        info.history_max = history_max;
        const auto expectSame = [&](const DVec3& eye, std::uint32_t sample_count)
        {
            Words picture = paths(tracer, octree, environment, info, cameraAt(eye));
            EXPECT_EQ(picture, engine.picture(expected, engine_sky, eye, history_max)) << history_max;
            EXPECT_EQ(tracer.sampleCount(), sample_count);
            return picture;
        };
        const Words first = expectSame(kEye, 1);
        EXPECT_NE(first, newPaths(octree, environment, kFewBounces, cameraAt(kEye)));
        EXPECT_NE(expectSame(kEye, 2), first);
        seconds.push_back(expectSame(kNextEye, 1));
        expectSame(kNextEye, 2);
        expectSame(kEye, 1);
    }
    EXPECT_NE(seconds[0], seconds[1]);
}

TEST_F(ApiPaths, DenoisingBeginsAnewWhereItIsTurnedOnOrOff)
{
    const Tree octree = this->octree();
    const DeviceTree expected = test::engineOctree(device(), test::apiScene(), test::apiGrid(5));
    Environment environment = sky();
    DeviceEnvironment engine_sky = engineSky();
    const Words plain = newPaths(octree, environment, kFewBounces, cameraAt(kEye));
    Tracer tracer = this->tracer();
    DenoisingEngine engine;
    const auto next = [&](const PathInfo& info, const DVec3& eye)
    { return paths(tracer, octree, environment, info, cameraAt(eye)); };
    EXPECT_EQ(next(kDenoised, kEye), engine.picture(expected, engine_sky, kEye, kDenoised.history_max));
    (void)next({.bounces = 2, .denoise = true, .history_max = 3}, kEye);
    EXPECT_EQ(tracer.sampleCount(), 2U); // history_max begins nothing anew
    EXPECT_EQ(next(kFewBounces, kEye), plain);
    EXPECT_EQ(tracer.sampleCount(), 1U);
    engine.forget();
    (void)engine.picture(expected, engine_sky, kEye, 0); // its random numbers were the plain picture's
    engine.forget();
    EXPECT_EQ(next(kDenoised, kNextEye), engine.picture(expected, engine_sky, kNextEye, kDenoised.history_max));
    EXPECT_EQ(tracer.sampleCount(), 1U);
}

TEST_F(ApiPaths, ALostFrameTakesEarlierPicturesAlong)
{
    const Tree octree = this->octree();
    const DeviceTree expected = test::engineOctree(device(), test::apiScene(), test::apiGrid(5));
    Environment environment = sky();
    DeviceEnvironment engine_sky = engineSky();
    Tracer tracer = this->tracer();
    DenoisingEngine engine;
    DenoisingEngine keeping; // which loses nothing
    test::TargetImage image(m_host.device, kFormat, kWidth, kHeight);
    const auto picture = [&](DenoisingEngine& of, const DVec3& eye)
    { return of.picture(expected, engine_sky, eye, kDenoised.history_max); };
    const auto next = [&](const DVec3& eye) { return paths(tracer, octree, environment, kDenoised, cameraAt(eye)); };
    EXPECT_EQ(next(kEye), picture(engine, kEye));
    (void)picture(keeping, kEye);
    m_host.lostFrame(
        [&](Recorder& recorder, VkCommandBuffer commands)
        {
            image.beginCopies(commands);
            tracer.tracePaths(recorder, octree, environment, cameraAt(kNextEye), kDenoised, image.target());
        });
    EXPECT_EQ(tracer.sampleCount(), 0U);
    (void)picture(engine, kNextEye);
    (void)picture(keeping, kNextEye);
    engine.forget();
    const Words alone = next(kEye);
    EXPECT_EQ(alone, picture(engine, kEye));
    EXPECT_NE(alone, picture(keeping, kEye));
    EXPECT_EQ(tracer.sampleCount(), 1U);
    EXPECT_EQ(next(kNextEye), picture(engine, kNextEye)); // what comes after counts again

    tracer.forgetSamples();
    engine.forget();
    EXPECT_EQ(next(kEye), picture(engine, kEye));
}

TEST_F(ApiPaths, ADynamicTreeBeginsAnewWhereItChangesAndLooksAsIfBuiltAtOnce)
{
    const Model fixed_model = m_host.upload(pathModel().info());
    const test::HostModel ball(test::sphereScene(glm::vec3(0), 2.0F, 9));
    ModelInfo ball_info = ball.info();
    ball_info.emission_scale = fixed_model.emissionScale();
    const Model ball_model = m_host.upload(ball_info);
    Tree fixed = m_host.build(fixed_model, {.grid = test::apiGrid(5), .keep_sums = true});
    Environment environment = sky();
    Tracer tracer = this->tracer();
    const Words still = paths(tracer, fixed, environment);
    std::optional<DynamicTree> tree;
    DynamicObjectId object = 0;
    m_host.frame(
        [&](Recorder& recorder, VkCommandBuffer)
        {
            tree.emplace(recorder, std::move(fixed),
                         DynamicTreeInfo{.merge = MergeRule::Average, .emission_scale = fixed_model.emissionScale()});
        });
    EXPECT_EQ(paths(tracer, *tree, environment), still);
    m_host.frame([&](Recorder& recorder, VkCommandBuffer)
                 { object = tree->addObject(recorder, ball_model, test::movedBy(8.25F, 5, 5)); });
    do
    {
        m_host.frame([&](Recorder& recorder, VkCommandBuffer) { tree->update(recorder); });
    } while (tree->needsUpdate());

    Scene both = test::apiScene();
    both.append(test::sphereScene(glm::vec3(8.25F, 5, 5), 2.0F, 9));
    const test::HostModel both_model(both);
    const Tree rebuilt = m_host.build(m_host.upload(both_model.info()), {.grid = test::apiGrid(5)});
    const Words moved = paths(tracer, *tree, environment);
    EXPECT_EQ(tracer.sampleCount(), 1U);
    EXPECT_NE(moved, still);
    EXPECT_EQ(moved, newPaths(rebuilt, environment));
    (void)paths(tracer, *tree, environment);
    EXPECT_EQ(tracer.sampleCount(), 2U);
    m_host.frame([&](Recorder& recorder, VkCommandBuffer) { EXPECT_TRUE(tree->undo(recorder)); });
    EXPECT_EQ(paths(tracer, *tree, environment), still);
    EXPECT_EQ(tracer.sampleCount(), 1U);
}

TEST_F(ApiPaths, ALostFrameTakesItsSamplesAndItsSunAlong)
{
    const Tree octree = this->octree();
    Environment environment = sky();
    Tracer tracer = this->tracer();
    test::TargetImage image(m_host.device, kFormat, kWidth, kHeight);
    const auto lose = [&]
    {
        m_host.lostFrame(
            [&](Recorder& recorder, VkCommandBuffer commands)
            {
                image.beginCopies(commands);
                tracer.tracePaths(recorder, octree, environment, test::apiCamera(), kFewBounces, image.target());
            });
        EXPECT_EQ(tracer.sampleCount(), 0U);
    };
    lose(); // what would have made the light tree
    const Words first = paths(tracer, octree, environment);
    EXPECT_EQ(tracer.sampleCount(), 1U);
    EXPECT_EQ(first, newPaths(octree, environment));
    lose();
    EXPECT_EQ(paths(tracer, octree, environment), first);
    m_host.lostFrame(
        [&](Recorder& recorder, VkCommandBuffer commands)
        {
            image.beginCopies(commands);
            tracer.trace(recorder, octree, test::apiCamera(), {}, image.target()); // which has no samples
        });
    EXPECT_EQ(tracer.sampleCount(), 1U);
    EXPECT_EQ(paths(tracer, octree, environment), newPaths(octree, environment, {.bounces = 2, .samples = 2}));

    environment.setSun({.direction = {0, 1, 0}});
    lose();
    Environment same = sky();
    same.setSun({.direction = {0, 1, 0}});
    EXPECT_EQ(paths(tracer, octree, environment), newPaths(octree, same));
}

TEST_F(ApiPaths, AnEnvironmentOfALostFrameIsLost)
{
    const Tree octree = this->octree(4);
    const SpotMap map;
    std::optional<Environment> lost_sky;
    std::optional<Environment> lost_map;
    m_host.lostFrame(
        [&](Recorder& recorder, VkCommandBuffer)
        {
            lost_sky.emplace(recorder);
            lost_map.emplace(recorder, map.info());
            lost_sky->setSun({}); // used in the frame in which it is made
        });
    for (Environment* const lost : {&*lost_sky, &*lost_map})
    {
        expectUsage([&] { lost->setSun({}); }, "environment was lost with its frame");
        expectUsage([&] { (void)newPaths(octree, *lost); }, "environment was lost with its frame");
    }
    Environment present = sky();
    Environment moved(std::move(present));
    expectUsage([&] { present.setSun({}); }, "environment was taken over or moved from");
    expectUsage([&] { (void)newPaths(octree, present); }, "environment was taken over or moved from");
    EXPECT_EQ(newPaths(octree, moved).size(), std::size_t{kWidth} * kHeight);
    Tracer tracer = this->tracer();
    Tracer other(std::move(tracer));
    expectUsage([&] { (void)paths(tracer, octree, moved); }, "tracer was taken over or moved from");
    expectUsage([&] { (void)tracer.sampleCount(); }, "tracer was taken over or moved from");
    expectUsage([&] { tracer.forgetSamples(); }, "tracer was taken over or moved from");
    EXPECT_EQ(other.sampleCount(), 0U);
}

TEST_F(ApiPaths, WhatPathsUseMayGoWhileFramesUseIt)
{
    const std::uint64_t before = used();
    auto tree = std::make_unique<Tree>(octree());
    auto environment = std::make_unique<Environment>(sky());
    const Words expected = newPaths(*tree, *environment, kDenoised);
    auto tracer = std::make_unique<Tracer>(this->tracer());
    test::TargetImage image(m_host.device, kFormat, kWidth, kHeight);
    std::unique_ptr<Environment> made;
    VkCommandBuffer commands = m_host.device.begin();
    {
        Recorder recorder(m_host.context, commands, ++m_host.last_frame);
        made = std::make_unique<Environment>(recorder, SpotMap().info());
        image.beginCopies(commands);
        tracer->tracePaths(recorder, *tree, *environment, test::apiCamera(), kDenoised, image.target());
        image.read(commands);
    }
    const std::uint64_t with = used();
    tracer.reset();
    environment.reset();
    made.reset();
    tree.reset();
    EXPECT_EQ(used(), with);
    m_host.device.submit(commands);
    m_host.device.wait();
    m_host.context.frameDone(m_host.last_frame);
    EXPECT_EQ(used(), before);
    EXPECT_EQ(image.words(), expected);
}

// The form that paths have on the tests' devices.
bool isInStages()
{
    return pathFormOn(test::device().device()) == PathForm::Stages;
}

TEST_F(ApiPaths, BuffersAreMadeForTheFirstPathsAndAreAsLargeAsTold)
{
    const test::HostModel box(test::boxScene(glm::vec3(2), glm::vec3(6))); // emits nothing
    const Tree octree = m_host.build(m_host.upload(box.info()), {.grid = test::apiGrid(4)});
    const bool in_stages = isInStages();
    const auto expectMore = [&](double bytes, double tolerance, const std::function<void()>& act)
    {
        const std::uint64_t before = used();
        act();
        EXPECT_NEAR(static_cast<double>(used() - before), bytes, tolerance);
    };
    std::optional<Environment> environment;
    std::optional<Environment> small;
    const SpotMap map;
    expectMore(10e6, 0.5e6, [&] { environment.emplace(sky()); });
    expectMore(12.0 * 128 + 288.0 * 256, 4096, // 16 x 16 cells
               [&]
               { m_host.frame([&](Recorder& recorder, VkCommandBuffer) { small.emplace(recorder, map.info()); }); });
    for (const std::uint32_t edge : {16U, 1024U}) // more pixels than advance together
    {
        Tracer tracer(m_host.context, edge, edge, kFormat);
        test::TargetImage image(m_host.device, kFormat, edge, edge);
        const double pixels = static_cast<double>(edge * edge);
        const double batch = in_stages ? std::min(pixels, 524288.0) : 0.0;
        const auto trace = [&](bool denoise)
        {
            m_host.frame(
                [&](Recorder& recorder, VkCommandBuffer commands)
                {
                    image.beginCopies(commands);
                    tracer.tracePaths(recorder, octree, *environment, test::apiCamera(),
                                      {.bounces = 0, .denoise = denoise}, image.target());
                });
        };
        expectMore(16 * pixels + 252 * batch + (in_stages ? 0.1e6 : 0.0), 0.05e6, [&] { trace(false); });
        expectMore(152 * pixels + 4 * batch, 0.05e6, [&] { trace(true); });
        expectMore(0, 0, [&] { trace(false); });
    }
}

TEST_F(ApiPaths, EveryBufferMayFailAndEveryKernelToo)
{
    test::EmbeddingHost host( // has no kernels yet
        []
        {
            test::HostOptions options;
            options.zvo_functions = test::failingVulkan();
            return options;
        }());
    const Tree octree = host.build(host.upload(pathModel().info()), {.grid = test::apiGrid(4)});
    const SpotMap map;
    std::optional<Environment> environment;
    std::optional<Tracer> tracer;
    test::TargetImage image(host.device, kFormat, kWidth, kHeight);
    const auto makeEnvironment = [&]
    { host.frame([&](Recorder& recorder, VkCommandBuffer) { environment.emplace(recorder, map.info()); }); };
    PathInfo info = kFewBounces;
    const auto trace = [&]
    {
        host.frame(
            [&](Recorder& recorder, VkCommandBuffer commands)
            {
                image.beginCopies(commands);
                tracer->tracePaths(recorder, octree, *environment, test::apiCamera(), info, image.target());
                image.read(commands);
            });
    };
    // Has calls of a function fail, one in each try, until act() gets through. Returns how many have failed.
    const auto sweep =
        [&](const char* function, std::uint64_t first, std::uint64_t step, const std::function<void()>& act)
    {
        std::uint64_t failures = 0;
        for (std::uint64_t number = first;; number += step)
        {
            host.submits_failed = !host.submits_failed; // each second failure is submitted all the same
            test::failCallOf(function, number);
            try
            {
                act();
                test::failCall(UINT64_MAX);
                return failures;
            }
            catch (const Error& error)
            {
                EXPECT_EQ(error.code(), ErrorCode::Memory) << error.what();
                EXPECT_EQ(tracer->sampleCount(), 0U);
                ++failures;
            }
            test::failCall(UINT64_MAX);
        }
    };
    tracer.emplace(host.context, kWidth, kHeight, kFormat);
    const char* const pipelines = "vkCreateComputePipelines"; // each call makes the one that failed in the last
    EXPECT_GE(sweep(pipelines, 1, 0, makeEnvironment), 3U);
    EXPECT_GE(sweep(pipelines, 1, 0, trace), 3U);
    EXPECT_EQ(tracer->sampleCount(), 1U);
    const Words first = image.words();
    tracer.emplace(host.context, kWidth, kHeight, kFormat);
    EXPECT_GE(sweep("vkCreateBuffer", 0, 1, makeEnvironment), 10U);
    EXPECT_GE(sweep("vkCreateBuffer", 0, 1, trace), isInStages() ? 15U : 8U);
    EXPECT_EQ(tracer->sampleCount(), 1U);
    EXPECT_EQ(image.words(), first);
    CameraInfo other = test::apiCamera();
    other.orthographic = true; // takes a kernel that is not there yet
    other.half_height = 8;
    for (const std::uint32_t expected : {0U, 1U})
    {
        test::failCallOf(pipelines, expected); // the second call needs only one
        host.frame(
            [&](Recorder& recorder, VkCommandBuffer commands)
            {
                image.beginCopies(commands);
                const auto add = [&]
                { tracer->tracePaths(recorder, octree, *environment, other, kFewBounces, image.target()); };
                if (expected == 0)
                {
                    EXPECT_THROW(add(), Error);
                }
                else
                {
                    EXPECT_NO_THROW(add());
                }
            });
        EXPECT_EQ(tracer->sampleCount(), expected);
    }
    test::failCall(UINT64_MAX);
    info = kDenoised;
    EXPECT_GE(sweep(pipelines, 1, 0, trace), 3U);
    EXPECT_EQ(tracer->sampleCount(), 1U);
    tracer.emplace(host.context, kWidth, kHeight, kFormat);
    info = kFewBounces;
    trace();
    info = kDenoised;
    EXPECT_GE(sweep("vkCreateBuffer", 0, 1, trace), 8U);
    EXPECT_EQ(tracer->sampleCount(), 1U);
    const Tree same = this->octree(4);
    Environment same_map = spotMap();
    EXPECT_EQ(first, newPaths(same, same_map));
}

TEST_F(ApiPaths, WhatIsNotValidIsRefusedAndNothingIsRecorded)
{
    const Tree octree = this->octree(4);
    Environment environment = sky();
    Tracer tracer = this->tracer();
    test::TargetImage image(m_host.device, kFormat, kWidth, kHeight);
    (void)paths(tracer, octree, environment);
    const auto refused =
        [&](const CameraInfo& camera, const PathInfo& info, const ImageTarget& target, const std::string& word)
    {
        m_host.frame([](Recorder&, VkCommandBuffer) {});
        const std::size_t before = m_host.context.passTimes().size();
        m_host.frame(
            [&](Recorder& recorder, VkCommandBuffer)
            { expectUsage([&] { tracer.tracePaths(recorder, octree, environment, camera, info, target); }, word); });
        EXPECT_EQ(m_host.context.passTimes().size(), before) << "passes of an older frame: this one has none; " << word;
        EXPECT_EQ(tracer.sampleCount(), 1U);
    };
    const auto refusedInfo = [&](const PathInfo& info, const std::string& word)
    { refused(test::apiCamera(), info, image.target(), word); };
    const auto refusedTarget = [&](const std::function<void(ImageTarget&)>& spoil, const std::string& word)
    {
        ImageTarget target = image.target();
        spoil(target);
        refused(test::apiCamera(), {}, target, word);
    };
    const float infinity = std::numeric_limits<float>::infinity();
    for (const float value : {-1.0F, infinity, std::numeric_limits<float>::quiet_NaN()})
    {
        refusedInfo({.lens_radius = value}, "PathInfo::lens_radius");
        refusedInfo({.focus_distance = value}, "PathInfo::focus_distance");
        refusedInfo({.exposure = value}, "PathInfo::exposure");
    }
    refusedInfo({.bounces = 1025}, "PathInfo::bounces is 1025");
    refusedInfo({.focus_distance = 0}, "PathInfo::focus_distance");
    refusedInfo({.samples = 0}, "PathInfo::samples is 0");
    refusedInfo({.samples = 1025}, "PathInfo::samples is 1025");
    refusedInfo({.denoise = true, .samples = 0}, "PathInfo::samples is 0");
    CameraInfo camera = test::apiCamera();
    camera.up = camera.forward;
    refused(camera, {}, image.target(), "camera");
    refusedTarget([](ImageTarget& target) { target.image = VK_NULL_HANDLE; }, "color");
    refusedTarget([](ImageTarget& target) { target.format = VK_FORMAT_B8G8R8A8_UNORM; }, "another format");
    refusedTarget([](ImageTarget& target) { target.format = VK_FORMAT_R8_UNORM; }, "VkFormat");
    refusedTarget([](ImageTarget& target) { target.layout = VK_IMAGE_LAYOUT_UNDEFINED; }, "VkImageLayout");
    refusedTarget([](ImageTarget& target) { target.offset.x = -3; }, "(-3, 0)");
    refusedTarget([](ImageTarget& target) { target.extent = {kWidth - 1, kHeight}; }, "does not fit");
    (void)paths(tracer, octree, environment);
    EXPECT_EQ(tracer.sampleCount(), 2U); // the samples stayed

    test::EmbeddingHost other_host;
    std::optional<Environment> foreign;
    other_host.frame([&](Recorder& recorder, VkCommandBuffer) { foreign.emplace(recorder); });
    expectUsage([&] { (void)paths(tracer, octree, *foreign); }, "two contexts");
    foreign.reset();
}

TEST_F(ApiPaths, LightThatThereCannotBeIsRefused)
{
    Environment environment = sky();
    const double infinity = std::numeric_limits<double>::infinity();
    const double nan = std::numeric_limits<double>::quiet_NaN();
    for (const double value : {0.0, nan, infinity, 1e-300})
    {
        expectUsage([&] { environment.setSun({.direction = {0, value, 0}}); }, "SunInfo::direction");
    }
    for (const double value : {-1.0, nan, infinity, 1e31})
    {
        expectUsage([&] { environment.setSun({.irradiance = {0, 0, value}}); }, "SunInfo::irradiance");
    }
    const std::uint64_t before = used();
    const auto refused =
        [&](const std::function<void(EnvironmentMapInfo&, std::vector<Vec3>&)>& spoil, const std::string& word)
    {
        SpotMap map;
        EnvironmentMapInfo info = map.info();
        spoil(info, map.texels);
        m_host.frame([](Recorder&, VkCommandBuffer) {});
        const std::size_t passes = m_host.context.passTimes().size();
        m_host.frame([&](Recorder& recorder, VkCommandBuffer)
                     { expectUsage([&] { const Environment made(recorder, info); }, word); });
        EXPECT_EQ(m_host.context.passTimes().size(), passes) << word;
        EXPECT_EQ(used(), before) << word;
    };
    using Info = EnvironmentMapInfo;
    using Texels = std::vector<Vec3>;
    refused([](Info& info, Texels&) { info = {}; }, "not 0 x 0");
    refused([](Info& info, Texels&) { info.width = 0; }, "not 0 x 8");
    refused([](Info& info, Texels&) { info.width = 16385; }, "not 16385 x 8");
    refused([](Info& info, Texels&) { info.width = info.height = 16384; }, "not 16384 x 16384");
    refused([](Info& info, Texels&) { info.height = 7; }, "has 128 elements, not 16 x 7");
    refused([&](Info& info, Texels&) { info.turn = nan; }, "EnvironmentMapInfo::turn");
    refused([](Info& info, Texels&) { info.strength = -1; }, "EnvironmentMapInfo::strength");
    refused([&](Info& info, Texels&) { info.strength = static_cast<float>(infinity); }, "EnvironmentMapInfo::strength");
    for (const double value : {-1.0, nan, infinity, 3e38}) // times strength, the last one is infinite
    {
        refused([&](Info&, Texels& texels) { texels[35][1] = static_cast<float>(value); }, "texel (3, 2)");
    }
}

} // namespace

} // namespace zvo
