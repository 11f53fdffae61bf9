// SPDX-License-Identifier: MIT
// Depth of pictures in a host's convention, against projections in double precision, and in compositions with planes.
#include "core/trace/trace_depth.h"
#include "support/engine_device.h"
#include "support/errors.h"
#include "support/trace_octrees.h"
#include "zvo/error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

namespace zvo
{
namespace
{

constexpr double kUnit = 1.0 / (1 << 24);       // relative rounding of single precision
constexpr double kDepthError = 1.0 / (1 << 19); // as core/trace/trace_depth.h states

using test::device;

/// A host's projection, made as hosts do.
struct Projection
{
    const char* name;
    bool orthographic;
    bool reversed;
    double near;
    double far; // INFINITY: no far plane

    // From world to clip space, for a picture with this aspect. y points down, as in Vulkan.
    [[nodiscard]] glm::dmat4 matrix(const ViewCamera& view, double aspect) const
    {
        glm::dmat4 to_view(1.0); // the viewer looks along -z, with y up
        for (int i = 0; i < 3; ++i)
        {
            to_view[i][0] = view.right[i];
            to_view[i][1] = view.up[i];
            to_view[i][2] = -view.forward[i];
        }
        to_view[3] = glm::dvec4(-glm::dot(view.right, view.position), -glm::dot(view.up, view.position),
                                glm::dot(view.forward, view.position), 1.0);
        const double at_near = reversed ? 1.0 : 0.0;
        const double at_far = 1.0 - at_near;
        glm::dmat4 to_clip(0.0);
        const double height = orthographic ? view.half_height : std::tan(0.5 * view.vertical_fov);
        to_clip[0][0] = 1.0 / (height * aspect);
        to_clip[1][1] = -1.0 / height;
        if (orthographic)
        {
            // depth = at_near + (distance - near) / (far - near) * (at_far - at_near)
            const double slope = (at_far - at_near) / (far - near);
            to_clip[2][2] = -slope;
            to_clip[3][2] = at_near - slope * near;
            to_clip[3][3] = 1.0;
        }
        else
        {
            // depth = a + b / distance
            const double a = std::isinf(far) ? at_far : (at_far * far - at_near * near) / (far - near);
            const double b =
                std::isinf(far) ? (at_near - at_far) * near : (at_near - at_far) * near * far / (far - near);
            to_clip[2][2] = -a;
            to_clip[3][2] = b;
            to_clip[2][3] = -1.0;
        }
        return glm::dmat4(to_clip) * to_view;
    }

    [[nodiscard]] float miss() const { return reversed ? 0.0F : 1.0F; }

    // The factor by which rounding of numbers below 1 is magnified if the near plane is far away.
    [[nodiscard]] double magnification() const { return std::isinf(far) ? 1.0 : std::max(1.0, far / (far - near)); }
};

std::ostream& operator<<(std::ostream& out, const Projection& projection)
{
    return out << projection.name;
}

constexpr Projection kProjections[] = {
    {"perspective", false, false, 4.0, 2000.0},
    {"perspective, thin", false, false, 20.0, 300.0},
    {"perspective, reversed", false, true, 4.0, 2000.0},
    {"perspective, reversed, infinite", false, true, 0.1, INFINITY},
    {"perspective, infinite", false, false, 4.0, INFINITY},
    {"orthographic", true, false, 10.0, 300.0},
    {"orthographic, reversed", true, true, -50.0, 400.0},
};

struct Ray
{
    glm::dvec3 origin;
    glm::dvec3 direction; // one unit along the view's axis
};

// The ray through a pixel's centre, from ViewCamera's definition alone.
Ray rayOf(const ViewCamera& view, std::uint32_t x, std::uint32_t y, std::uint32_t width, std::uint32_t height)
{
    const double half_height = view.orthographic ? view.half_height : std::tan(0.5 * view.vertical_fov);
    const double right = (2.0 * x + 1.0 - width) / height * half_height;
    const double up = -(2.0 * y + 1.0 - height) / height * half_height;
    const glm::dvec3 across = right * view.right + up * view.up;
    return view.orthographic ? Ray{view.position + across, view.forward} : Ray{view.position, view.forward + across};
}

struct DepthPicture
{
    std::vector<gpu::Hit> hits; // in dead tiles: misses
    std::vector<float> depth;
};

DepthPicture take(const DeviceTree& octree, const ViewCamera& view, const ClipDepth& clip, std::uint32_t width,
                  std::uint32_t height, const TraceOptions& options = {})
{
    NodePaths paths(device().device());
    TraceBuffers buffers(device().device(), width, height);
    vk::BufferOf<float> depth(device().device(), "depth", std::uint64_t{width} * height);
    const TraceCamera camera = traceCamera(view, octree.grid, height);
    device().run(
        [&](vk::FrameGraph& graph)
        {
            graph.fill(buffers.hits, gpu::kHitMiss);
            buildNodePaths(graph, octree, paths);
            tracePrimary(graph, octree, paths, camera, options, buffers);
            traceDepth(graph, octree.grid, camera, clip, buffers, depth);
        });
    return {device().download(buffers.hits), device().download(depth)};
}

double depthOf(const glm::dmat4& view_projection, const glm::dvec3& point)
{
    const glm::dvec4 clip = view_projection * glm::dvec4(point, 1.0);
    return clip.z / clip.w;
}

ViewCamera viewFor(const Projection& projection, const glm::dvec3& eye, const glm::dvec3& target)
{
    ViewCamera view = ViewCamera::lookAt(eye, target, 0.7);
    view.orthographic = projection.orthographic;
    view.half_height = 0.36 * glm::length(target - eye);
    return view;
}

// The point at which an exact ray enters the voxel, or node, of a hit, through the hit's face. The hit's t is not used.
struct Entry
{
    int axis;
    double distance;
    glm::dvec3 point;
};

Entry entryOf(const Grid& grid, const gpu::Hit& hit, const Ray& ray)
{
    const std::uint64_t where = std::uint64_t{hit.where.y} << 32 | hit.where.x;
    const glm::uvec3 cell(where & 0x3FFFF, where >> 18 & 0x3FFFF, where >> 36 & 0x3FFFF);
    const int axis = static_cast<int>(where >> gpu::kHitFaceShift & 3);
    if (axis == 3)
    {
        ADD_FAILURE() << "the ray starts inside of what it hits";
        return {};
    }
    const double cell_edge = std::ldexp(double(grid.voxel_size) * grid.rootResolution(),
                                        -2 * static_cast<int>(where >> gpu::kHitLevelShift & 15));
    const double face = cell[axis] + (ray.direction[axis] > 0.0 ? 0.0 : 1.0);
    const double distance = (double(grid.origin[axis]) + face * cell_edge - ray.origin[axis]) / ray.direction[axis];
    return {axis, distance, ray.origin + distance * ray.direction};
}

using TraceDepthProjections = testing::TestWithParam<Projection>;

std::string nameOf(const testing::TestParamInfo<Projection>& info)
{
    std::string name;
    for (const char* c = info.param.name; *c != '\0'; ++c)
    {
        name += std::isalpha(static_cast<unsigned char>(*c)) != 0 ? std::string(1, *c) : "";
    }
    return name;
}

INSTANTIATE_TEST_SUITE_P(Of, TraceDepthProjections, testing::ValuesIn(kProjections), nameOf);

TEST_P(TraceDepthProjections, IsThatOfTheFaceThroughWhichTheRayEntersItsVoxel)
{
    constexpr std::uint32_t kWidth = 101; // no multiples of a tile
    constexpr std::uint32_t kHeight = 67;
    struct GridCase
    {
        std::uint32_t depth; // odd: the root has twice the grid's edge
        glm::vec3 origin;
        float voxel_size;
        std::uint32_t detail_level;
    };
    for (const GridCase& grid_case : {GridCase{6, glm::vec3(0.0F), 1.0F, UINT32_MAX},
                                      GridCase{5, glm::vec3(-37.5F, 1000.25F, 3.0F), 0.3F, UINT32_MAX},
                                      GridCase{6, glm::vec3(500.0F, -20.0F, 7.0F), 1.7F, 2}})
    {
        SCOPED_TRACE(grid_case.depth);
        SCOPED_TRACE(grid_case.voxel_size);
        DeviceTree octree = test::octreeOf(device(), test::sphereShell(grid_case.depth, 0.4 * (1U << grid_case.depth)),
                                           grid_case.depth);
        octree.grid.origin = grid_case.origin;
        octree.grid.voxel_size = grid_case.voxel_size;
        const Grid& grid = octree.grid;
        const double edge = static_cast<double>(grid_case.voxel_size) * grid.resolution();
        const glm::dvec3 corner(grid_case.origin);
        Projection projection = GetParam(); // for scenes 64 units large
        projection.near *= edge / 64.0;
        projection.far *= edge / 64.0;
        const ViewCamera view = viewFor(projection, corner + edge * glm::dvec3(1.2, 1.0, 1.4),
                                        corner + 0.5 * edge + glm::dvec3(0.1, 0.0, -0.2));
        const glm::dmat4 matrix = projection.matrix(view, double(kWidth) / kHeight);
        TraceOptions options;
        options.detail_level = grid_case.detail_level;
        const DepthPicture picture =
            take(octree, view, ClipDepth::of(matrix, projection.miss()), kWidth, kHeight, options);
        std::uint32_t hit_count = 0;
        for (std::uint32_t y = 0; y < kHeight; ++y)
        {
            for (std::uint32_t x = 0; x < kWidth; ++x)
            {
                const std::size_t i = std::size_t{y} * kWidth + x;
                const gpu::Hit& hit = picture.hits[i];
                if (hit.index == gpu::kHitMiss)
                {
                    ASSERT_EQ(picture.depth[i], projection.miss());
                    continue;
                }
                const Ray ray = rayOf(view, x, y, kWidth, kHeight);
                const Entry entry = entryOf(grid, hit, ray);
                // Rays are made in single precision: the origin in unit space, the direction by three roundings. The
                // error along the ray grows if the face is seen edge-on.
                const double unit_edge = double(grid_case.voxel_size) * grid.rootResolution();
                const double origin_size = glm::length((ray.origin - corner) / unit_edge) + 2.0;
                const double moved = kUnit *
                                     (origin_size * unit_edge + 4.0 * entry.distance * glm::length(ray.direction)) /
                                     std::abs(ray.direction[entry.axis]);
                const double expected = depthOf(matrix, entry.point);
                const double slope = std::abs(depthOf(matrix, entry.point + 1e-3 * ray.direction) - expected) / 1e-3;
                const double rounding = kDepthError * projection.magnification() *
                                        (projection.reversed && std::isinf(projection.far) ? expected : 1.0);
                ASSERT_NEAR(picture.depth[i], expected, slope * moved + rounding)
                    << "pixel " << x << ", " << y << ", axis " << entry.axis;

                // The picture's rays agree with the host's matrix: the point is projected to the pixel's centre.
                const glm::dvec4 clip = matrix * glm::dvec4(entry.point, 1.0);
                ASSERT_NEAR(clip.x / clip.w, (2.0 * x + 1.0) / kWidth - 1.0, 1e-9);
                ASSERT_NEAR(clip.y / clip.w, (2.0 * y + 1.0) / kHeight - 1.0, 1e-9);
                ++hit_count;
            }
        }
        EXPECT_GT(hit_count, 1500U);
    }
}

// The first thing on a pixel's ray, computed exactly, or by a host's depth test.
enum class Winner
{
    Background,
    Plane,
    Voxels
};

// A box, and a disc of a plane, in world space.
struct Geometry
{
    glm::dvec3 min; // of the box
    glm::dvec3 max;
    glm::dvec3 normal; // of the plane
    glm::dvec3 middle;
    double radius;

    // The distance at which a ray enters the box; infinite if it misses. grown: added to the box in all directions.
    [[nodiscard]] double boxDistance(const Ray& ray, double grown = 0.0) const
    {
        const glm::dvec3 a = (min - grown - ray.origin) / ray.direction;
        const glm::dvec3 b = (max + grown - ray.origin) / ray.direction;
        const glm::dvec3 low = glm::min(a, b);
        const glm::dvec3 high = glm::max(a, b);
        const double enters = std::max({low.x, low.y, low.z, 0.0});
        return enters < std::min({high.x, high.y, high.z}) ? enters : INFINITY;
    }

    // The distance at which a ray meets the disc, which is shifted along its normal.
    [[nodiscard]] std::optional<double> planeDistance(const Ray& ray, double shifted = 0.0) const
    {
        const double distance = (glm::dot(normal, middle - ray.origin) + shifted) / glm::dot(normal, ray.direction);
        const bool meets = glm::length(ray.origin + distance * ray.direction - middle) < radius;
        return meets && distance > 0.0 ? std::optional(distance) : std::nullopt;
    }
};

Winner nearer(double box, std::optional<double> plane)
{
    return box < plane.value_or(INFINITY) ? Winner::Voxels : plane ? Winner::Plane : Winner::Background;
}

// A host draws a plane, and the picture over it at the pixels that pass its depth test.
void expectComposited(const DeviceTree& octree, const Geometry& geometry, const Projection& projection)
{
    constexpr std::uint32_t kWidth = 163;
    constexpr std::uint32_t kHeight = 123;
    // Tolerated error of surfaces, in units. The rays' rounding gives 5e-5 at these distances; rounding of depth gives
    // up to 5e-4, at 100 away with the near plane at 4. A pixel is 0.4 wide there.
    constexpr double kTolerance = 1e-3;
    const ViewCamera view = viewFor(projection, {75.0, 61.0, 88.0}, {30.0, 29.0, 31.0});
    const glm::dmat4 matrix = projection.matrix(view, double(kWidth) / kHeight);
    const DepthPicture picture = take(octree, view, ClipDepth::of(matrix, projection.miss()), kWidth, kHeight);
    std::vector<Winner> expected(picture.depth.size());
    std::size_t open_count = 0; // pixels whose answer changes when an edge moves by the tolerance
    for (std::uint32_t y = 0; y < kHeight; ++y)
    {
        for (std::uint32_t x = 0; x < kWidth; ++x)
        {
            const std::size_t i = std::size_t{y} * kWidth + x;
            const Ray ray = rayOf(view, x, y, kWidth, kHeight);
            const double box = geometry.boxDistance(ray);
            const std::optional<double> plane = geometry.planeDistance(ray);
            expected[i] = nearer(box, plane);
            bool open = false;
            for (const double by : {kTolerance, -kTolerance})
            {
                open = open || nearer(geometry.boxDistance(ray, by), plane) != expected[i] ||
                       nearer(box, geometry.planeDistance(ray, by)) != expected[i];
            }
            open_count += open ? 1 : 0;
            const float drawn =
                plane ? static_cast<float>(depthOf(matrix, ray.origin + *plane * ray.direction)) : projection.miss();
            const bool passes = projection.reversed ? picture.depth[i] > drawn : picture.depth[i] < drawn;
            const Winner shown = passes ? Winner::Voxels : plane ? Winner::Plane : Winner::Background;
            ASSERT_TRUE(open || shown == expected[i])
                << "pixel " << x << ", " << y << ": depth " << picture.depth[i] << ", the plane's " << drawn;
        }
    }
    // There are silhouettes before the plane and the background, and lines where voxels and the plane meet.
    std::size_t edge_count = 0;
    std::size_t before_nothing = 0;
    for (std::size_t i = 1; i < expected.size(); ++i)
    {
        const bool of_voxels =
            expected[i] != expected[i - 1] && (expected[i] == Winner::Voxels || expected[i - 1] == Winner::Voxels);
        edge_count += of_voxels ? 1 : 0;
        before_nothing += of_voxels && (expected[i] == Winner::Background || expected[i - 1] == Winner::Background);
    }
    EXPECT_GT(edge_count, 100U);
    EXPECT_GT(before_nothing, 20U);
    EXPECT_LT(open_count, 1 + edge_count / 10);
}

TEST_P(TraceDepthProjections, ABoxIsCompositedWithAPlaneAsExactGeometrySays)
{
    constexpr std::uint32_t kDepth = 6;
    const glm::uvec3 low(14, 9, 20);
    const glm::uvec3 high(47, 50, 41);
    const DeviceTree octree = test::octreeOf(device(),
                                             test::codesWhere(kDepth,
                                                              [&](const glm::uvec3& voxel) {
                                                                  return glm::all(glm::greaterThanEqual(voxel, low)) &&
                                                                         glm::all(glm::lessThan(voxel, high));
                                                              }),
                                             kDepth);
    const Geometry geometry = {
        glm::dvec3(low), glm::dvec3(high), glm::normalize(glm::dvec3(0.2, 1.0, 0.3)), {31.3, 28.1, 30.7}, 22.0};
    expectComposited(octree, geometry, GetParam());
}

// The rows of the transform are independent of the camera, so that z and w change with the pixel, too.
TEST(TraceDepth, TakesAnyTransform)
{
    constexpr std::uint32_t kWidth = 67;
    constexpr std::uint32_t kHeight = 41;
    const DeviceTree octree = test::octreeOf(device(), test::sphereShell(6, 25.0), 6);
    ClipDepth clip;
    clip.z = {0.003, 0.008, -0.002, 0.2};
    clip.w = {0.004, -0.002, 0.001, 1.0};
    for (const bool orthographic : {false, true})
    {
        ViewCamera view = ViewCamera::lookAt({75.0, 61.0, 88.0}, {30.0, 29.0, 31.0}, 0.7);
        view.orthographic = orthographic;
        view.half_height = 30.0;
        const DepthPicture picture = take(octree, view, clip, kWidth, kHeight);
        std::uint32_t hit_count = 0;
        for (std::uint32_t y = 0; y < kHeight; ++y)
        {
            for (std::uint32_t x = 0; x < kWidth; ++x)
            {
                const std::size_t i = std::size_t{y} * kWidth + x;
                if (picture.hits[i].index != gpu::kHitMiss)
                {
                    const Entry entry = entryOf(octree.grid, picture.hits[i], rayOf(view, x, y, kWidth, kHeight));
                    const glm::dvec4 point(entry.point, 1.0);
                    // 1e-5: on faces that are seen edge-on the point may move by 1e-3
                    ASSERT_NEAR(picture.depth[i], glm::dot(clip.z, point) / glm::dot(clip.w, point), 1e-5);
                    ++hit_count;
                }
            }
        }
        EXPECT_GT(hit_count, 500U);
    }
}

TEST(TraceDepth, PointsBeforeTheNearPlaneAndBehindTheFarOneHaveTheirDepth)
{
    // A wall at z = 3 to 4, seen from z = 24, which is 20 away.
    const DeviceTree octree =
        test::octreeOf(device(), test::codesWhere(4, [](const glm::uvec3& voxel) { return voxel.z == 3; }), 4);
    const ViewCamera view = ViewCamera::lookAt({8, 8, 24}, {8, 8, 0}, 0.2);
    for (const bool reversed : {false, true})
    {
        const auto depthWith = [&](double near, double far)
        {
            const Projection projection = {"", false, reversed, near, far};
            return take(octree, view, ClipDepth::of(projection.matrix(view, 1.0), projection.miss()), 16, 16)
                .depth.at(8 * 16 + 8);
        };
        const float at_near = reversed ? 1.0F : 0.0F;
        EXPECT_EQ(depthWith(21.0, 100.0), at_near);
        EXPECT_EQ(depthWith(2.0, 19.0), 1.0F - at_near);
        EXPECT_NE(depthWith(19.0, 21.0), at_near);
        EXPECT_NE(depthWith(19.0, 21.0), 1.0F - at_near);
    }
}

TEST(TraceDepth, InsideAVoxelItIsThatOfTheNearPlane)
{
    const DeviceTree octree = test::octreeOf(device(), test::codesWhere(3, [](const glm::uvec3&) { return true; }), 3);
    const ViewCamera view = ViewCamera::lookAt({4.5, 4.5, 4.5}, {4.5, 4.7, 1.0}, 1.0);
    for (const Projection& projection : kProjections)
    {
        if (!projection.orthographic)
        {
            const DepthPicture picture =
                take(octree, view, ClipDepth::of(projection.matrix(view, 2.0), projection.miss()), 18, 9);
            EXPECT_EQ(picture.depth, std::vector<float>(18 * 9, projection.reversed ? 1.0F : 0.0F)) << projection.name;
        }
    }
}

TEST(TraceDepth, AnEmptyOctreeIsMissedEverywhere)
{
    const DeviceTree octree = test::octreeOf(device(), {}, 5);
    const ViewCamera view = ViewCamera::lookAt({60, 40, 50}, {16, 16, 16}, 0.7);
    ClipDepth clip = ClipDepth::of(kProjections[0].matrix(view, 1.0), 0.25F);
    EXPECT_EQ(take(octree, view, clip, 33, 17).depth, std::vector<float>(33 * 17, 0.25F));
}

TEST(TraceDepth, RefusesWhatCannotBe)
{
    TraceBuffers buffers(device().device(), 9, 7);
    vk::BufferOf<float> small(device().device(), "small", 62);
    vk::BufferOf<float> depth(device().device(), "depth", 63);
    const Grid grid;
    const TraceCamera camera = traceCamera(ViewCamera::lookAt({4, 4, 4}, {0, 0, 0}, 0.7), grid, 7);
    ClipDepth clip;
    clip.w.w = 1.0;
    const auto expectRefused = [&](vk::BufferOf<float>& to, const ClipDepth& by, const char* part)
    {
        vk::FrameGraph graph(device().device(), VK_NULL_HANDLE);
        const std::string message =
            test::messageOf([&] { traceDepth(graph, grid, camera, by, buffers, to); }, ErrorCode::Usage);
        EXPECT_NE(message.find(part), std::string::npos) << message;
        EXPECT_EQ(graph.passCount(), 0U);
    };
    expectRefused(small, clip, "one for each pixel");
    clip.miss = 1.5F;
    expectRefused(depth, clip, "[0, 1]");
    clip.miss = NAN;
    expectRefused(depth, clip, "[0, 1]");
    clip.miss = 1.0F;
    clip.z.x = INFINITY;
    expectRefused(depth, clip, "finite");
}

} // namespace
} // namespace zvo
