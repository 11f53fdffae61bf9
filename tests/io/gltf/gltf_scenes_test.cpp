// SPDX-License-Identifier: MIT
// Real scenes, if they are there: counts and boxes that were measured independently.
#include "io/gltf/gltf_loader.h"

#include "support/scenes.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <gtest/gtest.h>
#include <string>

namespace zvo
{

namespace
{

struct RealScene
{
    const char* file;
    std::uint64_t triangle_count;
    std::size_t instance_count; // of primitives
    std::size_t image_count;    // of base colour and emission
    glm::vec3 min;              // to six digits
    glm::vec3 max;
};

void PrintTo(const RealScene& scene, std::ostream* out)
{
    *out << scene.file;
}

constexpr RealScene kScenes[] = {
    {"bunny.glb", 69451, 1, 0, {-0.0946899, 0.0329874, -0.0618736}, {0.0610091, 0.187321, 0.0587997}},
    {"bunny_low.glb", 4968, 1, 0, {-0.0943804, 0.0333099, -0.0616792}, {0.0607788, 0.186996, 0.0587146}},
    {"dragon.glb", 871414, 1, 0, {-0.108324, 0.0527295, -0.0504143}, {0.0965662, 0.197173, 0.0412075}},
    {"buddha_113k.glb", 112876, 1, 0, {-20.33, 0, -20.3583}, {20.33, 99.0123, 20.3583}},
    {"asian_dragon_28k.glb", 28198, 1, 0, {-98.8341, -41.3069, -57.2113}, {103.093, 49.3154, 77.0337}},
    {"sponza.glb", 262267, 25, 25, {-15.3676, -1.01155, -9.46246}, {14.3993, 11.4354, 8.84339}},
    {"cornell_box.glb", 32, 6, 0, {0, 0, 0}, {0.556, 0.5488, 0.5592}},
    {"damaged_helmet.glb", 15452, 1, 2, {-0.947459, -0.900974, -1.18715}, {0.942495, 0.900995, 0.812845}},
    {"alpha_blend_mode_test.glb", 61, 9, 6, {-4.3, -0.1, -0.75}, {4.3, 2.29953, 0.55}},
    {"milk_truck.glb", 3624, 5, 1, {-2.43091, 0.00145189, -1.396}, {2.438, 2.58437, 1.396}},
    {"box_textured.glb", 12, 1, 1, {-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}},
    {"duck/Duck.gltf", 4212, 1, 1, {-0.692985, 0.0992937, -0.613282}, {0.961799, 1.6397, 0.539252}},
};

/// Whether value, rounded to six digits, may give printed. largest: the box's largest coordinate, in whose last bits
/// single precision rounds.
bool agrees(float value, float printed, float largest)
{
    constexpr float kHalfSixthDigit = 5.1e-6F;
    constexpr float kLastBit = 1.2e-7F;
    return std::abs(value - printed) <= kHalfSixthDigit * std::abs(printed) + kLastBit * largest;
}

class RealScenes : public testing::TestWithParam<RealScene>
{
};

TEST_P(RealScenes, HaveTheCountsAndBoxesThatWereMeasured)
{
    const RealScene& wanted = GetParam();
    const auto path = test::sharedScene(wanted.file);
    if (!path)
    {
        GTEST_SKIP() << wanted.file << " is not at hand";
    }
    const Scene scene = loadGltf(*path);
    EXPECT_EQ(scene.triangleCount(), wanted.triangle_count);
    EXPECT_EQ(scene.instances.size(), wanted.instance_count);
    EXPECT_EQ(scene.images.size(), wanted.image_count);
    const Bounds bounds = scene.bounds();
    const glm::vec3 magnitude = glm::max(glm::abs(wanted.min), glm::abs(wanted.max));
    const float largest = std::max({magnitude.x, magnitude.y, magnitude.z});
    for (int axis = 0; axis < 3; ++axis)
    {
        EXPECT_TRUE(agrees(bounds.min[axis], wanted.min[axis], largest))
            << bounds.min[axis] << " for " << wanted.min[axis];
        EXPECT_TRUE(agrees(bounds.max[axis], wanted.max[axis], largest))
            << bounds.max[axis] << " for " << wanted.max[axis];
    }
    EXPECT_TRUE(scene.warnings.empty()) << scene.warnings.front();
}

INSTANTIATE_TEST_SUITE_P(Gltf, RealScenes, testing::ValuesIn(kScenes),
                         [](const testing::TestParamInfo<RealScene>& scene)
                         {
                             std::string name = std::filesystem::path(scene.param.file).stem().string();
                             std::erase_if(name, [](char c) { return c == '_'; });
                             return name;
                         });

TEST(RealScene, CornellBoxShinesWithSeventeenTwelveFour)
{
    const auto path = test::sharedScene("cornell_box.glb");
    if (!path)
    {
        GTEST_SKIP() << "cornell_box.glb is not at hand";
    }
    const Scene scene = loadGltf(*path);
    const auto light = std::find_if(scene.materials.begin(), scene.materials.end(),
                                    [](const Material& material) { return material.emission != glm::vec3(0.0F); });
    ASSERT_NE(light, scene.materials.end());
    EXPECT_NEAR(light->emission.x, 17.0F, 1e-5F);
    EXPECT_NEAR(light->emission.y, 12.0F, 1e-5F);
    EXPECT_NEAR(light->emission.z, 4.0F, 1e-5F);
    ASSERT_EQ(scene.cameras.size(), 1U);
    EXPECT_FALSE(scene.cameras[0].orthographic);
}

TEST(RealScene, SponzaCutsOutThreeMaterials)
{
    const auto path = test::sharedScene("sponza.glb");
    if (!path)
    {
        GTEST_SKIP() << "sponza.glb is not at hand";
    }
    const Scene scene = loadGltf(*path);
    const auto is_cut_out = [](const Material& material)
    { return material.alpha_mode == AlphaMode::Mask && material.alpha_cutoff == 0.5F; };
    EXPECT_EQ(std::count_if(scene.materials.begin(), scene.materials.end(), is_cut_out), 3);
    for (const Material& material : scene.materials)
    {
        EXPECT_NEAR(material.base_color.x, 0.588F, 1e-3F) << material.name;
    }
}

} // namespace

} // namespace zvo
