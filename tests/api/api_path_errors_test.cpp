// SPDX-License-Identifier: MIT
// Paths for which there is no memory, and what is refused.
#include "api_paths.h"
#include "api_scene.h"
#include "core/path/path_tracer.h"
#include "expect_usage.h"
#include "support/engine_device.h"
#include "support/failing_vulkan.h"
#include "zvo/error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace zvo
{

namespace
{

using test::ApiPaths;
using test::expectUsage;
using test::SpotMap;

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
               [&] { m_host.frame([&](Recorder& recorder) { small.emplace(recorder, map.info()); }); });
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
    const Tree octree = host.build(host.upload(test::pathModel().info()), {.grid = test::apiGrid(4)});
    const SpotMap map;
    std::optional<Environment> environment;
    std::optional<Tracer> tracer;
    test::TargetImage image(host.device, kFormat, kWidth, kHeight);
    const auto makeEnvironment = [&]
    { host.frame([&](Recorder& recorder) { environment.emplace(recorder, map.info()); }); };
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
    EXPECT_GE(sweep("vkCreateBuffer", 0, 1, trace), isInStages() ? 13U : 6U);
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
        m_host.frame([](Recorder&) {});
        const std::size_t before = m_host.context.passTimes().size();
        m_host.frame(
            [&](Recorder& recorder)
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
    refusedInfo({.shading = static_cast<Shading>(2)}, "PathInfo::shading");
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
    Environment foreign = other_host.make<Environment>();
    expectUsage([&] { (void)paths(tracer, octree, foreign); }, "two contexts");
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
        m_host.frame([](Recorder&) {});
        const std::size_t passes = m_host.context.passTimes().size();
        m_host.frame([&](Recorder& recorder) { expectUsage([&] { const Environment made(recorder, info); }, word); });
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
    refused([](Info& info, Texels&) { info.background_blur = -0.1F; }, "EnvironmentMapInfo::background_blur");
    refused([](Info& info, Texels&) { info.strength = -1; }, "EnvironmentMapInfo::strength");
    refused([&](Info& info, Texels&) { info.strength = static_cast<float>(infinity); }, "EnvironmentMapInfo::strength");
    for (const double value : {-1.0, nan, infinity, 3e38}) // times strength, the last one is infinite
    {
        refused([&](Info&, Texels& texels) { texels[35][1] = static_cast<float>(value); }, "texel (3, 2)");
    }
}

} // namespace

} // namespace zvo
