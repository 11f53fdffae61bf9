// SPDX-License-Identifier: MIT
// What a host's kernel finds through cones by zvo/trace.glsl, against known answers and many rays.
#include "core/dynamic/dynamic_octree.h"
#include "glsl/host_device.h"
#include "glsl/host_light.h"
#include "oracle/morton.h"
#include "support/dags.h"
#include "support/dynamic_updates.h"
#include "support/lit_voxels.h"
#include "support/octree_contents.h"
#include "support/scenes.h"
#include "support/trace_octrees.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <numbers>
#include <random>
#include <set>
#include <utility>
#include <vector>

namespace zvo
{
namespace
{

using test::deviceOfHosts;
using test::LitVoxel;

// The structs of tests/glsl/host/cones.comp.
struct Cone
{
    glm::vec3 origin;
    glm::vec3 direction;
    float aperture;
    float reach = 1e30F;
};

struct Found
{
    glm::vec4 one;
    glm::vec4 mean;
    glm::vec4 rays;
};

struct ConesPush
{
    gpu::ConstPtr<gpu::RadianceCacheTable> cache;
    gpu::ConstPtr<gpu::TreeTable> tree;
    gpu::ConstPtr<Cone> cones;
    gpu::Ptr<Found> results;
    gpu::uint count;
    gpu::uint rays;
};

struct CoveragePush
{
    gpu::ConstPtr<gpu::uvec2> masks;
    gpu::Ptr<gpu::vec3> results;
    gpu::uint count;
    gpu::uint padding = 0;
};

const LitVoxel kGreyWall = {{}, glm::uvec3(188), glm::vec3(0.0F)};

// The radiance cache of a tree, below a sky of one radiance.
struct LightOfCones : test::HostLight
{
    LightOfCones(const DeviceTree& tree, const glm::vec3& sky, const ViewCamera& view, std::uint32_t frames)
        : HostLight(tree, test::skyOf(sky), view, frames)
    {
    }

    std::vector<Found> through(const DeviceTree& tree, const std::vector<Cone>& cones, std::uint32_t rays)
    {
        return run<ConesPush, Found>("host/cones", tree, table(), cones, rays);
    }
};

// The aperture whose cone is so wide at a distance.
float apertureOf(float width, float distance)
{
    return 2.0F * std::atan(0.5F * width / distance);
}

TEST(HostCones, CountTheColumnsOfMasks)
{
    std::mt19937 random(3);
    std::vector<gpu::uvec2> masks = {{0U, 0U}, {~0U, ~0U}};
    for (std::uint32_t i = 0; i < 64; ++i)
    {
        masks.emplace_back(i < 32 ? 1U << i : 0U, i < 32 ? 0U : 1U << (i - 32));
    }
    for (std::uint32_t i = 0; i < 2000; ++i)
    {
        gpu::uvec2 mask(random(), random());
        for (std::uint32_t sparser = 0; sparser < i % 5; ++sparser)
        {
            mask &= gpu::uvec2(random(), random());
        }
        masks.push_back(mask);
    }
    const auto given = deviceOfHosts().makeBuffer("masks", std::span<const gpu::uvec2>(masks));
    vk::BufferOf<gpu::vec3> results(deviceOfHosts().device(), "results", masks.size());
    deviceOfHosts().run(
        [&](vk::FrameGraph& graph)
        {
            vk::UntypedPass pass = graph.addPass("host/coverage");
            pass.dispatch(masks.size(),
                          CoveragePush{pass.read(given), pass.write(results), static_cast<gpu::uint>(masks.size())});
        });
    const std::vector<gpu::vec3> found = deviceOfHosts().download(results);
    for (std::size_t i = 0; i < masks.size(); ++i)
    {
        std::array<std::set<std::pair<std::uint32_t, std::uint32_t>>, 3> columns;
        for (std::uint32_t cell = 0; cell < 64; ++cell)
        {
            if (((masks[i][cell / 32] >> (cell % 32)) & 1U) != 0)
            {
                const glm::uvec3 at = oracle::mortonDecode(cell);
                columns[0].emplace(at.y, at.z);
                columns[1].emplace(at.x, at.z);
                columns[2].emplace(at.x, at.y);
            }
        }
        for (int axis = 0; axis < 3; ++axis)
        {
            ASSERT_EQ(found[i][axis], static_cast<float>(columns[axis].size()) / 16.0F) << i << ", axis " << axis;
        }
    }
}

TEST(HostCones, SeeTheSkyWhereNothingIs)
{
    std::vector<LitVoxel> voxels;
    test::addBox(voxels, {0, 0, 0}, {64, 4, 64}, kGreyWall);
    const DeviceTree tree = test::litTree(deviceOfHosts(), voxels, 6);
    const glm::vec3 sky(0.5F, 1.0F, 2.0F);
    LightOfCones light(tree, sky, ViewCamera::lookAt({70.0, 60.0, 80.0}, {16.0, 16.0, 16.0}, 0.5), 4);
    const std::vector<Cone> cones = {{{32.0F, 6.0F, 32.0F}, {0, 1, 0}, 1.0F},
                                     {{32.0F, 60.0F, 32.0F}, {0.3F, 2.0F, -0.4F}, 2.5F},
                                     {{-40.0F, 10.0F, 32.0F}, {-1, 0, 0}, 0.1F},
                                     {{32.0F, 60.0F, 32.0F}, {0, -1, 0}, 1.0F, 40.0F}};
    for (const Found& found : light.through(tree, cones, 16))
    {
        EXPECT_EQ(found.one, glm::vec4(sky, 1.0F));
    }
}

// With walls of a brick no cone leaves a room, however wide the nodes are that it meets; in the small one they are
// voxels.
TEST(HostCones, HaveTheLightOfAllBouncesInAGlowingRoom)
{
    LitVoxel wall = kGreyWall;
    wall.emission = glm::vec3(0.5F);
    const float expected = 0.5F / (1.0F - static_cast<float>(test::albedoOf(wall).r));
    for (const std::uint32_t depth : {3U, 5U})
    {
        const std::uint32_t edge = 1U << depth;
        const std::uint32_t thickness = depth == 3 ? 1 : 4;
        const DeviceTree tree = test::litTree(deviceOfHosts(), test::roomOf(wall, edge, thickness), depth);
        const glm::vec3 middle(0.52F * static_cast<float>(edge));
        LightOfCones light(tree, glm::vec3(9.0F),
                           ViewCamera::lookAt(glm::dvec3(middle), glm::dvec3(middle) + glm::dvec3(1, 0.3, 0.2), 2.5),
                           256);
        std::vector<Cone> cones;
        for (const glm::vec3& direction : {glm::vec3(1, 0, 0), glm::vec3(0.2F, 1, 0.1F), glm::vec3(1, -2, -3)})
        {
            for (const float aperture : {0.02F, 0.5F, 1.0F, 1.5F})
            {
                cones.push_back({middle, direction, aperture});
            }
        }
        for (const Found& found : light.through(tree, cones, 64))
        {
            EXPECT_EQ(found.one.w, 0.0F);
            EXPECT_NEAR(found.mean.r, expected, 0.03F * expected);
        }
    }
}

using Pattern = std::function<bool(const glm::uvec3&)>;

// A wall of one voxel across a grid of 128^3, at x = kWall, where a pattern has voxels.
constexpr std::uint32_t kWall = 80;

std::vector<LitVoxel> wallOf(const Pattern& pattern, const LitVoxel& voxel)
{
    std::vector<LitVoxel> voxels;
    for (std::uint32_t i = 0; i < 128 * 128; ++i)
    {
        const glm::uvec3 cell(kWall, i % 128, i / 128);
        if (pattern(cell))
        {
            voxels.push_back({cell, voxel.color, voxel.emission});
        }
    }
    return voxels;
}

// For each of many cones: lavapipe ends the loops of an invocation after 65,535 iterations.
constexpr std::uint32_t kRays = 48;

// Cones from one distance towards many places of the wall.
std::vector<Cone> conesToWall(const glm::vec3& slope, float width, float distance)
{
    std::vector<Cone> cones;
    const glm::vec3 direction = glm::normalize(slope);
    for (std::uint32_t i = 0; i < 64; ++i)
    {
        const float number = static_cast<float>(i);
        const glm::vec3 target(static_cast<float>(kWall), 60.0F + 16.0F * glm::fract(0.7549F * number),
                               60.0F + 16.0F * glm::fract(0.5698F * number));
        cones.push_back({target - distance * direction, direction, apertureOf(width, distance)});
    }
    return cones;
}

struct Mean
{
    glm::dvec4 one{0.0};
    glm::dvec4 mean{0.0};
    glm::dvec4 rays{0.0};
};

Mean meanOf(const std::vector<Found>& all)
{
    Mean mean;
    for (const Found& found : all)
    {
        mean.one += glm::dvec4(found.one) / static_cast<double>(all.size());
        mean.mean += glm::dvec4(found.mean) / static_cast<double>(all.size());
        mean.rays += glm::dvec4(found.rays) / static_cast<double>(all.size());
    }
    return mean;
}

struct Grating
{
    const char* name;
    Pattern pattern;
    double open;
};

const std::vector<Grating>& gratings()
{
    static const std::vector<Grating> all = {
        {"a bar of 4", [](const glm::uvec3& c) { return c.y % 4 == 1; }, 0.75},
        {"2 bars of 4", [](const glm::uvec3& c) { return c.z % 4 < 2; }, 0.5},
        {"3 bars of 4", [](const glm::uvec3& c) { return c.y % 4 != 2; }, 0.25},
        {"dots", [](const glm::uvec3& c) { return c.y % 4 == 2 && c.z % 4 == 1; }, 15.0 / 16.0},
        {"blocks", [](const glm::uvec3& c) { return (c.y / 8 + c.z / 8) % 2 == 1; }, 0.5},
        {"a wall", [](const glm::uvec3&) { return true; }, 0.0}};
    return all;
}

// Gratings are open by their share of holes, and by that of rays that come through, whether a cone is so wide that it
// meets bricks (13 voxels) or nodes of 16^3 (40).
TEST(HostCones, AreOpenByTheShareOfRaysThatMeetNothing)
{
    for (const Grating& grating : gratings())
    {
        const DeviceTree tree = test::litTree(deviceOfHosts(), wallOf(grating.pattern, kGreyWall), 7);
        LightOfCones light(tree, glm::vec3(1.0F), ViewCamera::lookAt({-30.0, 64.0, 64.0}, {80.0, 64.0, 64.0}, 0.9), 1);
        for (const float width : {13.0F, 40.0F})
        {
            const float distance = std::max(20.0F, width);
            const bool is_in_nodes = grating.open != 0.5 || grating.name[0] == '2' || width == 40.0F;
            const Mean straight = meanOf(light.through(tree, conesToWall({1, 0, 0}, width, distance), kRays));
            EXPECT_NEAR(straight.one.w, grating.open, is_in_nodes ? 1e-4 : 0.05) << grating.name << ' ' << width;
            EXPECT_NEAR(straight.one.w, straight.rays.w, 0.06) << grating.name << ' ' << width;
            const Mean aslant = meanOf(light.through(tree, conesToWall({1, 0.2F, 0.1F}, width, distance), kRays));
            EXPECT_NEAR(aslant.one.w, aslant.rays.w, 0.06) << grating.name << ' ' << width;
        }
    }
}

// A cone that goes on behind what it has met does not meet that again as a part of a wider node.
TEST(HostCones, MeetNothingTwice)
{
    const DeviceTree tree = test::litTree(deviceOfHosts(), wallOf(gratings()[3].pattern, kGreyWall), 7);
    LightOfCones light(tree, glm::vec3(1.0F), ViewCamera::lookAt({-30.0, 64.0, 64.0}, {80.0, 64.0, 64.0}, 0.9), 1);
    for (const float width : {7.0F, 28.0F, 31.0F})
    {
        for (const glm::vec3& slope : {glm::vec3(1, 0.05F, 0), glm::vec3(1, 0.4F, -0.3F), glm::vec3(1, 0.7F, 0.7F)})
        {
            const Mean mean = meanOf(light.through(tree, conesToWall(slope, width, 2.0F * width), kRays));
            EXPECT_NEAR(mean.one.w, mean.rays.w, 0.05) << width << ' ' << slope.y;
        }
    }
}

// Black lamps in a wall, below a dark sky.
TEST(HostCones, SeeLampsAsRaysDo)
{
    const LitVoxel lamp = {{}, glm::uvec3(0), glm::vec3(1.5F, 1.0F, 0.5F)};
    for (const Grating& grating : gratings())
    {
        const DeviceTree tree = test::litTree(deviceOfHosts(), wallOf(grating.pattern, lamp), 7);
        LightOfCones light(tree, glm::vec3(0.0F), ViewCamera::lookAt({-30.0, 64.0, 64.0}, {80.0, 64.0, 64.0}, 0.9), 1);
        for (const float width : {3.0F, 13.0F, 40.0F})
        {
            const Mean mean =
                meanOf(light.through(tree, conesToWall({1, 0.1F, 0.1F}, width, std::max(20.0F, width)), kRays));
            EXPECT_NEAR(mean.mean.r, mean.rays.r, 0.1 * 1.5) << grating.name << ' ' << width;
        }
    }
}

// The same voxels in an octree, in a DAG, and with an overlay.
TEST(HostCones, FindTheSameInAnyTree)
{
    DynamicOptions options;
    options.emission_scale = 1.0F;
    DynamicOctree dynamic(deviceOfHosts(), test::litTree(deviceOfHosts(), wallOf(gratings()[1].pattern, kGreyWall), 7),
                          options);
    dynamic.add(uploadDynamicMesh(deviceOfHosts(), test::boxScene(glm::vec3(0.0F), glm::vec3(17.0F)), true, 1.0F),
                {{glm::translate(glm::mat4(1.0F), glm::vec3(72.3F, 61.2F, 50.1F))}, {}, {}});
    test::updateAll(deviceOfHosts(), dynamic);
    const DeviceTree& overlaid = dynamic.tree();
    ASSERT_TRUE(overlaid.hasOverlays());
    const DeviceTree octree =
        test::octreeOf(deviceOfHosts(), test::cellsOf(deviceOfHosts(), overlaid), overlaid.grid, 1.0F);
    const DeviceTree dag = test::svdagOf(deviceOfHosts(), octree);
    LightOfCones light(octree, glm::vec3(1.0F), ViewCamera::lookAt({-30.0, 64.0, 64.0}, {80.0, 64.0, 64.0}, 0.9), 16);
    std::vector<Cone> cones = conesToWall({1, 0.2F, 0.1F}, 13.0F, 20.0F);
    for (const Cone& cone : conesToWall({1, -0.2F, 0.3F}, 50.0F, 45.0F))
    {
        cones.push_back(cone);
    }
    const std::vector<Found> expected = light.through(octree, cones, 1);
    EXPECT_GT(meanOf(expected).one.r, meanOf(expected).one.w);
    const std::vector<Found> of_dag = light.through(dag, cones, 1);
    const std::vector<Found> of_overlay = light.through(overlaid, cones, 1);
    for (std::size_t i = 0; i < cones.size(); ++i)
    {
        EXPECT_EQ(of_dag[i].one, expected[i].one) << i;
        EXPECT_EQ(of_overlay[i].one, expected[i].one) << i;
    }
}

} // namespace
} // namespace zvo
