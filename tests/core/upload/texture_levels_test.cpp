// SPDX-License-Identifier: MIT
#include "core/upload/texture_levels.h"

#include "core/upload/gpu_scene.h"
#include "oracle/texture.h"
#include "runtime/trees.h"
#include "support/engine_device.h"
#include "support/errors.h"
#include "support/materials_scene.h"
#include "support/same_bytes.h"
#include "support/scenes.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cstring>
#include <limits>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace zvo
{
namespace
{

using test::device;

Image noise(std::uint32_t width, std::uint32_t height, std::uint32_t seed)
{
    std::mt19937 random(seed);
    Image image{"noise", width, height, {}};
    for (std::uint32_t i = 0; i < width * height * 4; ++i)
    {
        image.rgba.push_back(static_cast<std::uint8_t>(random()));
    }
    return image;
}

/// The square [0, edge]^2 at z = 0.5, on which an image lies once.
Scene square(float edge, Image image)
{
    Scene scene = test::triangleSoup(
        {{0, 0, 0.5F}, {edge, 0, 0.5F}, {0, edge, 0.5F}, {0, edge, 0.5F}, {edge, 0, 0.5F}, {edge, edge, 0.5F}});
    scene.primitives[0].uvs = {{0, 0}, {1, 0}, {0, 1}, {0, 1}, {1, 0}, {1, 1}};
    scene.images.push_back(std::move(image));
    scene.textures.push_back({});
    scene.materials[0].base_color_texture = 0;
    return scene;
}

std::uint32_t leastLevel(const Scene& scene, const Grid& grid, Coverage coverage = Coverage::Thin)
{
    return leastLevels(scene, {true}, grid, coverage).at(0);
}

/// An image that another one becomes when it is decoded. count: of the calls.
Image deferred(const Image& image, std::atomic<int>& count)
{
    Image result{image.name, image.width, image.height, {}};
    result.decode = [bytes = image.rgba, &count]
    {
        ++count;
        Pixels pixels(static_cast<std::uint8_t*>(std::malloc(bytes.size())));
        std::memcpy(pixels.get(), bytes.data(), bytes.size());
        return pixels;
    };
    return result;
}

struct Built
{
    std::vector<gpu::Attribute> voxels;
    std::vector<gpu::uint> emission;
};

Built build(const Scene& scene, const Grid& grid, Coverage coverage, const TextureOptions& textures)
{
    const GpuScene uploaded = uploadScene(device(), scene, true, std::nullopt, textures);
    const DeviceTree octree = buildOctree(device(), uploaded, grid, {coverage, true, {}}).octree;
    return {device().download(octree.voxel_attributes), device().download(octree.emission)};
}

TEST(TextureLevels, ThoseOfTexelsFarSmallerThanAVoxelAreNotStored)
{
    // 8 x 8 voxels for 64 x 64 texels: level 3 has as many.
    const Scene scene = square(1.0F, noise(64, 64, 1));
    const Grid grid{.origin = glm::vec3(0.0F), .voxel_size = 0.125F, .depth = 4};
    EXPECT_EQ(leastLevel(scene, grid), 3U);
    EXPECT_EQ(leastLevel(scene, {glm::vec3(0.0F), 1.0F, 1}), 6U);
    EXPECT_EQ(leastLevel(scene, {glm::vec3(0.0F), 1.0F / 128, 8}), 0U);
    EXPECT_EQ(levelCount(64, 64), 7U);
    EXPECT_EQ(levelCount(1, 5), 3U);

    const GpuScene all = uploadScene(device(), scene, true);
    const GpuScene some = uploadScene(device(), scene, true, std::nullopt, {grid, Coverage::Thin});
    EXPECT_EQ(all.texels.count(), 4096U + 1024 + 256 + 64 + 16 + 4 + 1);
    EXPECT_EQ(some.texels.count(), 64U + 16 + 4 + 1);
    EXPECT_LE(some.texels.bytes(), 6U * 64); // 6 bytes a texel of the largest level
}

TEST(TextureLevels, OfTrianglesThatAreNotVoxelizedDoNotMatter)
{
    const Grid grid{.origin = glm::vec3(0.0F), .voxel_size = 0.125F, .depth = 4};
    Scene scene = square(1.0F, noise(64, 64, 1));
    const auto add = [&](const std::vector<glm::vec3>& corners)
    {
        Scene other = square(1.0F, noise(1, 1, 1));
        std::copy(corners.begin(), corners.end(), other.primitives[0].positions.begin());
        other.primitives[0].material = 0;
        scene.instances.push_back({static_cast<std::uint32_t>(scene.primitives.size()), glm::mat4(1.0F)});
        scene.primitives.push_back(std::move(other.primitives[0]));
        scene.primitives.back().triangles.resize(1);
    };
    add({{9, 0, 0}, {99, 0, 0}, {9, 90, 0}}); // beside the grid
    add({{0, 0, 0}, {std::numeric_limits<float>::infinity(), 0, 0}, {0, 9, 0}});
    add({{0, 0, 0}, {1e9F, 0, 0}, {0, 9, 0}}); // beyond the lattice
    EXPECT_EQ(leastLevel(scene, grid), 3U);
    add({{0, 0, 0}, {1, 0, 0}, {1, 0, 0}}); // without area, it is in the conservative set alone
    scene.primitives.back().uvs.assign(6, glm::vec2(0.5F));
    EXPECT_EQ(leastLevel(scene, grid), 3U);
    EXPECT_EQ(leastLevel(scene, grid, Coverage::Conservative), 0U);
    add({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}); // all of it has the colour of one point
    scene.primitives.back().uvs.assign(6, glm::vec2(0.5F));
    EXPECT_EQ(leastLevel(scene, grid), 0U);
}

TEST(TextureLevels, AreThoseOfTheOracle)
{
    std::mt19937 random(8);
    std::uniform_real_distribution<float> uniform(0.0F, 1.0F);
    const Grid grid{.origin = glm::vec3(0.0F), .voxel_size = 1.0F / 64, .depth = 6};
    std::vector<int> seen(10, 0);
    for (int i = 0; i < 400; ++i)
    {
        Scene scene = square(1.0F, noise(256, 128, 3));
        scene.primitives[0].triangles.resize(1);
        const float stretch = std::exp2(std::uniform_real_distribution<float>(-4.0F, 6.0F)(random));
        for (std::size_t corner = 0; corner < 3; ++corner)
        {
            scene.primitives[0].positions[corner] = {uniform(random), uniform(random), uniform(random)};
            scene.primitives[0].uvs[corner] = stretch * glm::vec2(uniform(random), uniform(random));
        }
        glm::i64vec3 q[3];
        glm::i64vec2 uv[3];
        for (std::size_t corner = 0; corner < 3; ++corner)
        {
            const glm::vec3 p = scene.primitives[0].positions[corner] * (64.0F * 256.0F);
            q[corner] = {std::llround(p.x), std::llround(p.y), std::llround(p.z)};
            uv[corner] = {oracle::textureCoordinate(scene.primitives[0].uvs[corner].x),
                          oracle::textureCoordinate(scene.primitives[0].uvs[corner].y)};
        }
        const glm::i64vec3 a = q[1] - q[0];
        const glm::i64vec3 b = q[2] - q[0];
        const std::int64_t area = std::max(
            {std::abs(a.y * b.z - a.z * b.y), std::abs(a.z * b.x - a.x * b.z), std::abs(a.x * b.y - a.y * b.x)});
        const glm::i64vec2 c = uv[1] - uv[0];
        const glm::i64vec2 d = uv[2] - uv[0];
        const std::uint32_t expected =
            oracle::MipChain(scene.images[0]).levelFor(std::abs(c.x * d.y - c.y * d.x), area);
        ASSERT_EQ(leastLevel(scene, grid, Coverage::Conservative), expected) << i;
        ++seen.at(expected);
    }
    EXPECT_TRUE(std::all_of(seen.begin(), seen.begin() + 9, [](int count) { return count > 0; }));
}

TEST(TextureLevels, LeftOutChangeNoAttribute)
{
    for (const std::uint32_t depth : {3U, 5U, 7U})
    {
        for (const Coverage coverage : {Coverage::Thin, Coverage::Conservative})
        {
            Scene scene = test::materialsScene(32.0F, 60);
            for (Image& image : scene.images)
            {
                image = noise(257, 96, depth);
            }
            const Grid grid = Grid::around(scene.bounds(), depth);
            const Built all = build(scene, grid, coverage, {});
            const Built some = build(scene, grid, coverage, {grid, coverage});
            ASSERT_GT(all.voxels.size(), 50U);
            ASSERT_FALSE(all.emission.empty());
            EXPECT_TRUE(test::sameBytes(all.voxels, some.voxels)) << depth;
            EXPECT_TRUE(test::sameBytes(all.emission, some.emission)) << depth;
        }
    }
}

TEST(TextureUpload, DecodesEachImageOnceAndTellsHowFarItIs)
{
    const Image image = noise(40, 30, 2);
    Scene decoded = square(1.0F, image);
    for (int i = 1; i < 5; ++i)
    {
        decoded.append(square(1.0F, image));
    }
    Scene scene = decoded;
    std::atomic<int> count = 0;
    for (Image& each : scene.images)
    {
        each = deferred(each, count);
    }
    const Grid grid = Grid::around(scene.bounds(), 4);
    std::vector<double> progress;
    const auto listen = [&](double done) { progress.push_back(done); };
    const GpuScene uploaded = uploadScene(device(), scene, true, std::nullopt, {grid, Coverage::Thin, listen});
    EXPECT_EQ(count, 5);
    EXPECT_EQ(progress, (std::vector<double>{0.2, 0.4, 0.6, 0.8, 1.0}));
    EXPECT_TRUE(uploaded.warnings.empty());
    const GpuScene expected = uploadScene(device(), decoded, true, std::nullopt, {grid, Coverage::Thin});
    EXPECT_TRUE(test::sameBytes(device().download(uploaded.texels), device().download(expected.texels)));
}

TEST(TextureUpload, ImagesThatDoNotDecodeAreWhiteWithAWarning)
{
    Scene scene = square(1.0F, noise(32, 32, 2));
    scene.append(square(1.0F, noise(32, 32, 3)));
    scene.images[0].rgba = {};
    scene.images[0].decode = []() -> Pixels { throw Error(ErrorCode::Input, "a.gltf: images[0]: torn"); };
    const Grid grid = Grid::around(scene.bounds(), 3);
    const GpuScene uploaded = uploadScene(device(), scene, true, std::nullopt, {grid, Coverage::Thin});
    ASSERT_EQ(uploaded.warnings.size(), 1U);
    EXPECT_EQ(uploaded.warnings[0], "texture left out: a.gltf: images[0]: torn");
    scene.images[0] = noise(32, 32, 2);
    std::fill(scene.images[0].rgba.begin(), scene.images[0].rgba.end(), std::uint8_t{255});
    const GpuScene white = uploadScene(device(), scene, true, std::nullopt, {grid, Coverage::Thin});
    EXPECT_TRUE(test::sameBytes(device().download(uploaded.texels), device().download(white.texels)));
}

TEST(TextureUpload, ThatADeviceCannotHoldIsRefusedBeforeDecoding)
{
    vk::HeadlessOptions options;
    options.overrides.max_buffer_bytes = 1U << 20U;
    vk::HeadlessDevice small(options, zvoKernels());
    std::atomic<int> count = 0;
    Image big = noise(1024, 512, 1);
    big.name = "big.png";
    Scene scene = square(1.0F, deferred(big, count));
    scene.append(square(1.0F, deferred(noise(16, 16, 1), count)));
    test::expectParts(test::messageOf([&] { uploadScene(small, scene, true); }, ErrorCode::Memory),
                      {"scale down big.png, of 1024 x 512 pixels"});
    EXPECT_EQ(count, 0);
    const Grid grid = Grid::around(scene.bounds(), 4);
    EXPECT_LE(uploadScene(small, scene, true, std::nullopt, {grid, Coverage::Thin}).texels.bytes(), 1U << 12U);
}

} // namespace
} // namespace zvo
