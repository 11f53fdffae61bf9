// SPDX-License-Identifier: MIT
// The C interface's structs: every member and every default is passed on.
#include "api/c_convert.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <span>
#include <type_traits>

namespace zvo
{

namespace
{

template <typename... Structs> struct List
{
};

// Structs that zvo reads.
using Inputs =
    List<ZvoGrid, ZvoOptionalFeatures, ZvoContextInfo, ZvoTextureInfo, ZvoMaterialInfo, ZvoMeshInfo, ZvoInstanceInfo,
         ZvoModelInfo, ZvoTreeBuildInfo, ZvoTreeAlgebraInfo, ZvoDynamicTreeInfo, ZvoDynamicObjectInfo, ZvoBrushInfo,
         ZvoSunInfo, ZvoEnvironmentMapInfo, ZvoCameraInfo, ZvoTraceInfo, ZvoPathInfo, ZvoImageTarget, ZvoDepthTarget,
         ZvoRadianceCacheInfo, ZvoCachedFrameInfo, ZvoCachedPictureInfo>;

// Structs that zvo fills, but those with texts.
using Outputs =
    List<ZvoGrid, ZvoCameraRays, ZvoMemoryUse, ZvoTreeInfo, ZvoUpdateStats, ZvoCameraInfo, ZvoRadianceCacheStats>;

template <typename Struct, typename Cpp> void expectSameMembers(const Cpp& cpp, const Struct& c)
{
    eachShared<Struct>(cpp, c,
                       []<typename InCpp, typename InC>(const InCpp& cpp_member, const InC& c_member)
                       {
                           if constexpr (std::is_same_v<InCpp, InC>)
                           {
                               EXPECT_EQ(std::memcmp(&cpp_member, &c_member, sizeof(InC)), 0);
                           }
                           else if constexpr (std::is_same_v<InCpp, bool>)
                           {
                               EXPECT_EQ(cpp_member, c_member != VK_FALSE);
                           }
                           else if constexpr (requires { std::begin(cpp_member); })
                           {
                               EXPECT_TRUE(std::ranges::equal(cpp_member, c_member));
                           }
                           else if constexpr (std::is_class_v<InCpp>)
                           {
                               expectSameMembers(cpp_member, c_member);
                           }
                           else
                           {
                               EXPECT_EQ(static_cast<InC>(cpp_member), c_member);
                           }
                       });
}

// A struct whose bytes are all different. Its flags are set, and its enumerations have values without a name.
template <typename Struct> Struct numbered()
{
    Struct result = CStruct<Struct>::initial();
    auto* const bytes = reinterpret_cast<unsigned char*>(&result);
    for (std::size_t i = 0; i < sizeof(Struct); ++i)
    {
        bytes[i] = static_cast<unsigned char>(i + 1);
    }
    return result;
}

template <typename Struct> void expectPassedOn()
{
    const auto given = numbered<Struct>();
    typename CStruct<Struct>::InCpp cpp;
    assignShared<Struct>(cpp, given);
    expectSameMembers(cpp, given);
}

template <typename Struct> void expectPassedBack()
{
    typename CStruct<Struct>::InCpp cpp;
    assignShared<Struct>(cpp, numbered<Struct>());
    expectSameMembers(cpp, toC<Struct>(cpp));
}

TEST(CStructs, DefaultsAreThoseOfTheCppInterface)
{
    []<typename... Structs>(List<Structs...>)
    { (expectSameMembers(typename CStruct<Structs>::InCpp(), CStruct<Structs>::initial()), ...); }(Inputs());
    const auto context = ofC(CStruct<ZvoContextInfo>::initial());
    EXPECT_TRUE(context.instance_extensions.empty() && context.device_extensions.empty() && context.tuning.empty());
    EXPECT_TRUE(CStruct<ZvoContextInfo>::initial().log.function == nullptr);
    EXPECT_TRUE(ofC(CStruct<ZvoTextureInfo>::initial()).rgba.empty());
    EXPECT_TRUE(ofC(CStruct<ZvoEnvironmentMapInfo>::initial()).texels.empty());
    const auto mesh = ofC(CStruct<ZvoMeshInfo>::initial());
    EXPECT_TRUE(mesh.positions.empty() && mesh.normals.empty() && mesh.uvs.empty() && mesh.colors.empty());
    EXPECT_TRUE(mesh.triangles.empty());
    const ModelOfC model(CStruct<ZvoModelInfo>::initial());
    EXPECT_TRUE(model.info().meshes.empty() && model.info().instances.empty());
    EXPECT_TRUE(model.info().materials.empty() && model.info().textures.empty());
    EXPECT_EQ(model.info().emission_scale, ModelInfo().emission_scale);
}

TEST(CStructs, EveryMemberIsPassedOnAndBack)
{
    []<typename... Structs>(List<Structs...>) { (expectPassedOn<Structs>(), ...); }(Inputs());
    []<typename... Structs>(List<Structs...>) { (expectPassedBack<Structs>(), ...); }(Outputs());
}

TEST(CStructs, TextsAndExtensionsOfADeclarationArePassedOn)
{
    const char* const instance_extensions[] = {"a", "b"};
    const char* const device_extensions[] = {"c"};
    auto info = CStruct<ZvoContextInfo>::initial();
    info.instance_extensions = instance_extensions;
    info.instance_extension_count = 2;
    info.device_extensions = device_extensions;
    info.device_extension_count = 1;
    info.tuning = "path-form=stages";
    const ContextInfo cpp = ofC(info);
    EXPECT_EQ(cpp.instance_extensions.data(), instance_extensions);
    EXPECT_EQ(cpp.instance_extensions.size(), 2U);
    EXPECT_EQ(cpp.device_extensions.data(), device_extensions);
    EXPECT_EQ(cpp.device_extensions.size(), 1U);
    EXPECT_EQ(cpp.tuning, "path-form=stages");
}

template <typename Element> void expectSpan(std::span<Element> span, const void* first, std::size_t count)
{
    EXPECT_EQ(static_cast<const void*>(span.data()), first);
    EXPECT_EQ(span.size(), count);
}

TEST(CStructs, ArraysOfAModelArePassedOn)
{
    const float floats[4][8] = {};
    const std::uint32_t vertices[6] = {};
    const std::uint8_t rgba[8] = {};
    const ZvoMeshInfo meshes[] = {
        {sizeof(ZvoMeshInfo), floats[0], floats[1], floats[2], floats[3], 2, vertices, 1, 6, 0},
        {sizeof(ZvoMeshInfo), floats[0], nullptr, nullptr, nullptr, 1, vertices, 2, 7, 0}};
    const auto instance = numbered<ZvoInstanceInfo>();
    const auto material = numbered<ZvoMaterialInfo>();
    ZvoTextureInfo texture = ZVO_TEXTURE_INFO_INIT;
    texture.rgba = rgba;
    texture.rgba_bytes = 8;
    texture.width = 2;
    ZvoInstanceInfo given_instance = instance;
    ZvoMaterialInfo given_material = material;
    given_instance.struct_size = sizeof(instance);
    given_material.struct_size = sizeof(material);
    given_instance.reserved = given_material.reserved = 0;
    const ZvoModelInfo c = {sizeof(c), meshes, &given_instance, &given_material, &texture, 2, 1, 1, 1, VK_FALSE, 0};
    const ModelOfC model(c);
    const ModelInfo& info = model.info();
    ASSERT_EQ(info.meshes.size(), 2U);
    expectSpan(info.meshes[0].positions, floats[0], 2);
    expectSpan(info.meshes[0].normals, floats[1], 2);
    expectSpan(info.meshes[0].uvs, floats[2], 2);
    expectSpan(info.meshes[0].colors, floats[3], 2);
    expectSpan(info.meshes[0].triangles, vertices, 1);
    EXPECT_EQ(info.meshes[0].material, 6U);
    expectSpan(info.meshes[1].positions, floats[0], 1);
    EXPECT_TRUE(info.meshes[1].normals.empty() && info.meshes[1].uvs.empty() && info.meshes[1].colors.empty());
    expectSpan(info.meshes[1].triangles, vertices, 2);
    EXPECT_EQ(info.meshes[1].material, 7U);
    ASSERT_TRUE(info.instances.size() == 1 && info.materials.size() == 1 && info.textures.size() == 1);
    expectSameMembers(info.instances[0], instance);
    expectSameMembers(info.materials[0], material);
    expectSameMembers(info.textures[0], texture);
    expectSpan(info.textures[0].rgba, rgba, 8);
    EXPECT_FALSE(info.attributes);
    EXPECT_EQ(info.emission_scale, std::optional(0.0F));
}

TEST(CStructs, TexelsImagesAndReasonsArePassedOn)
{
    const float texels[18] = {};
    expectSpan(ofC(ZvoEnvironmentMapInfo{sizeof(ZvoEnvironmentMapInfo), texels, 3, 2, 4, 5, 0}).texels, texels, 6);
    ZvoImageTarget image = numbered<ZvoImageTarget>();
    image.struct_size = sizeof(image);
    ZvoDepthTarget depth = ZVO_DEPTH_TARGET_INIT;
    depth.image = &image;
    expectSameMembers(ofC(depth).image, image);

    const DroppedTriangles reasons = {{"nonfinite", 4}, {"outside", 5}, {"zero_area", 6}};
    const auto stats = toC<ZvoUpdateStats>({.dropped = reasons});
    const auto dropped = toC<ZvoDroppedTriangles>(reasons);
    const std::array<std::uint64_t, 4> expected = {4, 0, 5, 6};
    EXPECT_EQ((std::array{stats.dropped_nonfinite, stats.dropped_out_of_range, stats.dropped_outside,
                          stats.dropped_zero_area}),
              expected);
    EXPECT_EQ((std::array{dropped.nonfinite, dropped.out_of_range, dropped.outside, dropped.zero_area}), expected);
    EXPECT_EQ(toC<ZvoDroppedTriangles>({{"out_of_range", 8}}).out_of_range, 8U);
}

} // namespace

} // namespace zvo
