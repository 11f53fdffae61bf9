// SPDX-License-Identifier: MIT
#include "oracle/attributes.h"

#include "oracle/fragments.h"
#include "oracle/morton.h"
#include "oracle/test_scenes.h"
#include "oracle/voxelizer.h"
#include "support/scenes.h"

#include <gtest/gtest.h>

namespace zvo::oracle
{
namespace
{

/// Small enough to lie in voxel (0, 0, 0), around the middle of its column's lower face.
const std::vector<glm::vec3> kSmallTriangle{{0.1F, 0.1F, 0.3F}, {0.9F, 0.1F, 0.3F}, {0.1F, 0.9F, 0.3F}};

TEST(OracleColors, EmptySceneHasNone)
{
    EXPECT_TRUE(voxelColors(Scene{}, test::kUnitGrid, Coverage::Thin).empty());
}

TEST(OracleColors, FactorIsTheColorOfEachFragment)
{
    Scene scene = zvo::test::triangleSoup(kSmallTriangle);
    scene.materials[0].base_color = glm::vec4(0.25F, 0.5F, 1.0F, 0.0F);
    EXPECT_EQ(voxelColors(scene, test::kUnitGrid, Coverage::Thin),
              (std::vector<VoxelColor>{{0, 16384, 32768, 65535, 1}}));
}

TEST(OracleColors, FragmentsOfOneVoxelAddUp)
{
    Scene scene = zvo::test::triangleSoup(kSmallTriangle);
    scene.materials.push_back(test::materialOf(AlphaMode::Opaque, glm::vec4(1.0F, 0.0F, 0.25F, 1.0F)));
    scene.primitives.push_back(scene.primitives[0]);
    scene.primitives[1].material = 1;
    scene.instances.emplace_back().primitive = 1;
    scene.instances.emplace_back().primitive = 1;
    EXPECT_EQ(voxelColors(scene, test::kUnitGrid, Coverage::Thin),
              (std::vector<VoxelColor>{{0, 3 * 65535, 65535, 65535 + 2 * 16384, 3}}));
}

TEST(OracleColors, FragmentsThatDoNotExistDoNotCount)
{
    Scene scene = zvo::test::triangleSoup(kSmallTriangle);
    scene.materials.push_back(test::materialOf(AlphaMode::Mask, glm::vec4(1.0F, 1.0F, 1.0F, 0.4F)));
    scene.materials[0].base_color = glm::vec4(0.0F);
    scene.primitives.push_back(scene.primitives[0]);
    scene.primitives[1].material = 1;
    scene.instances.emplace_back().primitive = 1;
    EXPECT_EQ(voxelColors(scene, test::kUnitGrid, Coverage::Thin), (std::vector<VoxelColor>{{0, 0, 0, 0, 1}}));
}

TEST(OracleColors, VertexColorsAreInterpolatedAndMultiplied)
{
    Scene scene = zvo::test::triangleSoup({{0.0F, 0.0F, 0.5F}, {2.0F, 0.0F, 0.5F}, {0.0F, 2.0F, 0.5F}});
    scene.primitives[0].colors = {glm::vec4(1.0F, 0.0F, 0.0F, 1.0F), glm::vec4(0.0F, 1.0F, 0.0F, 1.0F),
                                  glm::vec4(0.0F, 0.0F, 1.0F, 1.0F)};
    scene.materials[0].base_color = glm::vec4(1.0F, 1.0F, 0.5F, 1.0F);
    const std::vector<VoxelColor> voxels = voxelColors(scene, test::kUnitGrid, Coverage::Thin);
    // Weights (1/2, 1/4, 1/4) at the first voxel's centre: 65535 / 2 and 65535 / 4, rounded down.
    EXPECT_EQ(voxels.at(0), (VoxelColor{0, 32767, 16383, mul16(32768, 16383), 1}));
}

TEST(OracleColors, TextureIsReadInLinearLight)
{
    Scene scene = zvo::test::triangleSoup({{0.0F, 0.0F, 0.5F}, {2.0F, 0.0F, 0.5F}, {0.0F, 2.0F, 0.5F}});
    scene.images.push_back({{}, 1, 1, {188, 55, 255, 255}});
    scene.textures.push_back({});
    scene.materials[0].base_color_texture = 0;
    // Without texture coordinates there is no texture.
    EXPECT_EQ(voxelColors(scene, test::kUnitGrid, Coverage::Thin).at(0), (VoxelColor{0, 65535, 65535, 65535, 1}));
    scene.primitives[0].uvs = {{0.0F, 0.0F}, {1.0F, 0.0F}, {0.0F, 1.0F}};
    EXPECT_EQ(voxelColors(scene, test::kUnitGrid, Coverage::Thin).at(0),
              (VoxelColor{0, linear16(188), linear16(55), 65535, 1}));
}

TEST(OracleColors, HasTheVoxelizersVoxelsInMortonOrder)
{
    test::Random random(8);
    std::vector<glm::vec3> corners;
    for (int i = 0; i < 4500; ++i)
        corners.emplace_back(test::pick(random, 0, 1000), test::pick(random, 0, 1000), test::pick(random, 0, 1000));
    const Grid grid{.origin = glm::vec3(0.0F), .voxel_size = 50.0F, .depth = 5};
    const Scene scene = zvo::test::triangleSoup(corners);
    const std::vector<VoxelColor> colors = voxelColors(scene, grid, Coverage::Conservative);
    std::vector<std::uint64_t> codes;
    for (const VoxelColor& voxel : colors)
    {
        codes.push_back(voxel.code);
        ASSERT_GE(voxel.count, 1U);
        ASSERT_EQ(voxel.sum_r, 65535 * voxel.count);
    }
    EXPECT_EQ(codes, voxelize(scene, grid, Coverage::Conservative).codes);
}

} // namespace
} // namespace zvo::oracle
