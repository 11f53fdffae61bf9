// SPDX-License-Identifier: MIT
// Rays that a host's kernels trace with zvo/trace.glsl (tests/glsl): in world space, and resumed where they stopped.
#include "glsl/host_device.h"
#include "glsl/host_trees.h"
#include "oracle/morton.h"
#include "oracle/trace.h"
#include "support/dags.h"
#include "support/trace_octrees.h"
#include "support/trace_rays.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <random>
#include <span>
#include <vector>

namespace zvo
{
namespace
{

using test::CodeSet;
using test::dagWith;
using test::deviceOfHosts;
using test::octreeWith;
using test::readTree;
using test::tableOf;

// The struct of tests/glsl/host/rays.comp.
struct WorldRay
{
    glm::vec3 origin;
    float t_min;
    glm::vec3 direction;
    float t_max;
};

struct Met
{
    gpu::Hit hit;
    gpu::Hit coarse;
    gpu::vec3 position;
    gpu::uint occluded;
};

struct RaysPush
{
    gpu::ConstPtr<gpu::TreeTable> tree;
    gpu::ConstPtr<WorldRay> rays;
    gpu::Ptr<Met> results;
    gpu::uint count;
    float detail;
};

// The struct of tests/glsl/host/steps.comp.
struct Both
{
    std::array<gpu::Hit, 2> hits;
    std::array<gpu::uint, 2> call_counts;
};

struct StepsPush
{
    std::array<gpu::ConstPtr<gpu::TreeTable>, 2> trees;
    gpu::ConstPtr<gpu::Ray> rays;
    gpu::Ptr<Both> results;
    gpu::uint count;
    gpu::uint padding = 0;
};

// Rays in world space, from around the grid to points in voxels or past them.
std::vector<WorldRay> worldRays(const Grid& grid, const test::Codes& codes, std::uint32_t count)
{
    std::mt19937 random(count);
    const auto uniform = [&](float low, float high)
    { return std::uniform_real_distribution<float>(low, high)(random); };
    const float edge = grid.voxel_size * static_cast<float>(grid.resolution());
    std::vector<WorldRay> rays;
    for (std::uint32_t i = 0; i < count; ++i)
    {
        WorldRay ray{};
        const glm::vec3 voxel(oracle::mortonDecode(codes[random() % codes.size()]));
        glm::vec3 target;
        for (int axis = 0; axis < 3; ++axis)
        {
            ray.origin[axis] = grid.origin[axis] + edge * uniform(-1.0F, 2.0F);
            target[axis] = grid.origin[axis] + grid.voxel_size * (voxel[axis] + uniform(0.1F, 0.9F));
        }
        ray.direction = (i % 3 == 0 ? 7.5F : 1.0F) * (target - ray.origin);
        ray.t_min = i % 5 == 0 ? 0.01F : 0.0F;
        ray.t_max = i % 4 == 0 ? uniform(0.0F, 1.2F) : i % 4 == 1 ? std::numeric_limits<float>::infinity() : 2.0F;
        rays.push_back(ray);
    }
    return rays;
}

std::vector<Met> meet(const DeviceTree& tree, const std::vector<WorldRay>& rays, float detail)
{
    const vk::BufferOf<gpu::TreeTable> table = tableOf(tree);
    const vk::BufferOf<WorldRay> ray_buffer = deviceOfHosts().makeBuffer("rays", std::span<const WorldRay>(rays));
    vk::BufferOf<Met> results(deviceOfHosts().device(), "results", rays.size());
    deviceOfHosts().run(
        [&](vk::FrameGraph& graph)
        {
            vk::UntypedPass pass = graph.addPass("host/rays");
            readTree(pass, tree);
            const RaysPush push = {pass.read(table), pass.read(ray_buffer), pass.write(results),
                                   static_cast<gpu::uint>(rays.size()), detail};
            pass.dispatch(rays.size(), push);
        });
    return deviceOfHosts().download(results);
}

// The ray in unit space, rounded as in shaders.
oracle::Ray unitRay(const Grid& grid, const WorldRay& ray)
{
    const float edge = grid.voxel_size * static_cast<float>(grid.rootResolution());
    return oracle::makeRay(1.0F + (ray.origin - grid.origin) / edge, ray.direction / edge,
                           std::max(ray.t_min, gpu::kTraceTimeMin));
}

TEST(HostGlsl, WorldRaysHitWhatEveryVoxelAskedOnItsOwnSays)
{
    constexpr std::uint32_t kCount = 3000;
    for (const std::uint32_t depth : {6U, 7U})
    {
        std::mt19937 random(depth);
        const test::Codes codes = depth == 6 ? test::sphereShell(6, 20.0) : test::randomCodes(7, 5000, random);
        test::Codes blocks;
        for (const std::uint64_t code : codes)
        {
            blocks.push_back(code >> 6);
        }
        blocks.erase(std::unique(blocks.begin(), blocks.end()), blocks.end());
        DeviceTree octree = test::octreeOf(deviceOfHosts(), codes, depth);
        octree.grid.origin = {-3.7F, 12.25F, 0.3F};
        octree.grid.voxel_size = 0.37F;
        const DeviceTree dag = test::svdagOf(deviceOfHosts(), octree);
        const Grid& grid = octree.grid;
        const oracle::VoxelTracer tracer(codes, depth);
        const oracle::VoxelTracer block_tracer(blocks, depth - 2);
        const std::vector<WorldRay> rays = worldRays(grid, codes, kCount);
        for (const DeviceTree& tree : {std::cref(octree), std::cref(dag)})
        {
            const std::vector<Met> mets = meet(tree, rays, 4.04F * grid.voxel_size);
            const bool is_exact =
                deviceOfHosts().device().report().type == "cpu"; // others need not round quotients correctly
            std::uint32_t hit_count = 0;
            std::uint32_t open_count = 0;
            for (std::uint32_t i = 0; i < kCount; ++i)
            {
                const auto expectSame =
                    [&](const gpu::Hit& met, const oracle::VoxelTracer& reference, std::uint32_t level)
                {
                    std::optional<oracle::Hit> expected = reference.trace(unitRay(grid, rays[i]));
                    if (expected && !(expected->t <= rays[i].t_max))
                    {
                        expected.reset();
                    }
                    const std::optional<test::DeviceHit> hit = test::unpack(met);
                    ASSERT_EQ(hit.has_value(), expected.has_value()) << i;
                    if (hit)
                    {
                        ASSERT_EQ(oracle::mortonEncode(hit->cell), expected->code) << i;
                        ASSERT_NEAR(hit->t, expected->t, is_exact ? 0.0F : 4e-6F) << i;
                        ASSERT_EQ(hit->face, expected->face) << i;
                        ASSERT_EQ(hit->level, level) << i;
                    }
                };
                expectSame(mets[i].hit, tracer, grid.nodeLevels());
                expectSame(mets[i].coarse, block_tracer, grid.nodeLevels() - 1);
                const std::optional<test::DeviceHit> hit = test::unpack(mets[i].hit);
                ASSERT_EQ(mets[i].occluded != 0, hit.has_value()) << i;
                (hit ? hit_count : open_count) += 1;
                if (hit)
                {
                    const glm::dvec3 point =
                        glm::dvec3(rays[i].origin) + static_cast<double>(hit->t) * glm::dvec3(rays[i].direction);
                    ASSERT_LT(glm::length(glm::dvec3(mets[i].position) - point),
                              1e-5 * static_cast<double>(grid.voxel_size) * grid.rootResolution())
                        << i;
                }
            }
            EXPECT_GT(hit_count, kCount / 2);
            EXPECT_GT(open_count, kCount / 10);
        }
    }
}

TEST(HostGlsl, RaysThatAreNoneHitNothing)
{
    const DeviceTree octree =
        octreeWith({3, test::codesWhere(3, [](const glm::uvec3&) { return true; })}, AttributeFormat::Bytes8);
    constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    const WorldRay good = {glm::vec3(-1.0F), 0.0F, glm::vec3(1.0F), kInfinity};
    std::vector<WorldRay> rays(7, good);
    rays[1].origin.y = kNan;
    rays[2].direction.x = kNan;
    rays[3].origin.z = kInfinity;
    rays[4].direction.z = -kInfinity;
    rays[5].t_max = kNan;
    rays[6].t_min = kInfinity;
    const std::vector<Met> mets = meet(octree, rays, 0.0F);
    EXPECT_EQ(mets[0].hit.index, 0U);
    EXPECT_EQ(mets[0].position, gpu::vec3(0.0F));
    for (std::size_t i = 1; i < rays.size(); ++i)
    {
        EXPECT_EQ(mets[i].hit.index, gpu::kHitMiss) << i;
        EXPECT_EQ(mets[i].occluded, 0U) << i;
    }
}

TEST(HostGlsl, UnfinishedRaysResumeInTwoTreesAtOnce)
{
    constexpr std::uint32_t kSteps = 20;
    std::mt19937 random(74);
    const CodeSet deep = {9, test::randomCodes(9, 20000, random)};
    const CodeSet shallow = {6, test::spongeCodes(6)};
    const DeviceTree octree = octreeWith(shallow, AttributeFormat::Bytes8);
    const DeviceTree dag = dagWith(deep, AttributeFormat::Bytes8);
    const std::array<const DeviceTree*, 2> trees = {&dag, &octree};
    const std::vector<gpu::Ray> rays = test::pickRays(random, dag.grid.rootResolution(), deep.codes, 2049);
    const std::array tables = {tableOf(dag), tableOf(octree)};
    const vk::BufferOf<gpu::Ray> ray_buffer = deviceOfHosts().makeBuffer("rays", std::span<const gpu::Ray>(rays));
    vk::BufferOf<Both> results(deviceOfHosts().device(), "results", rays.size());
    deviceOfHosts().run(
        [&](vk::FrameGraph& graph)
        {
            vk::UntypedPass pass = graph.addPass("host/steps", {kSteps});
            readTree(pass, *trees[0]);
            readTree(pass, *trees[1]);
            const StepsPush push = {{pass.read(tables[0]), pass.read(tables[1])},
                                    pass.read(ray_buffer),
                                    pass.write(results),
                                    static_cast<gpu::uint>(rays.size())};
            pass.dispatch(rays.size(), push);
        });
    const std::vector<Both> both = deviceOfHosts().download(results);
    for (std::size_t k = 0; k < 2; ++k)
    {
        const std::vector<gpu::Hit> expected = test::traceOnDevice(deviceOfHosts(), *trees.at(k), rays);
        std::uint32_t calls_max = 0;
        for (std::size_t i = 0; i < rays.size(); ++i)
        {
            const gpu::Hit& hit = both[i].hits.at(k);
            ASSERT_EQ(hit.index, expected[i].index) << i;
            if (hit.index != gpu::kHitMiss)
            {
                ASSERT_EQ(std::bit_cast<std::uint32_t>(hit.t), std::bit_cast<std::uint32_t>(expected[i].t)) << i;
                ASSERT_EQ(hit.where, expected[i].where) << i;
            }
            calls_max = std::max(calls_max, both[i].call_counts.at(k));
        }
        EXPECT_GT(calls_max, 2U);
    }
}

} // namespace
} // namespace zvo
