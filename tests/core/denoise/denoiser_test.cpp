// SPDX-License-Identifier: MIT
// Denoised pictures: nearer to the truth, no blur over edges, and earlier pictures only where they show the same.
#include "core/denoise/denoiser.h"

#include "core/light/environment.h"
#include "core/scene/camera.h"
#include "support/engine_device.h"
#include "support/lit_voxels.h"
#include "support/path_pictures.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace zvo
{
namespace
{

using test::device;
using test::LitVoxel;

constexpr std::uint32_t kWidth = 64;
constexpr std::uint32_t kHeight = 48;
constexpr std::uint32_t kHistory = 32; // samples

/// Pictures by one path tracer and one denoiser.
class Camera
{
public:
    explicit Camera(std::uint32_t width = kWidth, std::uint32_t height = kHeight)
        : m_tracer(device().device()), m_denoiser(device().device())
    {
        m_tracer.resize(width, height);
        m_denoiser.resize(width, height);
    }

    HdrImage noisy(const DeviceTree& tree, DeviceEnvironment& light, const ViewCamera& view, std::uint32_t samples,
                   PathOptions options = {})
    {
        options.features = true;
        options.reseeds = true;
        m_tracer.forget();
        const TraceCamera camera = traceCamera(view, tree.grid, m_tracer.picture().height);
        for (std::uint32_t i = 0; i < samples; ++i)
        {
            device().run([&](vk::FrameGraph& graph) { m_tracer.addSample(graph, tree, light, camera, options); });
        }
        return imageOf(m_tracer.picture());
    }

    HdrImage denoised(const DeviceTree& tree, DeviceEnvironment& light, const ViewCamera& view, std::uint32_t samples,
                      const PathOptions& options = {})
    {
        noisy(tree, light, view, samples, options);
        device().run([&](vk::FrameGraph& graph) { m_denoiser.denoise(graph, m_tracer.guided(), kHistory); });
        return imageOf(m_denoiser.picture());
    }

    // The last picture, if light of radiance 1 came from everywhere.
    HdrImage inEvenLight()
    {
        const SampledPicture picture = m_tracer.picture();
        std::vector<gpu::PixelSum> sums;
        for (const gpu::PixelFeatures& sum : device().download(m_tracer.guided().features))
        {
            sums.push_back({sum.direct + sum.albedo, 0.0F});
        }
        return pictureOf(sums, picture.width, picture.height, picture.sample_count);
    }

    Denoiser& denoiser() { return m_denoiser; }

private:
    static HdrImage imageOf(const SampledPicture& picture)
    {
        return pictureOf(device().download(picture.sums), picture.width, picture.height, picture.sample_count);
    }

    PathTracer m_tracer;
    Denoiser m_denoiser;
};

// Two walls and a floor with boxes of two colours, and a lamp that the views below do not show.
DeviceTree room()
{
    std::vector<LitVoxel> voxels;
    const LitVoxel grey = {{}, glm::uvec3(188)};
    test::addBox(voxels, {0, 0, 0}, {32, 1, 32}, grey);
    test::addBox(voxels, {0, 1, 0}, {32, 28, 1}, grey);
    test::addBox(voxels, {0, 1, 1}, {1, 28, 32}, {{}, glm::uvec3(220, 60, 40)});
    test::addBox(voxels, {8, 1, 6}, {14, 12, 12}, grey);
    test::addBox(voxels, {18, 1, 12}, {25, 6, 19}, {{}, glm::uvec3(60, 90, 220)});
    test::addBox(voxels, {12, 24, 12}, {18, 25, 18}, {{}, glm::uvec3(255), glm::vec3(1.5F)});
    return test::litTree(device(), voxels, 5);
}

ViewCamera intoTheRoom(double turn = 0.0)
{
    return ViewCamera::lookAt({30.0, 17.0, 40.0}, {13.0 + turn, 6.0, 8.0}, 0.5);
}

double meanOf(const HdrImage& image)
{
    double sum = 0;
    for (const glm::vec3& texel : image.texels)
    {
        sum += glm::dot(glm::dvec3(texel), glm::dvec3(1.0 / 3));
    }
    return sum / static_cast<double>(image.texels.size());
}

double squaredError(const HdrImage& image, const HdrImage& truth)
{
    double sum = 0;
    for (std::size_t i = 0; i < image.texels.size(); ++i)
    {
        const glm::dvec3 error = glm::dvec3(image.texels[i]) - glm::dvec3(truth.texels[i]);
        sum += glm::dot(error, error);
    }
    return sum / static_cast<double>(image.texels.size());
}

bool isFinite(const HdrImage& image)
{
    return std::ranges::all_of(image.texels,
                               [](const glm::vec3& texel) { return std::isfinite(texel.x + texel.y + texel.z); });
}

/// The room's truth, made once.
const HdrImage& truth()
{
    static const HdrImage image = []
    {
        DeviceEnvironment dark = test::constantSky(glm::vec3(0.05F));
        return Camera().noisy(room(), dark, intoTheRoom(), 512, {.bounces = 3, .seed = 1000});
    }();
    return image;
}

TEST(Denoiser, FourSamplesBecomeBetterThanManyMore)
{
    const DeviceTree tree = room();
    DeviceEnvironment light = test::constantSky(glm::vec3(0.05F));
    Camera camera;
    const HdrImage noisy = camera.noisy(tree, light, intoTheRoom(), 4, {.bounces = 3});
    const HdrImage many = camera.noisy(tree, light, intoTheRoom(), 24, {.bounces = 3});
    const HdrImage denoised = Camera().denoised(tree, light, intoTheRoom(), 4, {.bounces = 3});
    RecordProperty("noisy", std::to_string(squaredError(noisy, truth())));
    RecordProperty("denoised", std::to_string(squaredError(denoised, truth())));
    EXPECT_LT(squaredError(denoised, truth()), squaredError(noisy, truth()) / 5);
    EXPECT_LT(squaredError(denoised, truth()), squaredError(many, truth()));
    EXPECT_NEAR(meanOf(denoised) / meanOf(truth()), 1.0, 0.03) << "no light is lost";
}

TEST(Denoiser, ManySamplesAreNotSpoilt)
{
    const DeviceTree tree = room();
    DeviceEnvironment light = test::constantSky(glm::vec3(0.05F));
    Camera camera;
    const HdrImage noisy = camera.noisy(tree, light, intoTheRoom(), 128, {.bounces = 3});
    const HdrImage denoised = Camera().denoised(tree, light, intoTheRoom(), 128, {.bounces = 3});
    EXPECT_LT(squaredError(denoised, truth()), 1.5 * squaredError(noisy, truth()));
}

// The sky and the lamp, which the camera sees directly, stay as they are beside what is filtered.
TEST(Denoiser, DirectLightIsNotTouched)
{
    const DeviceTree tree = room();
    DeviceEnvironment light = test::constantSky(glm::vec3(0.5F));
    const ViewCamera past_the_room = ViewCamera::lookAt({30.0, 20.0, 40.0}, {12.0, 24.0, 8.0}, 0.9);
    const HdrImage plain = Camera().noisy(tree, light, past_the_room, 2, {.bounces = 2});
    const HdrImage denoised = Camera().denoised(tree, light, past_the_room, 2, {.bounces = 2});
    const auto countOf = [&](const HdrImage& image) { return std::ranges::count(image.texels, glm::vec3(0.5F)); };
    EXPECT_GT(countOf(plain), 500) << "pixels of the sky";
    EXPECT_EQ(countOf(denoised), countOf(plain));
    EXPECT_NE(denoised.texels, plain.texels);

    const HdrImage lamp = Camera().denoised(tree, light, past_the_room, 2, {.bounces = 0});
    EXPECT_LT(squaredError(lamp, Camera().noisy(tree, light, past_the_room, 2, {.bounces = 0})), 1e-12);
}

// A light whose square is no float is finite all the same, in this picture and in the next one.
TEST(Denoiser, VeryBrightLightIsFinite)
{
    const DeviceTree tree = room();
    DeviceEnvironment light(device().device());
    light.setSun({.direction = {0.3, 1.0, 0.8}, .irradiance = glm::dvec3(1e30)});
    Camera camera;
    EXPECT_TRUE(isFinite(camera.denoised(tree, light, intoTheRoom(), 2, {.bounces = 2})));
    EXPECT_TRUE(isFinite(camera.denoised(tree, light, intoTheRoom(0.5), 2, {.bounces = 2})));
}

// An orthographic camera that moves sideways by ten pixels sees nine tenths of the same places.
TEST(Denoiser, OrthographicCamerasKnowPlaces)
{
    const DeviceTree tree = room();
    DeviceEnvironment light = test::constantSky(glm::vec3(0.05F));
    const auto from = [](double x)
    {
        ViewCamera view = ViewCamera::lookAt({30.0 + x, 17.0, 40.0}, {13.0 + x, 6.0, 8.0}, 0.5);
        view.orthographic = true;
        view.half_height = 10.0;
        return view;
    };
    const PathOptions options = {.bounces = 3};
    const HdrImage exact = Camera().noisy(tree, light, from(0.0), 256, {.bounces = 3, .seed = 1000});
    const double alone = squaredError(Camera().denoised(tree, light, from(0.0), 2, options), exact);
    Camera camera;
    for (const double x : {3.0, 2.0, 1.0})
    {
        camera.denoised(tree, light, from(x), 2, options);
    }
    EXPECT_LT(squaredError(camera.denoised(tree, light, from(0.0), 2, options), exact), 0.75 * alone);
}

// In even light a convex body shows its colours alone: none of them reaches its neighbour.
TEST(Denoiser, ColoursDoNotBleed)
{
    std::vector<LitVoxel> voxels;
    for (std::uint32_t i = 0; i < 512; ++i)
    {
        const glm::uvec3 cell = {i % 8, i / 8 % 8, i / 64};
        const bool odd = (cell.x + cell.y + cell.z) % 2 == 1;
        voxels.push_back({cell + 4U, odd ? glm::uvec3(250, 30, 20) : glm::uvec3(40, 60, 240)});
    }
    const DeviceTree tree = test::litTree(device(), voxels, 4);
    DeviceEnvironment light = test::constantSky(glm::vec3(1.0F));
    const ViewCamera view = ViewCamera::lookAt({22.0, 18.0, 26.0}, {8.0, 8.0, 8.0}, 0.4);
    Camera camera;
    const HdrImage noisy = camera.noisy(tree, light, view, 32, {.bounces = 1});
    const HdrImage expected = camera.inEvenLight();
    const HdrImage denoised = Camera().denoised(tree, light, view, 32, {.bounces = 1});
    EXPECT_LT(squaredError(denoised, expected), 0.1 * squaredError(noisy, expected));
    EXPECT_LT(squaredError(denoised, expected), 1e-5);
}

TEST(Denoiser, EarlierPicturesOfTheSamePlaceHelp)
{
    const DeviceTree tree = room();
    DeviceEnvironment light = test::constantSky(glm::vec3(0.05F));
    const PathOptions options = {.bounces = 3};
    const double alone = squaredError(Camera().denoised(tree, light, intoTheRoom(), 2, options), truth());
    Camera camera;
    for (const double turn : {1.5, 1.0, 0.5})
    {
        camera.denoised(tree, light, intoTheRoom(turn), 2, options);
    }
    EXPECT_LT(squaredError(camera.denoised(tree, light, intoTheRoom(), 2, options), truth()), 0.75 * alone);
}

// Whatever a picture cannot know must leave it as if there was nothing before.
TEST(Denoiser, OtherPicturesDoNotCount)
{
    const DeviceTree tree = room();
    DeviceEnvironment light = test::constantSky(glm::vec3(0.05F));
    DeviceEnvironment other_light = test::constantSky(glm::vec3(0.5F));
    const PathOptions options = {.bounces = 1, .seed = 7};
    PathOptions later = options; // with the seed that the second picture gets
    later.seed = 8;
    const auto second = [&](const auto& first)
    {
        Camera camera;
        first(camera);
        return camera.denoised(tree, light, intoTheRoom(), 2, options).texels;
    };
    const std::vector<glm::vec3> alone = Camera().denoised(tree, light, intoTheRoom(), 2, later).texels;
    EXPECT_EQ(second([&](Camera& camera) { camera.denoised(tree, other_light, intoTheRoom(), 2, options); }), alone)
        << "other light";
    EXPECT_EQ(second(
                  [&](Camera& camera)
                  {
                      camera.denoised(tree, light, intoTheRoom(), 2, options);
                      camera.denoiser().forget();
                  }),
              alone)
        << "forgotten";
    const ViewCamera away = ViewCamera::lookAt({30.0, 20.0, 40.0}, {50.0, 20.0, 80.0}, 0.9);
    EXPECT_EQ(second([&](Camera& camera) { camera.denoised(tree, light, away, 2, options); }), alone)
        << "another place";
    EXPECT_NE(second([&](Camera& camera) { camera.denoised(tree, light, intoTheRoom(1.0), 2, options); }), alone)
        << "the same place";
}

// A wall that comes nearer is another place, pixel by pixel.
TEST(Denoiser, WhatMovedIsAnotherPlace)
{
    const auto wallAt = [](std::uint32_t z)
    {
        std::vector<LitVoxel> voxels;
        test::addBox(voxels, {0, 0, z}, {32, 32, z + 1}, {{}, glm::uvec3(188)});
        return test::litTree(device(), voxels, 5);
    };
    const DeviceTree far_wall = wallAt(4);
    const DeviceTree near_wall = wallAt(8);
    DeviceEnvironment light(device().device());
    light.setSun({.direction = {0.3, 1.0, 0.8}, .irradiance = glm::dvec3(2.0)});
    const ViewCamera view = ViewCamera::lookAt({16.0, 16.0, 40.0}, {16.0, 16.0, 0.0}, 0.3);
    const PathOptions options = {.bounces = 1};
    Camera camera;
    camera.denoised(far_wall, light, view, 2, options);
    PathOptions later = options;
    later.seed = 1;
    EXPECT_EQ(camera.denoised(near_wall, light, view, 2, options).texels,
              Camera().denoised(near_wall, light, view, 2, later).texels);
}

TEST(Denoiser, SmallPicturesAndEmptyTrees)
{
    const DeviceTree tree = room();
    const DeviceTree nothing = test::litTree(device(), {}, 3);
    DeviceEnvironment light = test::constantSky(glm::vec3(0.25F));
    for (const glm::uvec2 size : {glm::uvec2(1, 1), glm::uvec2(1, 9), glm::uvec2(17, 2)})
    {
        Camera camera(size.x, size.y);
        EXPECT_TRUE(isFinite(camera.denoised(tree, light, intoTheRoom(), 1, {.bounces = 2})));
        EXPECT_TRUE(isFinite(camera.denoised(tree, light, intoTheRoom(0.1), 3, {.bounces = 2})));
        const HdrImage empty = camera.denoised(nothing, light, intoTheRoom(), 1);
        EXPECT_TRUE(
            std::ranges::all_of(empty.texels, [](const glm::vec3& texel) { return texel == glm::vec3(0.25F); }));
    }
}

} // namespace
} // namespace zvo
