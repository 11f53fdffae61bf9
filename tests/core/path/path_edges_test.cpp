// SPDX-License-Identifier: MIT
// Path tracing at its limits: no voxels, one voxel, no light, deep grids, cameras in odd places, scenes of all kinds.
#include "core/base/read_file.h"
#include "core/path/daylight.h"
#include "core/path/path_tracer.h"
#include "io/image/hdr_image_io.h"
#include "io/scene/animated_scene.h"
#include "runtime/trees.h"
#include "support/engine_device.h"
#include "support/lit_voxels.h"
#include "support/path_pictures.h"
#include "support/scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <numeric>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace zvo
{
namespace
{

using test::device;
using test::LitVoxel;

/// Pictures of one tree in one light, of `edge` pixels along each edge.
class Pictures
{
public:
    Pictures(const DeviceTree& tree, const ViewCamera& view, std::uint32_t edge)
        : m_tree(tree), m_camera(traceCamera(view, tree.grid, edge)), m_edge(edge), m_tracer(device().device())
    {
    }

    HdrImage take(DeviceEnvironment& light, const PathOptions& options, std::uint32_t samples = 8)
    {
        m_tracer.resize(m_edge, m_edge);
        m_tracer.forget();
        for (std::uint32_t i = 0; i < samples; ++i)
        {
            device().run([&](vk::FrameGraph& graph) { m_tracer.addSample(graph, m_tree, light, m_camera, options); });
        }
        EXPECT_EQ(device().download(m_tracer.status()).front().capped_rays, 0U);
        return pictureOf(device().download(m_tracer.picture().sums), m_edge, m_edge, samples);
    }

private:
    const DeviceTree& m_tree;
    TraceCamera m_camera;
    std::uint32_t m_edge;
    PathTracer m_tracer;
};

bool isConstant(const HdrImage& image, const glm::vec3& value, float tolerance)
{
    return std::ranges::all_of(image.texels, [&](const glm::vec3& texel)
                               { return glm::all(glm::lessThanEqual(glm::abs(texel - value), glm::vec3(tolerance))); });
}

bool isFinite(const HdrImage& image)
{
    return std::ranges::all_of(image.texels,
                               [](const glm::vec3& texel)
                               {
                                   return std::isfinite(texel.x) && std::isfinite(texel.y) && std::isfinite(texel.z) &&
                                          glm::all(glm::greaterThanEqual(texel, glm::vec3(0.0F)));
                               });
}

DeviceTree oneVoxel(std::uint32_t depth, const glm::vec3& emission)
{
    return test::litTree(device(), {{glm::uvec3((1U << depth) - 1), glm::uvec3(255), emission}}, depth);
}

TEST(PathEdges, NoVoxelsShowTheMap)
{
    DeviceTree empty;
    empty.grid.depth = 4;
    DeviceEnvironment light = test::constantSky(glm::vec3(0.75F));
    Pictures pictures(empty, ViewCamera::lookAt({20, 20, 20}, {0, 0, 0}, 0.7), 9);
    EXPECT_TRUE(isConstant(pictures.take(light, {}), glm::vec3(0.75F), 1e-6F));
}

// More pixels than a batch has.
TEST(PathEdges, EveryPixelOfALargePictureIsTracedOnce)
{
    const DeviceTree tree = oneVoxel(3, glm::vec3(1.0F));
    DeviceEnvironment light = test::constantSky(glm::vec3(0.75F));
    const ViewCamera view = ViewCamera::lookAt({7.5, 7.5, 30.0}, {7.5, 7.5, 7.5}, 0.1);
    const HdrImage image = Pictures(tree, view, 730).take(light, {.bounces = 0}, 1);
    std::size_t lit = 0;
    for (const glm::vec3& texel : image.texels)
    {
        ASSERT_TRUE(texel == glm::vec3(0.75F) || texel == glm::vec3(1.0F));
        lit += texel == glm::vec3(1.0F) ? 1 : 0;
    }
    // The square's edge is 1 / (2 * 22 * tan(0.05)) of the picture's.
    const double edge = 730.0 / (44.0 * std::tan(0.05));
    EXPECT_NEAR(static_cast<double>(lit), edge * edge, 4.0 * edge);
    EXPECT_EQ(image.texels[365 * 730 + 365], glm::vec3(1.0F));
}

// In grids of every depth, whose rays take several rounds from depth 14 on.
TEST(PathEdges, OneVoxelIsSeenInEveryDepth)
{
    for (const std::uint32_t depth : {1U, 2U, 3U, 9U, 13U, 14U, 17U})
    {
        const DeviceTree tree = oneVoxel(depth, {0.25F, 0.5F, 1.5F});
        const glm::dvec3 middle(std::ldexp(1.0, static_cast<int>(depth)) - 0.5);
        DeviceEnvironment light = test::constantSky(glm::vec3(0.0F));
        Pictures pictures(tree, ViewCamera::lookAt(middle + glm::dvec3(2.0, 3.0, 4.0), middle, 0.5), 7);
        const HdrImage image = pictures.take(light, {});
        EXPECT_EQ(image.texels[3 * 7 + 3], glm::vec3(0.25F, 0.5F, 1.5F)) << depth;
        EXPECT_EQ(image.texels.front(), glm::vec3(0.0F)) << depth;
        EXPECT_EQ(image.texels.back(), glm::vec3(0.0F)) << depth;
    }
}

TEST(PathEdges, ACameraInAVoxelSeesItsEmission)
{
    const DeviceTree tree = oneVoxel(3, {0.5F, 1.0F, 1.5F});
    DeviceEnvironment light = test::constantSky(glm::vec3(1.0F));
    Pictures pictures(tree, ViewCamera::lookAt({7.5, 7.25, 7.5}, {0, 0, 0}, 0.7), 6);
    EXPECT_TRUE(isConstant(pictures.take(light, {}), {0.5F, 1.0F, 1.5F}, 0.0F));
}

TEST(PathEdges, WithoutBouncesOnlyLightItselfIsSeen)
{
    std::vector<LitVoxel> voxels;
    test::addBox(voxels, {0, 0, 0}, {8, 1, 8}, {{}, glm::uvec3(255), glm::vec3(0.0F)});
    const DeviceTree dark = test::litTree(device(), voxels, 3);
    test::addBox(voxels, {0, 1, 0}, {8, 2, 8}, {{}, glm::uvec3(255), glm::vec3(1.25F)});
    const DeviceTree lit = test::litTree(device(), voxels, 3);
    const ViewCamera above = ViewCamera::lookAt({4.0, 12.0, 4.01}, {4.0, 1.0, 4.0}, 0.2);
    DeviceEnvironment light = test::constantSky(glm::vec3(1.0F));
    EXPECT_TRUE(isConstant(Pictures(dark, above, 6).take(light, {.bounces = 0}), glm::vec3(0.0F), 0.0F));
    EXPECT_TRUE(isConstant(Pictures(lit, above, 6).take(light, {.bounces = 0}), glm::vec3(1.25F), 0.0F));
}

TEST(PathEdges, WithoutLightAllIsBlack)
{
    const DeviceTree tree = oneVoxel(3, glm::vec3(0.0F));
    DeviceEnvironment light = test::constantSky(glm::vec3(0.0F));
    Pictures pictures(tree, ViewCamera::lookAt({9.0, 11.0, 12.0}, {7.5, 7.5, 7.5}, 0.2), 6);
    EXPECT_TRUE(isConstant(pictures.take(light, {}), glm::vec3(0.0F), 0.0F));
}

// What is in the plane of focus stays sharp; what is not, does not.
TEST(PathEdges, ALensBlursWhatIsOutOfFocus)
{
    std::vector<LitVoxel> voxels;
    test::addBox(voxels, {0, 0, 0}, {4, 8, 1}, {{}, glm::uvec3(0), glm::vec3(1.0F)});
    test::addBox(voxels, {4, 0, 0}, {8, 8, 1}, {{}, glm::uvec3(0), glm::vec3(0.0F)});
    const DeviceTree tree = test::litTree(device(), voxels, 3);
    const ViewCamera view = ViewCamera::lookAt({4.0, 4.0, 11.0}, {4.0, 4.0, 1.0}, 0.4);
    DeviceEnvironment dark = test::constantSky(glm::vec3(0.0F));
    Pictures pictures(tree, view, 16);
    const auto mixed = [](const HdrImage& image)
    {
        return std::ranges::count_if(image.texels,
                                     [](const glm::vec3& texel) { return texel.x > 0.05F && texel.x < 0.95F; });
    };
    const HdrImage sharp = pictures.take(dark, {.bounces = 0, .lens_radius = 0.5F, .focus_distance = 10.0F}, 64);
    const HdrImage blurred = pictures.take(dark, {.bounces = 0, .lens_radius = 0.5F, .focus_distance = 5.0F}, 64);
    EXPECT_EQ(mixed(sharp), 0);
    EXPECT_GT(mixed(blurred), 16);
}

TEST(PathEdges, OrthographicCamerasSeeTheSameLight)
{
    // Seen along z, the voxel is a square of a quarter of the picture's edge.
    const DeviceTree tree = oneVoxel(3, glm::vec3(1.0F));
    ViewCamera view = ViewCamera::lookAt({7.5, 7.5, 30.0}, {7.5, 7.5, 7.5}, 0.2);
    view.orthographic = true;
    view.half_height = 2.0;
    DeviceEnvironment light = test::constantSky(glm::vec3(0.0F));
    const HdrImage image = Pictures(tree, view, 16).take(light, {});
    for (std::uint32_t i = 0; i < 256; ++i)
    {
        const bool inside = i % 16 >= 6 && i % 16 < 10 && i / 16 >= 6 && i / 16 < 10;
        EXPECT_EQ(image.texels[i], glm::vec3(inside ? 1.0F : 0.0F)) << i;
    }
}

// No pixel of any scene is infinite, NaN or negative, whatever the seed. By default pictures are small, and each seed
// has one of the lights; with ZVO_TEST_ALL_LIGHTS=1 every seed has all lights, with larger pictures of finer voxels.
using PathScenes = testing::TestWithParam<std::string>;

bool hasAllLights()
{
    const char* all = std::getenv("ZVO_TEST_ALL_LIGHTS");
    return all != nullptr && std::string_view(all) == "1";
}

// The path of one of the project's scenes, or "models/NAME" for a model that does not come with it.
std::optional<std::filesystem::path> pathOf(const std::string& name)
{
    constexpr std::string_view kModels = "models/";
    return name.starts_with(kModels) ? test::sharedScene(name.substr(kModels.size())) : test::ownScene(name);
}

// A scene, or a scene file's at some time; nothing if a model is missing.
std::optional<Scene> sceneOf(const std::string& name)
{
    const auto path = pathOf(name);
    const std::string stem = name.substr(0, name.find('.'));
    if (!path || (isSceneFile(*path) && !test::missingModelOf(stem).empty()))
    {
        return std::nullopt;
    }
    AnimatedSceneOptions options;
    if (std::filesystem::is_directory(test::modelsFolder()))
    {
        options.scenes_folder = test::modelsFolder();
    }
    return sceneAt(loadAnimatedScene(*path, options), 0.7);
}

// Black below, almost black above, but for one texel as bright as half floats can be.
HdrImage hardMap()
{
    HdrImage map = {64, 32, std::vector<glm::vec3>(2048)};
    std::fill_n(map.texels.begin(), 1024, glm::vec3(1e-6F));
    map.texels[5 * 64 + 40] = glm::vec3(65504.0F);
    return map;
}

std::vector<DeviceEnvironment> allLights()
{
    std::vector<DeviceEnvironment> lights;
    lights.emplace_back(device().device()).setSun(daylight());
    lights.push_back(test::constantSky(glm::vec3(0.0F)));
    lights.emplace_back(device().device(), hardMap(), 0.3, 1.0);
    for (const char* name : {"kloppenheim_05_1k.hdr", "phalzer_forest_01_1k.hdr"})
    {
        const auto path = test::sharedScene(name);
        if (path && hasAllLights())
        {
            std::vector<std::string> warnings;
            lights.emplace_back(device().device(), decodeHdrImage(readFile(*path), name, warnings), 0.0, 1.0);
        }
    }
    return lights;
}

TEST_P(PathScenes, HaveFinitePixels)
{
    constexpr std::uint32_t kSeeds = 64;
    const std::optional<Scene> scene = sceneOf(GetParam());
    if (!scene)
    {
        GTEST_SKIP() << GetParam() << " is not there, or one of its models";
    }
    const bool all = hasAllLights();
    const Grid grid = Grid::around(scene->bounds(), all ? 9 : 6);
    const GpuScene uploaded = uploadScene(device(), *scene, true, brightestEmission(*scene));
    const DeviceTree tree = buildOctree(device(), uploaded, grid, {}).octree;
    std::vector<DeviceEnvironment> lights = allLights();
    Pictures pictures(tree, ViewCamera::framing(scene->bounds(), 1.0), all ? 64 : 12);
    glm::vec3 sum(0.0F);
    for (std::uint32_t seed = 0; seed < kSeeds; ++seed)
    {
        for (std::size_t i = 0; i < lights.size(); ++i)
        {
            if (all || seed % lights.size() == i)
            {
                const HdrImage image = pictures.take(lights[i], {.seed = seed}, 1);
                ASSERT_TRUE(isFinite(image)) << "seed " << seed << ", light " << i;
                sum = std::accumulate(image.texels.begin(), image.texels.end(), sum);
            }
        }
    }
    EXPECT_GT(sum.g, 0.0F);
}

INSTANTIATE_TEST_SUITE_P(All, PathScenes,
                         testing::Values("cornell_box.glb", "atrium.glb", "cube.glb", "knot.glb",
                                         "atrium_knot.scene.json", "buddha_dragon.scene.json",
                                         "sponza_bunny.scene.json", "models/cornell_box.glb", "models/bunny_low.glb",
                                         "models/buddha_113k.glb", "models/asian_dragon_28k.glb",
                                         "models/damaged_helmet.glb", "models/alpha_blend_mode_test.glb",
                                         "models/milk_truck.glb", "models/box_textured.glb", "models/duck/Duck.gltf",
                                         "models/sponza.glb", "models/dragon.glb", "models/bunny.glb"));

} // namespace
} // namespace zvo
