// SPDX-License-Identifier: MIT
// The radiance cache, as a host has it in the course of its frames.
#include "api/context_impl.h"
#include "api_paths.h"
#include "api_scene.h"
#include "core/frame/frame_renderer.h"
#include "core/radiance/radiance_view.h"
#include "core/trace/tree_tracer.h"
#include "expect_usage.h"
#include "host_kernel.h"
#include "support/engine_device.h"
#include "support/failing_vulkan.h"
#include "support/radiance_cache.h"
#include "zvo/error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <map>
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

using test::expectUsage;
using test::FaceLight;
using test::FaceName;
using Faces = std::map<FaceName, FaceLight>;

constexpr RadianceCacheInfo kGrid = {.width = 48, .height = 36, .faces = 20000};
constexpr std::uint32_t kSlots = 40000; // more than there are

// Push constants of tests/glsl/host/cached_faces.comp.
struct FacesPush
{
    std::uint64_t cache;
    std::uint64_t results;
    std::uint32_t slots;
    std::uint32_t unused;
};

// What a shader of the host's finds by the address of a radiance cache.
struct Found
{
    std::uint32_t run_count = 0;
    std::uint32_t frame_count = 0;
    Faces faces;
};

std::vector<glm::uvec2> wordsOf(const Faces& faces)
{
    std::vector<glm::uvec2> words;
    for (const auto& [name, face] : faces)
    {
        words.push_back(face.words);
    }
    return words;
}

// The share of faces whose light counts many samples.
double settledShare(const Faces& faces)
{
    const auto count = std::ranges::count_if(faces, [](const auto& face) { return face.second.samples > 24; });
    return static_cast<double>(count) / static_cast<double>(faces.size());
}

// The engine's light alone, on another device.
class KeptEngine
{
public:
    KeptEngine()
    {
        m_tracer.resize(kGrid.width, kGrid.height);
        m_cache.setRoom(0, kGrid.faces);
        const SunInfo sun;
        m_sky.setSun({.direction = {sun.direction[0], sun.direction[1], sun.direction[2]},
                      .irradiance = {sun.irradiance[0], sun.irradiance[1], sun.irradiance[2]}});
    }

    Faces frames(const DeviceTree& tree, std::uint32_t count, const RadianceOptions& options = {})
    {
        const ViewCamera view = ViewCamera::lookAt({22, 17, 25}, {5, 5, 5}, 0.6);
        const TraceCamera camera = traceCamera(view, tree.grid, kGrid.height);
        for (std::uint32_t i = 0; i < count; ++i)
        {
            test::device().run(
                [&](vk::FrameGraph& graph)
                {
                    const TraceCamera through = shifted(camera, pointOfPixel(m_cache.frameCount()));
                    m_tracer.tracePrimary(graph, tree, through, {});
                    m_cache.update(graph, tree, m_sky, through, m_tracer.buffers(), options);
                });
        }
        return test::facesOf(m_cache);
    }

    std::vector<std::uint32_t> picture(const DeviceTree& tree, const glm::dvec3& eye, std::uint32_t width,
                                       std::uint32_t height, const Exposure& exposure)
    {
        const ViewCamera view = ViewCamera::lookAt(eye, {5, 5, 5}, 0.6);
        const TraceCamera camera = traceCamera(view, tree.grid, height);
        TreeTracer tracer(test::device().device());
        Developer developer(test::device().device());
        tracer.resize(width, height);
        const std::uint64_t pixels = std::uint64_t{width} * height;
        RadianceView shown(test::device().device(), width, height);
        vk::BufferOf<gpu::uint> image(test::device().device(), "picture", pixels);
        test::device().run(
            [&](vk::FrameGraph& graph)
            {
                tracer.tracePrimary(graph, tree, camera, {});
                shown.add(graph, m_cache, tree, m_sky, camera, tracer.buffers());
                developer.develop(graph, shown.picture(), TexelFormat::Rgba8, exposure, image);
            });
        return test::device().download(image);
    }

private:
    DeviceEnvironment m_sky{test::device().device()};
    TreeTracer m_tracer{test::device().device()};
    DeviceRadianceCache m_cache{test::device().device()};
};

class ApiRadianceCache : public test::ApiPaths
{
protected:
    static void SetUpTestSuite()
    {
        test::ApiPaths::SetUpTestSuite();
        s_copy = std::make_unique<test::HostKernel>(s_host->device, "host/cached_faces", sizeof(FacesPush));
        s_copied = std::make_unique<test::HostBuffer>(s_host->device, (1 + kSlots) * sizeof(gpu::CachedFace));
    }

    static void TearDownTestSuite()
    {
        s_copied.reset();
        s_copy.reset();
        test::ApiPaths::TearDownTestSuite();
    }

    template <typename AnyTree>
    void frames(RadianceCache& light, AnyTree& tree, Environment& environment, std::uint32_t count,
                const CachedFrameInfo& info = {})
    {
        for (std::uint32_t i = 0; i < count; ++i)
        {
            m_host.frame([&](Recorder& recorder)
                         { light.update(recorder, tree, environment, test::apiCamera(), info); });
        }
    }

    // Records what finds the light by its address, behind what has been recorded.
    static void find(Recorder& recorder, VkCommandBuffer commands, const RadianceCache& light)
    {
        recorder.makeVisible(VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT);
        const FacesPush push = {light.address(), s_copied->address(), kSlots, 0};
        s_copy->run(commands, kSlots / 64 + 1, std::as_bytes(std::span(&push, 1)));
    }

    static Found found()
    {
        const std::span table(static_cast<const gpu::CachedFace*>(s_copied->mapped()), 1 + kSlots);
        return {table[0].key.x, table[0].key.y, test::facesOf(table.subspan(1))};
    }

    Found found(const RadianceCache& light)
    {
        m_host.frame([&](Recorder& recorder, VkCommandBuffer commands) { find(recorder, commands, light); });
        return found();
    }

    static std::unique_ptr<test::HostKernel> s_copy;
    static std::unique_ptr<test::HostBuffer> s_copied;
};

std::unique_ptr<test::HostKernel> ApiRadianceCache::s_copy;
std::unique_ptr<test::HostBuffer> ApiRadianceCache::s_copied;

TEST_F(ApiRadianceCache, IsThatOfTheEngineOfOctreesAndDags)
{
    Tree tree = octree();
    Environment environment = sky();
    KeptEngine engine;
    const Faces expected = engine.frames(test::engineOctree(test::device(), test::apiScene(), test::apiGrid(5)), 12,
                                         {.faces = 700, .seed = 3});
    ASSERT_GT(expected.size(), 1000U);
    for (const bool as_dag : {false, true})
    {
        if (as_dag)
        {
            tree = m_host.compress(std::move(tree));
        }
        RadianceCache light(m_host.context, kGrid);
        frames(light, tree, environment, 12, {.rays = 700, .seed = 3});
        const Found found = this->found(light);
        EXPECT_EQ(found.frame_count, 12U);
        EXPECT_TRUE(std::ranges::equal(
            found.faces, expected, {}, [](const auto& face) { return face.second.words; },
            [](const auto& face) { return face.second.words; }))
            << (as_dag ? "of a DAG" : "of an octree");
        EXPECT_EQ(light.stats().faces, expected.size());
        EXPECT_EQ(light.stats().refused, 0U);
        EXPECT_GT(light.stats().room, expected.size());
        EXPECT_FALSE(light.stats().is_crowded);
        EXPECT_GT(light.bytes(), expected.size() * 35);
    }
}

TEST_F(ApiRadianceCache, KeepsAsManyFacesAsTheHostAllows)
{
    const Tree tree = octree();
    Environment environment = sky();
    RadianceCache light(m_host.context, {.width = kGrid.width, .height = kGrid.height, .faces = 800});
    frames(light, tree, environment, 12, {.rays = 100});
    const RadianceCacheStats stats = light.stats();
    EXPECT_TRUE(stats.is_crowded);
    EXPECT_GT(stats.refused, 0U);
    EXPECT_NEAR(static_cast<double>(stats.room), 800.0, 8.0);
    EXPECT_LT(stats.faces, 1000U);
}

TEST_F(ApiRadianceCache, PicturesAreThoseOfTheEngine)
{
    const std::uint32_t width = m_host.kWidth; // larger than the light's own grid
    const std::uint32_t height = m_host.kHeight;
    const Tree tree = octree();
    Environment environment = sky();
    RadianceCache light(m_host.context, kGrid);
    Tracer tracer(m_host.context, width, height, kFormat);
    test::TargetImage image(m_host.device, kFormat, width, height);
    const auto traceOf = [&](const Tree& of, const CameraInfo& camera, const CachedPictureInfo& info)
    {
        return m_host.picture(image, [&](Recorder& recorder, const ImageTarget& target)
                              { tracer.traceCached(recorder, of, environment, light, camera, info, target); });
    };
    const auto trace = [&](const CameraInfo& camera, const CachedPictureInfo& info)
    { return traceOf(tree, camera, info); };
    expectUsage([&] { trace(test::apiCamera(), {}); }, "RadianceCache::update() comes first");
    frames(light, tree, environment, 6);
    KeptEngine engine;
    const DeviceTree expected = test::engineOctree(test::device(), test::apiScene(), test::apiGrid(5));
    engine.frames(expected, 6);
    const auto first = trace(test::apiCamera(), {});
    EXPECT_EQ(first, engine.picture(expected, {22, 17, 25}, width, height, {}));
    const CameraInfo beside = CameraInfo::lookAt({21, 17.5, 25}, {5, 5, 5}, 0.6);
    EXPECT_EQ(trace(beside, {.automatic_exposure = false, .exposure = 0.5F}),
              engine.picture(expected, {21, 17.5, 25}, width, height, {false, 0.5F}));
    expectUsage([&] { trace(test::apiCamera(), {.exposure = -1}); }, "CachedPictureInfo::exposure");
    expectUsage([&] { trace(test::apiCamera(), {.shading = static_cast<Shading>(2)}); }, "CachedPictureInfo::shading");
    const Tree other = octree(4);
    expectUsage([&] { traceOf(other, test::apiCamera(), {}); }, "RadianceCache::update() comes first");
    m_host.lostFrame([&](Recorder& recorder) { light.update(recorder, tree, environment, test::apiCamera()); });
    expectUsage([&] { trace(test::apiCamera(), {}); }, "RadianceCache::update() comes first");
}

TEST_F(ApiRadianceCache, StaysAtItsAddressWhenItMoves)
{
    const Tree tree = octree();
    Environment environment = sky();
    RadianceCache light(m_host.context, kGrid);
    frames(light, tree, environment, 6);
    const std::uint64_t address = light.address();
    const Found before = found(light);
    frames(light, tree, environment, 1, {.rays = 500}); // with other lists, faces move to another table
    const Found after = found(light);
    EXPECT_EQ(light.address(), address);
    EXPECT_EQ(after.run_count, before.run_count);
    EXPECT_EQ(after.frame_count, 7U);
    ASSERT_GE(after.faces.size(), before.faces.size());
    std::size_t same_count = 0;
    for (const auto& [name, face] : before.faces)
    {
        ASSERT_TRUE(after.faces.contains(name));
        EXPECT_GE(after.faces.at(name).samples, face.samples);
        same_count += after.faces.at(name).words == face.words ? 1 : 0;
    }
    EXPECT_GT(same_count, before.faces.size() / 4);
    EXPECT_LT(same_count, before.faces.size());
}

TEST_F(ApiRadianceCache, FramesInFlightAreThoseOfFramesThatAreWaitedFor)
{
    const Tree tree = octree();
    Environment environment = sky();
    RadianceCache waited(m_host.context, kGrid);
    frames(waited, tree, environment, 4);
    const Found expected = found(waited);
    RadianceCache light(m_host.context, kGrid);
    for (int i = 0; i < 4; ++i)
    {
        VkCommandBuffer commands = m_host.device.begin();
        {
            Recorder recorder(m_host.context, commands, ++m_host.last_frame, VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT);
            light.update(recorder, tree, environment, test::apiCamera());
            find(recorder, commands, light);
        }
        m_host.device.submit(commands);
    }
    EXPECT_EQ(light.stats().faces, 0U) << "no frame is done";
    m_host.device.wait();
    m_host.context.frameDone(m_host.last_frame);
    EXPECT_EQ(wordsOf(found().faces), wordsOf(expected.faces));
    EXPECT_EQ(light.stats().faces, expected.faces.size());
}

// The host reads counts of a frame that is done, for which the fence alone does not suffice.
TEST_F(ApiRadianceCache, TheHostSeesItsCounts)
{
    const Tree tree = octree(4);
    Environment environment = sky();
    RadianceCache light(m_host.context, kGrid);
    m_host.frame(
        [&](Recorder& recorder)
        {
            light.update(recorder, tree, environment, test::apiCamera());
            const std::string& dump = recorder.impl().graph.dump();
            const std::size_t copy = dump.find("radiance/report");
            ASSERT_NE(copy, std::string::npos);
            EXPECT_NE(dump.find(" -> host\n", copy), std::string::npos) << dump;
        });
    EXPECT_GT(light.stats().faces, 0U);
}

TEST_F(ApiRadianceCache, BeginsAnewAfterALostFrameAndInAnotherGrid)
{
    const Tree tree = octree();
    const Tree coarse = octree(4);
    Environment environment = sky();
    RadianceCache fresh(m_host.context, kGrid);
    frames(fresh, tree, environment, 1);
    const Found expected = found(fresh);
    RadianceCache light(m_host.context, kGrid);
    frames(light, tree, environment, 3);
    m_host.lostFrame([&](Recorder& recorder) { light.update(recorder, tree, environment, test::apiCamera()); });
    EXPECT_EQ(found(light).frame_count, 3U) << "what shaders find is that of the last frame that was not lost";
    frames(light, tree, environment, 1);
    EXPECT_EQ(wordsOf(found(light).faces), wordsOf(expected.faces));
    frames(light, coarse, environment, 1);
    EXPECT_EQ(found(light).frame_count, 1U);
    frames(light, tree, environment, 2);
    EXPECT_EQ(found(light).frame_count, 2U);
    light.forget();
    EXPECT_EQ(found(light).frame_count, 2U);
    frames(light, tree, environment, 1);
    EXPECT_EQ(wordsOf(found(light).faces), wordsOf(expected.faces));
}

// Brushes, other lamps and another sun change light that nothing else tells of.
TEST_F(ApiRadianceCache, SeesWhatChangesByItself)
{
    DynamicTreeInfo info;
    info.emission_scale = m_host.upload(test::pathModel().info()).emissionScale();
    DynamicTree tree = m_host.make<DynamicTree>(octree(3), info);
    Environment environment = sky();
    RadianceCache light(m_host.context, kGrid);
    const auto settledAfter = [&](const std::function<void()>& change)
    {
        frames(light, tree, environment, 40);
        change();
        frames(light, tree, environment, 32); // which count few samples
        return settledShare(found(light).faces);
    };
    const auto edit = [&]
    {
        m_host.edit(tree, {.action = BrushAction::Carve, .center = {5, 5, 5}, .radius = 1});
        tree.endStroke();
    };
    const auto undo = [&] { m_host.frame([&](Recorder& recorder) { EXPECT_TRUE(tree.undoEdit(recorder)); }); };
    const auto turn = [&] { environment.setSun({.direction = {1, 2, 0}}); };
    EXPECT_GT(settledAfter([] {}), 0.3); // others are seen, or hit, now and then
    EXPECT_LT(settledAfter(turn), 0.1);
    EXPECT_LT(settledAfter(edit), 0.1);
    EXPECT_LT(settledAfter(undo), 0.1);
    EXPECT_GT(settledAfter([] {}), 0.2);
}

// A tree that takes the place of another one, in its object and perhaps in its memory, is another tree.
TEST_F(ApiRadianceCache, FollowsADynamicTreeThatIsMadeAnew)
{
    Scene bright = test::apiScene();
    for (Material& material : bright.materials)
    {
        material.emission *= 16.0F;
    }
    const test::HostModel bright_model(bright);
    const float scale = m_host.upload(bright_model.info()).emissionScale();
    std::optional<DynamicTree> tree;
    const auto make = [&](const test::HostModel& of)
    {
        ModelInfo info = of.info();
        info.emission_scale = scale;
        Tree fixed = m_host.build(m_host.upload(info), {.grid = test::apiGrid(3)});
        m_host.frame([&](Recorder& recorder)
                     { tree.emplace(recorder, std::move(fixed), DynamicTreeInfo{.emission_scale = scale}); });
    };
    Environment environment = sky();
    const auto light_after = [&](RadianceCache& light, std::uint32_t count)
    {
        frames(light, *tree, environment, count);
        double sum = 0.0;
        const Found found = this->found(light);
        for (const auto& [name, face] : found.faces)
        {
            sum += face.radiance.g / static_cast<double>(found.faces.size());
        }
        return sum;
    };
    RadianceCache light(m_host.context, kGrid);
    make(test::pathModel());
    const double before = light_after(light, 300);
    const void* const first = tree->impl(); // whose memory another tree may get
    for (int tries = 0; tries == 0 || (tries < 32 && tree->impl() != first); ++tries)
    {
        make(bright_model);
    }
    const double after = light_after(light, 32);
    RadianceCache fresh(m_host.context, kGrid);
    const double expected = light_after(fresh, 100);
    EXPECT_GT(expected, 2.0 * before);
    EXPECT_GT(after, 0.5 * (before + expected)) << before << " before, " << expected << " in the end";
}

TEST_F(ApiRadianceCache, MayGoWhileFramesUseIt)
{
    const Tree tree = octree(4);
    Environment environment = sky();
    const std::uint64_t before = m_host.context.memory().used;
    auto light = std::make_unique<RadianceCache>(m_host.context, kGrid);
    VkCommandBuffer commands = m_host.device.begin();
    {
        Recorder recorder(m_host.context, commands, ++m_host.last_frame);
        light->update(recorder, tree, environment, test::apiCamera());
        find(recorder, commands, *light);
    }
    const std::uint64_t with = m_host.context.memory().used;
    light.reset();
    EXPECT_EQ(m_host.context.memory().used, with);
    m_host.device.submit(commands);
    m_host.device.wait();
    m_host.context.frameDone(m_host.last_frame);
    EXPECT_EQ(m_host.context.memory().used, before);
    EXPECT_GT(found().faces.size(), 100U);
}

TEST_F(ApiRadianceCache, ShadersFindNothingAfterACallThatFailed)
{
    const Tree tree = octree(4);
    Environment environment = sky();
    RadianceCache fresh(m_host.context, kGrid);
    frames(fresh, tree, environment, 1);
    const Found expected = found(fresh);
    std::uint64_t failures = 0;
    for (std::uint64_t number = 0;; ++number)
    {
        RadianceCache light(m_host.context, kGrid);
        m_host.submits_failed = number % 2 == 0;
        test::failCallOf("vkCreateBuffer", number);
        try
        {
            frames(light, tree, environment, 1);
            test::failCall(UINT64_MAX);
            EXPECT_EQ(wordsOf(found(light).faces), wordsOf(expected.faces));
            break;
        }
        catch (const Error& error)
        {
            test::failCall(UINT64_MAX);
            EXPECT_EQ(error.code(), ErrorCode::Memory) << error.what();
            ++failures;
        }
        if (m_host.submits_failed)
        {
            EXPECT_EQ(found(light).run_count, 0U);
        }
        frames(light, tree, environment, 1);
        EXPECT_EQ(wordsOf(found(light).faces), wordsOf(expected.faces)) << number;
    }
    EXPECT_GE(failures, 10U);
}

TEST_F(ApiRadianceCache, WhatIsNotValidIsRefused)
{
    const auto make = [&](const RadianceCacheInfo& info)
    { return [&, info] { const RadianceCache light(m_host.context, info); }; };
    expectUsage(make({.width = 0}), "not 0");
    expectUsage(make({.height = 16385}), "not 16385");
    expectUsage(make({.faces = (std::uint64_t{1} << 29) + 1}), "RadianceCacheInfo::faces is 536870913");
    const Tree tree = octree(4);
    Environment environment = sky();
    RadianceCache light(m_host.context, kGrid);
    const auto refused = [&](const CameraInfo& camera, const CachedFrameInfo& info, const std::string& word)
    {
        m_host.frame([&](Recorder& recorder)
                     { expectUsage([&] { light.update(recorder, tree, environment, camera, info); }, word); });
    };
    CameraInfo camera = test::apiCamera();
    refused(camera, {.rays = 0}, "CachedFrameInfo::rays is 0");
    refused(camera, {.rays = (1U << 22) + 1}, "CachedFrameInfo::rays is 4194305");
    camera.up = camera.forward;
    refused(camera, {}, "camera");

    std::optional<Environment> lost;
    m_host.lostFrame([&](Recorder& recorder) { lost.emplace(recorder); });
    expectUsage([&] { frames(light, tree, *lost, 1); }, "environment was lost");
    test::EmbeddingHost other_host;
    Environment foreign = other_host.make<Environment>();
    expectUsage([&] { frames(light, tree, foreign, 1); }, "two contexts");
    frames(light, tree, environment, 1);

    RadianceCache taken(std::move(light));
    const std::string empty = "radiance cache was taken over or moved from";
    expectUsage([&] { frames(light, tree, environment, 1); }, empty);
    expectUsage([&] { (void)light.address(); }, empty);
    expectUsage([&] { (void)light.stats(); }, empty);
    expectUsage([&] { (void)light.bytes(); }, empty);
    expectUsage([&] { light.forget(); }, empty);
    EXPECT_GT(taken.stats().faces, 100U);
    light = std::move(taken);
    frames(light, tree, environment, 1);
    EXPECT_EQ(found(light).frame_count, 2U);
}

} // namespace

} // namespace zvo
