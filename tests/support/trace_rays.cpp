// SPDX-License-Identifier: MIT
#include "support/trace_rays.h"

#include "oracle/morton.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <random>

namespace zvo::test
{

std::optional<DeviceHit> unpack(const gpu::Hit& hit)
{
    if (hit.index == gpu::kHitMiss)
    {
        return std::nullopt;
    }
    const std::uint64_t where = hit.where.x | std::uint64_t{hit.where.y} << 32;
    const std::uint64_t coordinate = (std::uint64_t{1} << gpu::kHitCoordinateBits) - 1;
    const auto part = [&](std::uint32_t axis)
    { return static_cast<std::uint32_t>(where >> (axis * gpu::kHitCoordinateBits) & coordinate); };
    return DeviceHit{hit.t,
                     hit.index,
                     static_cast<std::uint32_t>(where >> gpu::kHitFaceShift & 3),
                     static_cast<std::uint32_t>(where >> gpu::kHitLevelShift & 15),
                     {part(0), part(1), part(2)}};
}

gpu::Ray deviceRay(const oracle::Ray& ray, float t_max)
{
    return {ray.origin, ray.t_min, ray.inv, t_max};
}

TracedRays traceRaysOf(vk::HeadlessDevice& device, const DeviceTree& tree, const std::vector<gpu::Ray>& rays,
                       const TraceOptions& options)
{
    const vk::BufferOf<gpu::Ray> ray_buffer = device.makeBuffer("rays", std::span<const gpu::Ray>(rays));
    vk::BufferOf<gpu::Hit> hits(device.device(), "hits", rays.size());
    vk::BufferOf<gpu::DispatchArgs> rounds(device.device(), "rounds", gpu::kTraceRoundsMax);
    vk::BufferOf<gpu::TraceStatus> status(device.device(), "status", 1);
    device.run(
        [&](vk::FrameGraph& graph)
        {
            graph.fill(status, 0);
            traceRays(graph, tree, ray_buffer, hits, rounds, status, options);
        });
    return {device.download(hits), device.download(status).at(0).capped_rays};
}

std::vector<gpu::Hit> traceOnDevice(vk::HeadlessDevice& device, const DeviceTree& tree,
                                    const std::vector<gpu::Ray>& rays, const TraceOptions& options,
                                    std::uint32_t capped_count)
{
    TracedRays traced = traceRaysOf(device, tree, rays, options);
    EXPECT_EQ(traced.capped_rays, capped_count);
    return std::move(traced.hits);
}

oracle::Ray pickRay(std::mt19937& random, std::uint32_t resolution, const Codes& codes, bool very_far)
{
    const auto pick = [&](int low, int high) { return std::uniform_int_distribution<int>(low, high)(random); };
    const auto uniform = [&](float low, float high)
    { return std::uniform_real_distribution<float>(low, high)(random); };
    const auto edge = 1.0F / static_cast<float>(resolution);
    int kind = pick(0, 8);
    kind = kind == 6 && !very_far ? 5 : kind;
    glm::vec3 origin{uniform(0.5F, 2.5F), uniform(0.5F, 2.5F), uniform(0.5F, 2.5F)};
    glm::vec3 direction{uniform(-1.0F, 1.0F), uniform(-1.0F, 1.0F), uniform(-1.0F, 1.0F)};
    const glm::vec3 voxel(oracle::mortonDecode(codes[random() % codes.size()]));
    const bool aims = pick(0, 1) == 1;
    for (int axis = 0; axis < 3; ++axis)
    {
        if (kind == 1 || kind == 2)
        {
            origin[axis] = 1.0F + edge * static_cast<float>(pick(-2, static_cast<int>(resolution) + 2));
        }
        if (aims) // at a point of a voxel, or one of its corners
        {
            const float inside = kind == 1 ? static_cast<float>(pick(0, 1)) : uniform(0.0F, 1.0F);
            direction[axis] = 1.0F + edge * (voxel[axis] + inside) - origin[axis];
        }
        if (kind == 2 || kind == 3)
        {
            direction[axis] = pick(0, 1) == 0 ? -0.0F : static_cast<float>(pick(-1, 1));
        }
        if (kind == 4)
        {
            direction[axis] *= axis == pick(0, 2) ? 1.0F : 1e-6F;
        }
        if (kind == 5 || kind == 6) // from far away, where planes may coincide by rounding
        {
            origin[axis] =
                1.0F + edge * (voxel[axis] + uniform(0.0F, 1.0F)) - direction[axis] * (kind == 5 ? 100.0F : 1e6F);
        }
        if (kind == 7)
        {
            direction[axis] *= std::ldexp(1.0F, pick(-60, 60));
        }
        if (kind == 8) // from a point of a voxel
        {
            origin[axis] = 1.0F + edge * (voxel[axis] + uniform(-1.0F, 2.0F));
        }
    }
    const float t_min = pick(0, 3) == 0 ? uniform(0.0F, 1.0F) : 0.0F;
    return oracle::makeRay(origin, direction, std::max(t_min, gpu::kTraceTimeMin));
}

std::vector<gpu::Ray> pickRays(std::mt19937& random, std::uint32_t resolution, const Codes& codes, std::uint32_t count)
{
    std::vector<gpu::Ray> rays(count);
    std::ranges::generate(rays, [&] { return deviceRay(pickRay(random, resolution, codes)); });
    return rays;
}

void expectEqualsReference(vk::HeadlessDevice& device, const DeviceTree& tree, const Codes& codes, std::uint32_t count,
                           const TraceOptions& options, bool very_far)
{
    const Grid& grid = tree.grid;
    const std::uint32_t depth = grid.depth;
    const oracle::VoxelTracer tracer(codes, depth);
    std::mt19937 random(depth * 1000 + count);
    std::vector<oracle::Ray> rays;
    std::vector<gpu::Ray> device_rays;
    for (std::uint32_t i = 0; i < count; ++i)
    {
        rays.push_back(pickRay(random, grid.rootResolution(), codes, very_far));
        device_rays.push_back(deviceRay(rays.back()));
    }
    const std::vector<gpu::Hit> hits = traceOnDevice(device, tree, device_rays, options);
    std::uint32_t hit_count = 0;
    for (std::uint32_t i = 0; i < count; ++i)
    {
        const std::optional<oracle::Hit> expected = tracer.trace(rays[i]);
        const std::optional<DeviceHit> hit = unpack(hits[i]);
        ASSERT_EQ(hit.has_value(), expected.has_value()) << "depth " << depth << " ray " << i;
        if (!expected)
        {
            continue;
        }
        ++hit_count;
        ASSERT_LT(hit->index, codes.size()) << "depth " << depth << " ray " << i;
        ASSERT_EQ(codes[hit->index], expected->code) << "depth " << depth << " ray " << i;
        ASSERT_EQ(oracle::mortonEncode(hit->cell), expected->code) << "depth " << depth << " ray " << i;
        ASSERT_EQ(std::bit_cast<std::uint32_t>(hit->t), std::bit_cast<std::uint32_t>(expected->t))
            << "depth " << depth << " ray " << i;
        ASSERT_EQ(hit->face, expected->face) << "depth " << depth << " ray " << i;
        ASSERT_EQ(hit->level, grid.nodeLevels());
    }
    EXPECT_GE(hit_count, count / 10) << "depth " << depth;
}

} // namespace zvo::test
