// SPDX-License-Identifier: MIT
// Where the rays of a picture's tiles start, compared with each voxel's own time in double precision.
#include "core/trace/trace.h"

#include "oracle/morton.h"
#include "support/engine_device.h"
#include "support/pictures.h"
#include "support/trace_octrees.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <random>
#include <string>
#include <vector>

namespace zvo
{
namespace
{

using test::device;

constexpr std::uint32_t kPictureWidth = 150;
constexpr std::uint32_t kPictureHeight = 100;
constexpr double kNever = std::numeric_limits<double>::infinity();

// The rays of a tile: where they are along each axis after time t is in [low_from + t * low_by, high_from + t *
// high_by].
struct TileRays
{
    glm::dvec3 low_from{kNever};
    glm::dvec3 high_from{-kNever};
    glm::dvec3 low_by{kNever};
    glm::dvec3 high_by{-kNever};
};

TileRays raysOfTile(const TraceCamera& camera, const glm::uvec2& tile)
{
    const glm::dvec3 origin(camera.rays.origin);
    const glm::dvec3 forward(camera.rays.forward);
    TileRays rays;
    for (const std::uint32_t corner : {0U, 1U, 2U, 3U}) // pixels may be outside of the picture, as tiles may
    {
        const glm::dvec2 pixel(tile.x * gpu::kTileEdge + (corner & 1U) * (gpu::kTileEdge - 1),
                               tile.y * gpu::kTileEdge + (corner >> 1U) * (gpu::kTileEdge - 1));
        const glm::dvec2 n = 2.0 * pixel + 1.0 - glm::dvec2(kPictureWidth, kPictureHeight);
        const glm::dvec3 offset =
            n.x * glm::dvec3(camera.rays.half_pixel_x) + n.y * glm::dvec3(camera.rays.half_pixel_y);
        const glm::dvec3 from = camera.orthographic ? origin + offset : origin;
        const glm::dvec3 by = camera.orthographic ? forward : forward + offset;
        rays.low_from = glm::min(rays.low_from, from);
        rays.high_from = glm::max(rays.high_from, from);
        rays.low_by = glm::min(rays.low_by, by);
        rays.high_by = glm::max(rays.high_by, by);
    }
    return rays;
}

// The first time, from 0 on, at which the box around the rays is within room of a cube; none if it never is.
std::optional<double> meetingTime(const TileRays& rays, const glm::dvec3& corner, double edge, double room)
{
    double first = 0.0;
    double last = kNever;
    const auto keepWhereNotNegative = [&](double at_zero, double slope) // of at_zero + t * slope
    {
        if (slope > 0.0)
        {
            first = std::max(first, -at_zero / slope);
        }
        else if (slope < 0.0)
        {
            last = std::min(last, -at_zero / slope);
        }
        else if (at_zero < 0.0)
        {
            last = -kNever;
        }
    };
    for (int axis = 0; axis < 3; ++axis)
    {
        keepWhereNotNegative(rays.high_from[axis] - corner[axis] + room, rays.high_by[axis]);
        keepWhereNotNegative(corner[axis] + edge + room - rays.low_from[axis], -rays.low_by[axis]);
    }
    return first <= last ? std::optional(first) : std::nullopt;
}

// The first of these times, of all voxels.
double firstMeeting(const TileRays& rays, const std::vector<glm::dvec3>& corners, double edge, double room)
{
    double first = kNever;
    for (const glm::dvec3& corner : corners)
    {
        first = std::min(first, meetingTime(rays, corner, edge, room).value_or(kNever));
    }
    return first;
}

// Cameras at all distances, also so near voxels that these are large.
std::vector<ViewCamera> camerasOf(const DeviceTree& octree, const test::Codes& codes, std::mt19937& random)
{
    std::vector<ViewCamera> cameras = test::manyCameras(octree.grid);
    for (int i = 0; i < 4; ++i)
    {
        const auto uniform = [&] { return std::uniform_real_distribution<>(-9.0, 9.0)(random); };
        const glm::dvec3 target = glm::dvec3(oracle::mortonDecode(codes[random() % codes.size()])) + 0.5;
        cameras.push_back(ViewCamera::lookAt(target + glm::dvec3(uniform(), uniform(), uniform()), target, 0.3));
    }
    return cameras;
}

// How much earlier than at its first voxel a tile may start, as a distance: by rounding, and because a beam may end at
// cells up to half as wide as it is when it has left their node.
double roomOfTile(const TraceCamera& camera, double start, double edge)
{
    const double width = gpu::kTileEdge * 2.0 * glm::length(glm::dvec3(camera.rays.half_pixel_x));
    const double by_time = camera.orthographic ? 0.0 : width; // what the beam's width grows by
    const double begun = camera.orthographic ? width : by_time * (start + 4.0 * edge);
    const double cell = by_time < 0.2 ? 0.5 * begun / (1.0 - 4.0 * by_time) : kNever;
    const double distance = glm::length(glm::dvec3(camera.rays.origin) - 1.5);
    return 1e-5 * (2.0 + distance) + (cell > edge ? cell : 0.0);
}

TEST(TraceBeam, TilesStartJustBeforeTheFirstVoxelThatTheirRaysMayBeIn)
{
    std::mt19937 random(45);
    std::uint32_t dead_tiles = 0;
    std::uint32_t started_tiles = 0;
    std::uint32_t sooner_tiles = 0;
    for (const auto& [depth, count] : {std::pair(1U, 4U),
                                       {2U, 30U},
                                       {4U, 600U},
                                       {5U, 600U},
                                       {7U, 600U},
                                       {9U, 600U},
                                       {12U, 600U},
                                       {13U, 600U},
                                       {17U, 600U}})
    {
        const test::Codes codes = test::randomCodes(depth, count, random);
        const DeviceTree octree = test::octreeOf(device(), codes, depth);
        const double edge = 1.0 / octree.grid.rootResolution();
        std::vector<glm::dvec3> corners;
        for (const std::uint64_t code : codes)
        {
            corners.push_back(1.0 + edge * glm::dvec3(oracle::mortonDecode(code)));
        }
        TraceBuffers buffers(device().device(), kPictureWidth, kPictureHeight);
        NodePaths paths(device().device());
        const glm::uvec2 tiles = (glm::uvec2(kPictureWidth, kPictureHeight) + gpu::kTileEdge - 1U) / gpu::kTileEdge;
        std::size_t number = 0;
        for (const ViewCamera& view : camerasOf(octree, codes, random))
        {
            SCOPED_TRACE("depth " + std::to_string(depth) + " camera " + std::to_string(number++));
            const TraceCamera camera = traceCamera(view, octree.grid, kPictureHeight);
            const auto startsWith = [&](const TraceOptions& options)
            {
                test::takePicture(device(), octree, paths, camera, buffers, options);
                return device().download(buffers.starts);
            };
            const std::vector<float> starts = startsWith({});
            const std::vector<float> sooner = startsWith({.iterations_max = 3}); // of beams that end at large nodes
            for (std::size_t i = 0; i < starts.size(); ++i)
            {
                const TileRays rays = raysOfTile(camera, {i % tiles.x, i / tiles.x});
                const double first = firstMeeting(rays, corners, edge, 0.0);
                ASSERT_LE(sooner[i], starts[i]) << "tile " << i;
                sooner_tiles += sooner[i] < starts[i] ? 1 : 0;
                if (starts[i] == gpu::kTileDead)
                {
                    ASSERT_EQ(first, kNever) << "tile " << i;
                    ++dead_tiles;
                    continue;
                }
                // Strictly before, so that the ray enters the voxel, unless it begins in there.
                ASSERT_TRUE(starts[i] < first || starts[i] == gpu::kTraceTimeMin)
                    << "tile " << i << " starts at " << starts[i] << ", first at " << first;
                const double first_near = firstMeeting(rays, corners, edge, roomOfTile(camera, starts[i], edge));
                ASSERT_GE(starts[i] * (1.0 + 1e-5), first_near) << "tile " << i << ", first at " << first;
                started_tiles += first != kNever ? 1 : 0;
            }
        }
    }
    EXPECT_GT(dead_tiles, 1000U);
    EXPECT_GT(started_tiles, 1000U);
    EXPECT_GT(sooner_tiles, 1000U);
}

} // namespace
} // namespace zvo
