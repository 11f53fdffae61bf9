// SPDX-License-Identifier: MIT
// The C interface's structs: sizes, members, and null pointers.
#include "api/c_convert.h"
#include "api/c_struct.h"
#include "c_host.h"
#include "expect_usage.h"

#include <gtest/gtest.h>

#include <cstring>
#include <utility>

namespace zvo
{

namespace
{

using test::expectUsage;

template <typename Struct> class CStruct : public testing::Test
{
protected:
    using Bytes = std::vector<unsigned char>;

    static constexpr std::size_t kSize = sizeof(Struct);
    static constexpr std::size_t kSizeBytes = sizeof(std::size_t);

    // A host's struct of this size. Every byte behind the size is value.
    static Bytes given(std::size_t size, unsigned char value)
    {
        Bytes bytes(std::max(size, kSizeBytes), value);
        std::memcpy(bytes.data(), &size, kSizeBytes);
        return bytes;
    }

    // Sets the reserved members that the host's struct has to 0.
    static void clearReserved(Bytes& bytes)
    {
        if constexpr (requires(Struct value) { value.reserved; })
        {
            const auto first = std::min(offsetof(Struct, reserved), bytes.size());
            std::fill_n(bytes.begin() + static_cast<std::ptrdiff_t>(first),
                        std::min(sizeof(Struct::reserved), bytes.size() - first), 0);
        }
    }

    static Struct* in(Bytes& bytes) { return reinterpret_cast<Struct*>(bytes.data()); }

    static Bytes bytesOf(const Struct& value)
    {
        Bytes bytes(kSize);
        std::memcpy(bytes.data(), &value, kSize);
        return bytes;
    }
};

using Structs =
    testing::Types<ZvoOptionalFeatures, ZvoDeviceInfo, ZvoContextInfo, ZvoMemoryUse, ZvoPassTime, ZvoTextureInfo,
                   ZvoMaterialInfo, ZvoMeshInfo, ZvoInstanceInfo, ZvoModelInfo, ZvoModelStats, ZvoTreeInfo,
                   ZvoTreeBuildInfo, ZvoDroppedTriangles, ZvoDynamicTreeInfo, ZvoBrushInfo, ZvoUpdateStats, ZvoSunInfo,
                   ZvoEnvironmentMapInfo, ZvoCameraInfo, ZvoTraceInfo, ZvoPathInfo, ZvoImageTarget, ZvoDepthTarget,
                   ZvoKeptLightInfo, ZvoKeptFrameInfo, ZvoKeptLightStats, ZvoKeptPictureInfo>;
TYPED_TEST_SUITE(CStruct, Structs);

TYPED_TEST(CStruct, MembersThatAnOlderHostDoesNotKnowAreTheDefaults)
{
    const auto defaults = this->bytesOf(initial<TypeParam>());
    for (std::size_t size = this->kSizeBytes; size <= this->kSize; size += kMemberBytes)
    {
        auto bytes = this->given(size, 0x5A); // exactly that many, so that sanitizers see reads behind them
        this->clearReserved(bytes);
        const auto read = this->bytesOf(readStruct(this->in(bytes), "it"));
        EXPECT_TRUE(std::equal(bytes.begin() + this->kSizeBytes, bytes.end(), read.begin() + this->kSizeBytes));
        EXPECT_TRUE(std::equal(read.begin() + static_cast<std::ptrdiff_t>(size), read.end(),
                               defaults.begin() + static_cast<std::ptrdiff_t>(size)));
    }
}

TYPED_TEST(CStruct, MembersOfANewerHostMustBeZero)
{
    auto bytes = this->given(this->kSize + 12, 0);
    EXPECT_NO_THROW(readStruct(this->in(bytes), "it"));
    for (std::size_t i = this->kSize; i < bytes.size(); ++i)
    {
        bytes[i] = 1;
        expectUsage([&] { readStruct(this->in(bytes), "it"); }, "does not know");
        bytes[i] = 0;
    }
}

TYPED_TEST(CStruct, WhatIsReservedMustBeZero)
{
    if constexpr (requires(TypeParam value) { value.reserved; })
    {
        auto value = initial<TypeParam>();
        EXPECT_NO_THROW(readStruct(&value, "it"));
        value.reserved = 1;
        expectUsage([&] { readStruct(&value, "it"); }, "it has a reserved member");
    }
}

TYPED_TEST(CStruct, NoSizeIsAnError)
{
    std::vector<std::size_t> sizes = {this->kSize + 1, this->kSize - 2, 4100, std::size_t{1} << 40, SIZE_MAX};
    for (std::size_t size = 0; size < this->kSizeBytes; ++size)
    {
        sizes.push_back(size);
    }
    for (const std::size_t size : sizes)
    {
        auto bytes = this->given(this->kSize, 0); // whatever its size says, nothing behind it is read
        std::memcpy(bytes.data(), &size, this->kSizeBytes);
        expectUsage([&] { readStruct(this->in(bytes), "it"); }, "struct_size");
        expectUsage([&] { writeStruct(this->in(bytes), "it", initial<TypeParam>()); }, "struct_size");
    }
    expectUsage([] { readStruct<TypeParam>(nullptr, "it"); }, "it is null");
    expectUsage([] { writeStruct<TypeParam>(nullptr, "it", initial<TypeParam>()); }, "it is null");
}

TYPED_TEST(CStruct, AsMuchIsFilledAsTheHostKnowsAndTheRestIsZero)
{
    TypeParam value;
    std::memset(&value, 0x5A, sizeof(value));
    for (std::size_t size = this->kSizeBytes; size < this->kSize + 9; size += kMemberBytes)
    {
        auto bytes = this->given(size, 0xEE);
        writeStruct(this->in(bytes), "it", value);
        std::size_t kept = 0;
        std::memcpy(&kept, bytes.data(), sizeof(kept));
        EXPECT_EQ(kept, size);
        for (std::size_t i = this->kSizeBytes; i < size; ++i)
        {
            ASSERT_EQ(bytes[i], i < this->kSize ? 0x5A : 0) << i << " of " << size;
        }
    }
}

TYPED_TEST(CStruct, AnArraysFirstSizeIsItsStride)
{
    const std::size_t stride = this->kSize + 16; // of a newer host
    typename TestFixture::Bytes bytes;
    for (unsigned char value = 1; value <= 3; ++value)
    {
        auto element = this->given(stride, 0);
        std::fill(element.begin() + this->kSizeBytes, element.begin() + this->kSize, value);
        this->clearReserved(element);
        bytes.insert(bytes.end(), element.begin(), element.end());
    }
    const std::vector<TypeParam> read = readStructs(this->in(bytes), 3, "it");
    ASSERT_EQ(read.size(), 3U);
    for (std::size_t i = 0; i < 3; ++i)
    {
        EXPECT_EQ(this->bytesOf(read[i])[this->kSizeBytes], i + 1);
    }
    // The lowest byte of the second one's size, which is below 256.
    bytes[stride] = static_cast<unsigned char>(stride - 8);
    if (stride < 256)
    {
        expectUsage([&] { readStructs(this->in(bytes), 3, "it"); }, "several sizes");
    }
    EXPECT_TRUE(readStructs<TypeParam>(nullptr, 0, "it").empty());
    expectUsage([] { readStructs<TypeParam>(nullptr, 1, "it"); }, "it is null");
}

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
