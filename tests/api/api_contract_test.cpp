// SPDX-License-Identifier: MIT
// What zvo promises to hosts: the Vulkan functions it does not call, its messages on misuse, and its state after
// failures.
#include "api_scene.h"
#include "expect_usage.h"
#include "support/failing_vulkan.h"
#include "support/host_allocator.h"
#include "support/host_memory.h"
#include "support/sweep.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>

namespace zvo
{

namespace
{

using test::expectUsage;

/// Uses everything that a host can do, in a few frames. Returns a picture of each tree.
class Program
{
public:
    explicit Program(test::EmbeddingHost& host) : m_host(host) {}

    std::vector<std::vector<std::uint32_t>> run()
    {
        const test::HostModel description(m_scene);
        const Model model = m_host.upload(description.info());
        Tree octree = m_host.build(model, {.grid = test::apiGrid(4), .format = AttributeFormat::Bytes4});
        std::vector<std::vector<std::uint32_t>> pictures = {m_host.picture(octree, test::apiCamera())};
        const Tree dag = m_host.compress(std::move(octree));
        pictures.push_back(m_host.picture(dag, test::apiCamera()));

        auto tree = m_host.make<DynamicTree>(m_host.build(model, {.grid = test::apiGrid(4)}),
                                             DynamicTreeInfo{.history_entries = 2});
        m_host.add(tree, model, test::movedBy(1, 2, 0));
        m_host.update(tree);
        pictures.push_back(m_host.picture(tree, test::apiCamera()));
        m_host.edit(tree, {.center = {8, 8, 8}, .radius = 3});
        m_host.update(tree);
        pictures.push_back(m_host.picture(tree, test::apiCamera()));
        pictures.push_back(paths(tree));
        return pictures;
    }

private:
    std::vector<std::uint32_t> paths(DynamicTree& tree)
    {
        constexpr std::uint32_t kEdge = 16;
        Tracer tracer(m_host.context, kEdge, kEdge, VK_FORMAT_R8G8B8A8_UNORM);
        test::TargetImage image(m_host.device, VK_FORMAT_R8G8B8A8_UNORM, kEdge, kEdge);
        const std::vector<Vec3> texels(8, {1, 2, 3});
        return m_host.picture(image,
                              [&](Recorder& recorder, const ImageTarget& target)
                              {
                                  Environment environment(recorder, {.width = 4, .height = 2, .texels = texels});
                                  environment.setSun({});
                                  tracer.tracePaths(recorder, tree, environment, test::apiCamera(), {.bounces = 1},
                                                    target);
                              });
    }

    test::EmbeddingHost& m_host;
    Scene m_scene = test::boxScene(glm::vec3(2), glm::vec3(6));
};

TEST(ApiContract, ZvoNeitherSubmitsNorWaits)
{
    test::failCall(UINT64_MAX);
    test::HostOptions options;
    options.zvo_functions = test::failingVulkan();
    {
        test::EmbeddingHost host(options);
        Program(host).run();
        EXPECT_GT(test::callCount("vkCreateBuffer"), 20U); // the calls are counted
        for (const char* const function :
             {"vkQueueSubmit", "vkQueueSubmit2", "vkQueueWaitIdle", "vkDeviceWaitIdle", "vkWaitForFences",
              "vkWaitSemaphores", "vkQueuePresentKHR", "vkCreateFence", "vkCreateCommandPool", "vkBeginCommandBuffer",
              "vkEndCommandBuffer", "vkAllocateCommandBuffers", "vkCreateDevice", "vkCreateInstance"})
        {
            EXPECT_EQ(test::callCount(function), 0U) << function;
        }
    }
    EXPECT_EQ(test::liveObjects(), std::vector<std::string>());
}

// The pictures of every program of these tests.
const std::vector<std::vector<std::uint32_t>>& expectedPictures()
{
    static const std::vector<std::vector<std::uint32_t>> pictures = []
    {
        test::EmbeddingHost host;
        return Program(host).run();
    }();
    return pictures;
}

// Runs a program in which something fails, and returns whether it did. The failure must be an Error, and the context
// must work afterwards.
bool failOnce(test::EmbeddingHost& host, const std::function<void()>& stopFailing)
{
    bool has_failed = false;
    try
    {
        EXPECT_EQ(Program(host).run(), expectedPictures());
    }
    catch (const Error& error)
    {
        has_failed = true;
        EXPECT_EQ(error.code(), ErrorCode::Memory) << error.what();
    }
    stopFailing();
    EXPECT_EQ(host.context.memory().used, 0U) << "after a failure: " << has_failed;
    EXPECT_EQ(Program(host).run(), expectedPictures());
    return has_failed;
}

struct Failure
{
    bool has_failed;  // the program
    bool was_reached; // the call that was to fail
};

// The allocator has a call fail until the program has run.
Failure failOnce(test::EmbeddingHost& host, test::HostAllocator& allocator)
{
    Failure result{};
    result.has_failed = failOnce(host,
                                 [&]
                                 {
                                     result.was_reached = allocator.hasFailed();
                                     allocator.failCall(UINT64_MAX);
                                 });
    return result;
}

TEST(ApiContract, EveryRequestForMemoryMayFail)
{
    std::uint64_t failures = 0;
    bool has_failed = true;
    for (std::uint64_t number = 0; has_failed; ++number) // on a new context, which has no memory yet
    {
        test::HostMemory memory;
        test::HostOptions options;
        options.memory = memory.callbacks();
        {
            test::EmbeddingHost host(options, [](ContextInfo& info) { info.memory_budget_bytes = 512ULL << 20; });
            memory.attach(host.device);
            memory.failRequests(number);
            host.submits_failed = number % 2 == 1;
            has_failed = failOnce(host, [&] { memory.failRequests(UINT64_MAX); });
            failures += has_failed ? 1 : 0;
        }
        EXPECT_EQ(memory.liveCount(), 0U);
    }
    EXPECT_GE(failures, 5U);
}

TEST(ApiContract, EveryAllocationOfTheDriverMayFail)
{
    test::HostAllocator allocator;
    test::HostOptions options;
    options.allocation_callbacks = allocator.callbacks();
    std::uint64_t failures = 0;
    {
        test::EmbeddingHost host(options);
        Program(host).run(); // kernels are made: of these, test::AllocationCallbacks has every allocation fail
        test::Sweep sweep;
        std::uint64_t run_count = 0;
        for (std::uint64_t number = sweep.first();; number += sweep.step())
        {
            allocator.failCall(number);
            host.submits_failed = run_count++ % 2 == 1;
            const auto [has_failed, was_reached] = failOnce(host, allocator);
            failures += has_failed ? 1 : 0;
            if (!was_reached)
            {
                break;
            }
        }
    }
    EXPECT_GT(failures, test::Sweep().share(100));
    EXPECT_EQ(allocator.liveCount(), 0U);
}

TEST(ApiContract, AllocationsOfTheDriverMayFailWhileKernelsAreMade)
{
    test::Sweep sweep(61, 13); // making a context takes time
    bool was_reached = true;
    std::uint64_t failures = 0;
    for (std::uint64_t number = sweep.first(); was_reached; number += sweep.step())
    {
        test::HostAllocator allocator;
        test::HostOptions options;
        options.allocation_callbacks = allocator.callbacks();
        {
            test::EmbeddingHost host(options);
            allocator.failCall(number);
            const auto [has_failed, reached] = failOnce(host, allocator);
            failures += has_failed ? 1 : 0;
            was_reached = reached;
        }
        EXPECT_EQ(allocator.liveCount(), 0U);
    }
    EXPECT_GE(failures, 3U);
}

TEST(ApiContract, WhatIsTooMuchForTheBudgetIsAnErrorThatNamesIt)
{
    test::EmbeddingHost host({},
                             [](ContextInfo& info) { info.memory_budget_bytes = 8 << 20; }); // GPUs take larger blocks
    const test::HostModel description(test::apiScene());
    const Model model = host.upload(description.info());
    TreeBuild build(host.context, model, {.grid = test::apiGrid(10)});
    try
    {
        host.finish(build);
        FAIL() << "no error";
    }
    catch (const Error& error)
    {
        EXPECT_EQ(error.code(), ErrorCode::Memory);
        EXPECT_NE(std::string(error.what()).find("ContextInfo::memory_budget_bytes"), std::string::npos)
            << error.what();
    }
    const Tree small = host.build(model, {.grid = test::apiGrid(4)});
    EXPECT_GT(small.info().voxel_count, 0U);
    EXPECT_LE(host.context.memory().peak_held, 8U << 20);
}

TEST(ApiContract, MisuseIsAnErrorThatSaysWhat)
{
    test::EmbeddingHost host;
    const Scene scene = test::boxScene(glm::vec3(2), glm::vec3(6));
    const test::HostModel description(scene);
    const Model model = host.upload(description.info());
    const Tree tree = host.build(model, {.grid = test::apiGrid(4)});

    const auto uploading = [&](const std::function<void(ModelInfo&)>& spoil, const std::string& word)
    {
        ModelInfo info = description.info();
        spoil(info);
        expectUsage([&] { host.upload(info); }, word);
    };
    std::vector<std::array<std::uint32_t, 3>> triangles = {{0, 1, 4711}};
    MeshInfo mesh = description.info().meshes[0];
    const std::vector<MaterialInfo> materials = {{.base_color_texture = 3, .emission = {}}};
    const std::vector<InstanceInfo> instances = {{.mesh = 9}};
    const std::vector<TextureInfo> textures = {{.width = 4, .height = 4, .rgba = {}}};
    uploading([&](ModelInfo& info) { info.instances = instances; }, "mesh 9");
    uploading([&](ModelInfo& info) { info.textures = textures; }, "texture 0");
    uploading([&](ModelInfo& info) { info.materials = materials; }, "texture 3");
    mesh.triangles = triangles;
    uploading([&](ModelInfo& info) { info.meshes = {&mesh, 1}; }, "vertex 4711");
    mesh = description.info().meshes[0];
    mesh.normals = mesh.positions.first(1);
    uploading([&](ModelInfo& info) { info.meshes = {&mesh, 1}; }, "positions");
    mesh = description.info().meshes[0];
    mesh.material = 5;
    uploading([&](ModelInfo& info) { info.meshes = {&mesh, 1}; }, "material 5");
    expectUsage([&] { (void)model.gridAround(0); }, "depth");
    expectUsage([&] { Tracer(host.context, 0, 10, VK_FORMAT_R8G8B8A8_UNORM); }, "edges");
    expectUsage([&] { Tracer(host.context, 10, 10, VK_FORMAT_R8_UNORM); }, "R8G8B8A8");
    Tracer tracer(host.context, 10, 10, VK_FORMAT_R8G8B8A8_UNORM);
    test::TargetImage image(host.device, VK_FORMAT_B8G8R8A8_UNORM, 10, 10);
    const auto tracing = [&](const CameraInfo& camera, const TraceInfo& info, const ImageTarget& target)
    { host.frame([&](Recorder& recorder) { tracer.trace(recorder, tree, camera, info, target); }); };
    expectUsage([&] { tracing(test::apiCamera(), {}, image.target()); }, "another format");
    CameraInfo camera = test::apiCamera();
    camera.up = camera.forward;
    const test::TargetImage right(host.device, VK_FORMAT_R8G8B8A8_UNORM, 10, 10);
    expectUsage([&] { tracing(camera, {}, right.target()); }, "camera");
    expectUsage([&] { tracing(test::apiCamera(), {.occlusion_rays = 65}, right.target()); }, "65");
    expectUsage(
        [&]
        {
            host.frame([&](Recorder&, VkCommandBuffer commands)
                       { const Recorder second(host.context, commands, host.last_frame + 1); });
        },
        "one Recorder");
    for (int i = 1; i <= 2; ++i) // only the second one can be lost
    {
        VkCommandBuffer commands = host.device.begin();
        const Recorder recorder(host.context, commands, host.last_frame + static_cast<std::uint64_t>(i));
    }
    host.context.frameLost(host.last_frame + 3); // a frame that never began
    expectUsage([&] { host.context.frameLost(host.last_frame + 1); }, "begun last");
    host.context.frameLost(host.last_frame + 2);
    expectUsage([&] { host.context.frameLost(host.last_frame + 1); }, "begun last");
    host.context.frameDone(++host.last_frame);
    TreeBuild build(host.context, model, {.grid = test::apiGrid(4)});
    expectUsage([&] { (void)build.take(); }, "not there");
    host.finish(build);
    (void)build.take();
    expectUsage([&] { (void)build.take(); }, "taken");
}

TEST(ApiContract, FramesThatAreNeverDoneAreToldOnce)
{
    std::vector<std::string> warnings;
    test::EmbeddingHost host({},
                             [&](ContextInfo& info)
                             {
                                 info.log.user = &warnings;
                                 info.log.function = [](void* user, LogSeverity severity, const char* message)
                                 {
                                     if (severity == LogSeverity::Warning)
                                     {
                                         static_cast<std::vector<std::string>*>(user)->emplace_back(message);
                                     }
                                 };
                             });
    const auto record = [&](int frames)
    {
        for (int i = 0; i < frames; ++i)
        {
            VkCommandBuffer commands = host.device.begin();
            {
                const Recorder recorder(host.context, commands, ++host.last_frame);
            }
            host.device.submit(commands);
            host.device.wait();
        }
    };
    record(64);
    EXPECT_TRUE(warnings.empty()) << warnings.front();
    record(40);
    ASSERT_EQ(warnings.size(), 1U);
    EXPECT_NE(warnings.front().find("frameDone"), std::string::npos) << warnings.front();
    host.context.frameDone(host.last_frame);
    record(64);
    EXPECT_EQ(warnings.size(), 1U);
    record(1);
    EXPECT_EQ(warnings.size(), 2U);
    host.context.frameDone(host.last_frame);
}

TEST(ApiContract, ATreeThatCannotBecomeDynamicStays)
{
    test::EmbeddingHost host;
    const test::HostModel description(test::apiScene());
    const Model model = host.upload(description.info());
    Tree tree = host.build(model, {.grid = test::apiGrid(), .format = AttributeFormat::Bytes4});
    const auto expected = host.picture(tree, test::apiCamera());
    const auto makeDynamic = [&]
    {
        host.frame([&](Recorder& recorder)
                   { DynamicTree(recorder, std::move(tree), {.emission_scale = model.emissionScale()}); });
    };
    expectUsage(makeDynamic, "8 bytes");
    EXPECT_EQ(host.picture(tree, test::apiCamera()), expected);
    tree = host.build(model, {.grid = test::apiGrid()});
    makeDynamic();
    expectUsage([&] { host.picture(tree, test::apiCamera()); }, "taken over");
}

TEST(ApiContract, ObjectsMayGoWhileFramesUseThem)
{
    test::EmbeddingHost host;
    const test::HostModel description(test::apiScene());
    auto model = std::make_unique<Model>(host.upload(description.info()));
    auto tree = std::make_unique<Tree>(host.build(*model, {.grid = test::apiGrid()}));
    const auto expected = host.picture(*tree, test::apiCamera());
    auto build = std::make_unique<TreeBuild>(host.context, *model, TreeBuildInfo{.grid = test::apiGrid()});
    auto tracer = std::make_unique<Tracer>(host.context, host.kWidth, host.kHeight, VK_FORMAT_R8G8B8A8_UNORM);
    test::TargetImage image(host.device, VK_FORMAT_R8G8B8A8_UNORM, host.kWidth, host.kHeight);
    VkCommandBuffer commands = host.device.begin();
    {
        Recorder recorder(host.context, commands, ++host.last_frame);
        build->record(recorder);
        image.beginCopies(commands);
        tracer->trace(recorder, *tree, test::apiCamera(), {}, image.target());
        image.read(commands);
    }
    const std::uint64_t used = host.context.memory().used;
    build.reset();
    tracer.reset();
    tree.reset();
    model.reset();
    EXPECT_EQ(host.context.memory().used, used);
    host.device.submit(commands);
    host.device.wait();
    host.context.frameDone(host.last_frame);
    EXPECT_EQ(host.context.memory().used, 0U);
    EXPECT_EQ(image.words(), expected);
}

TEST(ApiContract, TimesOfPassesAreToldOfFramesThatAreDone)
{
    test::HostOptions options;
    options.optional.pass_times = true;
    test::EmbeddingHost host(options, [](ContextInfo& info) { info.timed_passes_per_frame = 300; });
    if (host.context.report().timestamp_period_ns == 0)
    {
        GTEST_SKIP() << "the device has no timestamps";
    }
    const test::HostModel description(test::apiScene());
    const Tree tree = host.build(host.upload(description.info()), {.grid = test::apiGrid()});
    (void)host.picture(tree, test::apiCamera());
    bool has_primary = false;
    for (const PassTime& pass : host.context.passTimes())
    {
        has_primary = has_primary || pass.name == "trace/primary";
        EXPECT_GE(pass.ms, 0.0);
    }
    EXPECT_TRUE(has_primary);
}

TEST(ApiContract, TheVersionIsThatOfTheHeaders)
{
    EXPECT_EQ(version(), ZVO_VERSION);
}

} // namespace

} // namespace zvo
