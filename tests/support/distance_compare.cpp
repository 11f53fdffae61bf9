// SPDX-License-Identifier: MIT
#include "support/distance_compare.h"

#include "core/base/morton.h"
#include "oracle/distance.h"
#include "oracle/winding.h"
#include "runtime/distances.h"
#include "support/fill_compare.h"

#include <algorithm>
#include <vector>

namespace zvo::test
{

namespace
{

// The distances of all cells, x fastest; UINT32_MAX beyond the band.
std::vector<std::uint32_t> exactDistances(const std::vector<oracle::Triangle>& triangles, int resolution,
                                          std::uint32_t band)
{
    const std::uint32_t limit = 4096 * band * (4096 * band) + 1;
    std::vector<std::uint32_t> distances(static_cast<std::size_t>(resolution) * resolution * resolution, UINT32_MAX);
    for (const oracle::Triangle& triangle : triangles)
    {
        glm::ivec3 low;
        glm::ivec3 high;
        for (std::size_t axis = 0; axis < 3; ++axis)
        {
            const auto [least, most] = std::minmax({triangle[0][axis], triangle[1][axis], triangle[2][axis]});
            const auto cell = [&](oracle::Int128 at)
            {
                const auto last = oracle::Int128{resolution} - 1;
                return static_cast<int>(std::clamp(oracle::floorDivide(at, 256), oracle::Int128{0}, last));
            };
            low[static_cast<int>(axis)] = cell(least - 256 * static_cast<int>(band) - 256);
            high[static_cast<int>(axis)] = cell(most + 256 * static_cast<int>(band) + 256);
        }
        for (int z = low.z; z <= high.z; ++z)
        {
            for (int y = low.y; y <= high.y; ++y)
            {
                for (int x = low.x; x <= high.x; ++x)
                {
                    std::uint32_t& least = distances[x + static_cast<std::size_t>(resolution) * (y + resolution * z)];
                    const oracle::Vec center = {256 * x + 128, 256 * y + 128, 256 * z + 128};
                    least = std::min(least, oracle::squaredDistance(center, triangle, std::min(least, limit)));
                }
            }
        }
    }
    return distances;
}

} // namespace

DistanceComparison compareDistances(vk::HeadlessDevice& device, const Scene& scene, const Grid& grid,
                                    const DistanceOptions& options)
{
    DistanceComparison found;
    const std::vector<oracle::Triangle> triangles = latticeTriangles(scene, grid);
    found.is_closed = oracle::isClosed(triangles);
    const auto resolution = static_cast<int>(grid.resolution());
    std::vector<std::uint32_t> exact = exactDistances(triangles, resolution, options.band);
    const std::vector<std::int16_t> winding =
        found.is_closed ? oracle::windingNumbers(triangles, grid.resolution()) : std::vector<std::int16_t>();
    const GpuScene uploaded = uploadScene(device, scene, false);
    const DistanceData data = downloadDistances(device, findDistances(device, uploaded, grid, options).distances);
    std::uint64_t before = 0;
    for (std::size_t i = 0; i < data.leaves.size(); ++i)
    {
        const std::uint64_t code = codeOfCell(data.leaves[i].leaf) + 1;
        bool has_cell = false;
        for (std::uint32_t cell = 0; cell < gpu::kCentersInBand; ++cell)
        {
            const glm::uvec3 place = 4U * data.leaves[i].leaf + cellOfCode(cell);
            const std::size_t number =
                place.x + grid.resolution() * (place.y + std::size_t{grid.resolution()} * place.z);
            const std::uint32_t value = data.squared[i * gpu::kCentersInBand + cell];
            const bool inside = data.isInside(i, cell);
            has_cell = has_cell || data.isInBand(i, cell);
            found.in_band += data.isInBand(i, cell) ? 1 : 0;
            found.inside += data.isInBand(i, cell) && inside ? 1 : 0;
            found.wrong_values += value == exact[number] ? 0 : 1;
            if (found.is_closed && value != 0)
            {
                const bool expected = options.fill == Fill::Parity ? winding[number] % 2 != 0 : winding[number] != 0;
                found.wrong_signs += inside == (expected && options.fill != Fill::None) ? 0 : 1;
            }
            exact[number] = UINT32_MAX;
        }
        found.in_order = found.in_order && code > before && has_cell;
        before = code;
    }
    found.wrong_values +=
        static_cast<std::uint64_t>(std::ranges::count_if(exact, [](std::uint32_t d) { return d != UINT32_MAX; }));
    return found;
}

} // namespace zvo::test
