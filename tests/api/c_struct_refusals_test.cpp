// SPDX-License-Identifier: MIT
// The C interface refuses counts that no memory has, and null pointers.
#include "api/c_convert.h"
#include "c_host.h"
#include "expect_usage.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <set>
#include <string>
#include <tuple>
#include <type_traits>

namespace zvo
{

namespace
{

using test::expectUsage;

TEST(CStructs, CountsThatNoMemoryHasAreRefused)
{
    const float floats[12] = {};
    const std::uint32_t vertices[3] = {};
    auto mesh = CStruct<ZvoMeshInfo>::initial();
    mesh.positions = floats;
    mesh.vertex_count = 3;
    mesh.triangles = vertices;
    mesh.triangle_count = std::size_t{1} << 62;
    expectUsage([&] { ofC(mesh); }, "ZvoMeshInfo::triangles has more elements");
    mesh.triangle_count = 1;
    mesh.vertex_count = SIZE_MAX;
    expectUsage([&] { ofC(mesh); }, "ZvoMeshInfo::positions has more elements");
    mesh.vertex_count = 3;
    auto model = CStruct<ZvoModelInfo>::initial();
    model.meshes = &mesh;
    model.mesh_count = std::size_t{1} << 62;
    expectUsage([&] { ModelOfC{model}; }, "ZvoModelInfo::meshes has more elements");
    auto map = CStruct<ZvoEnvironmentMapInfo>::initial();
    map.texels = floats;
    map.width = map.height = UINT32_MAX;
    expectUsage([&] { ofC(map); }, "ZvoEnvironmentMapInfo::texels has more elements");
}

TEST(CStructs, ArraysThatAreNullAndNotEmptyAreRefused)
{
    ZvoMeshInfo mesh = ZVO_MESH_INFO_INIT;
    mesh.vertex_count = 3;
    expectUsage([&] { ofC(mesh); }, "ZvoMeshInfo::positions is null");
    mesh.vertex_count = 0;
    mesh.triangle_count = 1;
    expectUsage([&] { ofC(mesh); }, "ZvoMeshInfo::triangles is null");
    ZvoTextureInfo texture = ZVO_TEXTURE_INFO_INIT;
    texture.rgba_bytes = 4;
    expectUsage([&] { ofC(texture); }, "ZvoTextureInfo::rgba is null");
    ZvoModelInfo model = ZVO_MODEL_INFO_INIT;
    model.mesh_count = 1;
    expectUsage([&] { const ModelOfC it(model); }, "ZvoModelInfo::meshes is null");
    ZvoContextInfo context = ZVO_CONTEXT_INFO_INIT;
    context.device_extension_count = 1;
    expectUsage([&] { ofC(context); }, "ZvoContextInfo::device_extensions is null");
    expectUsage([] { ofC(CStruct<ZvoDepthTarget>::initial()); }, "ZvoDepthTarget::image is null");
    ZvoEnvironmentMapInfo map = ZVO_ENVIRONMENT_MAP_INFO_INIT;
    map.width = map.height = 1;
    expectUsage([&] { ofC(map); }, "ZvoEnvironmentMapInfo::texels is null");
}

// The handle, or other object of the host's, that functions are called with.
template <typename Object> Object*& handle()
{
    static Object* object = nullptr;
    return object;
}

// What a parameter is given. Pointers that are no handles point to defaults, to numbers, or to handles to be made.
template <typename Parameter> Parameter given()
{
    using Pointee = std::remove_const_t<std::remove_pointer_t<Parameter>>;
    if constexpr (!std::is_pointer_v<Parameter>)
    {
        return static_cast<Parameter>(1);
    }
    else if constexpr (requires { CStruct<Pointee>::initial(); })
    {
        static Pointee defaults = CStruct<Pointee>::initial();
        return &defaults;
    }
    else if constexpr (std::is_arithmetic_v<Pointee> || std::is_pointer_v<Pointee>)
    {
        static Pointee values[16] = {}; // a matrix has the most
        return values;
    }
    else
    {
        return handle<Pointee>();
    }
}

// Calls a function with each of its pointers null in turn, but those with the numbers `optional`, and expects Usage.
// Returns how many they were.
template <typename... Parameters>
std::size_t refusesNulls(ZvoResult (*function)(Parameters...), const char* name,
                         const std::set<std::size_t>& optional = {})
{
    std::size_t count = 0;
    for (std::size_t without = 0; without < sizeof...(Parameters); ++without)
    {
        std::size_t number = 0;
        bool is_null = false;
        const auto given_or_null = [&]<typename Parameter>(Parameter argument)
        {
            if (number++ != without || optional.count(without) != 0)
            {
                return argument;
            }
            is_null = std::is_pointer_v<Parameter>;
            return is_null ? Parameter{} : argument;
        };
        const std::tuple<Parameters...> arguments{given_or_null(given<Parameters>())...}; // in this order
        if (is_null)
        {
            ++count;
            EXPECT_EQ(std::apply(function, arguments), ZVO_ERROR_USAGE) << name << " without argument " << without;
            EXPECT_EQ(std::string(zvoLastError()).find(std::string(name) + ": "), 0U) << zvoLastError();
            EXPECT_NE(std::string(zvoLastError()).find("null"), std::string::npos) << zvoLastError();
        }
    }
    return count;
}

TEST(CStructs, PointersThatAreNullAreRefused)
{
    test::CEmbeddingHost host;
    ZvoTreeBuildInfo build_info = ZVO_TREE_BUILD_INFO_INIT;
    build_info.grid = {{-2, -2, -2}, 1, 4};
    const ZvoDynamicTreeInfo dynamic_info = ZVO_DYNAMIC_TREE_INFO_INIT;
    const ZvoRadianceCacheInfo light_info = ZVO_RADIANCE_CACHE_INFO_INIT;
    VkDeviceCreateInfo create_info{};
    ZvoModel* const model = host.uploadBox();
    ZvoTree* const taken = host.build(model, build_info);
    const ZvoDeviceReport* report = nullptr;
    ASSERT_EQ(zvoContextReport(host.context, &report), ZVO_OK);
    handle<std::remove_pointer_t<PFN_vkGetInstanceProcAddr>>() = host.info.get_instance_proc_addr;
    handle<std::remove_pointer_t<VkInstance>>() = host.info.instance;
    handle<std::remove_pointer_t<VkPhysicalDevice>>() = host.info.physical_device;
    handle<std::remove_pointer_t<VkCommandBuffer>>() = host.device.begin();
    handle<VkDeviceCreateInfo>() = &create_info;
    handle<void>() = &create_info;
    handle<ZvoContext>() = host.context;
    handle<ZvoDeviceReport>() = const_cast<ZvoDeviceReport*>(report);
    handle<ZvoModel>() = model;
    handle<ZvoTree>() = host.build(model, build_info);
    ASSERT_EQ(zvoFeatureStorageCreate(&handle<ZvoFeatureStorage>()), ZVO_OK);
    ASSERT_EQ(zvoTreeBuildCreate(host.context, model, &build_info, &handle<ZvoTreeJob>()), ZVO_OK);
    ASSERT_EQ(zvoTracerCreate(host.context, 8, 8, VK_FORMAT_R8G8B8A8_UNORM, &handle<ZvoTracer>()), ZVO_OK);
    ASSERT_EQ(zvoRadianceCacheCreate(host.context, &light_info, &handle<ZvoRadianceCache>()), ZVO_OK);
    ASSERT_EQ(zvoKernelPreparationCreate(host.context, "", &handle<ZvoKernelPreparation>()), ZVO_OK);
    host.frame(
        [&](ZvoRecorder* recorder)
        {
            ASSERT_EQ(zvoDynamicTreeCreate(recorder, taken, &dynamic_info, &handle<ZvoDynamicTree>()), ZVO_OK);
            ASSERT_EQ(zvoEnvironmentCreate(recorder, nullptr, &handle<ZvoEnvironment>()), ZVO_OK);
            ASSERT_EQ(zvoQueryBatchCreateDynamic(recorder, handle<ZvoDynamicTree>(), ZVO_QUERY_KIND_POINT, nullptr, 0,
                                                 &handle<ZvoQueryBatch>()),
                      ZVO_OK);
        });
    ZvoQueryAnswer answer{};
    handle<ZvoQueryAnswer>() = &answer;
    std::size_t pointers = 0;
#define REFUSES_NULLS(function, ...) pointers += refusesNulls(&function, #function __VA_OPT__(, ) __VA_ARGS__)
    REFUSES_NULLS(zvoQuery);
    REFUSES_NULLS(zvoDeviceReportInfo);
    REFUSES_NULLS(zvoDeviceReportText);
    REFUSES_NULLS(zvoFeatureStorageCreate);
    REFUSES_NULLS(zvoPatchFeatures, {2});
    REFUSES_NULLS(zvoPatchFeatureChain, {2, 3});
    REFUSES_NULLS(zvoContextCreate);
    REFUSES_NULLS(zvoContextFrameDone);
    REFUSES_NULLS(zvoContextFrameLost);
    REFUSES_NULLS(zvoContextMemory);
    REFUSES_NULLS(zvoContextPassTimeCount);
    REFUSES_NULLS(zvoContextPassTime, {2}); // no pass has a time: that is refused first
    REFUSES_NULLS(zvoContextReport);
    REFUSES_NULLS(zvoContextMadeKernels);
    REFUSES_NULLS(zvoKernelPreparationCreate);
    REFUSES_NULLS(zvoKernelPreparationSize);
    REFUSES_NULLS(zvoKernelPreparationMake);
    REFUSES_NULLS(zvoKernelPreparationFinish);
    REFUSES_NULLS(zvoRecorderBegin);
    REFUSES_NULLS(zvoModelStats);
    REFUSES_NULLS(zvoModelGridAround);
    REFUSES_NULLS(zvoTreeInfo);
    REFUSES_NULLS(zvoTreeAddress);
    REFUSES_NULLS(zvoTreeBuildCreate);
    REFUSES_NULLS(zvoTreeCompressionCreate);
    REFUSES_NULLS(zvoTreeJobIsDone);
    REFUSES_NULLS(zvoTreeJobIsBroken);
    REFUSES_NULLS(zvoTreeJobTake);
    REFUSES_NULLS(zvoTreeJobDropped);
    REFUSES_NULLS(zvoDynamicTreeSetTransform);
    REFUSES_NULLS(zvoDynamicTreeRemoveObject);
    REFUSES_NULLS(zvoDynamicTreeNeedsUpdate);
    REFUSES_NULLS(zvoDynamicTreeEndStroke);
    REFUSES_NULLS(zvoDynamicTreeTakeUpdate);
    REFUSES_NULLS(zvoDynamicTreeInfo);
    REFUSES_NULLS(zvoDynamicTreeAddress);
    REFUSES_NULLS(zvoTracerCreate);
    REFUSES_NULLS(zvoTracerSampleCount);
    REFUSES_NULLS(zvoTracerForgetSamples);
    REFUSES_NULLS(zvoSunlight);
    REFUSES_NULLS(zvoEnvironmentSetSun);
    REFUSES_NULLS(zvoRadianceCacheCreate);
    REFUSES_NULLS(zvoRadianceCacheAddress);
    REFUSES_NULLS(zvoRadianceCacheForget);
    REFUSES_NULLS(zvoRadianceCacheStats);
    REFUSES_NULLS(zvoRadianceCacheBytes);
    REFUSES_NULLS(zvoLatticePosition);
    REFUSES_NULLS(zvoQueryBatchIsDone);
    REFUSES_NULLS(zvoQueryBatchAnswers);
    REFUSES_NULLS(zvoCameraLookAt);
    REFUSES_NULLS(zvoCameraOfMatrices);
    REFUSES_NULLS(zvoCameraRays);
    host.frame(
        [&](ZvoRecorder* recorder)
        {
            handle<ZvoRecorder>() = recorder;
            REFUSES_NULLS(zvoRecorderMakeVisible);
            REFUSES_NULLS(zvoModelCreate);
            REFUSES_NULLS(zvoTreeFromFile);
            REFUSES_NULLS(zvoTreeFromMemory);
            REFUSES_NULLS(zvoTreeJobRecord);
            REFUSES_NULLS(zvoDynamicTreeCreate);
            REFUSES_NULLS(zvoDynamicTreeAddObject);
            REFUSES_NULLS(zvoDynamicTreeAddObjectWith);
            REFUSES_NULLS(zvoDynamicTreeUpdate);
            REFUSES_NULLS(zvoDynamicTreeUndo);
            REFUSES_NULLS(zvoDynamicTreeRedo);
            REFUSES_NULLS(zvoDynamicTreeEdit);
            REFUSES_NULLS(zvoDynamicTreeStamp);
            REFUSES_NULLS(zvoDynamicTreeUndoEdit);
            REFUSES_NULLS(zvoDynamicTreeRedoEdit);
            REFUSES_NULLS(zvoTracerTrace, {6});
            REFUSES_NULLS(zvoTracerTraceDynamic, {6});
            REFUSES_NULLS(zvoTracerTracePaths);
            REFUSES_NULLS(zvoTracerTracePathsDynamic);
            REFUSES_NULLS(zvoTracerTraceCached);
            REFUSES_NULLS(zvoTracerTraceCachedDynamic);
            REFUSES_NULLS(zvoRadianceCacheUpdate);
            REFUSES_NULLS(zvoRadianceCacheUpdateDynamic);
            REFUSES_NULLS(zvoQueryBatchCreate);
            REFUSES_NULLS(zvoQueryBatchCreateDynamic);
            REFUSES_NULLS(zvoEnvironmentCreate, {1});
        });
#undef REFUSES_NULLS
    EXPECT_GT(pointers, 150U);
    for (const void* const made :
         {static_cast<const void*>(*given<ZvoDeviceReport**>()), static_cast<const void*>(*given<ZvoContext**>()),
          static_cast<const void*>(*given<ZvoRecorder**>()), static_cast<const void*>(*given<ZvoModel**>()),
          static_cast<const void*>(*given<ZvoTree**>()), static_cast<const void*>(*given<ZvoTreeJob**>()),
          static_cast<const void*>(*given<ZvoDynamicTree**>()), static_cast<const void*>(*given<ZvoEnvironment**>()),
          static_cast<const void*>(*given<ZvoTracer**>()), static_cast<const void*>(*given<ZvoRadianceCache**>()),
          static_cast<const void*>(*given<ZvoQueryBatch**>())})
    {
        EXPECT_EQ(made, nullptr); // a failure leaves its results unchanged
    }
    zvoTracerDestroy(handle<ZvoTracer>());
    zvoRadianceCacheDestroy(handle<ZvoRadianceCache>());
    zvoQueryBatchDestroy(handle<ZvoQueryBatch>());
    zvoKernelPreparationDestroy(handle<ZvoKernelPreparation>());
    zvoEnvironmentDestroy(handle<ZvoEnvironment>());
    zvoDynamicTreeDestroy(handle<ZvoDynamicTree>());
    zvoTreeJobDestroy(handle<ZvoTreeJob>());
    zvoFeatureStorageDestroy(handle<ZvoFeatureStorage>());
    zvoTreeDestroy(handle<ZvoTree>());
    zvoModelDestroy(model);
}

TEST(CStructs, DestroyingNullDoesNothing)
{
    zvoDeviceReportDestroy(nullptr);
    zvoFeatureStorageDestroy(nullptr);
    zvoContextDestroy(nullptr);
    zvoRecorderEnd(nullptr);
    zvoModelDestroy(nullptr);
    zvoTreeDestroy(nullptr);
    zvoTreeJobDestroy(nullptr);
    zvoDynamicTreeDestroy(nullptr);
    zvoEnvironmentDestroy(nullptr);
    zvoTracerDestroy(nullptr);
    zvoRadianceCacheDestroy(nullptr);
    zvoQueryBatchDestroy(nullptr);
    zvoKernelPreparationDestroy(nullptr);
}

} // namespace

} // namespace zvo
