// SPDX-License-Identifier: MIT
#include "oracle/voxelizer.h"

#include "oracle/morton.h"
#include "oracle/test_scenes.h"
#include "support/scenes.h"

#include <gtest/gtest.h>

namespace zvo::oracle
{
namespace
{

/// Two triangles in the plane z = height over the whole unit grid; texture coordinates 0 .. 1 with v = y / 4.
Scene floorScene(float height)
{
    const glm::vec3 corners[4] = {{0, 0, height}, {4, 0, height}, {4, 4, height}, {0, 4, height}};
    Scene scene = zvo::test::triangleSoup({corners[0], corners[1], corners[2], corners[0], corners[2], corners[3]});
    for (const glm::vec3& position : scene.primitives[0].positions)
        scene.primitives[0].uvs.emplace_back(position.x / 4, position.y / 4);
    return scene;
}

/// Gives the scene's first material a texture of 2 x 1 texels with these alphas.
void setAlphaTexture(Scene& scene, std::uint8_t left, std::uint8_t right)
{
    scene.images.push_back({{}, 2, 1, {255, 255, 255, left, 255, 255, 255, right}});
    scene.textures.push_back({0, WrapMode::ClampToEdge, WrapMode::ClampToEdge});
    scene.materials[0].base_color_texture = 0;
}

std::vector<std::uint64_t> codesWhere(const std::function<bool(const glm::uvec3&)>& wanted)
{
    std::vector<std::uint64_t> codes;
    for (const glm::uvec3& voxel : test::allVoxels(4))
        if (wanted(voxel))
            codes.push_back(mortonEncode(voxel));
    std::sort(codes.begin(), codes.end());
    return codes;
}

TEST(OracleVoxelizer, EmptySceneHasNoVoxels)
{
    const OracleVoxels voxels = voxelize(Scene{}, test::kUnitGrid, Coverage::Thin);
    EXPECT_TRUE(voxels.codes.empty());
    EXPECT_TRUE(voxels.dropped.empty());
}

TEST(OracleVoxelizer, FloorIsOneLayerThinAndTwoLayersConservative)
{
    const Scene scene = floorScene(2.0F);
    EXPECT_EQ(voxelize(scene, test::kUnitGrid, Coverage::Thin).codes, codesWhere([](auto v) { return v.z == 2; }));
    EXPECT_EQ(voxelize(scene, test::kUnitGrid, Coverage::Conservative).codes,
              codesWhere([](auto v) { return v.z == 1 || v.z == 2; }));
    EXPECT_EQ(voxelize(floorScene(4.0F), test::kUnitGrid, Coverage::Thin).codes,
              codesWhere([](auto v) { return v.z == 3; }));
}

TEST(OracleVoxelizer, InstancesAreUnited)
{
    Scene scene = floorScene(0.5F);
    scene.instances.push_back(scene.instances[0]);
    scene.instances[1].transform[3].z = 3.0F;
    EXPECT_EQ(voxelize(scene, test::kUnitGrid, Coverage::Thin).codes,
              codesWhere([](auto v) { return v.z == 0 || v.z == 3; }));
}

TEST(OracleVoxelizer, CountsDroppedTrianglesByReason)
{
    const glm::vec3 o(0.0F);
    const Scene scene =
        zvo::test::triangleSoup({o, o, glm::vec3(NAN), o, o, glm::vec3(1e30F), o, o, o, -glm::vec3(1.0F),
                                 -glm::vec3(1.0F), -glm::vec3(2.0F), o, o, glm::vec3(4.0F)});
    using Dropped = std::map<std::string, std::uint64_t>;
    EXPECT_EQ(voxelize(scene, test::kUnitGrid, Coverage::Thin).dropped,
              (Dropped{{"nonfinite", 1}, {"out_of_range", 1}, {"outside", 1}, {"zero_area", 2}}));
    EXPECT_EQ(voxelize(scene, test::kUnitGrid, Coverage::Conservative).dropped,
              (Dropped{{"nonfinite", 1}, {"out_of_range", 1}, {"outside", 1}}));
}

TEST(OracleVoxelizer, MaskTakesAlphaFromTheTexture)
{
    Scene scene = floorScene(0.5F);
    setAlphaTexture(scene, 0, 255);
    scene.materials[0].alpha_mode = AlphaMode::Mask;
    // Texel centres lie at x = 1 and x = 3; at the voxels' centres alpha is 0, 1/4, 3/4, 1. The level of detail is the
    // whole image: a texel is larger than a voxel.
    EXPECT_EQ(voxelize(scene, test::kUnitGrid, Coverage::Thin).codes,
              codesWhere([](auto v) { return v.z == 0 && v.x >= 2; }));
    scene.materials[0].alpha_cutoff = 0.2F;
    EXPECT_EQ(voxelize(scene, test::kUnitGrid, Coverage::Thin).codes,
              codesWhere([](auto v) { return v.z == 0 && v.x >= 1; }));
    scene.materials[0].alpha_cutoff = 1.5F;
    EXPECT_TRUE(voxelize(scene, test::kUnitGrid, Coverage::Thin).codes.empty());
    scene.materials[0].alpha_mode = AlphaMode::Opaque;
    EXPECT_EQ(voxelize(scene, test::kUnitGrid, Coverage::Thin).codes, codesWhere([](auto v) { return v.z == 0; }));
}

TEST(OracleVoxelizer, MaskMultipliesTextureFactorAndVertexAlpha)
{
    Scene scene = floorScene(0.5F);
    setAlphaTexture(scene, 255, 255);
    scene.materials[0].alpha_mode = AlphaMode::Mask;
    scene.materials[0].base_color.a = 0.8F;
    scene.primitives[0].colors.assign(6, glm::vec4(1.0F, 1.0F, 1.0F, 0.6F)); // 0.48 in all
    EXPECT_TRUE(voxelize(scene, test::kUnitGrid, Coverage::Thin).codes.empty());
    scene.materials[0].alpha_cutoff = 0.47F;
    EXPECT_EQ(voxelize(scene, test::kUnitGrid, Coverage::Thin).codes.size(), 16U);
}

TEST(OracleVoxelizer, BlendKeepsTheVoxelsOfLowRank)
{
    Scene scene = floorScene(0.5F);
    scene.materials[0].alpha_mode = AlphaMode::Blend;
    scene.materials[0].base_color.a = 0.25F; // ranks 0 to 15: x_0 = y_0 and y_0 = z_0... with z = 0: x_0 = 0, y_0 = 0
    EXPECT_EQ(voxelize(scene, test::kUnitGrid, Coverage::Thin).codes,
              codesWhere([](auto v) { return v.z == 0 && v.x % 2 == 0 && v.y % 2 == 0; }));
    scene.materials[0].base_color.a = 0.0F;
    EXPECT_TRUE(voxelize(scene, test::kUnitGrid, Coverage::Thin).codes.empty());
    scene.materials[0].base_color.a = 1.0F;
    EXPECT_EQ(voxelize(scene, test::kUnitGrid, Coverage::Thin).codes.size(), 16U);
}

TEST(OracleVoxelizer, CodesAreSortedAndUniqueAndThinIsASubset)
{
    test::Random random(7);
    std::vector<glm::vec3> corners;
    for (int i = 0; i < 3000; ++i)
        corners.emplace_back(std::uniform_real_distribution<float>(-8.0F, 72.0F)(random),
                             std::uniform_real_distribution<float>(-8.0F, 72.0F)(random),
                             std::uniform_real_distribution<float>(-8.0F, 72.0F)(random));
    for (std::size_t i = 0; i < corners.size(); i += 3) // small triangles
        for (std::size_t k = 1; k < 3; ++k)
            corners[i + k] = corners[i] + (corners[i + k] - corners[i]) * 0.1F;
    const Scene scene = zvo::test::triangleSoup(corners);
    const Grid grid{.origin = glm::vec3(0.0F), .voxel_size = 1.0F, .depth = 6};
    const OracleVoxels thin = voxelize(scene, grid, Coverage::Thin);
    const OracleVoxels all = voxelize(scene, grid, Coverage::Conservative);
    EXPECT_EQ(std::adjacent_find(all.codes.begin(), all.codes.end(), std::greater_equal<>()), all.codes.end());
    EXPECT_GT(thin.codes.size(), 1000U);
    EXPECT_LT(thin.codes.size(), all.codes.size());
    EXPECT_TRUE(std::includes(all.codes.begin(), all.codes.end(), thin.codes.begin(), thin.codes.end()));
    EXPECT_LT(all.codes.back(), std::uint64_t{1} << 18);
}

} // namespace
} // namespace zvo::oracle
