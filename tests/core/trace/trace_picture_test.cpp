// SPDX-License-Identifier: MIT
// Options that change how pictures are made do not change what they show.
#include "core/base/morton.h"
#include "core/trace/trace.h"
#include "core/upload/gpu_scene.h"
#include "oracle/trace.h"
#include "runtime/trees.h"
#include "support/engine_device.h"
#include "support/pictures.h"
#include "support/scenes.h"
#include "support/trace_octrees.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <random>
#include <vector>

namespace zvo
{
namespace
{

using test::hitCount;
using test::manyCameras;
using test::Picture;

using test::device;

Picture takeAny(const DeviceTree& octree, const TraceCamera& camera, std::uint32_t width, std::uint32_t height,
                const TraceOptions& options)
{
    return test::takePicture(device(), octree, camera, width, height, options);
}

/// Takes a picture, and expects that all of its rays got an answer.
Picture take(const DeviceTree& octree, const TraceCamera& camera, std::uint32_t width, std::uint32_t height,
             const TraceOptions& options)
{
    Picture picture = takeAny(octree, camera, width, height, options);
    EXPECT_EQ(picture.capped_rays, 0U);
    return picture;
}

void expectSameHits(const Picture& a, const Picture& b)
{
    ASSERT_EQ(a.hits.size(), b.hits.size());
    for (std::size_t i = 0; i < a.hits.size(); ++i)
    {
        ASSERT_EQ(a.hits[i].index, b.hits[i].index) << "pixel " << i;
        if (a.hits[i].index != gpu::kHitMiss)
        {
            ASSERT_EQ(a.hits[i].t, b.hits[i].t) << "pixel " << i;
            ASSERT_EQ(a.hits[i].where, b.hits[i].where) << "pixel " << i;
        }
    }
    EXPECT_EQ(a.image, b.image);
}

TEST(TracePicture, BeamDoesNotChangeThePicture)
{
    std::mt19937 random(6);
    const std::pair<std::uint32_t, test::Codes> sets[] = {
        {1, {0, 5}},
        {2, test::randomCodes(2, 9, random)},
        {3, test::randomCodes(3, 9, random)},
        {5, test::randomCodes(5, 60, random)},
        {6, test::sphereShell(6, 20.0)},
        {7, test::randomCodes(7, 400, random)},
        {8, test::randomCodes(8, 3000, random)},
        {11, test::randomCodes(11, 3000, random)},
        {15, test::randomCodes(15, 300, random)},
    };
    std::uint32_t saved_tiles = 0;
    for (const auto& [depth, codes] : sets)
    {
        DeviceTree octree = test::octreeOf(device(), codes, depth);
        test::addAttributes(device(), octree);
        std::size_t number = 0;
        for (const ViewCamera& camera : manyCameras(octree.grid))
        {
            SCOPED_TRACE("depth " + std::to_string(depth) + " camera " + std::to_string(number++));
            const TraceCamera rays = traceCamera(camera, octree.grid, 150);
            TraceOptions options;
            const Picture with = take(octree, rays, 203, 150, options);
            options.beam = false;
            const Picture without = take(octree, rays, 203, 150, options);
            expectSameHits(with, without);
            EXPECT_EQ(without.live_tiles, 26U * 19U);
            saved_tiles += without.live_tiles - with.live_tiles;
        }
    }
    EXPECT_GT(saved_tiles, 5000U);
}

TEST(TracePicture, BeamDoesNotChangeThePictureOfCoarserNodes)
{
    std::mt19937 random(16);
    std::uint32_t saved_tiles = 0;
    for (const std::uint32_t depth : {5U, 6U, 9U})
    {
        const DeviceTree octree = test::octreeOf(device(), test::randomCodes(depth, 300, random), depth);
        std::size_t number = 0;
        for (const ViewCamera& camera : manyCameras(octree.grid))
        {
            const TraceCamera rays = traceCamera(camera, octree.grid, 90);
            for (const auto& [level, pixels] : {std::pair(1U, 0.0F),
                                                {2U, 0.0F},
                                                {3U, 0.0F},
                                                {4U, 0.0F},
                                                {UINT32_MAX, 2.0F},
                                                {UINT32_MAX, 20.0F},
                                                {2U, 9.0F}})
            {
                SCOPED_TRACE("depth " + std::to_string(depth) + " camera " + std::to_string(number) + " level " +
                             std::to_string(level) + " pixels " + std::to_string(pixels));
                TraceOptions options;
                options.detail_level = level;
                options.detail_pixels = pixels;
                const Picture with = take(octree, rays, 120, 90, options);
                options.beam = false;
                const Picture without = take(octree, rays, 120, 90, options);
                expectSameHits(with, without);
                saved_tiles += without.live_tiles - with.live_tiles;
            }
            ++number;
        }
    }
    EXPECT_GT(saved_tiles, 1000U);
}

TEST(TracePicture, HitsEqualTheReference)
{
    constexpr std::uint32_t kDepth = 6;
    const test::Codes codes = test::spongeCodes(kDepth);
    const DeviceTree octree = test::octreeOf(device(), codes, kDepth);
    const oracle::VoxelTracer tracer(codes, kDepth);
    for (const ViewCamera& view : manyCameras(octree.grid))
    {
        const TraceCamera camera = traceCamera(view, octree.grid, 41);
        const Picture picture = take(octree, camera, 67, 41, {});
        const gpu::CameraRays& rays = camera.rays;
        // A GPU need not round quotients correctly. Then a ray that meets an edge may hit the voxel beside it.
        const bool is_exact = device().device().report().type == "cpu";
        int other_count = 0;
        for (int y = 0; y < 41; ++y)
        {
            for (int x = 0; x < 67; ++x)
            {
                const glm::vec3 offset = static_cast<float>(2 * x + 1 - 67) * rays.half_pixel_x +
                                         static_cast<float>(2 * y + 1 - 41) * rays.half_pixel_y;
                const glm::vec3 origin = camera.orthographic ? rays.origin + offset : rays.origin;
                const glm::vec3 direction = camera.orthographic ? rays.forward : rays.forward + offset;
                const auto expected = tracer.trace(oracle::makeRay(origin, direction, gpu::kTraceTimeMin));
                const gpu::Hit& hit = picture.hits[static_cast<std::size_t>(y * 67 + x)];
                ASSERT_EQ(hit.index != gpu::kHitMiss, expected.has_value());
                if (expected)
                {
                    ASSERT_NEAR(hit.t, expected->t, is_exact ? 0.0F : 1e-5F * expected->t);
                    other_count += codes.at(hit.index) != expected->code ? 1 : 0;
                }
            }
        }
        EXPECT_LE(other_count, is_exact ? 0 : 3);
    }
}

TEST(TracePicture, ItsBuffersTellAllTheMemoryThatTheyTake)
{
    const vk::MemoryAllocator& memory = device().device().memory();
    for (const auto& [width, height] : {std::pair{1U, 1U}, {300U, 201U}})
    {
        const std::uint64_t used = memory.usedBytes();
        const TraceBuffers buffers(device().device(), width, height);
        constexpr std::uint64_t kRoundingMax = std::uint64_t{8} * 256;
        EXPECT_LE(buffers.bytes(), memory.usedBytes() - used);
        EXPECT_GE(buffers.bytes() + kRoundingMax, memory.usedBytes() - used);
        EXPECT_EQ(buffers.bytes(), buffers.starts.bytes() + buffers.live.bytes() + buffers.args.bytes() +
                                       buffers.rounds.bytes() + buffers.status.bytes() + buffers.hits.bytes() +
                                       buffers.light.bytes() + buffers.sky.bytes() + buffers.image.bytes());
    }
}

TEST(TracePicture, SizesThatDoNotFillTilesLeaveNothingUnwritten)
{
    const DeviceTree octree = test::octreeOf(device(), test::sphereShell(5, 14.0), 5);
    for (const auto& [width, height] : {std::pair{1U, 1U}, {8U, 8U}, {9U, 7U}, {65U, 3U}, {130U, 67U}})
    {
        const ViewCamera view = ViewCamera::framing({glm::vec3(0.0F), glm::vec3(32.0F)}, double(width) / height);
        const Picture picture = take(octree, traceCamera(view, octree.grid, height), width, height, {});
        for (const gpu::uint pixel : picture.image)
        {
            ASSERT_EQ(pixel >> 24, 255U);
        }
        EXPECT_GT(hitCount(picture), 0U);
    }
}

TEST(TracePicture, MoreLiveTilesThanOneRowOfWorkgroupsAreAllTraced)
{
    // Inside a shell every tile is live. The tiles past the first row of workgroups do not fill the last row.
    const DeviceTree octree = test::octreeOf(device(), test::sphereShell(5, 14.0), 5);
    const ViewCamera view = ViewCamera::lookAt(glm::dvec3(16.0), glm::dvec3(17.0, 16.5, 16.2), 1.0);
    constexpr std::uint32_t kWidth = 8 * 331;
    constexpr std::uint32_t kHeight = 8 * 100;
    const Picture picture = take(octree, traceCamera(view, octree.grid, kHeight), kWidth, kHeight, {});
    static_assert(kWidth / 8 * (kHeight / 8) > gpu::kTilesFold);
    EXPECT_EQ(picture.live_tiles, kWidth / 8 * (kHeight / 8));
    EXPECT_EQ(hitCount(picture), kWidth * kHeight);
}

TEST(TracePicture, EveryViewOfAnEmptyOctreeIsBackground)
{
    const DeviceTree octree = test::octreeOf(device(), {}, 5);
    const ViewCamera view = ViewCamera::framing({glm::vec3(0.0F), glm::vec3(32.0F)}, 1.0);
    for (const View shown : {View::Color, View::Albedo, View::Normal, View::Depth, View::Level, View::Iterations,
                             View::Voxel, View::Bricks, View::Origin})
    {
        TraceOptions options;
        options.view = shown;
        const Picture picture = take(octree, traceCamera(view, octree.grid, 40), 40, 40, options);
        EXPECT_EQ(picture.live_tiles, 0U);
        EXPECT_EQ(hitCount(picture), 0U);
        if (shown != View::Color)
        {
            EXPECT_EQ(picture.image, std::vector<gpu::uint>(1600, 255U << 24));
        }
    }
}

TEST(TracePicture, ViewsShowWhatTheyAreNamedAfter)
{
    // A wall of voxels across the grid fills the picture, seen from the front.
    const test::Codes codes = test::codesWhere(4, [](const glm::uvec3& voxel) { return voxel.z == 3; });
    DeviceTree octree = test::octreeOf(device(), codes, 4);
    const std::vector<gpu::Attribute> attributes(codes.size(), {200U | 100U << 8 | 50U << 16, 0U}); // normal +z
    octree.voxel_attributes = device().makeBuffer("attributes", std::span<const gpu::Attribute>(attributes));
    const ViewCamera front = ViewCamera::lookAt({8, 8, 24}, {8, 8, 0}, 0.2);
    const ViewCamera back = ViewCamera::lookAt({8, 8, -8}, {8, 8, 0}, 0.2);
    const auto pixel = [&](const ViewCamera& camera, View view)
    {
        TraceOptions options;
        options.view = view;
        return take(octree, traceCamera(camera, octree.grid, 16), 16, 16, options).image.at(8 * 16 + 8) & 0xFFFFFF;
    };
    EXPECT_EQ(pixel(front, View::Albedo), 200U | 100U << 8 | 50U << 16);
    EXPECT_EQ(pixel(front, View::Normal), 128U | 128U << 8 | 255U << 16);
    EXPECT_EQ(pixel(back, View::Normal), 128U | 128U << 8 | 0U << 16); // two-sided, so it is turned towards the viewer
    // The wall's face is 20 voxels away, the grid's faces are at 8 and 24.
    const auto depth = static_cast<gpu::uint>(255.0 * (1.0 - 0.9 * (20.0 - 8.0) / (24.0 - 8.0)) + 0.5);
    EXPECT_EQ(pixel(front, View::Depth), depth * (1U + (1U << 8) + (1U << 16)));
    EXPECT_NE(pixel(front, View::Iterations), 0U);
}

// A ball of which the lower half is voxels without normals, as of both sides of a thin shell. There the normals are the
// faces', as everywhere without attributes.
TEST(TracePicture, VoxelsWithoutNormalsAreShadedByTheFacesThatRaysEnter)
{
    const auto is_in = [](const glm::uvec3& voxel) { return glm::length(glm::dvec3(voxel) - 15.5) < 14.0; };
    const test::Codes codes = test::codesWhere(5, is_in);
    DeviceTree octree = test::octreeOf(device(), codes, 5);
    const TraceCamera camera = traceCamera(ViewCamera::lookAt({60, 40, 50}, {16, 16, 16}, 0.6), octree.grid, 128);
    TraceOptions options;
    options.view = View::Normal;
    const Picture faces = take(octree, camera, 128, 128, options);
    std::vector<gpu::Attribute> attributes;
    for (const std::uint64_t code : codes)
    {
        const bool has_normal = cellOfCode(code).y >= 16;
        attributes.push_back({0x808080U, has_normal ? 0U : gpu::kNoNormal}); // normal +z
    }
    octree.voxel_attributes = device().makeBuffer("attributes", std::span<const gpu::Attribute>(attributes));
    const Picture normals = take(octree, camera, 128, 128, options);
    constexpr gpu::uint kFront = 128U | 128U << 8 | 255U << 16;
    std::size_t of_faces = 0;
    std::size_t of_attributes = 0;
    for (std::size_t i = 0; i < faces.image.size(); ++i)
    {
        of_faces += normals.image[i] == faces.image[i] && (faces.image[i] & 0xFFFFFF) != kFront ? 1 : 0;
        of_attributes += normals.image[i] != faces.image[i] ? 1 : 0;
        ASSERT_TRUE(normals.image[i] == faces.image[i] || (normals.image[i] & 0xFFFFFF) == kFront) << i;
    }
    EXPECT_GT(of_faces, 1000U);
    EXPECT_GT(of_attributes, 1000U);
}

TEST(TracePicture, AWallShadesWhatIsBehindIt)
{
    // A floor, with a roof over half of it; the sun is straight above.
    const test::Codes codes =
        test::codesWhere(5, [](const glm::uvec3& voxel) { return voxel.y == 0 || (voxel.y == 12 && voxel.x < 16); });
    const DeviceTree octree = test::octreeOf(device(), codes, 5);
    const TraceCamera camera = traceCamera(ViewCamera::lookAt({16, 8, 60}, {16, 0, 16}, 0.3), octree.grid, 32);
    TraceOptions options;
    options.to_sun = {0.0, 1.0, 0.0};
    const Picture lit = take(octree, camera, 64, 32, options);
    const auto red = [&](int x, int y) { return lit.image.at(static_cast<std::size_t>(y * 64 + x)) & 255U; };
    EXPECT_LT(red(26, 16) + 40, red(38, 16));
    options.shadows = false;
    const Picture unshaded = take(octree, camera, 64, 32, options);
    EXPECT_GT(unshaded.image.at(16 * 64 + 26) & 255U, red(26, 16) + 40);
}

TEST(TracePicture, OcclusionDarkensCorners)
{
    // A floor and a wall behind it, in the shade, seen from above.
    const DeviceTree octree = test::octreeOf(
        device(), test::codesWhere(6, [](const glm::uvec3& v) { return v.y == 0 || (v.z == 0 && v.y < 30); }), 6);
    const TraceCamera camera = traceCamera(ViewCamera::lookAt({32, 60, 33}, {32, 0, 32}, 0.9), octree.grid, 64);
    TraceOptions options;
    options.sun = 0.0F;
    options.shadows = false;
    options.occlusion_rays = 16;
    options.occlusion_reach = 0.3F;
    const Picture picture = take(octree, camera, 64, 64, options);
    const auto red = [&](int y) { return picture.image.at(static_cast<std::size_t>(y * 64 + 32)) & 255U; };
    EXPECT_GT(red(40), 20U);
    EXPECT_LT(red(0) + 10, red(40)); // beside the wall
    options.occlusion_rays = 0;
    const Picture open = take(octree, camera, 64, 64, options);
    EXPECT_LT(red(0) + 10, open.image.at(32) & 255U);
}

TEST(TracePicture, RoundsDoNotChangeThePicture)
{
    constexpr std::uint32_t kIterationsMax = 9;
    constexpr std::uint32_t kDepth = 6;
    DeviceTree octree = test::octreeOf(device(), test::spongeCodes(kDepth), kDepth);
    test::addAttributes(device(), octree);
    std::uint32_t iterations_max = 0;
    std::size_t number = 0;
    for (const ViewCamera& camera : manyCameras(octree.grid))
    {
        SCOPED_TRACE("camera " + std::to_string(number++));
        const TraceCamera rays = traceCamera(camera, octree.grid, 47);
        TraceOptions options;
        const Picture at_once = take(octree, rays, 61, 47, options);
        options.iterations_max = kIterationsMax;
        const Picture in_rounds = take(octree, rays, 61, 47, options);
        expectSameHits(at_once, in_rounds);
        EXPECT_EQ(at_once.light, in_rounds.light);
        options.view = View::Iterations;
        const Picture counted = take(octree, rays, 61, 47, options);
        iterations_max = std::max(iterations_max, *std::max_element(counted.light.begin(), counted.light.end()));
    }
    EXPECT_GT(iterations_max, 2 * kIterationsMax);
}

TEST(TracePicture, OcclusionRaysOfAPixelShareItsIterations)
{
    constexpr std::uint32_t kDepth = 6;
    const DeviceTree octree = test::octreeOf(device(), test::spongeCodes(kDepth), kDepth);
    const TraceCamera camera =
        traceCamera(ViewCamera::framing({glm::vec3(0.0F), glm::vec3(64.0F)}, 1.0), octree.grid, 64);
    TraceOptions options;
    options.shadows = false;
    options.occlusion_reach = 1.0F;
    options.occlusion_rays = 1;
    options.iterations_max = 100; // enough for each ray, but not for all rays of a pixel
    const Picture one = take(octree, camera, 64, 64, options);
    options.occlusion_rays = 64;
    const Picture capped = takeAny(octree, camera, 64, 64, options);
    options.iterations_max = gpu::kTraceIterationsMax;
    const Picture whole = take(octree, camera, 64, 64, options);
    EXPECT_GT(capped.capped_rays, hitCount(one));
    EXPECT_LT(capped.capped_rays, 64 * hitCount(one));
    EXPECT_NE(capped.light, whole.light);
}

TEST(TracePicture, DetailShowsCoarserNodesFartherAway)
{
    DeviceTree octree = test::octreeOf(device(), test::codesWhere(7, [](const glm::uvec3& v) { return v.y == 3; }), 7);
    const TraceCamera camera = traceCamera(ViewCamera::lookAt({64, 30, 130}, {64, 0, 40}, 1.0), octree.grid, 64);
    TraceOptions options;
    options.detail_pixels = 3.0F;
    const Picture picture = take(octree, camera, 64, 64, options);
    const auto level = [&](int y)
    { return picture.hits.at(static_cast<std::size_t>(y * 64 + 32)).where.y >> 22 & 15U; };
    EXPECT_EQ(level(60), 4U);
    EXPECT_LT(level(28), 4U);
}

// A floor looks as it does with its triangles wound the other way, also from near the ground.
TEST(TracePicture, FloorsMayBeWoundAsCeilings)
{
    const std::vector<glm::vec3> corners = {{0, 0.1F, 0}, {0, 0.1F, 1}, {1, 0.2F, 1},
                                            {0, 0.1F, 0}, {1, 0.2F, 1}, {1, 0.2F, 0}};
    std::vector<glm::vec3> reversed = corners;
    std::reverse(reversed.begin(), reversed.end());
    const Grid grid{.origin = glm::vec3(0.0F), .voxel_size = 1.0F / 128, .depth = 7};
    const auto look = [&](const std::vector<glm::vec3>& triangles, double height)
    {
        const ViewCamera camera = ViewCamera::lookAt({0.5, height, 1.6}, {0.5, 0.15, 0.4}, 0.7);
        const GpuScene scene = uploadScene(device(), test::triangleSoup(triangles), true);
        const DeviceTree octree = buildOctree(device(), scene, grid, {}).octree;
        return take(octree, traceCamera(camera, grid, 96), 128, 96, {});
    };
    for (const double height : {0.4, 0.7, 2.0})
    {
        const Picture up = look(corners, height);
        const Picture down = look(reversed, height);
        std::size_t equal_count = 0;
        for (std::size_t i = 0; i < up.image.size(); ++i)
        {
            equal_count += up.hits[i].index != gpu::kHitMiss && up.image[i] == down.image[i] ? 1 : 0;
        }
        const std::uint32_t hits = hitCount(up);
        EXPECT_GT(hits, 1000U);
        EXPECT_GE(static_cast<double>(equal_count), 0.9 * hits) << "from " << height;
    }
}

} // namespace
} // namespace zvo
