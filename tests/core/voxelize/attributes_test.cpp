// SPDX-License-Identifier: MIT
// Colours, normals and emission of voxels and inner nodes.
#include "core/base/morton.h"
#include "core/upload/texture_pool.h"
#include "io/gltf/gltf_loader.h"
#include "oracle/attributes.h"
#include "runtime/octree_sha256.h"
#include "runtime/trees.h"
#include "support/engine_device.h"
#include "support/octree_access.h"
#include "support/param_names.h"
#include "support/scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <iterator>
#include <map>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace zvo
{
namespace
{

using test::device;

struct Built
{
    DeviceTree octree;
    std::vector<gpu::Attribute> voxels;
    std::vector<gpu::Attribute> nodes;
};

Built build(const Scene& scene, const Grid& grid, Coverage coverage = Coverage::Thin)
{
    const GpuScene gpu_scene = uploadScene(device(), scene, true);
    Built built{buildOctree(device(), gpu_scene, grid, {coverage, true, {}}).octree, {}, {}};
    built.voxels = device().download(built.octree.voxel_attributes);
    built.nodes = device().download(built.octree.node_attributes);
    return built;
}

double degreesBetween(const glm::dvec3& a, const glm::dvec3& b)
{
    return glm::degrees(std::acos(std::clamp(glm::dot(glm::normalize(a), glm::normalize(b)), -1.0, 1.0)));
}

std::uint32_t channel(std::uint32_t color, int c)
{
    return color >> (8 * c) & 0xFF;
}

void expectColorsEqualTheOracle(const Scene& scene, std::uint32_t depth, Coverage coverage)
{
    const Grid grid = Grid::around(scene.bounds(), depth);
    const Built built = build(scene, grid, coverage);
    const std::vector<oracle::VoxelColor> expected = oracle::voxelColors(scene, grid, coverage);
    ASSERT_EQ(built.voxels.size(), expected.size());
    const std::vector<std::uint8_t>& to_srgb = linearToSrgbTable();
    std::size_t differences = 0;
    for (std::size_t i = 0; i < expected.size(); ++i)
    {
        const oracle::VoxelColor& sums = expected[i];
        const std::uint64_t half = sums.count / 2;
        const std::uint32_t color = to_srgb[(sums.sum_r + half) / sums.count] |
                                    to_srgb[(sums.sum_g + half) / sums.count] << 8 |
                                    to_srgb[(sums.sum_b + half) / sums.count] << 16;
        differences += (built.voxels[i].color & 0xFFFFFF) != color ? 1 : 0;
    }
    EXPECT_EQ(differences, 0U) << "of " << expected.size() << " voxels";
}

using SceneColors = testing::TestWithParam<std::string>;

INSTANTIATE_TEST_SUITE_P(Scenes, SceneColors,
                         testing::Values("sponza.glb", "damaged_helmet.glb", "milk_truck.glb",
                                         "alpha_blend_mode_test.glb", "box_textured.glb", "cornell_box.glb"),
                         test::paramName<std::string>);

TEST_P(SceneColors, EqualTheOracleBitForBit)
{
    const auto path = test::sharedScene(GetParam());
    if (!path)
    {
        GTEST_SKIP() << GetParam() << " is not there";
    }
    const Scene scene = loadGltf(*path);
    expectColorsEqualTheOracle(scene, 7, Coverage::Thin);
    expectColorsEqualTheOracle(scene, 6, Coverage::Conservative);
}

TEST(VoxelColors, OfTheOwnAtriumEqualTheOracle)
{
    expectColorsEqualTheOracle(loadGltf(test::ownScene("atrium.glb")), 7, Coverage::Thin);
}

TEST(VoxelColors, VertexColorsAndOddTexturesWithEveryWrapEqualTheOracle)
{
    std::mt19937 random(5);
    for (const WrapMode wrap : {WrapMode::Repeat, WrapMode::MirroredRepeat, WrapMode::ClampToEdge})
    {
        Scene scene = test::randomTriangles(11, 200, 32.0F);
        scene.images.push_back({"odd", 13, 5, {}});
        for (std::uint32_t i = 0; i < 13 * 5 * 4; ++i)
        {
            scene.images[0].rgba.push_back(static_cast<std::uint8_t>(random()));
        }
        scene.textures.push_back({0, wrap, wrap});
        scene.materials[0].base_color_texture = 0;
        scene.materials[0].base_color = {0.7F, 0.9F, 0.3F, 0.8F};
        scene.materials[0].alpha_mode = AlphaMode::Blend;
        for (std::size_t i = 0; i < scene.primitives[0].positions.size(); ++i)
        {
            const auto uniform = [&] { return std::uniform_real_distribution<float>(-2.0F, 3.0F)(random); };
            scene.primitives[0].uvs.emplace_back(uniform(), uniform());
            scene.primitives[0].colors.emplace_back(uniform(), uniform(), uniform(), 0.9F);
        }
        expectColorsEqualTheOracle(scene, 5, Coverage::Thin);
        expectColorsEqualTheOracle(scene, 5, Coverage::Conservative);
    }
}

TEST(VoxelNormals, OfABoxPointOutwardsAlongTheAxes)
{
    const Grid grid{.origin = glm::vec3(0.0F), .voxel_size = 1.0F, .depth = 4};
    Scene floor = test::triangleSoup({{0, 5, 0}, {0, 5, 16}, {16, 5, 16}, {0, 5, 0}, {16, 5, 16}, {16, 5, 0}});
    for (const bool mirrored : {false, true}) // mirroring in x reverses the winding, but not the normal
    {
        if (mirrored)
        {
            floor.instances[0].transform = glm::mat4(-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 16, 0, 0, 1);
        }
        const Built built = build(floor, grid);
        ASSERT_EQ(built.voxels.size(), 256U);
        for (const gpu::Attribute& voxel : built.voxels)
        {
            EXPECT_LT(degreesBetween(test::normalOf(voxel), {0, 1, 0}), 0.01);
        }
    }
}

TEST(VoxelNormals, OfASpherePointAwayFromItsCenter)
{
    const Grid grid{.origin = glm::vec3(0.0F), .voxel_size = 1.0F, .depth = 6};
    Scene sphere = test::sphereScene(glm::vec3(32.0F), 30.0F, 64);
    for (const bool smooth : {false, true})
    {
        if (smooth)
        {
            for (const glm::vec3& position : sphere.primitives[0].positions)
            {
                sphere.primitives[0].normals.push_back(glm::normalize(position - glm::vec3(32.0F)));
            }
        }
        const Built built = build(sphere, grid);
        const std::vector<std::uint64_t> codes = voxelCodes(device(), built.octree);
        double outward = 0; // the largest angle between a normal and the direction away from the centre
        double inward = 0;
        for (std::size_t i = 0; i < codes.size(); ++i)
        {
            glm::dvec3 center(0.5 - 32.0);
            for (int bit = 0; bit < 6; ++bit)
            {
                for (int axis = 0; axis < 3; ++axis)
                {
                    center[axis] += static_cast<double>((codes[i] >> (3 * bit + axis) & 1) << bit);
                }
            }
            const double angle = degreesBetween(test::normalOf(built.voxels[i]), center);
            outward = std::max(outward, angle);
            inward = std::max(inward, 180 - angle);
        }
        // Flat normals follow the winding, which is the same for all; smooth ones are given.
        const double worst = smooth ? outward : std::min(outward, inward);
        EXPECT_LT(worst, smooth ? 3.0 : 6.0);
    }
}

// Triangles in one voxel each: at (x, 0, z), x of them face up and z down.
TEST(VoxelNormals, AreMissingWhereTheMeanOfUnitNormalsIsShorterThanAQuarter)
{
    const Grid grid{.origin = glm::vec3(0.0F), .voxel_size = 1.0F, .depth = 4};
    std::vector<glm::vec3> corners;
    std::map<std::uint64_t, glm::ivec2> counts;
    for (int up = 0; up < 16; ++up)
    {
        for (int down = up == 0 ? 1 : 0; down < 16; ++down)
        {
            counts[codeOfCell({up, 0, down})] = {up, down};
            const auto at = [&](float x, float z)
            { return glm::vec3(static_cast<float>(up) + x, 0.5F, static_cast<float>(down) + z); };
            for (int i = 0; i < up; ++i)
            {
                corners.insert(corners.end(), {at(0.2F, 0.2F), at(0.2F, 0.8F), at(0.8F, 0.8F)});
            }
            for (int i = 0; i < down; ++i)
            {
                corners.insert(corners.end(), {at(0.2F, 0.2F), at(0.8F, 0.8F), at(0.2F, 0.8F)});
            }
        }
    }
    const Built built = build(test::triangleSoup(corners), grid, Coverage::Conservative);
    ASSERT_EQ(built.voxels.size(), counts.size());
    auto voxel = built.voxels.begin();
    for (const auto& [code, count] : counts)
    {
        const bool is_missing = 4 * std::abs(count.x - count.y) < count.x + count.y;
        EXPECT_EQ(voxel->normal == gpu::kNoNormal, is_missing) << count.x << " up, " << count.y << " down";
        if (!is_missing)
        {
            EXPECT_LT(degreesBetween(test::normalOf(*voxel), {0, count.x > count.y ? 1 : -1, 0}), 0.01);
        }
        ++voxel;
    }
}

// Checks a normal against a sum of vectors, of which the mean has the length `mean`, in floating point: where rounding
// may decide, either answer is right. Returns whether the normal is missing.
bool expectNormalOfSum(const gpu::Attribute& attribute, const glm::dvec3& sum, double mean)
{
    const bool is_missing = attribute.normal == gpu::kNoNormal;
    if (std::abs(mean - 0.25) > 0.001)
    {
        EXPECT_EQ(is_missing, mean < 0.25) << mean;
    }
    if (!is_missing)
    {
        EXPECT_LT(degreesBetween(test::normalOf(attribute), sum), 0.02);
    }
    return is_missing;
}

TEST(VoxelNormals, PointWhereTheSumsOfTheFragmentsDo)
{
    const Scene scene = test::randomTriangles(22, 3000, 64.0F);
    const Grid grid{.origin = glm::vec3(0.0F), .voxel_size = 1.0F, .depth = 6};
    BuildOptions options = {Coverage::Conservative, true, {}};
    options.keep_sums = true;
    const DeviceTree octree = buildOctree(device(), uploadScene(device(), scene, true), grid, options).octree;
    const auto voxels = device().download(octree.voxel_attributes);
    const auto sums = device().download(octree.sums.sums);
    ASSERT_EQ(octree.sums.sum_shift, 0U);
    ASSERT_EQ(voxels.size(), sums.size());
    std::size_t missing = 0;
    for (std::size_t i = 0; i < voxels.size(); ++i)
    {
        const glm::dvec3 biased(sums[i].normal_x, sums[i].normal_y, sums[i].normal_z);
        const glm::dvec3 sum = biased - 32768.0 * sums[i].fragments;
        missing += expectNormalOfSum(voxels[i], sum, glm::length(sum) / (32767.0 * sums[i].fragments)) ? 1 : 0;
    }
    EXPECT_GT(missing, voxels.size() / 100);
    EXPECT_LT(missing, voxels.size() / 2);
}

TEST(NodeAttributes, AreTheMeansOfTheirChildren)
{
    const Scene scene = test::randomTriangles(21, 300, 64.0F);
    const Grid grid{.origin = glm::vec3(0.0F), .voxel_size = 1.0F, .depth = 6};
    Scene colored = scene;
    std::mt19937 random(3);
    for (std::size_t i = 0; i < colored.primitives[0].positions.size(); ++i)
    {
        const auto uniform = [&] { return std::uniform_real_distribution<float>(0.0F, 1.0F)(random); };
        colored.primitives[0].colors.emplace_back(uniform(), uniform(), uniform(), 1.0F);
    }
    const Built built = build(colored, grid);
    const std::vector<gpu::Node> nodes = test::octreeNodes(device(), built.octree);
    std::size_t missing = 0;
    for (std::size_t level = 0; level < built.octree.levels.size(); ++level)
    {
        const bool is_leaf = level + 1 == built.octree.levels.size();
        const std::vector<gpu::Attribute>& children = is_leaf ? built.voxels : built.nodes;
        const auto [first, count] = built.octree.levels[level];
        for (std::uint32_t i = first; i < first + count; ++i)
        {
            const int child_count = std::popcount(nodes[i].mask_lo) + std::popcount(nodes[i].mask_hi);
            double sums[3] = {};
            glm::dvec3 normal_sum(0.0);
            for (int c = 0; c < child_count; ++c)
            {
                const glm::dvec3 normal = test::normalOf(children[nodes[i].base_lo + static_cast<unsigned>(c)]);
                const glm::dvec3 size = glm::abs(normal);
                normal_sum += normal / std::max(size.x + size.y + size.z, 1.0);
                for (int k = 0; k < 3; ++k)
                {
                    sums[k] +=
                        srgbToLinearTable()[channel(children[nodes[i].base_lo + static_cast<unsigned>(c)].color, k)];
                }
            }
            for (int k = 0; k < 3; ++k)
            {
                const auto mean = static_cast<std::size_t>(std::floor(sums[k] / child_count + 0.5));
                EXPECT_EQ(channel(built.nodes[i].color, k), linearToSrgbTable()[mean]) << "node " << i;
            }
            const glm::dvec3 size = glm::abs(normal_sum);
            missing += expectNormalOfSum(built.nodes[i], normal_sum, (size.x + size.y + size.z) / child_count) ? 1 : 0;
        }
    }
    EXPECT_GT(missing, 0U);
    EXPECT_LT(missing, built.nodes.size());
}

TEST(Emission, IsTheMeanOverAllFragmentsOfAVoxel)
{
    const Grid grid{.origin = glm::vec3(0.0F), .voxel_size = 1.0F, .depth = 4};
    // A lamp, and a dark sheet in the same layer that shares half of its voxels.
    Scene scene =
        test::triangleSoup({{0, 5.5F, 0}, {0, 5.5F, 16}, {16, 5.5F, 16}, {0, 5.5F, 0}, {16, 5.5F, 16}, {16, 5.5F, 0}});
    scene.materials[0].emission = {20.0F, 10.0F, 5.0F};
    scene.append(test::triangleSoup(
        {{0, 5.25F, 0}, {0, 5.25F, 16}, {8, 5.25F, 16}, {0, 5.25F, 0}, {8, 5.25F, 16}, {8, 5.25F, 0}}));
    scene.append(test::triangleSoup({{0, 9.5F, 0}, {0, 9.5F, 16}, {16, 9.5F, 16}}));
    const Built built = build(scene, grid);
    const std::vector<gpu::uvec2> words = device().download(built.octree.emission_words);
    const std::vector<gpu::uint> emission = device().download(built.octree.emission);
    const std::vector<std::uint64_t> codes = voxelCodes(device(), built.octree);
    std::size_t rank = 0;
    for (std::size_t i = 0; i < codes.size(); ++i)
    {
        const bool emissive = (words[i / 32].x >> (i % 32) & 1) != 0;
        const bool in_layer = ((codes[i] >> 1 & 1) | (codes[i] >> 4 & 1) << 1 | (codes[i] >> 7 & 1) << 2 |
                               (codes[i] >> 10 & 1) << 3) == 5;
        EXPECT_EQ(emissive, in_layer);
        EXPECT_EQ((built.voxels[i].color >> 24 & gpu::kAttributeEmissive) != 0, emissive);
        if (i % 32 == 0)
        {
            EXPECT_EQ(words[i / 32].y, rank);
        }
        if (!emissive)
        {
            continue;
        }
        const gpu::uint packed = emission[rank++];
        const double scale = std::exp2(static_cast<double>(packed >> 27) - 24) * built.octree.emission_scale;
        const glm::dvec3 radiance(scale * (packed & 511), scale * (packed >> 9 & 511), scale * (packed >> 18 & 511));
        // Each triangle that touches the voxel gives a fragment, so the lamp's share is between a third and one.
        const double share = radiance.r / 20.0;
        EXPECT_GT(share, 0.3);
        EXPECT_LT(share, 1.01);
        EXPECT_NEAR(radiance.g, radiance.r / 2, 0.05);
        EXPECT_NEAR(radiance.b, radiance.r / 4, 0.05);
        if ((codes[i] >> 9 & 1) != 0 &&
            (codes[i] & 0b1001001) != 0) // x > 8 has only the lamp (the sheet's edge touches 8)
        {
            EXPECT_NEAR(radiance.r, 20.0, 0.1);
        }
    }
    EXPECT_EQ(rank, 256U);
    EXPECT_EQ(emission.size(), rank);
}

// One set of coordinates for the colour's texture and one for the emission's give the colours and the emission of
// scenes that have only one of the textures, with its set.
TEST(Emission, MayHaveItsOwnTextureCoordinates)
{
    const Grid grid{.origin = glm::vec3(0.0F), .voxel_size = 1.0F, .depth = 6};
    std::mt19937 random(17);
    const auto uniform = [&](float high) { return std::uniform_real_distribution<float>(0.0F, high)(random); };
    Scene both = test::randomTriangles(33, 400, 64.0F);
    for (std::size_t i = 0; i < both.primitives[0].positions.size(); ++i)
    {
        both.primitives[0].uvs.emplace_back(uniform(3.0F), uniform(3.0F));
        both.primitives[0].emission_uvs.emplace_back(uniform(40.0F), uniform(2.0F)); // another level of detail
    }
    for (std::uint32_t i = 0; i < 2; ++i)
    {
        Image image{.name = "random", .width = 64, .height = 32, .rgba = {}};
        std::generate_n(std::back_inserter(image.rgba), 64 * 32 * 4,
                        [&] { return static_cast<std::uint8_t>(random() | 1U); });
        both.images.push_back(std::move(image));
        both.textures.push_back({.image = i});
    }
    both.materials[0].emission = glm::vec3(3.0F);
    both.materials[0].base_color_texture = 0;
    both.materials[0].emission_texture = 1;
    const auto with = [&](const Scene& scene, const TextureOptions& options)
    {
        const GpuScene uploaded = uploadScene(device(), scene, true, std::nullopt, options);
        return buildOctree(device(), uploaded, grid, {Coverage::Conservative, true, {}}).octree;
    };
    const DeviceTree octree = with(both, {});
    EXPECT_EQ(octreeSha256(device(), with(both, {.grid = grid, .coverage = Coverage::Conservative})),
              octreeSha256(device(), octree));

    Scene lamp = both;
    lamp.materials[0].base_color_texture = std::nullopt;
    lamp.primitives[0].uvs = std::exchange(lamp.primitives[0].emission_uvs, {});
    EXPECT_EQ(device().download(with(lamp, {}).emission), device().download(octree.emission));
    Scene plain = both;
    plain.materials[0].emission_texture = std::nullopt; // emits everywhere, as `both` does
    plain.primitives[0].emission_uvs.clear();
    const auto colors = device().download(with(plain, {}).voxel_attributes);
    const auto expected = device().download(octree.voxel_attributes);
    EXPECT_TRUE(std::ranges::equal(colors, expected, {}, &gpu::Attribute::color, &gpu::Attribute::color));
}

TEST(Attributes, SurviveMoreFragmentsInAVoxelThanTheSumsHold)
{
    const Grid grid{.origin = glm::vec3(0.0F), .voxel_size = 1.0F, .depth = 2};
    std::vector<glm::vec3> corners;
    for (int i = 0; i < 150000; ++i)
    {
        corners.insert(corners.end(), {{1.2F, 1.5F, 1.2F}, {1.2F, 1.5F, 1.8F}, {1.8F, 1.5F, 1.8F}});
    }
    Scene scene = test::triangleSoup(corners);
    scene.materials[0].base_color = {1.0F, 0.5F, 0.0F, 1.0F};
    const Built built = build(scene, grid);
    ASSERT_EQ(built.voxels.size(), 1U);
    EXPECT_NEAR(channel(built.voxels[0].color, 0), 255, 1);
    EXPECT_NEAR(channel(built.voxels[0].color, 1), 188, 1); // sRGB of 0.5
    EXPECT_EQ(channel(built.voxels[0].color, 2), 0U);
    EXPECT_LT(degreesBetween(test::normalOf(built.voxels[0]), {0, 1, 0}), 0.1);
}

void expectNoDependenceOnOrder(Scene scene, const Grid& grid)
{
    for (const Coverage coverage : {Coverage::Thin, Coverage::Conservative})
    {
        const std::string sha = octreeSha256(device(), build(scene, grid, coverage).octree);
        std::mt19937 random(9);
        for (Primitive& primitive : scene.primitives)
        {
            std::shuffle(primitive.triangles.begin(), primitive.triangles.end(), random);
        }
        std::shuffle(scene.instances.begin(), scene.instances.end(), random);
        EXPECT_EQ(octreeSha256(device(), build(scene, grid, coverage).octree), sha);
    }
}

TEST(Attributes, DoNotDependOnTheOrderOfTriangles)
{
    Scene scene = test::randomTriangles(31, 3000, 64.0F);
    scene.materials[0].base_color = {0.3F, 0.6F, 0.9F, 1.0F};
    std::mt19937 random(9);
    for (std::size_t i = 0; i < scene.primitives[0].positions.size(); ++i)
    {
        const auto uniform = [&] { return std::uniform_real_distribution<float>(0.0F, 1.0F)(random); };
        scene.primitives[0].colors.emplace_back(uniform(), uniform(), uniform(), 1.0F);
    }
    expectNoDependenceOnOrder(scene, {.origin = glm::vec3(0.0F), .voxel_size = 1.0F, .depth = 6});
}

TEST(Attributes, OfMeshesDoNotDependOnTheOrderOfTrianglesAndInstances)
{
    std::vector<std::filesystem::path> paths = {test::ownScene("atrium.glb")};
    for (const char* name : {"bunny.glb", "sponza.glb"})
    {
        if (const auto path = test::sharedScene(name))
        {
            paths.push_back(*path);
        }
    }
    for (const std::filesystem::path& path : paths)
    {
        SCOPED_TRACE(path.filename().string());
        const Scene scene = loadGltf(path);
        expectNoDependenceOnOrder(scene, Grid::around(scene.bounds(), 8));
    }
}

} // namespace
} // namespace zvo
