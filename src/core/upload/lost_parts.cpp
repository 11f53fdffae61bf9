// SPDX-License-Identifier: MIT
#include "core/upload/lost_parts.h"

#include "core/scene/mesh_parts.h"
#include "core/upload/lattice_corners.h"
#include "voxelize/voxelize.h"

#include <algorithm>
#include <cstdlib>
#include <optional>
#include <vector>

namespace zvo
{

namespace
{

constexpr std::int64_t kEdge = gpu::kVoxelLattice;
// Longer triangles with an area have voxels in any case: their columns are one voxel apart, or less.
constexpr std::int64_t kLengthMax = 16 * kEdge;

std::int64_t floorDivision(std::int64_t a, std::int64_t b) // b > 0
{
    return a / b - (a % b < 0 ? 1 : 0);
}

// Whether a voxel's diamonds meet a triangle in all three projections.
bool meetsDiamonds(const LatticeCorners& corners, const glm::i64vec3& normal, const glm::i64vec3& voxel)
{
    for (int axis = 0; axis < 3; ++axis)
    {
        const int a = (axis + 1) % 3;
        const int b = (axis + 2) % 3;
        for (std::size_t i = 0; i < 3; ++i)
        {
            const glm::i64vec3 e = corners[(i + 1) % 3] - corners[i];
            const glm::i64vec3 to_centre = kEdge * voxel + kEdge / 2 - corners[i];
            const std::int64_t side = e[a] * to_centre[b] - e[b] * to_centre[a];
            if ((normal[axis] < 0 ? -side : side) + kEdge / 2 * std::max(std::abs(e[a]), std::abs(e[b])) < 0)
            {
                return false;
            }
        }
    }
    return true;
}

// Whether the thin rule gives a triangle a voxel of the grid (docs/voxelization.md, "Thin").
bool hasVoxel(const LatticeCorners& corners, const Grid& grid)
{
    const glm::i64vec3 low = glm::min(glm::min(corners[0], corners[1]), corners[2]);
    const glm::i64vec3 high = glm::max(glm::max(corners[0], corners[1]), corners[2]);
    const glm::i64vec3 n = normalOf(corners);
    const glm::i64vec3 size = glm::abs(n);
    const int w = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const glm::i64vec3 length = high - low;
    if (n[w] == 0 || std::max({length.x, length.y, length.z}) > kLengthMax)
    {
        return n[w] != 0;
    }
    const std::int64_t resolution = grid.resolution();
    glm::i64vec3 first(0); // the voxels of each axis whose intervals the triangle meets
    glm::i64vec3 last(0);
    for (int axis = 0; axis < 3; ++axis)
    {
        first[axis] = std::max(floorDivision(low[axis] - 1, kEdge), std::int64_t{0});
        last[axis] = std::min(floorDivision(high[axis], kEdge), resolution - 1);
    }
    const int u = (w + 1) % 3;
    const int v = (w + 2) % 3;
    glm::i64vec3 c(0);
    for (c[u] = first[u]; c[u] <= last[u]; ++c[u])
    {
        for (c[v] = first[v]; c[v] <= last[v]; ++c[v])
        {
            const glm::i64vec3 to_centre = kEdge * c + kEdge / 2 - corners[0];
            const std::int64_t height = corners[0][w] * n[w] - n[u] * to_centre[u] - n[v] * to_centre[v]; // times n_w
            c[w] = floorDivision(n[w] < 0 ? -height : height, size[w] * kEdge);
            const bool is_upper_face = n[u] == 0 && n[v] == 0 && c[w] == resolution;
            c[w] -= is_upper_face ? 1 : 0;
            if (c[w] >= first[w] && c[w] <= last[w] && meetsDiamonds(corners, n, c))
            {
                return true;
            }
        }
    }
    return false;
}

void addParts(const Primitive& primitive, const MeshParts& parts, const glm::mat4& transform, const Grid& grid,
              PartCount& count)
{
    enum class State : std::uint8_t
    {
        Outside,
        Lost,
        Covered
    };
    std::vector<State> states(parts.count);
    for (std::size_t i = 0; i < primitive.triangles.size(); ++i)
    {
        State& state = states[parts.of_triangle[i]];
        if (state != State::Covered)
        {
            const auto corners = latticeCorners(primitive, primitive.triangles[i], transform, grid);
            state = !corners ? state : hasVoxel(*corners, grid) ? State::Covered : State::Lost;
        }
    }
    count.lost += static_cast<std::uint64_t>(std::count(states.begin(), states.end(), State::Lost));
    count.parts += states.size() - static_cast<std::uint64_t>(std::count(states.begin(), states.end(), State::Outside));
}

} // namespace

PartCount countParts(const Scene& scene, const Grid& grid)
{
    PartCount count;
    for (const bool welded : {false, true})
    {
        count = {};
        std::vector<std::optional<MeshParts>> parts(scene.primitives.size());
        for (const Instance& instance : scene.instances)
        {
            const Primitive& primitive = scene.primitives[instance.primitive];
            if (primitive.is_points)
            {
                continue; // has a voxel each
            }
            std::optional<MeshParts>& own = parts[instance.primitive];
            if (!own)
            {
                own = partsOf(primitive, welded);
            }
            addParts(primitive, *own, instance.transform, grid, count);
        }
        if (count.lost == 0)
        {
            break;
        }
    }
    return count;
}

} // namespace zvo
