// SPDX-License-Identifier: MIT
#include "support/fill_compare.h"

#include "core/base/morton.h"
#include "core/tree/tree_data.h"
#include "oracle/robust_fill.h"
#include "oracle/snap.h"
#include "oracle/winding.h"
#include "runtime/trees.h"
#include "support/same_bytes.h"
#include "support/scenes.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>
#include <vector>

namespace zvo::test
{

std::vector<oracle::Triangle> latticeTriangles(const Scene& scene, const Grid& grid)
{
    std::vector<oracle::Triangle> triangles;
    for (const Instance& instance : scene.instances)
    {
        const Primitive& primitive = scene.primitives[instance.primitive];
        for (const glm::uvec3& corners : primitive.triangles)
        {
            const auto& at = primitive.positions;
            const std::array<glm::vec3, 3> points = {at[corners.x], at[corners.y], at[corners.z]};
            triangles.push_back(
                oracle::snapTriangle(points, instance.transform, grid, Coverage::Conservative).triangle);
        }
    }
    return triangles;
}

namespace
{

// The number of a voxel in a grid of resolution^3, x fastest.
std::size_t numberOfCode(std::uint64_t code, std::size_t resolution)
{
    const glm::uvec3 cell = cellOfCode(code);
    return cell.x + resolution * (cell.y + resolution * cell.z);
}

} // namespace

FillComparison compareFill(vk::HeadlessDevice& device, const Scene& scene, const Grid& grid, Coverage coverage,
                           Fill fill, Shell shell)
{
    FillComparison found;
    const std::vector<oracle::Triangle> triangles = latticeTriangles(scene, grid);
    found.is_closed = oracle::isClosed(triangles);
    if (!found.is_closed && fill != Fill::Robust)
    {
        return found;
    }
    const GpuScene uploaded = uploadScene(device, scene, true);
    const BuildResult surface = buildOctree(device, uploaded, grid, {.coverage = coverage});
    const BuildResult filled =
        buildOctree(device, uploaded, grid, {.coverage = coverage, .fill = fill, .shell = shell});
    const TreeData tree = downloadTree(device, filled.octree);
    const std::vector<std::uint64_t> surface_codes = voxelCodes(device, surface.octree);
    std::vector<std::uint64_t> on_surface;
    const std::size_t resolution = grid.resolution();
    std::vector<bool> occupied(resolution * resolution * resolution);
    const auto numberOf = [&](std::uint64_t code) { return numberOfCode(code, resolution); };
    std::vector<bool> inside(occupied.size());
    if (found.is_closed)
    {
        const std::vector<std::int16_t> winding = shell == Shell::None
                                                      ? oracle::windingsBesideCentres(triangles, grid.resolution())
                                                      : oracle::windingNumbers(triangles, grid.resolution());
        std::transform(winding.begin(), winding.end(), inside.begin(),
                       [fill](std::int16_t number) { return fill == Fill::Parity ? number % 2 != 0 : number != 0; });
    }
    else
    {
        std::vector<bool> is_surface(occupied.size());
        for (const std::uint64_t code : surface_codes)
        {
            is_surface[numberOf(code)] = true;
        }
        const std::vector<std::int8_t> sides = oracle::robustSides(triangles, is_surface, grid.resolution());
        std::transform(sides.begin(), sides.end(), inside.begin(), [](std::int8_t side) { return side > 0; });
        for (std::size_t number = 0; number < sides.size(); ++number)
        {
            found.undecided += sides[number] == 0 && !is_surface[number] ? 1 : 0;
        }
    }
    if (fill == Fill::Robust)
    {
        found.wrong += filled.open.undecided == found.undecided ? 0 : 1;
    }
    forEachCell(tree,
                [&](std::uint64_t code, bool is_surface)
                {
                    occupied[numberOf(code)] = true;
                    if (is_surface)
                    {
                        on_surface.push_back(code);
                        found.wrong += shell == Shell::None && !inside[numberOf(code)] ? 1 : 0;
                        return;
                    }
                    ++found.interior;
                    found.wrong += inside[numberOf(code)] ? 0 : 1;
                });
    for (std::size_t number = 0; number < inside.size(); ++number)
    {
        found.wrong += inside[number] && !occupied[number] ? 1 : 0;
    }
    found.wrong += filled.octree.interior_count == found.interior ? 0 : 1;
    std::vector<gpu::Attribute> attributes = downloadTree(device, surface.octree).voxel_attributes;
    std::vector<std::uint64_t> expected_codes = surface_codes;
    if (shell == Shell::None)
    {
        std::vector<gpu::Attribute> kept;
        expected_codes.clear();
        for (std::size_t i = 0; i < surface_codes.size(); ++i)
        {
            if (inside[numberOf(surface_codes[i])])
            {
                expected_codes.push_back(surface_codes[i]);
                kept.push_back(attributes[i]);
            }
        }
        attributes = std::move(kept);
    }
    found.same_surface = on_surface == expected_codes && sameBytes(tree.voxel_attributes, attributes);
    return found;
}

double wrongOfHoles(vk::HeadlessDevice& device, const Scene& closed, const Scene& with_holes, const Grid& grid,
                    Fill fill)
{
    const std::vector<std::int16_t> winding = oracle::windingNumbers(latticeTriangles(closed, grid), grid.resolution());
    const GpuScene uploaded = uploadScene(device, with_holes, false);
    const BuildResult filled = buildOctree(device, uploaded, grid, {.attributes = false, .fill = fill});
    std::vector<bool> is_wrong(winding.size());
    std::transform(winding.begin(), winding.end(), is_wrong.begin(), [](std::int16_t number) { return number != 0; });
    const auto inside_count = static_cast<double>(std::ranges::count(is_wrong, true));
    forEachCell(downloadTree(device, filled.octree),
                [&](std::uint64_t code, bool is_surface)
                {
                    const std::size_t number = numberOfCode(code, grid.resolution());
                    is_wrong[number] = !is_surface && !is_wrong[number];
                });
    return static_cast<double>(std::ranges::count(is_wrong, true)) / inside_count;
}

Scene withHoles(Scene scene, std::mt19937& random, double share)
{
    std::bernoulli_distribution is_lost(share);
    for (Primitive& primitive : scene.primitives)
    {
        std::erase_if(primitive.triangles, [&](const glm::uvec3&) { return is_lost(random); });
    }
    return scene;
}

Scene tetrahedra(std::mt19937& random, const Grid& grid)
{
    const auto pick = [&](int low, int high) { return std::uniform_int_distribution<int>(low, high)(random); };
    const int step = std::array{1, 32, 64, 128, 256}[static_cast<std::size_t>(pick(0, 4))];
    const int top = static_cast<int>(256 * grid.resolution()) / step;
    std::vector<glm::vec3> corners;
    for (int solid = pick(1, 6); solid > 0; --solid)
    {
        std::array<glm::vec3, 4> points;
        for (glm::vec3& point : points)
        {
            point = glm::vec3(pick(0, top - 1), pick(0, top - 1), pick(0, top - 1)) * static_cast<float>(step) / 256.0F;
        }
        for (const auto& [a, b, c] : {std::array{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}})
        {
            corners.insert(corners.end(),
                           {points.at(static_cast<std::size_t>(a)), points.at(static_cast<std::size_t>(b)),
                            points.at(static_cast<std::size_t>(c))});
        }
    }
    return triangleSoup(corners);
}

} // namespace zvo::test
