// SPDX-License-Identifier: MIT
// What a host's kernel finds of a radiance cache by zvo/trace.glsl, against known answers and zvo's own pictures.
#include "glsl/host_device.h"
#include "glsl/host_light.h"
#include "support/lit_voxels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace zvo
{
namespace
{

using test::deviceOfHosts;

using test::LitVoxel;
using test::skyOf;

// The structs of tests/glsl/host/radiance_cache.comp.
struct Place
{
    glm::vec3 position;
    glm::vec3 normal;
    glm::vec3 direction;
};

struct Light
{
    glm::vec4 irradiance;
    glm::vec4 gathered;
    glm::vec4 met;
    float open;
};

struct Push
{
    gpu::ConstPtr<gpu::RadianceCacheTable> cache;
    gpu::ConstPtr<gpu::TreeTable> tree;
    gpu::ConstPtr<Place> places;
    gpu::Ptr<Light> results;
    gpu::uint count;
    gpu::uint rays;
    float reach;
    gpu::uint seed;
};

// Voxels and their radiance cache.
struct Lit : test::HostLight
{
    Lit(const std::vector<LitVoxel>& voxels, std::uint32_t depth, DeviceEnvironment&& outside, const ViewCamera& view,
        std::uint32_t frames)
        : Lit(test::litTree(deviceOfHosts(), voxels, depth), std::move(outside), view, frames)
    {
    }

    Lit(DeviceTree&& lit, DeviceEnvironment&& outside, const ViewCamera& view, std::uint32_t frames)
        : HostLight(lit, std::move(outside), view, frames), tree(std::move(lit))
    {
    }

    std::vector<Light> at(const std::vector<Place>& places, std::uint32_t rays = 256, float reach = 1e30F)
    {
        return at(places, table(), rays, reach);
    }

    std::vector<Light> at(const std::vector<Place>& places, const gpu::RadianceCacheTable& cache, std::uint32_t rays,
                          float reach)
    {
        return run<Push, Light>("host/radiance_cache", tree, cache, places, rays, reach, gpu::uint{7});
    }

    DeviceTree tree;
};

const LitVoxel kWhite = {{}, glm::uvec3(255), glm::vec3(0.0F)};
const LitVoxel kGrey = {{}, glm::uvec3(188), glm::vec3(0.0F)};

// A white ball in an even sky receives the sky from everywhere, whether a host's surface is before or behind the faces
// of the voxels, and whichever way it faces.
TEST(HostRadianceCache, IsTheSkyOnAConvexBody)
{
    constexpr double kRadius = 9.0;
    std::vector<LitVoxel> voxels;
    for (std::uint32_t i = 0; i < 32 * 32 * 32; ++i)
    {
        const glm::uvec3 cell(i % 32, i / 32 % 32, i / 1024);
        if (glm::length(glm::dvec3(cell) + 0.5 - 16.0) <= kRadius)
        {
            voxels.push_back({cell, kWhite.color, kWhite.emission});
        }
    }
    const glm::vec3 radiance(0.5F, 1.0F, 2.0F);
    Lit lit(voxels, 5, skyOf(radiance), ViewCamera::lookAt({70.0, 60.0, 80.0}, {16.0, 16.0, 16.0}, 0.25), 400);
    std::vector<Place> places;
    for (double latitude = 0.1; latitude < 1.5; latitude += 0.1)
    {
        for (double longitude = 0.1; longitude < 1.5; longitude += 0.1)
        {
            const glm::dvec3 normal(std::cos(latitude) * std::cos(longitude), std::sin(latitude),
                                    std::cos(latitude) * std::sin(longitude));
            for (const double off : {-0.6, 0.0, 0.6})
            {
                places.push_back({glm::vec3(16.0 + (kRadius + off) * normal), glm::vec3(normal), glm::vec3(normal)});
            }
        }
    }
    float mean = 0.0F;
    std::size_t outside_count = 0;
    for (const Light& light : lit.at(places))
    {
        ASSERT_GT(light.irradiance.w, 0.2F);
        EXPECT_NEAR(light.irradiance.r, radiance.r, 0.06F * radiance.r);
        EXPECT_NEAR(light.irradiance.b, radiance.b, 0.06F * radiance.b);
        mean += light.irradiance.g / static_cast<float>(places.size());
        EXPECT_EQ(light.open, 1.0F);
        EXPECT_NEAR(light.gathered.g, radiance.g, 1e-4F);
        EXPECT_EQ(light.gathered.w, 1.0F);
        outside_count += light.met.w == 1.0F ? 1 : 0; // else the ray begins in a voxel
        EXPECT_NEAR(light.met.b, light.met.w * radiance.b, 1e-4F);
    }
    EXPECT_NEAR(mean, radiance.g, 0.005F * radiance.g);
    EXPECT_GT(outside_count, places.size() / 4);
}

// How well light is known that is a brick's, because no face is near.
constexpr float kOfBrick = 1.0F / 16.0F;

// In a closed room whose walls glow, all bounces add up to the sum of a geometric series, at walls and for what stands
// in the room without being among the voxels.
TEST(HostRadianceCache, IsThatOfAllBouncesInAGlowingRoom)
{
    LitVoxel wall = kGrey;
    wall.emission = glm::vec3(0.5F);
    Lit lit(test::roomOf(wall, 8), 3, skyOf(glm::vec3(0.0F)), ViewCamera::lookAt({4.2, 4.1, 4.3}, {1.0, 2.0, 3.0}, 2.5),
            256);
    const float expected = 0.5F / (1.0F - static_cast<float>(test::albedoOf(wall).r));
    const std::vector<Place> places = {{{4.3F, 1.1F, 3.4F}, {0, 1, 0}, {0, -1, 0.1F}},
                                       {{4.3F, 0.6F, 3.4F}, {0, 1, 0}, {0.3F, 0.6F, 0.9F}},
                                       {{1.0F, 3.3F, 3.9F}, {1, 0, 0}, {1, 0, 0}},
                                       {{6.9F, 3.7F, 5.2F}, {-1, 0, 0}, {-1, 0.3F, 0}},
                                       {{3.1F, 4.4F, 4.0F}, glm::normalize(glm::vec3(1, 2, -1)), {0, 1, 0}}};
    const std::vector<Light> lights = lit.at(places, 256);
    for (std::size_t i = 0; i < places.size(); ++i)
    {
        const bool is_in_room = i == 4;
        EXPECT_NEAR(lights[i].irradiance.w, is_in_room ? kOfBrick : 1.0F, 1e-6F) << i;
        EXPECT_NEAR(lights[i].irradiance.r, expected, 0.01F * expected) << i;
        EXPECT_NEAR(lights[i].gathered.r, expected, 0.01F * expected) << i;
        EXPECT_EQ(lights[i].open, 0.0F) << i;
        EXPECT_EQ(lights[i].met.w, 1.0F) << i;
        EXPECT_NEAR(lights[i].met.g, i == 1 ? 0.5F : expected, 0.01F * expected) << i << ": one ray begins in a voxel";
    }
    for (const Light& light : lit.at(places, 64, 0.5F))
    {
        EXPECT_EQ(light.open, 1.0F) << "walls are further away";
    }
}

// Above a floor in the sun, of which a box hides the half; no light but that of the sun, straight from above.
TEST(HostRadianceCache, OfTheSunIsWhereItsShadowIsNot)
{
    std::vector<LitVoxel> voxels;
    test::addBox(voxels, {0, 0, 0}, {16, 1, 16}, kGrey);
    test::addBox(voxels, {8, 10, 0}, {16, 11, 16}, kGrey);
    Lit lit(voxels, 4, skyOf(glm::vec3(0.0F), {.direction = {0, 1, 0}, .irradiance = glm::dvec3(1.5)}),
            ViewCamera::lookAt({-14.0, 12.0, 8.0}, {8.0, 1.0, 8.0}, 0.9), 400);
    const std::vector<Place> places = {{{3.2F, 1.0F, 8.3F}, {0, 1, 0}, {1, -0.1F, 0}},
                                       {{12.2F, 1.0F, 8.3F}, {0, 1, 0}, {0, 1, 0}},
                                       {{3.2F, 1.0F, 8.3F}, {0, -1, 0}, {0, 1, 0}}};
    const std::vector<Light> lights = lit.at(places, 256);
    EXPECT_NEAR(lights[0].irradiance.r, 1.5F, 0.15F);
    EXPECT_NEAR(lights[0].gathered.r, 1.5F, 0.15F);
    EXPECT_LT(lights[1].irradiance.r, 0.3F);
    EXPECT_GT(lights[1].irradiance.r, 0.005F) << "from the floor beside";
    EXPECT_NEAR(lights[1].gathered.r, lights[1].irradiance.r, 0.25F * lights[1].irradiance.r);
    EXPECT_LT(lights[1].open, 0.8F);
    EXPECT_NEAR(lights[2].irradiance.w, kOfBrick, 1e-6F) << "nothing is cached below but under the box";
    EXPECT_LT(lights[2].irradiance.r, 0.3F);
    EXPECT_EQ(lights[2].met, glm::vec4(0.0F, 0.0F, 0.0F, 1.0F)) << "the sky, without the sun";
}

// Where no light is cached, shaders find none.
TEST(HostRadianceCache, IsNotFoundInAnEmptyTable)
{
    std::vector<LitVoxel> voxels;
    test::addBox(voxels, {2, 2, 2}, {6, 6, 6}, kWhite);
    Lit lit(voxels, 3, skyOf(glm::vec3(1.0F)), ViewCamera::lookAt({19.0, 15.0, 23.0}, {4.0, 4.0, 4.0}, 0.4), 1);
    const std::vector<Place> places = {{{4.0F, 6.0F, 4.0F}, {0, 1, 0}, {0, -1, 0}},
                                       {{4.0F, 8.0F, 4.0F}, {0, -1, 0}, {0, -1, 0}},
                                       {{4.0F, 8.0F, 4.0F}, {0, -1, 0}, {0, 1, 0}}};
    for (const Light& light : lit.at(places, {}, 16, 1e30F))
    {
        EXPECT_EQ(light.irradiance, glm::vec4(0.0F));
        EXPECT_EQ(light.gathered, glm::vec4(0.0F));
        EXPECT_EQ(light.met, glm::vec4(0.0F)) << "of voxels, and of what is outside";
    }
}

// Rays of a picture see what zvo's picture of the same light shows.
TEST(HostRadianceCache, OfHitsIsThatOfZvosPicture)
{
    std::vector<LitVoxel> voxels = test::roomOf(kGrey, 16);
    for (LitVoxel& voxel : voxels)
    {
        voxel.color = voxel.cell.x == 0 ? glm::uvec3(200, 60, 60) : voxel.color;
    }
    test::addBox(voxels, {6, 12, 6}, {10, 13, 10}, {{}, glm::uvec3(90), glm::vec3(1.5F, 1.0F, 0.5F)});
    test::addBox(voxels, {4, 1, 4}, {8, 6, 7}, kWhite);
    const ViewCamera view = ViewCamera::lookAt({13.0, 9.0, 13.5}, {5.0, 5.0, 5.0}, 1.2);
    Lit lit(voxels, 4, skyOf(glm::vec3(0.0F)), view, 300);
    lit.tracer.beginPicture(test::cachedOptions());
    constexpr std::uint32_t kEdge = Lit::kEdge;
    lit.addSample(lit.tree, view);
    const SampledPicture sampled = lit.tracer.samples(test::cachedOptions());
    const HdrImage picture = pictureOf(deviceOfHosts().download(sampled.sums), kEdge, kEdge, 1);
    std::vector<Place> places;
    for (std::uint32_t i = 0; i < kEdge * kEdge; ++i)
    {
        const double half = std::tan(0.5 * view.vertical_fov) / kEdge;
        const double x = 2.0 * (i % kEdge) + 1.0 - kEdge;
        const double y = 2.0 * (i / kEdge) + 1.0 - kEdge; // NOLINT(bugprone-integer-division)
        places.push_back({glm::vec3(view.position), glm::vec3(0, 1, 0),
                          glm::vec3(view.forward + half * (x * view.right - y * view.up))});
    }
    const std::vector<Light> lights = lit.at(places, 1);
    double difference = 0.0;
    std::uint32_t far_count = 0;
    for (std::uint32_t i = 0; i < kEdge * kEdge; ++i)
    {
        ASSERT_EQ(lights[i].met.w, 1.0F) << i;
        const double off = std::abs(double{lights[i].met.g} / double{picture.texels[i].g} - 1.0);
        difference += off / (kEdge * kEdge);
        far_count += off > 0.02 ? 1 : 0;
    }
    EXPECT_LT(difference, 0.005);
    EXPECT_LT(far_count, kEdge * kEdge / 200) << "rays in world space may meet another face at an edge";
}

} // namespace
} // namespace zvo
