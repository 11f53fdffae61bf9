// SPDX-License-Identifier: MIT
#include "examples/composite.h"

#include "core/base/grid.h"
#include "core/scene/scene.h"
#include "io/scene/load_scene.h"
#include "oracle/trace.h"
#include "oracle/voxelizer.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace zvo::test
{

namespace
{

constexpr double kWidth = Picture::kWidth;
constexpr double kHeight = Picture::kHeight;
constexpr double kNone = std::numeric_limits<double>::infinity();

// Where a pixel is looked at, in pixels from its centre.
constexpr double kOff = 1.0 / 64;
const std::array<glm::dvec2, 5> kSamples = {{{0, 0}, {-kOff, -kOff}, {kOff, -kOff}, {-kOff, kOff}, {kOff, kOff}}};

// The examples' camera, from its definition: pixels are square, the picture spans the field of view vertically.
struct Eye
{
    glm::dvec3 position{1.5, 2, 3.5};
    glm::dvec3 forward = glm::normalize(-position);
    glm::dvec3 right = glm::normalize(glm::cross(forward, glm::dvec3(0, 1, 0)));
    glm::dvec3 up = glm::cross(right, forward);
    double tangent = std::tan(0.5 * 26 * std::numbers::pi / 180);

    // Through a point of the picture, in pixels from the top left. Distances along it are those along forward.
    [[nodiscard]] glm::dvec3 direction(const glm::dvec2& pixel) const
    {
        const double x = (2 * pixel.x - kWidth) / kHeight;
        const double y = (2 * pixel.y - kHeight) / kHeight;
        return forward + tangent * (x * right - y * up);
    }

    [[nodiscard]] glm::dvec2 pixelOf(const glm::dvec3& point) const
    {
        const glm::dvec3 offset = point - position;
        const glm::dvec2 across(glm::dot(offset, right), -glm::dot(offset, up));
        return 0.5 * (across / (glm::dot(offset, forward) * tangent) * kHeight + glm::dvec2(kWidth, kHeight));
    }
};

using Triangle = std::array<glm::dvec3, 3>;

// Where a ray meets a triangle, or kNone (T. Moeller, B. Trumbore, Fast, Minimum Storage Ray/Triangle Intersection,
// 1997).
double meet(const glm::dvec3& origin, const glm::dvec3& direction, const Triangle& triangle)
{
    const glm::dvec3 a = triangle[1] - triangle[0];
    const glm::dvec3 b = triangle[2] - triangle[0];
    const glm::dvec3 p = glm::cross(direction, b);
    const double determinant = glm::dot(a, p);
    const glm::dvec3 s = origin - triangle[0];
    const glm::dvec3 q = glm::cross(s, a);
    const double u = glm::dot(s, p) / determinant;
    const double v = glm::dot(direction, q) / determinant;
    return u >= 0 && v >= 0 && u + v <= 1 ? glm::dot(b, q) / determinant : kNone;
}

using Depths = std::array<double, kSamples.size()>; // of a pixel's samples

// Of the mesh, for all pixels.
std::vector<Depths> meshDepths(const Eye& eye, const host::Mesh& mesh)
{
    Depths none;
    none.fill(kNone);
    std::vector<Depths> depths(Picture::kWidth * Picture::kHeight, none);
    for (const auto& indices : mesh.triangles)
    {
        Triangle triangle;
        glm::dvec2 low(kNone);
        glm::dvec2 high(-kNone);
        for (std::size_t i = 0; i < 3; ++i)
        {
            const auto& position = mesh.vertices[indices[i]].position;
            triangle[i] = {position[0], position[1], position[2]};
            low = glm::min(low, eye.pixelOf(triangle[i]));
            high = glm::max(high, eye.pixelOf(triangle[i]));
        }
        const glm::dvec2 size(kWidth, kHeight);
        low = glm::clamp(glm::floor(low - 1.0), glm::dvec2(0), size);
        high = glm::clamp(glm::ceil(high + 1.0), glm::dvec2(0), size);
        for (double y = low.y; y < high.y; ++y)
        {
            for (double x = low.x; x < high.x; ++x)
            {
                Depths& pixel = depths[static_cast<std::size_t>(y * kWidth + x)];
                for (std::size_t i = 0; i < kSamples.size(); ++i)
                {
                    const glm::dvec3 direction = eye.direction(glm::dvec2(x, y) + 0.5 + kSamples[i]);
                    pixel[i] = std::min(pixel[i], meet(eye.position, direction, triangle));
                }
            }
        }
    }
    return depths;
}

Winner winnerOf(const Depths& mesh, const Depths& voxel, double tolerance)
{
    const auto [mesh_first, mesh_last] = std::ranges::minmax(mesh);
    const auto [voxel_first, voxel_last] = std::ranges::minmax(voxel);
    return mesh_last + tolerance < voxel_first   ? Winner::Mesh
           : mesh_first - tolerance > voxel_last ? Winner::VoxelBeforeMesh
                                                 : Winner::Open;
}

} // namespace

Winners winnersOf(const std::filesystem::path& knot, std::uint32_t depth, const host::Mesh& mesh)
{
    const Scene scene = loadScene({&knot, 1});
    const Grid grid = Grid::around(scene.bounds(), depth);
    const oracle::VoxelTracer tracer(oracle::voxelize(scene, grid, Coverage::Thin).codes, depth);
    const double edge = double{grid.voxel_size} * grid.rootResolution();
    const Eye eye;
    const glm::vec3 origin(1.0 + (eye.position - glm::dvec3(grid.origin)) / edge);
    const std::vector<Depths> mesh_depths = meshDepths(eye, mesh);
    Winners winners(mesh_depths.size(), Winner::Neither);
    for (std::size_t i = 0; i < winners.size(); ++i)
    {
        const Depths& mesh_depth = mesh_depths[i];
        if (std::ranges::min(mesh_depth) == kNone)
        {
            continue;
        }
        Depths voxel_depth{};
        for (std::size_t sample = 0; sample < kSamples.size(); ++sample)
        {
            const glm::dvec2 pixel(static_cast<double>(i % Picture::kWidth), static_cast<double>(i / Picture::kWidth));
            const glm::vec3 direction(eye.direction(pixel + 0.5 + kSamples[sample]));
            const auto hit = tracer.trace(oracle::makeRay(origin, direction));
            voxel_depth[sample] = hit ? edge * double{hit->t} : kNone;
        }
        winners[i] = winnerOf(mesh_depth, voxel_depth, 0.001 * double{grid.voxel_size});
    }
    return winners;
}

std::size_t edgeCount(const Winners& winners)
{
    std::size_t count = 0;
    for (std::size_t i = 0; i + Picture::kWidth < winners.size(); ++i)
    {
        for (const std::size_t beside : {i + 1, i + Picture::kWidth})
        {
            const auto [first, second] = std::minmax(winners[i], winners[beside]);
            count += first == Winner::Mesh && second == Winner::VoxelBeforeMesh ? 1 : 0;
        }
    }
    return count;
}

} // namespace zvo::test
