// SPDX-License-Identifier: MIT
// The C interface refuses counts that no memory has, values that no enumeration has, and null pointers.
#include "api/c_convert.h"
#include "api/c_struct.h"
#include "c_host.h"
#include "expect_usage.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>

namespace zvo
{

namespace
{

using test::expectUsage;

TEST(CStructs, CountsThatNoMemoryHasAreRefused)
{
    const float floats[12] = {};
    const std::uint32_t vertices[3] = {};
    auto mesh = initial<ZvoMeshInfo>();
    mesh.positions = floats;
    mesh.vertex_count = 3;
    mesh.triangles = vertices;
    mesh.triangle_count = std::size_t{1} << 62;
    expectUsage([&] { ofC(mesh); }, "ZvoMeshInfo::triangles has more elements");
    mesh.triangle_count = 1;
    mesh.vertex_count = SIZE_MAX;
    expectUsage([&] { ofC(mesh); }, "ZvoMeshInfo::positions has more elements");
    mesh.vertex_count = 3;
    auto model = initial<ZvoModelInfo>();
    model.meshes = &mesh;
    model.mesh_count = std::size_t{1} << 62;
    expectUsage([&] { ModelOfC{model}; }, "ZvoModelInfo::meshes has more elements");
    auto map = initial<ZvoEnvironmentMapInfo>();
    map.texels = floats;
    map.width = map.height = UINT32_MAX;
    expectUsage([&] { ofC(map); }, "ZvoEnvironmentMapInfo::texels has more elements");
}

TEST(CStructs, ValuesThatNoEnumerationHasAreRefused)
{
    const auto refuses = [](auto info, std::uint32_t decltype(info)::*member, std::uint32_t count, const char* name)
    {
        for (std::uint32_t value = 0; value < count; ++value)
        {
            info.*member = value;
            EXPECT_NO_THROW(ofC(info)) << name << " " << value;
        }
        for (const std::uint32_t value : {count, UINT32_MAX})
        {
            info.*member = value;
            expectUsage([&] { ofC(info); }, name);
        }
    };
    refuses(initial<ZvoTextureInfo>(), &ZvoTextureInfo::wrap_u, 3, "ZvoTextureInfo::wrap_u");
    refuses(initial<ZvoTextureInfo>(), &ZvoTextureInfo::wrap_v, 3, "ZvoTextureInfo::wrap_v");
    refuses(initial<ZvoMaterialInfo>(), &ZvoMaterialInfo::alpha_mode, 3, "ZvoMaterialInfo::alpha_mode");
    refuses(initial<ZvoTreeBuildInfo>(), &ZvoTreeBuildInfo::coverage, 2, "ZvoTreeBuildInfo::coverage");
    refuses(initial<ZvoTreeBuildInfo>(), &ZvoTreeBuildInfo::format, 4, "ZvoTreeBuildInfo::format");
    refuses(initial<ZvoDynamicTreeInfo>(), &ZvoDynamicTreeInfo::coverage, 2, "ZvoDynamicTreeInfo::coverage");
    refuses(initial<ZvoDynamicTreeInfo>(), &ZvoDynamicTreeInfo::merge, 3, "ZvoDynamicTreeInfo::merge");
    refuses(initial<ZvoBrushInfo>(), &ZvoBrushInfo::shape, 2, "ZvoBrushInfo::shape");
    refuses(initial<ZvoBrushInfo>(), &ZvoBrushInfo::action, 3, "ZvoBrushInfo::action");
    refuses(initial<ZvoTraceInfo>(), &ZvoTraceInfo::view, 9, "ZvoTraceInfo::view");
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
    expectUsage([] { ofC(initial<ZvoDepthTarget>()); }, "ZvoDepthTarget::image is null");
    ZvoEnvironmentMapInfo map = ZVO_ENVIRONMENT_MAP_INFO_INIT;
    map.width = map.height = 1;
    expectUsage([&] { ofC(map); }, "ZvoEnvironmentMapInfo::texels is null");
}

// Calls a function with each of its pointers null in turn and the others as given, and expects Usage. Arguments that
// are no pointers stay. Returns the number of pointers.
template <typename... Parameters, std::size_t... kIndices>
int refusesNulls(ZvoResult (*function)(Parameters...), std::index_sequence<kIndices...>, const char* name,
                 Parameters... arguments)
{
    int count = 0;
    const auto without = [&](std::size_t index)
    {
        const auto kept = [&](std::size_t own, auto argument)
        {
            if constexpr (std::is_pointer_v<decltype(argument)>)
            {
                count += own == index ? 1 : 0;
                return own == index ? nullptr : argument;
            }
            return argument;
        };
        const int before = count;
        const std::tuple<Parameters...> changed(kept(kIndices, arguments)...);
        if (count != before)
        {
            EXPECT_EQ(std::apply(function, changed), ZVO_ERROR_USAGE) << name << " without argument " << index;
            EXPECT_EQ(std::string(zvoLastError()).find(std::string(name) + ": "), 0U) << zvoLastError();
            EXPECT_NE(std::string(zvoLastError()).find("null"), std::string::npos) << zvoLastError();
        }
    };
    (without(kIndices), ...);
    return count;
}

#define REFUSES_NULLS(function, ...)                                                                                   \
    pointers += [&]<typename... Parameters>(ZvoResult (*called)(Parameters...)) {                                      \
        return refusesNulls<Parameters...>(called, std::index_sequence_for<Parameters...>(), #function, __VA_ARGS__);  \
    }(&function)

TEST(CStructs, PointersThatAreNullAreRefused)
{
    test::CEmbeddingHost host;
    ZvoModel* model = host.uploadBox();
    ZvoTreeBuildInfo build_info = ZVO_TREE_BUILD_INFO_INIT;
    build_info.grid = {{-2, -2, -2}, 1, 4};
    ZvoTree* tree = host.build(model, build_info);
    ZvoTree* taken = host.build(model, build_info);
    const ZvoDynamicTreeInfo dynamic_info = ZVO_DYNAMIC_TREE_INFO_INIT;
    ZvoDynamicTree* dynamic = nullptr;
    ZvoEnvironment* environment = nullptr;
    ZvoTracer* tracer = nullptr;
    ZvoTreeBuild* build = nullptr;
    ZvoTreeCompression* compression = nullptr;
    ZvoFeatureStorage* storage = nullptr;
    const ZvoDeviceReport* report = nullptr;
    ASSERT_EQ(zvoContextReport(host.context, &report), ZVO_OK);
    ASSERT_EQ(zvoFeatureStorageCreate(&storage), ZVO_OK);
    ASSERT_EQ(zvoTreeBuildCreate(host.context, model, &build_info, &build), ZVO_OK);
    ASSERT_EQ(zvoTracerCreate(host.context, 8, 8, VK_FORMAT_R8G8B8A8_UNORM, &tracer), ZVO_OK);
    host.frame(
        [&](ZvoRecorder* recorder)
        {
            ASSERT_EQ(zvoDynamicTreeCreate(recorder, taken, &dynamic_info, &dynamic), ZVO_OK);
            ASSERT_EQ(zvoEnvironmentCreate(recorder, nullptr, &environment), ZVO_OK);
        });
    taken = host.build(model, build_info);
    ASSERT_EQ(zvoTreeCompressionCreate(host.context, taken, &compression), ZVO_OK);

    int pointers = 0;
    ZvoDeviceReport* made_report = nullptr;
    ZvoDeviceInfo device_info = ZVO_DEVICE_INFO_INIT;
    const char* text = nullptr;
    VkDeviceCreateInfo create_info{};
    ZvoContext* made_context = nullptr;
    ZvoMemoryUse use = ZVO_MEMORY_USE_INIT;
    std::uint32_t count = 0;
    ZvoRecorder* made_recorder = nullptr;
    ZvoModelStats model_stats = ZVO_MODEL_STATS_INIT;
    ZvoTreeInfo tree_info = ZVO_TREE_INFO_INIT;
    ZvoUpdateStats update_stats = ZVO_UPDATE_STATS_INIT;
    ZvoDroppedTriangles dropped = ZVO_DROPPED_TRIANGLES_INIT;
    ZvoGrid grid = ZVO_GRID_INIT;
    std::uint64_t address = 0;
    VkBool32 flag = VK_FALSE;
    ZvoTree* made_tree = nullptr;
    ZvoTreeBuild* made_build = nullptr;
    ZvoTreeCompression* made_compression = nullptr;
    ZvoDynamicTree* made_dynamic = nullptr;
    ZvoTracer* made_tracer = nullptr;
    ZvoModel* made_model = nullptr;
    ZvoDynamicObjectId object = 0;
    const ZvoInstanceInfo instance = ZVO_INSTANCE_INFO_INIT;
    const float* const place = instance.transform;
    const double eye[3] = {1, 2, 3};
    ZvoCameraInfo camera = ZVO_CAMERA_INFO_INIT;
    ZvoCameraRays rays{};
    const ZvoBrushInfo brush = ZVO_BRUSH_INFO_INIT;
    const ZvoModelInfo model_info = ZVO_MODEL_INFO_INIT;
    const ZvoTraceInfo trace_info = ZVO_TRACE_INFO_INIT;
    const ZvoPathInfo path_info = ZVO_PATH_INFO_INIT;
    const ZvoSunInfo sun = ZVO_SUN_INFO_INIT;
    const ZvoKeptLightInfo kept_info = ZVO_KEPT_LIGHT_INFO_INIT;
    const ZvoKeptFrameInfo kept_frame = ZVO_KEPT_FRAME_INFO_INIT;
    const ZvoKeptPictureInfo kept_picture = ZVO_KEPT_PICTURE_INFO_INIT;
    ZvoKeptLightStats kept_stats = ZVO_KEPT_LIGHT_STATS_INIT;
    ZvoKeptLight* light = nullptr;
    ZvoKeptLight* made_light = nullptr;
    ASSERT_EQ(zvoKeptLightCreate(host.context, &kept_info, &light), ZVO_OK);
    const ZvoImageTarget color = host.target();
    REFUSES_NULLS(zvoQuery, host.info.get_instance_proc_addr, host.info.instance, host.info.physical_device,
                  &made_report);
    REFUSES_NULLS(zvoDeviceReportInfo, report, &device_info);
    REFUSES_NULLS(zvoDeviceReportText, report, ZVO_REPORT_PRESENT, 0, &text);
    REFUSES_NULLS(zvoFeatureStorageCreate, &storage);
    EXPECT_EQ(zvoPatchFeatures(nullptr, storage, nullptr), ZVO_ERROR_USAGE);
    EXPECT_EQ(zvoPatchFeatures(&create_info, nullptr, nullptr), ZVO_ERROR_USAGE);
    REFUSES_NULLS(zvoContextCreate, &host.info, &made_context);
    REFUSES_NULLS(zvoContextFrameDone, host.context, 0);
    REFUSES_NULLS(zvoContextFrameLost, host.context, 1);
    REFUSES_NULLS(zvoContextMemory, host.context, &use);
    REFUSES_NULLS(zvoContextPassTimeCount, host.context, &count);
    EXPECT_EQ(zvoContextPassTime(nullptr, 0, nullptr), ZVO_ERROR_USAGE);
    REFUSES_NULLS(zvoContextReport, host.context, &report);
    REFUSES_NULLS(zvoRecorderBegin, host.context, host.device.begin(), 1000, 0, &made_recorder);
    REFUSES_NULLS(zvoModelStats, model, &model_stats);
    REFUSES_NULLS(zvoModelGridAround, model, 4, &grid);
    REFUSES_NULLS(zvoTreeInfo, tree, &tree_info);
    REFUSES_NULLS(zvoTreeAddress, tree, &address);
    REFUSES_NULLS(zvoTreeBuildCreate, host.context, model, &build_info, &made_build);
    REFUSES_NULLS(zvoTreeBuildIsDone, build, &flag);
    REFUSES_NULLS(zvoTreeBuildIsBroken, build, &flag);
    REFUSES_NULLS(zvoTreeBuildTake, build, &made_tree);
    REFUSES_NULLS(zvoTreeBuildDropped, build, &dropped);
    REFUSES_NULLS(zvoTreeCompressionCreate, host.context, tree, &made_compression);
    REFUSES_NULLS(zvoTreeCompressionIsDone, compression, &flag);
    REFUSES_NULLS(zvoTreeCompressionIsBroken, compression, &flag);
    REFUSES_NULLS(zvoTreeCompressionTake, compression, &made_tree);
    REFUSES_NULLS(zvoDynamicTreeSetTransform, dynamic, 0, place);
    REFUSES_NULLS(zvoDynamicTreeRemoveObject, dynamic, 0);
    REFUSES_NULLS(zvoDynamicTreeNeedsUpdate, dynamic, &flag);
    REFUSES_NULLS(zvoDynamicTreeEndStroke, dynamic);
    REFUSES_NULLS(zvoDynamicTreeTakeUpdate, dynamic, &update_stats, &flag);
    REFUSES_NULLS(zvoDynamicTreeInfo, dynamic, &tree_info);
    REFUSES_NULLS(zvoDynamicTreeAddress, dynamic, &address);
    REFUSES_NULLS(zvoTracerCreate, host.context, 8, 8, VK_FORMAT_R8G8B8A8_UNORM, &made_tracer);
    REFUSES_NULLS(zvoTracerSampleCount, tracer, &count);
    REFUSES_NULLS(zvoTracerForgetSamples, tracer);
    REFUSES_NULLS(zvoEnvironmentSetSun, environment, &sun);
    REFUSES_NULLS(zvoKeptLightCreate, host.context, &kept_info, &made_light);
    REFUSES_NULLS(zvoKeptLightAddress, light, &address);
    REFUSES_NULLS(zvoKeptLightForget, light);
    REFUSES_NULLS(zvoKeptLightStats, light, &kept_stats);
    REFUSES_NULLS(zvoKeptLightBytes, light, &address);
    REFUSES_NULLS(zvoCameraLookAt, eye, eye, 0.5, &camera);
    REFUSES_NULLS(zvoCameraRays, &camera, &grid, 8, &rays);
    host.frame(
        [&](ZvoRecorder* recorder)
        {
            REFUSES_NULLS(zvoRecorderMakeVisible, recorder, 0);
            REFUSES_NULLS(zvoModelCreate, recorder, &model_info, &made_model);
            REFUSES_NULLS(zvoTreeFromFile, recorder, "none", &made_tree);
            REFUSES_NULLS(zvoTreeFromMemory, recorder, eye, 4, &made_tree);
            REFUSES_NULLS(zvoTreeBuildRecord, build, recorder, &flag);
            REFUSES_NULLS(zvoTreeCompressionRecord, compression, recorder, &flag);
            REFUSES_NULLS(zvoDynamicTreeCreate, recorder, tree, &dynamic_info, &made_dynamic);
            REFUSES_NULLS(zvoDynamicTreeAddObject, dynamic, recorder, model, place, &object);
            REFUSES_NULLS(zvoDynamicTreeUpdate, dynamic, recorder, 0, &flag);
            REFUSES_NULLS(zvoDynamicTreeUndo, dynamic, recorder, &flag);
            REFUSES_NULLS(zvoDynamicTreeRedo, dynamic, recorder, &flag);
            REFUSES_NULLS(zvoDynamicTreeEdit, dynamic, recorder, &brush, &flag);
            REFUSES_NULLS(zvoDynamicTreeUndoEdit, dynamic, recorder, &flag);
            REFUSES_NULLS(zvoDynamicTreeRedoEdit, dynamic, recorder, &flag);
            REFUSES_NULLS(zvoTracerTracePaths, tracer, recorder, tree, environment, &camera, &path_info, &color);
            REFUSES_NULLS(zvoTracerTracePathsDynamic, tracer, recorder, dynamic, environment, &camera, &path_info,
                          &color);
            REFUSES_NULLS(zvoKeptLightUpdate, light, recorder, tree, environment, &camera, &kept_frame);
            REFUSES_NULLS(zvoKeptLightUpdateDynamic, light, recorder, dynamic, environment, &camera, &kept_frame);
            REFUSES_NULLS(zvoTracerTraceKept, tracer, recorder, tree, environment, light, &camera, &kept_picture,
                          &color);
            REFUSES_NULLS(zvoTracerTraceKeptDynamic, tracer, recorder, dynamic, environment, light, &camera,
                          &kept_picture, &color);
            EXPECT_EQ(zvoEnvironmentCreate(nullptr, nullptr, &environment), ZVO_ERROR_USAGE);
            EXPECT_EQ(zvoEnvironmentCreate(recorder, nullptr, nullptr), ZVO_ERROR_USAGE);
            for (int missing = 0; missing < 6; ++missing)
            {
                const auto given = [&](int index, auto* pointer) { return index == missing ? nullptr : pointer; };
                EXPECT_EQ(zvoTracerTrace(given(0, tracer), given(1, recorder), given(2, tree), given(3, &camera),
                                         given(4, &trace_info), given(5, &color), nullptr),
                          ZVO_ERROR_USAGE);
                EXPECT_EQ(zvoTracerTraceDynamic(given(0, tracer), given(1, recorder), given(2, dynamic),
                                                given(3, &camera), given(4, &trace_info), given(5, &color), nullptr),
                          ZVO_ERROR_USAGE);
            }
        });
    EXPECT_GT(pointers, 100);
    for (const void* const made : {static_cast<const void*>(made_report), static_cast<const void*>(made_context),
                                   static_cast<const void*>(made_recorder), static_cast<const void*>(made_model),
                                   static_cast<const void*>(made_tree), static_cast<const void*>(made_build),
                                   static_cast<const void*>(made_compression), static_cast<const void*>(made_dynamic),
                                   static_cast<const void*>(made_tracer), static_cast<const void*>(made_light)})
    {
        EXPECT_EQ(made, nullptr); // a failure leaves its results unchanged
    }
    zvoDeviceReportDestroy(nullptr);
    zvoContextDestroy(nullptr);
    zvoTracerDestroy(tracer);
    zvoKeptLightDestroy(light);
    zvoKeptLightDestroy(nullptr);
    zvoEnvironmentDestroy(environment);
    zvoDynamicTreeDestroy(dynamic);
    zvoTreeCompressionDestroy(compression);
    zvoTreeBuildDestroy(build);
    zvoFeatureStorageDestroy(storage);
    zvoTreeDestroy(tree);
    zvoModelDestroy(model);
}

} // namespace

} // namespace zvo
