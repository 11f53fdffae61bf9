// SPDX-License-Identifier: MIT
#include "support/fill_compare.h"

#include "core/base/morton.h"
#include "core/tree/tree_data.h"
#include "oracle/snap.h"
#include "oracle/winding.h"
#include "runtime/trees.h"
#include "support/same_bytes.h"
#include "support/scenes.h"

#include <array>
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

FillComparison compareFill(vk::HeadlessDevice& device, const Scene& scene, const Grid& grid, Coverage coverage,
                           Fill fill)
{
    FillComparison found;
    const std::vector<oracle::Triangle> triangles = latticeTriangles(scene, grid);
    found.is_closed = oracle::isClosed(triangles);
    if (!found.is_closed)
    {
        return found;
    }
    const std::vector<std::int16_t> winding = oracle::windingNumbers(triangles, grid.resolution());
    const GpuScene uploaded = uploadScene(device, scene, true);
    const BuildResult surface = buildOctree(device, uploaded, grid, {.coverage = coverage});
    const BuildResult filled = buildOctree(device, uploaded, grid, {.coverage = coverage, .fill = fill});
    const TreeData tree = downloadTree(device, filled.octree);
    std::vector<std::uint64_t> on_surface;
    std::vector<bool> occupied(winding.size());
    const std::size_t resolution = grid.resolution();
    const auto numberOf = [&](std::uint64_t code)
    {
        const glm::uvec3 cell = cellOfCode(code);
        return cell.x + resolution * (cell.y + resolution * cell.z);
    };
    const auto isInside = [&](std::size_t number)
    { return fill == Fill::Parity ? winding[number] % 2 != 0 : winding[number] != 0; };
    forEachCell(tree,
                [&](std::uint64_t code, bool is_surface)
                {
                    occupied[numberOf(code)] = true;
                    if (is_surface)
                    {
                        on_surface.push_back(code);
                        return;
                    }
                    ++found.interior;
                    found.wrong += isInside(numberOf(code)) ? 0 : 1;
                });
    for (std::size_t number = 0; number < winding.size(); ++number)
    {
        found.wrong += isInside(number) && !occupied[number] ? 1 : 0;
    }
    found.wrong += filled.octree.interior_count == found.interior ? 0 : 1;
    found.same_surface = on_surface == voxelCodes(device, surface.octree) &&
                         sameBytes(tree.voxel_attributes, downloadTree(device, surface.octree).voxel_attributes);
    return found;
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
