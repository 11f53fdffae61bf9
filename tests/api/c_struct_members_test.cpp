// SPDX-License-Identifier: MIT
// The C interface's structs: every member and every default is passed on.
#include "api/c_convert.h"
#include "api/c_struct.h"

#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>

namespace zvo
{

namespace
{

// Compares two structs of the C++ interface field by field.

void expectSame(const ContextInfo& a, const ContextInfo& b)
{
    EXPECT_EQ(a.get_instance_proc_addr, b.get_instance_proc_addr);
    EXPECT_EQ(a.instance, b.instance);
    EXPECT_EQ(a.physical_device, b.physical_device);
    EXPECT_EQ(a.device, b.device);
    EXPECT_EQ(a.queue_family, b.queue_family);
    EXPECT_EQ(a.instance_api_version, b.instance_api_version);
    EXPECT_EQ(a.instance_extensions.data(), b.instance_extensions.data());
    EXPECT_EQ(a.instance_extensions.size(), b.instance_extensions.size());
    EXPECT_EQ(a.device_extensions.data(), b.device_extensions.data());
    EXPECT_EQ(a.device_extensions.size(), b.device_extensions.size());
    EXPECT_EQ(a.enabled_features, b.enabled_features);
    EXPECT_EQ(a.enabled_core_features, b.enabled_core_features);
    EXPECT_EQ(a.allocation_callbacks, b.allocation_callbacks);
    EXPECT_EQ(a.pipeline_cache, b.pipeline_cache);
    EXPECT_EQ(a.memory.user, b.memory.user);
    EXPECT_EQ(a.memory.allocate, b.memory.allocate);
    EXPECT_EQ(a.memory.release, b.memory.release);
    EXPECT_EQ(a.memory_budget_bytes, b.memory_budget_bytes);
    EXPECT_EQ(a.log.function, b.log.function);
    EXPECT_EQ(a.log.user, b.log.user);
    EXPECT_EQ(a.timed_passes_per_frame, b.timed_passes_per_frame);
    EXPECT_EQ(a.subgroup_size, b.subgroup_size);
    EXPECT_EQ(a.tuning, b.tuning);
}

void expectSame(const GridInfo& a, const GridInfo& b)
{
    EXPECT_EQ(a.origin, b.origin);
    EXPECT_EQ(a.voxel_size, b.voxel_size);
    EXPECT_EQ(a.depth, b.depth);
}

void expectSame(const MaterialInfo& a, const MaterialInfo& b)
{
    EXPECT_EQ(a.base_color, b.base_color);
    EXPECT_EQ(a.base_color_texture, b.base_color_texture);
    EXPECT_EQ(a.emission, b.emission);
    EXPECT_EQ(a.emission_texture, b.emission_texture);
    EXPECT_EQ(a.alpha_mode, b.alpha_mode);
    EXPECT_EQ(a.alpha_cutoff, b.alpha_cutoff);
}

void expectSame(const TextureInfo& a, const TextureInfo& b)
{
    EXPECT_EQ(a.width, b.width);
    EXPECT_EQ(a.height, b.height);
    EXPECT_EQ(a.rgba.data(), b.rgba.data());
    EXPECT_EQ(a.rgba.size(), b.rgba.size());
    EXPECT_EQ(a.wrap_u, b.wrap_u);
    EXPECT_EQ(a.wrap_v, b.wrap_v);
}

template <typename Element> void expectSame(std::span<Element> a, std::span<Element> b)
{
    EXPECT_EQ(a.data(), b.data());
    EXPECT_EQ(a.size(), b.size());
}

void expectSame(const MeshInfo& a, const MeshInfo& b)
{
    expectSame(a.positions, b.positions);
    expectSame(a.normals, b.normals);
    expectSame(a.uvs, b.uvs);
    expectSame(a.colors, b.colors);
    expectSame(a.triangles, b.triangles);
    EXPECT_EQ(a.material, b.material);
}

void expectSame(const InstanceInfo& a, const InstanceInfo& b)
{
    EXPECT_EQ(a.mesh, b.mesh);
    EXPECT_EQ(a.transform, b.transform);
}

void expectSame(const TreeBuildInfo& a, const TreeBuildInfo& b)
{
    expectSame(a.grid, b.grid);
    EXPECT_EQ(a.coverage, b.coverage);
    EXPECT_EQ(a.format, b.format);
    EXPECT_EQ(a.keep_sums, b.keep_sums);
}

void expectSame(const DynamicTreeInfo& a, const DynamicTreeInfo& b)
{
    EXPECT_EQ(a.coverage, b.coverage);
    EXPECT_EQ(a.merge, b.merge);
    EXPECT_EQ(a.frames_in_flight, b.frames_in_flight);
    EXPECT_EQ(a.history_entries, b.history_entries);
    EXPECT_EQ(a.history_bytes, b.history_bytes);
    EXPECT_EQ(a.strokes, b.strokes);
    EXPECT_EQ(a.edit_bytes, b.edit_bytes);
    EXPECT_EQ(a.emission_scale, b.emission_scale);
}

void expectSame(const BrushInfo& a, const BrushInfo& b)
{
    EXPECT_EQ(a.shape, b.shape);
    EXPECT_EQ(a.action, b.action);
    EXPECT_EQ(a.center, b.center);
    EXPECT_EQ(a.radius, b.radius);
    EXPECT_EQ(a.color, b.color);
}

void expectSame(const CameraInfo& a, const CameraInfo& b)
{
    EXPECT_EQ(a.position, b.position);
    EXPECT_EQ(a.forward, b.forward);
    EXPECT_EQ(a.up, b.up);
    EXPECT_EQ(a.orthographic, b.orthographic);
    EXPECT_EQ(a.vertical_fov, b.vertical_fov);
    EXPECT_EQ(a.half_height, b.half_height);
}

void expectSame(const TraceInfo& a, const TraceInfo& b)
{
    EXPECT_EQ(a.view, b.view);
    EXPECT_EQ(a.shadows, b.shadows);
    EXPECT_EQ(a.to_sun, b.to_sun);
    EXPECT_EQ(a.sun, b.sun);
    EXPECT_EQ(a.exposure, b.exposure);
    EXPECT_EQ(a.occlusion_rays, b.occlusion_rays);
    EXPECT_EQ(a.occlusion_reach, b.occlusion_reach);
    EXPECT_EQ(a.detail_pixels, b.detail_pixels);
}

void expectSame(const SunInfo& a, const SunInfo& b)
{
    EXPECT_EQ(a.direction, b.direction);
    EXPECT_EQ(a.irradiance, b.irradiance);
}

void expectSame(const EnvironmentMapInfo& a, const EnvironmentMapInfo& b)
{
    expectSame(a.texels, b.texels);
    EXPECT_EQ(a.width, b.width);
    EXPECT_EQ(a.height, b.height);
    EXPECT_EQ(a.turn, b.turn);
    EXPECT_EQ(a.strength, b.strength);
}

void expectSame(const PathInfo& a, const PathInfo& b)
{
    EXPECT_EQ(a.bounces, b.bounces);
    EXPECT_EQ(a.seed, b.seed);
    EXPECT_EQ(a.lens_radius, b.lens_radius);
    EXPECT_EQ(a.focus_distance, b.focus_distance);
    EXPECT_EQ(a.roulette, b.roulette);
    EXPECT_EQ(a.automatic_exposure, b.automatic_exposure);
    EXPECT_EQ(a.exposure, b.exposure);
    EXPECT_EQ(a.samples, b.samples);
    EXPECT_EQ(a.denoise, b.denoise);
    EXPECT_EQ(a.history_max, b.history_max);
}

void expectSame(const KeptLightInfo& a, const KeptLightInfo& b)
{
    EXPECT_EQ(a.width, b.width);
    EXPECT_EQ(a.height, b.height);
    EXPECT_EQ(a.faces, b.faces);
}

void expectSame(const KeptFrameInfo& a, const KeptFrameInfo& b)
{
    EXPECT_EQ(a.rays, b.rays);
    EXPECT_EQ(a.seed, b.seed);
}

void expectSame(const ImageTarget& a, const ImageTarget& b)
{
    EXPECT_EQ(a.image, b.image);
    EXPECT_EQ(a.format, b.format);
    EXPECT_EQ(a.layout, b.layout);
    EXPECT_EQ(a.offset.x, b.offset.x);
    EXPECT_EQ(a.offset.y, b.offset.y);
    EXPECT_EQ(a.mip_level, b.mip_level);
    EXPECT_EQ(a.array_layer, b.array_layer);
    EXPECT_EQ(a.extent.width, b.extent.width);
    EXPECT_EQ(a.extent.height, b.extent.height);
}

TEST(CStructs, DefaultsAreThoseOfTheCppInterface)
{
    expectSame(ofC(initial<ZvoContextInfo>()), ContextInfo());
    expectSame(ofC(ZvoGrid ZVO_GRID_INIT), GridInfo());
    expectSame(ofC(initial<ZvoMaterialInfo>()), MaterialInfo());
    expectSame(ofC(initial<ZvoTextureInfo>()), TextureInfo());
    expectSame(ofC(initial<ZvoMeshInfo>()), MeshInfo());
    expectSame(ofC(initial<ZvoInstanceInfo>()), InstanceInfo());
    expectSame(ofC(initial<ZvoTreeBuildInfo>()), TreeBuildInfo());
    expectSame(ofC(initial<ZvoDynamicTreeInfo>()), DynamicTreeInfo());
    expectSame(ofC(initial<ZvoBrushInfo>()), BrushInfo());
    expectSame(ofC(initial<ZvoSunInfo>()), SunInfo());
    expectSame(ofC(initial<ZvoEnvironmentMapInfo>()), EnvironmentMapInfo());
    expectSame(ofC(initial<ZvoCameraInfo>()), CameraInfo());
    expectSame(ofC(initial<ZvoTraceInfo>()), TraceInfo());
    expectSame(ofC(initial<ZvoPathInfo>()), PathInfo());
    expectSame(ofC(initial<ZvoImageTarget>()), ImageTarget());
    expectSame(ofC(initial<ZvoKeptLightInfo>()), KeptLightInfo());
    expectSame(ofC(initial<ZvoKeptFrameInfo>()), KeptFrameInfo());
    EXPECT_EQ(ofC(initial<ZvoKeptPictureInfo>()).automatic_exposure, KeptPictureInfo().automatic_exposure);
    EXPECT_EQ(ofC(initial<ZvoKeptPictureInfo>()).exposure, KeptPictureInfo().exposure);
    EXPECT_EQ(ofC(initial<ZvoOptionalFeatures>()).pass_times, OptionalFeatures().pass_times);
    EXPECT_EQ(ofC(initial<ZvoOptionalFeatures>()).subgroup_sizes, OptionalFeatures().subgroup_sizes);
    EXPECT_EQ(ofC(initial<ZvoOptionalFeatures>()).int64_atomics, OptionalFeatures().int64_atomics);
    const ZvoImageTarget image = ZVO_IMAGE_TARGET_INIT;
    auto depth = initial<ZvoDepthTarget>();
    depth.image = &image;
    EXPECT_EQ(ofC(depth).view_projection, DepthTarget().view_projection);
    EXPECT_EQ(ofC(depth).miss, DepthTarget().miss);
    const ModelOfC model(initial<ZvoModelInfo>());
    EXPECT_TRUE(model.info().meshes.empty() && model.info().instances.empty());
    EXPECT_TRUE(model.info().materials.empty() && model.info().textures.empty());
    EXPECT_EQ(model.info().attributes, ModelInfo().attributes);
    EXPECT_EQ(model.info().emission_scale, ModelInfo().emission_scale);
}

// Pointers that are never read.
template <typename Type> Type handle(std::uintptr_t number)
{
    return reinterpret_cast<Type>(number);
}

TEST(CStructs, EveryMemberOfKeptLightIsPassedOn)
{
    ZvoKeptLightInfo info = ZVO_KEPT_LIGHT_INFO_INIT;
    info.faces = std::uint64_t{1} << 30;
    info.width = 7;
    info.height = 9;
    expectSame(ofC(info), {7, 9, std::uint64_t{1} << 30});
    ZvoKeptFrameInfo frame = ZVO_KEPT_FRAME_INFO_INIT;
    frame.rays = 5;
    frame.seed = 6;
    expectSame(ofC(frame), {5, 6});
    ZvoKeptPictureInfo picture = ZVO_KEPT_PICTURE_INFO_INIT;
    picture.automatic_exposure = VK_FALSE;
    picture.exposure = 2;
    EXPECT_FALSE(ofC(picture).automatic_exposure);
    EXPECT_EQ(ofC(picture).exposure, 2.0F);
    const ZvoKeptLightStats stats = toC(KeptLightStats{3, 4});
    EXPECT_EQ(stats.faces, 3U);
    EXPECT_EQ(stats.refused, 4U);
}

TEST(CStructs, EveryMemberOfADeclarationIsPassedOn)
{
    const char* const instance_extensions[] = {"a", "b"};
    const char* const device_extensions[] = {"c"};
    const VkPhysicalDeviceFeatures core{};
    const VkAllocationCallbacks callbacks{};
    const auto function = handle<PFN_vkGetInstanceProcAddr>(8);
    const ZvoContextInfo c = {sizeof(c),
                              function,
                              handle<VkInstance>(16),
                              handle<VkPhysicalDevice>(24),
                              handle<VkDevice>(32),
                              3,
                              VK_API_VERSION_1_3,
                              instance_extensions,
                              device_extensions,
                              2,
                              1,
                              &callbacks,
                              &core,
                              &callbacks,
                              handle<VkPipelineCache>(40),
                              {},
                              77,
                              {},
                              5,
                              8,
                              "path-form=stages"};
    ContextInfo cpp;
    cpp.get_instance_proc_addr = function;
    cpp.instance = c.instance;
    cpp.physical_device = c.physical_device;
    cpp.device = c.device;
    cpp.queue_family = 3;
    cpp.instance_api_version = VK_API_VERSION_1_3;
    cpp.instance_extensions = instance_extensions;
    cpp.device_extensions = device_extensions;
    cpp.enabled_features = &callbacks;
    cpp.enabled_core_features = &core;
    cpp.allocation_callbacks = &callbacks;
    cpp.pipeline_cache = c.pipeline_cache;
    cpp.memory_budget_bytes = 77;
    cpp.timed_passes_per_frame = 5;
    cpp.subgroup_size = 8;
    cpp.tuning = "path-form=stages";
    expectSame(ofC(c), cpp);
}

TEST(CStructs, EveryMemberOfAModelIsPassedOn)
{
    const float floats[8] = {};
    const std::uint32_t vertices[6] = {};
    const std::uint8_t rgba[8] = {};
    const auto vec2 = reinterpret_cast<const Vec2*>(floats);
    const auto vec3 = reinterpret_cast<const Vec3*>(floats);
    const auto vec4 = reinterpret_cast<const Vec4*>(floats);
    const auto triangles = reinterpret_cast<const std::array<std::uint32_t, 3>*>(vertices);
    const ZvoMeshInfo meshes[] = {{sizeof(ZvoMeshInfo), floats, floats, floats, floats, 2, vertices, 1, 6, 0},
                                  {sizeof(ZvoMeshInfo), floats, nullptr, nullptr, nullptr, 1, vertices, 2, 7, 0}};
    ZvoInstanceInfo instance = ZVO_INSTANCE_INFO_INIT;
    InstanceInfo cpp_instance;
    for (std::size_t i = 0; i < 16; ++i)
    {
        instance.transform[i] = cpp_instance.transform[i] = static_cast<float>(i) + 0.5F;
    }
    instance.mesh = cpp_instance.mesh = 1;
    const ZvoMaterialInfo material = {sizeof(material), {1, 2, 3, 4}, 5, {6, 7, 8}, 9, ZVO_ALPHA_MODE_MASK, 0.25F, 0};
    const ZvoTextureInfo texture = {
        sizeof(texture), rgba, 8, 2, 1, ZVO_WRAP_MODE_CLAMP_TO_EDGE, ZVO_WRAP_MODE_MIRRORED_REPEAT};
    const ZvoModelInfo c = {sizeof(c), meshes, &instance, &material, &texture, 2, 1, 1, 1, VK_FALSE, 0};
    const ModelOfC model(c);
    const ModelInfo& info = model.info();
    ASSERT_EQ(info.meshes.size(), 2U);
    expectSame(info.meshes[0], MeshInfo{{vec3, 2}, {vec3, 2}, {vec2, 2}, {vec4, 2}, {triangles, 1}, 6});
    expectSame(info.meshes[1], MeshInfo{{vec3, 1}, {}, {}, {}, {triangles, 2}, 7});
    ASSERT_EQ(info.instances.size(), 1U);
    expectSame(info.instances[0], cpp_instance);
    ASSERT_EQ(info.materials.size(), 1U);
    expectSame(info.materials[0], MaterialInfo{{1, 2, 3, 4}, 5, {6, 7, 8}, 9, AlphaMode::Mask, 0.25F});
    ASSERT_EQ(info.textures.size(), 1U);
    expectSame(info.textures[0], TextureInfo{2, 1, rgba, WrapMode::ClampToEdge, WrapMode::MirroredRepeat});
    EXPECT_FALSE(info.attributes);
    EXPECT_EQ(info.emission_scale, std::optional(0.0F));
}

TEST(CStructs, EveryMemberOfTheOthersIsPassedOn)
{
    const ZvoGrid grid = {{1, 2, 3}, 4, 5};
    expectSame(ofC(grid), {{1, 2, 3}, 4, 5});
    expectSame(ofC(toC(GridInfo{{1, 2, 3}, 4, 5})), {{1, 2, 3}, 4, 5});
    expectSame(ofC(ZvoTreeBuildInfo{sizeof(ZvoTreeBuildInfo), grid, ZVO_COVERAGE_CONSERVATIVE,
                                    ZVO_ATTRIBUTE_FORMAT_BLOCKS, VK_TRUE}),
               {{{1, 2, 3}, 4, 5}, Coverage::Conservative, AttributeFormat::Blocks, true});
    expectSame(ofC(ZvoDynamicTreeInfo{sizeof(ZvoDynamicTreeInfo), ZVO_COVERAGE_CONSERVATIVE, ZVO_MERGE_RULE_STATIC_WINS,
                                      3, 0.5F, 4, 5, 6, 7}),
               {Coverage::Conservative, MergeRule::StaticWins, 3, 4, 5, 6, 7, 0.5F});
    expectSame(
        ofC(ZvoBrushInfo{sizeof(ZvoBrushInfo), ZVO_BRUSH_SHAPE_BOX, ZVO_BRUSH_ACTION_PAINT, {-1, 2, 3}, 4, 5, 0}),
        {BrushShape::Box, BrushAction::Paint, {-1, 2, 3}, 4, 5});
    const CameraInfo camera = {{1, 2, 3}, {4, 5, 6}, {7, 8, 9}, true, 10, 11};
    expectSame(ofC(ZvoCameraInfo{sizeof(ZvoCameraInfo), {1, 2, 3}, {4, 5, 6}, {7, 8, 9}, 10, 11, VK_TRUE, 0}), camera);
    expectSame(ofC(toC(camera)), camera);
    expectSame(ofC(ZvoTraceInfo{sizeof(ZvoTraceInfo), {1, 2, 3}, ZVO_VIEW_BRICKS, VK_FALSE, 4, 5, 6, 7, 8, 0}),
               {View::Bricks, false, {1, 2, 3}, 4, 5, 6, 7, 8});
    expectSame(ofC(ZvoSunInfo{sizeof(ZvoSunInfo), {1, 2, 3}, {4, 5, 6}}), SunInfo{{1, 2, 3}, {4, 5, 6}});
    const float texels[18] = {};
    expectSame(ofC(ZvoEnvironmentMapInfo{sizeof(ZvoEnvironmentMapInfo), texels, 3, 2, 4, 5, 0}),
               EnvironmentMapInfo{3, 2, {reinterpret_cast<const Vec3*>(texels), 6}, 4, 5});
    expectSame(ofC(ZvoPathInfo{sizeof(ZvoPathInfo), 1, 2, 3, 4, VK_TRUE, VK_FALSE, 5, 6, VK_TRUE, 7}),
               PathInfo{1, 2, 3, 4, true, true, false, 5, 6, 7});
    const ZvoImageTarget image = {
        sizeof(image), handle<VkImage>(8), VK_FORMAT_B8G8R8A8_SRGB, VK_IMAGE_LAYOUT_GENERAL, {1, 2}, 3, 4, {5, 6}};
    const ImageTarget cpp_image = {image.image, VK_FORMAT_B8G8R8A8_SRGB, VK_IMAGE_LAYOUT_GENERAL, {1, 2}, 3, 4, {5, 6}};
    expectSame(ofC(image), cpp_image);
    ZvoDepthTarget depth = ZVO_DEPTH_TARGET_INIT;
    depth.image = &image;
    depth.view_projection[14] = 9;
    depth.miss = 0;
    expectSame(ofC(depth).image, cpp_image);
    EXPECT_EQ(ofC(depth).view_projection[14], 9);
    EXPECT_EQ(ofC(depth).miss, 0.0F);
    OptionalFeatures features = ofC(ZvoOptionalFeatures{sizeof(ZvoOptionalFeatures), VK_FALSE, VK_TRUE, VK_FALSE, 0});
    EXPECT_TRUE(!features.pass_times && features.subgroup_sizes && !features.int64_atomics);
    features = ofC(ZvoOptionalFeatures{sizeof(ZvoOptionalFeatures), VK_FALSE, VK_FALSE, VK_TRUE, 0});
    EXPECT_TRUE(!features.pass_times && !features.subgroup_sizes && features.int64_atomics);

    const ZvoUpdateStats stats = toC(UpdateStats{true, 1, 2, 3, {{"nonfinite", 4}, {"outside", 5}, {"zero_area", 6}}});
    EXPECT_EQ(stats.failed, VkBool32{VK_TRUE});
    EXPECT_EQ((std::array{stats.node_count, stats.voxel_count, stats.moving_count, stats.dropped_nonfinite,
                          stats.dropped_out_of_range, stats.dropped_outside, stats.dropped_zero_area}),
              (std::array<std::uint64_t, 7>{1, 2, 3, 4, 0, 5, 6}));
    const ZvoDroppedTriangles dropped = toC(std::map<std::string, std::uint64_t>{{"out_of_range", 8}});
    EXPECT_EQ(dropped.out_of_range, 8U);
    EXPECT_EQ(dropped.nonfinite + dropped.outside + dropped.zero_area, 0U);
}

} // namespace

} // namespace zvo
