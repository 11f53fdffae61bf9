// SPDX-License-Identifier: MIT
// Voxels of a scene with inverted hulls show what a rasterizer shows that culls back faces.
#include "core/scene/hulls.h"
#include "core/upload/gpu_scene.h"
#include "runtime/trees.h"
#include "support/engine_device.h"
#include "support/pictures.h"
#include "support/toon_scene.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

namespace zvo
{
namespace
{

using test::device;

constexpr int kWidth = 480;
constexpr int kHeight = 270;

// Rasterizes the front faces of single-sided triangles in front of the camera: the material of each pixel, kNone where
// there is nothing.
std::vector<std::uint32_t> rasterize(const Scene& scene, const ViewCamera& camera)
{
    std::vector<std::uint32_t> materials(std::size_t{kWidth} * kHeight, kNone);
    std::vector<double> nearness(materials.size(), 0.0); // 1 / depth
    const double scale = 0.5 * kHeight / std::tan(0.5 * camera.vertical_fov);
    for (const Instance& instance : scene.instances)
    {
        const Primitive& primitive = scene.primitives[instance.primitive];
        for (const glm::uvec3& triangle : primitive.triangles)
        {
            std::array<glm::dvec3, 3> corners; // x and y in pixels, 1 / depth
            for (int i = 0; i < 3; ++i)
            {
                const glm::dvec3 p(instance.transform * glm::vec4(primitive.positions[triangle[i]], 1.0F));
                const glm::dvec3 seen = p - camera.position;
                const double depth = glm::dot(seen, camera.forward);
                corners[i] = {0.5 * kWidth + scale * glm::dot(seen, camera.right) / depth,
                              0.5 * kHeight - scale * glm::dot(seen, camera.up) / depth, 1.0 / depth};
            }
            const auto edge = [](const glm::dvec3& a, const glm::dvec3& b, const glm::dvec2& p)
            { return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x); };
            const double area = -edge(corners[0], corners[1], glm::dvec2(corners[2]));
            if (area <= 0.0) // rows go down: counterclockwise corners have a negative area there
            {
                continue;
            }
            const glm::dvec3 low = glm::min(glm::min(corners[0], corners[1]), corners[2]);
            const glm::dvec3 high = glm::max(glm::max(corners[0], corners[1]), corners[2]);
            for (int y = std::max(0, static_cast<int>(low.y)); y < kHeight && y <= high.y; ++y)
            {
                for (int x = std::max(0, static_cast<int>(low.x)); x < kWidth && x <= high.x; ++x)
                {
                    const glm::dvec2 p(x + 0.5, y + 0.5);
                    const glm::dvec3 weights =
                        -glm::dvec3(edge(corners[1], corners[2], p), edge(corners[2], corners[0], p),
                                    edge(corners[0], corners[1], p)) /
                        area;
                    const double near_here =
                        weights.x * corners[0].z + weights.y * corners[1].z + weights.z * corners[2].z;
                    const std::size_t pixel = static_cast<std::size_t>(y) * kWidth + static_cast<std::size_t>(x);
                    if (glm::all(glm::greaterThanEqual(weights, glm::dvec3(0.0))) && near_here > nearness[pixel])
                    {
                        nearness[pixel] = near_here;
                        materials[pixel] = primitive.material;
                    }
                }
            }
        }
    }
    return materials;
}

double linearOf(std::uint32_t code)
{
    const double value = code / 255.0;
    return value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
}

// The material whose colour is nearest to a pixel's.
std::uint32_t nearestMaterial(const Scene& scene, std::uint32_t texel)
{
    const glm::dvec3 color(linearOf(texel & 255U), linearOf((texel >> 8) & 255U), linearOf((texel >> 16) & 255U));
    std::uint32_t nearest = 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::uint32_t i = 0; i < scene.materials.size(); ++i)
    {
        const double distance = glm::distance(color, glm::dvec3(scene.materials[i].base_color));
        nearest = distance < least ? i : nearest;
        least = std::min(least, distance);
    }
    return nearest;
}

// The share of pixels in which the voxels of voxelized have the colour that the rasterizer sees in scene.
double agreement(const Scene& voxelized, const Scene& scene, std::uint32_t depth)
{
    const Bounds bounds = scene.bounds();
    const Grid grid = Grid::around(bounds, depth);
    const glm::dvec3 middle = 0.5 * (glm::dvec3(bounds.min) + glm::dvec3(bounds.max));
    const ViewCamera camera = ViewCamera::lookAt(middle + glm::dvec3(14.0, 24.0, 22.0), middle, 0.7);
    const DeviceTree octree = buildOctree(device(), uploadScene(device(), voxelized, true), grid, {}).octree;
    TraceOptions options;
    options.view = View::Albedo;
    const test::Picture picture =
        test::takePicture(device(), octree, traceCamera(camera, grid, kHeight), kWidth, kHeight, options);
    const std::vector<std::uint32_t> expected = rasterize(scene, camera);
    std::size_t equal_count = 0;
    for (std::size_t i = 0; i < expected.size(); ++i)
    {
        const bool missed = picture.hits[i].index == gpu::kHitMiss;
        const bool equal = missed || expected[i] == kNone
                               ? missed && expected[i] == kNone
                               : scene.materials[nearestMaterial(scene, picture.image[i])].base_color ==
                                     scene.materials[expected[i]].base_color;
        equal_count += equal ? 1 : 0;
    }
    return static_cast<double>(equal_count) / static_cast<double>(expected.size());
}

TEST(ToonPicture, ShowsWhatIsInTheHulls)
{
    const Scene scene = test::toonScene(32); // 1,024 objects
    EXPECT_LT(agreement(scene, scene, 9), 0.9);
    Scene shown = scene;
    leaveOutHulls(shown);
    const double share = agreement(shown, scene, 11);
    EXPECT_GE(share, 0.98);
}

} // namespace
} // namespace zvo
