// SPDX-License-Identifier: MIT
#include "core/scene/camera.h"

#include "zvo/error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace zvo
{
namespace
{

void expectNear(const glm::dvec3& a, const glm::dvec3& b, double tolerance = 1e-6)
{
    EXPECT_LT(glm::length(a - b), tolerance) << a.x << ' ' << a.y << ' ' << a.z;
}

void expectOrthonormal(const ViewCamera& camera)
{
    expectNear(glm::cross(camera.right, camera.up), -camera.forward);
    EXPECT_NEAR(glm::length(camera.right), 1.0, 1e-12);
    EXPECT_NEAR(glm::length(camera.up), 1.0, 1e-12);
    EXPECT_NEAR(glm::dot(camera.right, camera.up), 0.0, 1e-12);
}

/// The position of a world point in the picture, in half picture heights right and up of the middle.
glm::dvec2 project(const ViewCamera& camera, const glm::dvec3& point)
{
    const glm::dvec3 offset = point - camera.position;
    const double scale = camera.orthographic ? camera.half_height
                                             : std::tan(0.5 * camera.vertical_fov) * glm::dot(offset, camera.forward);
    return {glm::dot(offset, camera.right) / scale, glm::dot(offset, camera.up) / scale};
}

TEST(ViewCamera, LooksFromEyeToTargetWithYUp)
{
    const ViewCamera camera = ViewCamera::lookAt({0.0, 1.0, 5.0}, {0.0, 1.0, 0.0}, 0.5);
    expectNear(camera.forward, {0.0, 0.0, -1.0});
    expectNear(camera.right, {1.0, 0.0, 0.0});
    expectNear(camera.up, {0.0, 1.0, 0.0});
    const ViewCamera slanted = ViewCamera::lookAt({1.0, 2.0, 3.0}, {-4.0, 0.5, 2.0}, 0.5);
    expectOrthonormal(slanted);
    EXPECT_GT(slanted.up.y, 0.0);
    EXPECT_EQ(slanted.right.y, 0.0);
}

TEST(ViewCamera, LooksStraightUpAndDown)
{
    for (const double y : {-3.0, 3.0})
    {
        const ViewCamera camera = ViewCamera::lookAt({0.0, 0.0, 0.0}, {0.0, y, 0.0}, 0.5);
        expectOrthonormal(camera);
        expectNear(camera.forward, {0.0, y / 3.0, 0.0});
    }
}

TEST(ViewCamera, RefusesViewsWithoutADirection)
{
    EXPECT_THROW(ViewCamera::lookAt({1, 2, 3}, {1, 2, 3}, 0.5), Error);
    EXPECT_THROW(ViewCamera::lookAt({1, 2, NAN}, {1, 2, 3}, 0.5), Error);
    EXPECT_THROW(ViewCamera::lookAt({1, 2, 3}, {0, 2, 3}, 0.0), Error);
    EXPECT_THROW(ViewCamera::lookAt({1, 2, 3}, {0, 2, 3}, std::numbers::pi), Error);
    EXPECT_THROW(ViewCamera::lookAt({1, 2, 3}, {0, 2, 3}, NAN), Error);
    Camera flat;
    flat.transform = glm::mat4(0.0F);
    EXPECT_THROW(ViewCamera::of(flat), Error);
}

TEST(ViewCamera, TakesASceneCameraWithoutItsScale)
{
    Camera camera;
    camera.transform = glm::mat4(glm::vec4(0, 0, -3, 0), glm::vec4(0, 2, 0, 0), glm::vec4(5, 0, 0, 0),
                                 glm::vec4(7, 8, 9, 1)); // x to -z, y to y, z to x
    camera.vertical_fov = 0.25F;
    const ViewCamera view = ViewCamera::of(camera);
    expectOrthonormal(view);
    expectNear(view.position, {7, 8, 9});
    expectNear(view.forward, {-1, 0, 0});
    expectNear(view.right, {0, 0, -1});
    EXPECT_EQ(view.vertical_fov, 0.25);
}

TEST(ViewCamera, FramingFillsThePictureWithTheBoxInItsMiddle)
{
    for (const glm::vec3& size : {glm::vec3(7, 1, 40), glm::vec3(50, 0, 50), glm::vec3(1, 90, 2), glm::vec3(3)})
    {
        for (const double aspect : {0.2, 1.0, 1.78})
        {
            const glm::vec3 corner(-3.0F, 5.0F, 100.0F);
            const ViewCamera camera = ViewCamera::framing({corner, corner + size}, aspect);
            expectOrthonormal(camera);
            glm::dvec2 low(INFINITY);
            glm::dvec2 high(-INFINITY);
            for (int i = 0; i < 8; ++i)
            {
                const glm::vec3 side(i & 1, i >> 1 & 1, i >> 2);
                const glm::dvec2 at = project(camera, corner + side * size) / glm::dvec2(aspect, 1.0);
                low = glm::min(low, at);
                high = glm::max(high, at);
            }
            EXPECT_NEAR(glm::length(low + high), 0.0, 1e-9) << size.x << ' ' << aspect;
            EXPECT_NEAR(std::max(high.x, high.y), 0.92, 1e-9) << size.x << ' ' << aspect;
        }
    }
    expectOrthonormal(ViewCamera::framing({{1.0F, 1.0F, 1.0F}, {1.0F, 1.0F, 1.0F}}, 1.0));
}

TEST(ViewCamera, TurnsCounterclockwiseAsSeenFromAbove)
{
    const ViewCamera camera = ViewCamera::lookAt({1.0, 2.0, 13.0}, {1.0, 2.0, 3.0}, 0.5);
    const ViewCamera turned = camera.turnedAround({1.0, 0.0, 3.0}, 0.5 * std::numbers::pi);
    expectOrthonormal(turned);
    expectNear(turned.position, {11.0, 2.0, 3.0}); // from +z to +x
    expectNear(turned.forward, {-1.0, 0.0, 0.0});
}

TEST(ViewCamera, RaysGoThroughWhereThePointsAre)
{
    Grid grid;
    grid.origin = {-2.0F, 1.0F, 3.0F};
    grid.voxel_size = 0.25F;
    grid.depth = 5; // the root covers 64 voxels: 16 world units
    ViewCamera camera = ViewCamera::lookAt({3.0, 4.0, 20.0}, {1.0, 3.0, 5.0}, 0.7);
    for (const bool orthographic : {false, true})
    {
        camera.orthographic = orthographic;
        camera.half_height = 4.0;
        const TraceCamera rays = traceCamera(camera, grid, 240);
        EXPECT_EQ(rays.orthographic, orthographic);
        const glm::dvec3 point(2.0, 3.5, 6.0);
        const glm::dvec2 at = project(camera, point);
        const glm::vec3 offset = static_cast<float>(240.0 * at.x) * rays.rays.half_pixel_x -
                                 static_cast<float>(240.0 * at.y) * rays.rays.half_pixel_y;
        const double depth = glm::dot(point - camera.position, camera.forward) / 16.0;
        const glm::vec3 origin = rays.rays.origin + (orthographic ? offset : glm::vec3(0.0F));
        const glm::vec3 direction = rays.rays.forward + (orthographic ? glm::vec3(0.0F) : offset);
        const glm::dvec3 unit = glm::dvec3(origin) + depth * glm::dvec3(direction);
        expectNear(glm::dvec3(grid.origin) + 16.0 * (unit - 1.0), point, 1e-4);
    }
}

} // namespace
} // namespace zvo
