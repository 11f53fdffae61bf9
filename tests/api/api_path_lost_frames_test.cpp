// SPDX-License-Identifier: MIT
// What lost frames take along of paths and their light, and what may go while frames use it.
#include "api_paths.h"
#include "api_scene.h"
#include "expect_usage.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <utility>

namespace zvo
{

namespace
{

using test::ApiPaths;
using test::expectUsage;
using test::SpotMap;

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
        [&](Recorder& recorder)
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

} // namespace

} // namespace zvo
