// SPDX-License-Identifier: MIT
// Denoised pictures of paths, for which earlier pictures count.
#include "api_paths.h"
#include "api_scene.h"
#include "core/denoise/denoiser.h"
#include "core/path/develop.h"
#include "core/path/path_tracer.h"
#include "support/engine_device.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

namespace zvo
{

namespace
{

using test::ApiPaths;
using test::device;
using test::engineSky;

/// Denoised pictures by the engine alone, one after the other.
class DenoisingEngine
{
public:
    DenoisingEngine()
    {
        m_tracer.resize(ApiPaths::kWidth, ApiPaths::kHeight);
        m_denoiser.resize(ApiPaths::kWidth, ApiPaths::kHeight);
    }

    ApiPaths::Words picture(const DeviceTree& tree, DeviceEnvironment& environment, const DVec3& eye,
                            std::uint32_t history_max)
    {
        const PathOptions options = {.bounces = 2, .smooth = true, .reseeds = true, .features = true};
        const ViewCamera view = ViewCamera::lookAt({eye[0], eye[1], eye[2]}, {5, 5, 5}, 0.6);
        vk::BufferOf<gpu::uint> image(device().device(), "picture",
                                      std::uint64_t{ApiPaths::kWidth} * ApiPaths::kHeight);
        device().run(
            [&](vk::FrameGraph& graph)
            {
                m_tracer.addSample(graph, tree, environment, traceCamera(view, tree.grid, ApiPaths::kHeight), options);
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

} // namespace

} // namespace zvo
