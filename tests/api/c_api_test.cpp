// SPDX-License-Identifier: MIT
// The C interface: pictures of a program in C, failures, and structs that grow.
#include "api/c_guard.h"
#include "api/c_members.h"
#include "api_scene.h"
#include "c_host.h"
#include "c_program.h"
#include "core/file/zvo_file.h"
#include "runtime/trees.h"
#include "support/engine_device.h"
#include "support/host_memory.h"

#include <gtest/gtest.h>

#include <new>
#include <stdexcept>
#include <string>
#include <thread>

namespace zvo
{

namespace
{

using test::device;

// Two samples of each pixel, one in each of two frames.
template <typename AnyTree>
std::vector<std::uint32_t> pathsInCpp(test::EmbeddingHost& host, AnyTree& tree, Environment&& environment)
{
    environment.setSun({.direction = {1, 0.75, 0.45}});
    Tracer tracer(host.context, host.kWidth, host.kHeight, VK_FORMAT_R8G8B8A8_UNORM);
    test::TargetImage image(host.device, VK_FORMAT_R8G8B8A8_UNORM, host.kWidth, host.kHeight);
    const auto trace = [&](Recorder& recorder, const ImageTarget& target)
    { tracer.tracePaths(recorder, tree, environment, test::apiCamera(), {.bounces = 1}, target); };
    host.picture(image, trace);
    return host.picture(image, trace);
}

// The pictures of c_program.c, made by the C++ interface.
std::vector<std::vector<std::uint32_t>> picturesInCpp()
{
    test::EmbeddingHost host;
    const CameraInfo camera = test::apiCamera();
    MeshInfo mesh;
    mesh.positions = {reinterpret_cast<const Vec3*>(kCBoxCorners), 8};
    mesh.triangles = {reinterpret_cast<const std::array<std::uint32_t, 3>*>(kCBoxTriangles), 12};
    MaterialInfo material;
    material.base_color[1] = 0.25F;
    ModelInfo info;
    info.meshes = {&mesh, 1};
    info.materials = {&material, 1};
    const Model model = host.upload(info);
    Tree octree = host.build(model, {.grid = test::apiGrid(5)});
    std::vector<std::vector<std::uint32_t>> pictures = {host.picture(octree, camera)};
    Tree dag = host.compress(std::move(octree));
    pictures.push_back(host.picture(dag, camera));
    std::vector<Vec3> texels(8, {2, 1, 0});
    std::fill_n(texels.begin(), 4, Vec3{1, 2, 3});
    const EnvironmentMapInfo map = {4, 2, texels, 0, 0.5F};
    pictures.push_back(pathsInCpp(host, dag, host.make<Environment>(map)));
    auto tree = host.make<DynamicTree>(std::move(dag), DynamicTreeInfo{.history_entries = 2});
    host.frame([&](Recorder& recorder) { tree.addObject(recorder, model, test::movedBy(3, 4, 2)); });
    host.update(tree);
    pictures.push_back(host.picture(tree, camera));
    host.edit(tree, {.action = BrushAction::Fill, .center = {24, 8, 24}, .radius = 4, .color = 255});
    host.update(tree);
    pictures.push_back(host.picture(tree, camera));
    pictures.push_back(pathsInCpp(host, tree, host.make<Environment>()));
    return pictures;
}

TEST(CApi, AProgramInCShowsWhatOneInCppShows)
{
    const std::vector<std::vector<std::uint32_t>> expected = picturesInCpp();
    ASSERT_EQ(expected.size(), C_PROGRAM_PICTURES);
    EXPECT_EQ(expected[0], expected[1]);
    EXPECT_NE(expected[1], expected[2]);
    EXPECT_NE(expected[2], expected[3]);
    EXPECT_NE(expected[3], expected[4]);
    EXPECT_NE(expected[4], expected[5]);
    test::CEmbeddingHost host;
    EXPECT_EQ(host.runProgram(), C_PROGRAM_PICTURES);
    EXPECT_EQ(host.pictures, expected);
    ZvoMemoryUse use = ZVO_MEMORY_USE_INIT;
    EXPECT_EQ(zvoContextMemory(host.context, &use), ZVO_OK);
    EXPECT_EQ(use.used, 0U);
    EXPECT_GT(use.peak_held, 0U);
    EXPECT_GE(use.peak_held, use.held);
}

TEST(CApi, AHostsMemoryAndLogAreFunctionsInC)
{
    test::HostMemory memory;
    std::vector<std::string> messages;
    test::HostOptions options;
    options.memory = memory.callbacks();
    test::CEmbeddingHost host(
        options,
        [&](ZvoContextInfo& info)
        {
            info.log.user = &messages;
            info.log.function = [](void* user, ZvoLogSeverity severity, const char* message)
            {
                EXPECT_LE(severity, std::uint32_t{ZVO_LOG_WARNING});
                static_cast<std::vector<std::string>*>(user)->emplace_back(message);
            };
        },
        [&](const test::HostDevice& device) { memory.attach(device); });
    EXPECT_EQ(host.runProgram(), C_PROGRAM_PICTURES);
    EXPECT_GT(memory.requestCount(), 0U);
    EXPECT_FALSE(messages.empty());

    // Without any memory, an operation fails with a message.
    memory.failRequests(0);
    ZvoTracer* tracer = nullptr;
    EXPECT_EQ(zvoTracerCreate(host.context, 4096, 4096, VK_FORMAT_R8G8B8A8_UNORM, &tracer), ZVO_ERROR_MEMORY);
    EXPECT_EQ(std::string(zvoLastError()).find("zvoTracerCreate: "), 0U) << zvoLastError();
    EXPECT_EQ(tracer, nullptr);
    memory.failRequests(UINT64_MAX);
}

TEST(CApi, EveryExceptionBecomesAResult)
{
    const auto resultOf = [](auto&& exception)
    { return guarded("zvoTest", [&] { throw std::forward<decltype(exception)>(exception); }); };
    for (int code = ZVO_ERROR_OTHER; code <= ZVO_ERROR_MEMORY; ++code)
    {
        EXPECT_EQ(resultOf(Error(static_cast<ErrorCode>(code), "why " + std::to_string(code))), code);
        EXPECT_EQ(zvoLastError(), "zvoTest: why " + std::to_string(code));
    }
    EXPECT_EQ(resultOf(std::bad_alloc()), ZVO_ERROR_MEMORY);
    EXPECT_EQ(resultOf(std::bad_array_new_length()), ZVO_ERROR_MEMORY);
    EXPECT_EQ(resultOf(std::length_error("too long")), ZVO_ERROR_OTHER);
    EXPECT_STREQ(zvoLastError(), "zvoTest: too long");
    EXPECT_EQ(resultOf(7), ZVO_ERROR_OTHER);
    EXPECT_EQ(resultOf(Error(ErrorCode::Usage, std::string(100000, 'x'))), ZVO_ERROR_USAGE);
    EXPECT_GT(std::string(zvoLastError()).size(), 1000U);
    const std::string before = zvoLastError();
    EXPECT_EQ(guarded("zvoTest", [] {}), ZVO_OK);
    EXPECT_EQ(zvoLastError(), before);
    std::thread([] { EXPECT_STREQ(zvoLastError(), ""); }).join(); // each thread has its own
}

TEST(CApi, FilesAreReadAndBrokenOnesAreInputErrors)
{
    test::CEmbeddingHost host;
    std::vector<std::byte> bytes;
    const DeviceTree octree = test::engineOctree(device(), test::apiScene(), test::apiGrid());
    writeZvo(downloadTree(device(), octree),
             [&](std::span<const std::byte> more) { bytes.insert(bytes.end(), more.begin(), more.end()); });
    ZvoTree* tree = nullptr;
    host.frame([&](ZvoRecorder* recorder)
               { EXPECT_EQ(zvoTreeFromMemory(recorder, bytes.data(), bytes.size(), &tree), ZVO_OK); });
    ASSERT_NE(tree, nullptr);
    ZvoTreeInfo description = ZVO_TREE_INFO_INIT;
    EXPECT_EQ(zvoTreeInfo(tree, &description), ZVO_OK);
    EXPECT_EQ(description.structure, std::uint32_t{ZVO_TREE_STRUCTURE_SVO});
    EXPECT_EQ(description.format, std::uint32_t{ZVO_ATTRIBUTE_FORMAT_BYTES8});
    EXPECT_EQ(description.grid.depth, test::apiGrid().depth);
    EXPECT_EQ(description.voxel_count, octree.voxel_count);
    EXPECT_EQ(description.node_count, octree.node_count);
    EXPECT_EQ(description.emission_scale, octree.emission_scale);
    std::uint64_t address = 0;
    EXPECT_EQ(zvoTreeAddress(tree, &address), ZVO_OK);
    EXPECT_NE(address, 0U);
    EXPECT_EQ(host.picture(tree), test::pictureOf(device(), octree, View::Color));
    zvoTreeDestroy(tree);
    bytes[200] ^= std::byte{1};
    host.frame(
        [&](ZvoRecorder* recorder)
        {
            EXPECT_EQ(zvoTreeFromMemory(recorder, bytes.data(), bytes.size(), &tree), ZVO_ERROR_INPUT);
            EXPECT_EQ(zvoTreeFromMemory(recorder, bytes.data(), 0, &tree), ZVO_ERROR_INPUT);
            EXPECT_EQ(zvoTreeFromFile(recorder, "/no/such/file.zvo", &tree), ZVO_ERROR_INPUT);
            EXPECT_NE(std::string(zvoLastError()).find("/no/such/file.zvo"), std::string::npos) << zvoLastError();
            EXPECT_EQ(zvoRecorderMakeVisible(recorder, VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT), ZVO_OK);
        });
}

TEST(CApi, WhatIsTakenOverIsGoneOnlyOnSuccess)
{
    test::CEmbeddingHost host;
    ZvoModel* const model = host.uploadBox();
    ZvoTreeBuildInfo info = ZVO_TREE_BUILD_INFO_INIT;
    info.grid = {{-2, -2, -2}, 1, 4};
    info.coverage = 2;
    ZvoTreeJob* build = nullptr;
    EXPECT_EQ(zvoTreeBuildCreate(host.context, model, &info, &build), ZVO_ERROR_USAGE);
    EXPECT_NE(std::string(zvoLastError()).find("TreeBuildInfo::coverage has no value 2"), std::string::npos);
    info.coverage = ZVO_COVERAGE_THIN;
    info.format = ZVO_ATTRIBUTE_FORMAT_BYTES4;
    ZvoTree* tree = host.build(model, info);
    ZvoTreeInfo description = ZVO_TREE_INFO_INIT;
    ZvoTreeAlgebraInfo algebra_info = ZVO_TREE_ALGEBRA_INFO_INIT;
    ZvoTreeJob* algebra = nullptr;
    host.frame(
        [&](ZvoRecorder* recorder)
        {
            EXPECT_EQ(zvoTreeAlgebraCreate(recorder, tree, tree, &algebra_info, &algebra), ZVO_ERROR_USAGE);
            EXPECT_NE(std::string(zvoLastError()).find("8 bytes"), std::string::npos) << zvoLastError();
        });
    ZvoTreeJob* compression = nullptr;
    EXPECT_EQ(zvoTreeCompressionCreate(host.context, tree, nullptr), ZVO_ERROR_USAGE);
    EXPECT_EQ(zvoTreeInfo(tree, &description), ZVO_OK); // the tree is as before
    EXPECT_EQ(zvoTreeCompressionCreate(host.context, tree, &compression), ZVO_OK);
    EXPECT_EQ(zvoTreeJobTake(compression, &tree), ZVO_ERROR_USAGE);
    VkBool32 has_more = VK_TRUE;
    while (has_more)
    {
        host.frame([&](ZvoRecorder* recorder)
                   { EXPECT_EQ(zvoTreeJobRecord(compression, recorder, &has_more), ZVO_OK); });
    }
    VkBool32 is_broken = VK_TRUE;
    EXPECT_EQ(zvoTreeJobIsBroken(compression, &is_broken), ZVO_OK);
    EXPECT_EQ(is_broken, VkBool32{VK_FALSE});
    ASSERT_EQ(zvoTreeJobTake(compression, &tree), ZVO_OK);
    zvoTreeJobDestroy(compression);
    EXPECT_EQ(zvoTreeCompressionCreate(host.context, tree, &compression), ZVO_ERROR_USAGE); // the tree is a DAG already
    EXPECT_EQ(zvoTreeInfo(tree, &description), ZVO_OK);
    EXPECT_EQ(description.structure, std::uint32_t{ZVO_TREE_STRUCTURE_SVDAG});

    // Dynamic trees refuse attributes of 4 bytes, and leave the tree as it is.
    ZvoDynamicTree* dynamic = nullptr;
    const ZvoDynamicTreeInfo defaults = ZVO_DYNAMIC_TREE_INFO_INIT;
    host.frame([&](ZvoRecorder* recorder)
               { EXPECT_EQ(zvoDynamicTreeCreate(recorder, tree, &defaults, &dynamic), ZVO_ERROR_USAGE); });
    std::uint64_t address = 0;
    EXPECT_EQ(zvoTreeInfo(tree, &description), ZVO_OK);
    EXPECT_EQ(zvoTreeAddress(tree, &address), ZVO_OK);
    EXPECT_NE(address, 0U);
    zvoTreeDestroy(tree);
    zvoModelDestroy(model);
}

TEST(CApi, ReportsAndPassTimesAreToldLineByLine)
{
    test::HostOptions options;
    options.optional.pass_times = true;
    test::CEmbeddingHost host(options, [](ZvoContextInfo& info) { info.timed_passes_per_frame = 300; });
    const DeviceReport expected =
        query(host.info.get_instance_proc_addr, host.info.instance, host.info.physical_device, VK_API_VERSION_1_3);
    ZvoDeviceReport* asked = nullptr;
    ASSERT_EQ(zvoQuery(host.info.get_instance_proc_addr, host.info.instance, host.info.physical_device,
                       VK_API_VERSION_1_3, &asked),
              ZVO_OK);
    const ZvoDeviceReport* own = nullptr;
    ASSERT_EQ(zvoContextReport(host.context, &own), ZVO_OK);
    for (const ZvoDeviceReport* const report : {static_cast<const ZvoDeviceReport*>(asked), own})
    {
        ZvoDeviceInfo description = ZVO_DEVICE_INFO_INIT;
        ASSERT_EQ(zvoDeviceReportInfo(report, &description), ZVO_OK);
        eachShared<ZvoDeviceInfo>(description, expected,
                                  [](const auto& told, const auto& known) { EXPECT_EQ(told, known); });
        EXPECT_EQ(description.usable, VkBool32{VK_TRUE});
        for (const auto& [list, lines] :
             {std::pair(ZVO_REPORT_PRESENT, expected.present), std::pair(ZVO_REPORT_MISSING, expected.missing),
              std::pair(ZVO_REPORT_REASONS, expected.reasons)})
        {
            std::vector<std::string> told;
            for (const char* text = "";; told.emplace_back(text))
            {
                ASSERT_EQ(zvoDeviceReportText(report, list, static_cast<std::uint32_t>(told.size()), &text), ZVO_OK);
                if (text == nullptr)
                {
                    break;
                }
            }
            EXPECT_EQ(told, lines);
        }
        const char* text = nullptr;
        EXPECT_EQ(zvoDeviceReportText(report, 3, 0, &text), ZVO_ERROR_USAGE);
    }
    zvoDeviceReportDestroy(asked);

    EXPECT_EQ(host.runProgram(), C_PROGRAM_PICTURES);
    std::uint32_t count = 0;
    ASSERT_EQ(zvoContextPassTimeCount(host.context, &count), ZVO_OK);
    bool has_develop = false;
    ZvoPassTime time = ZVO_PASS_TIME_INIT;
    for (std::uint32_t i = 0; i < count; ++i)
    {
        ASSERT_EQ(zvoContextPassTime(host.context, i, &time), ZVO_OK);
        has_develop = has_develop || std::string(time.name) == "path/develop"; // of the last picture
    }
    EXPECT_EQ(has_develop, expected.timestamp_period_ns != 0);
    EXPECT_EQ(zvoContextPassTime(host.context, count, &time), ZVO_ERROR_USAGE);
}

TEST(CApi, FeaturesArePatchedOrWhatStandsInTheWayIsSaid)
{
    ZvoFeatureStorage* storage = nullptr;
    ASSERT_EQ(zvoFeatureStorageCreate(&storage), ZVO_OK);
    VkDeviceCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO;
    ZvoOptionalFeatures optional = ZVO_OPTIONAL_FEATURES_INIT;
    optional.pass_times = VK_TRUE;
    const auto hasStruct = [&](VkStructureType type)
    {
        const auto* next = static_cast<const VkBaseInStructure*>(info.pNext);
        while (next != nullptr && next->sType != type)
        {
            next = next->pNext;
        }
        return next != nullptr;
    };
    EXPECT_EQ(zvoPatchFeatures(&info, storage, nullptr), ZVO_OK);
    EXPECT_TRUE(hasStruct(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SYNCHRONIZATION_2_FEATURES));
    EXPECT_FALSE(hasStruct(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_HOST_QUERY_RESET_FEATURES));
    EXPECT_EQ(zvoPatchFeatures(&info, storage, &optional), ZVO_OK);
    EXPECT_TRUE(hasStruct(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_HOST_QUERY_RESET_FEATURES));
    zvoFeatureStorageDestroy(storage);

    // A feature that was not enabled is refused.
    test::HostOptions options;
    options.patch = false;
    const test::HostDevice device(options);
    const test::Declaration declaration(device);
    const ZvoContextInfo bare = test::cDeclaration(declaration.info);
    ZvoContext* context = nullptr;
    EXPECT_EQ(zvoContextCreate(&bare, &context), ZVO_ERROR_DEVICE);
    EXPECT_EQ(context, nullptr);
}

TEST(CApi, RadianceCacheIsThatOfTheCppInterface)
{
    test::CEmbeddingHost host;
    ZvoModel* const model = host.uploadBox();
    ZvoTreeBuildInfo build_info = ZVO_TREE_BUILD_INFO_INIT;
    build_info.grid = {{-2, -2, -2}, 1, 4};
    ZvoTree* tree = host.build(model, build_info);
    ZvoEnvironment* environment = nullptr;
    ZvoCameraInfo camera = ZVO_CAMERA_INFO_INIT;
    const double eye[3] = {22, 17, 25};
    const double target[3] = {5, 5, 5};
    ASSERT_EQ(zvoCameraLookAt(eye, target, 0.6, &camera), ZVO_OK);
    ZvoRadianceCacheInfo info = ZVO_RADIANCE_CACHE_INFO_INIT;
    info.width = 40;
    info.height = 30;
    ZvoRadianceCache* light = nullptr;
    ASSERT_EQ(zvoRadianceCacheCreate(host.context, &info, &light), ZVO_OK);
    ZvoCachedFrameInfo frame = ZVO_CACHED_FRAME_INFO_INIT;
    const auto faceCount = [&]
    {
        ZvoRadianceCacheStats stats = ZVO_RADIANCE_CACHE_STATS_INIT;
        EXPECT_EQ(zvoRadianceCacheStats(light, &stats), ZVO_OK);
        return stats.faces;
    };
    host.frame(
        [&](ZvoRecorder* recorder)
        {
            EXPECT_EQ(zvoEnvironmentCreate(recorder, nullptr, &environment), ZVO_OK);
            EXPECT_EQ(zvoRadianceCacheUpdate(light, recorder, tree, environment, &camera, &frame), ZVO_OK);
            frame.rays = 0;
            EXPECT_EQ(zvoRadianceCacheUpdate(light, recorder, tree, environment, &camera, &frame), ZVO_ERROR_USAGE);
            frame.rays = 4000;
        });
    const std::uint64_t still = faceCount();
    EXPECT_GT(still, 20U);
    std::uint64_t address = 0;
    std::uint64_t same_address = 0;
    std::uint64_t bytes = 0;
    EXPECT_EQ(zvoRadianceCacheAddress(light, &address), ZVO_OK);
    EXPECT_NE(address, 0U);
    EXPECT_EQ(zvoRadianceCacheBytes(light, &bytes), ZVO_OK);
    EXPECT_GT(bytes, 36 * still);
    EXPECT_EQ(zvoRadianceCacheForget(light), ZVO_OK);
    ZvoDynamicTree* dynamic = nullptr;
    const ZvoDynamicTreeInfo dynamic_info = ZVO_DYNAMIC_TREE_INFO_INIT;
    host.frame(
        [&](ZvoRecorder* recorder)
        {
            EXPECT_EQ(zvoDynamicTreeCreate(recorder, tree, &dynamic_info, &dynamic), ZVO_OK);
            EXPECT_EQ(zvoRadianceCacheUpdateDynamic(light, recorder, dynamic, environment, &camera, &frame), ZVO_OK);
        });
    EXPECT_EQ(faceCount(), still) << "the same faces of the same voxels";
    ZvoTracer* tracer = nullptr;
    const ZvoCachedPictureInfo picture = ZVO_CACHED_PICTURE_INFO_INIT;
    const ZvoImageTarget color = host.target();
    ASSERT_EQ(zvoTracerCreate(host.context, host.kWidth, host.kHeight, VK_FORMAT_R8G8B8A8_UNORM, &tracer), ZVO_OK);
    host.frame(
        [&](ZvoRecorder* recorder)
        {
            host.beginImage();
            EXPECT_EQ(zvoRadianceCacheUpdateDynamic(light, recorder, dynamic, environment, &camera, &frame), ZVO_OK);
            EXPECT_EQ(
                zvoTracerTraceCachedDynamic(tracer, recorder, dynamic, environment, light, &camera, &picture, &color),
                ZVO_OK);
            EXPECT_EQ(zvoRadianceCacheForget(light), ZVO_OK);
            EXPECT_EQ(
                zvoTracerTraceCachedDynamic(tracer, recorder, dynamic, environment, light, &camera, &picture, &color),
                ZVO_ERROR_USAGE);
        });
    zvoTracerDestroy(tracer);
    EXPECT_EQ(zvoRadianceCacheAddress(light, &same_address), ZVO_OK);
    EXPECT_EQ(same_address, address);
    zvoRadianceCacheDestroy(light);
    zvoDynamicTreeDestroy(dynamic);
    zvoEnvironmentDestroy(environment);
    zvoModelDestroy(model);
}

TEST(CApi, TheVersionIsThatOfTheHeader)
{
    EXPECT_EQ(zvoVersion(), ZVO_VERSION);
}

} // namespace

} // namespace zvo
