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

// Whether the thin rule gives a triangle a voxel of the grid (docs/voxelization.md, "Thin").
class ThinTriangle
{
public:
    ThinTriangle(const LatticeCorners& corners, const Grid& grid)
        : m_v(corners), m_low(glm::min(glm::min(corners[0], corners[1]), corners[2])),
          m_high(glm::max(glm::max(corners[0], corners[1]), corners[2])), m_n(normalOf(corners)),
          m_resolution(grid.resolution())
    {
    }

    [[nodiscard]] bool hasVoxel() const
    {
        const glm::i64vec3 size = glm::abs(m_n);
        const int w = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
        const glm::i64vec3 length = m_high - m_low;
        if (m_n[w] == 0 || std::max({length.x, length.y, length.z}) > kLengthMax)
        {
            return m_n[w] != 0;
        }
        const int u = (w + 1) % 3;
        const int v = (w + 2) % 3;
        glm::i64vec3 c;
        for (c[u] = first(u); c[u] <= last(u); ++c[u])
        {
            for (c[v] = first(v); c[v] <= last(v); ++c[v])
            {
                c[w] = layer(w, kEdge * c[u] + kEdge / 2 - m_v[0][u], kEdge * c[v] + kEdge / 2 - m_v[0][v]);
                if (c[w] >= first(w) && c[w] <= last(w) && isInside(c))
                {
                    return true;
                }
            }
        }
        return false;
    }

private:
    // The voxels of an axis whose intervals the triangle meets.
    [[nodiscard]] std::int64_t first(int axis) const
    {
        return std::max(floorDivision(m_low[axis] - 1, kEdge), std::int64_t{0});
    }
    [[nodiscard]] std::int64_t last(int axis) const
    {
        return std::min(floorDivision(m_high[axis], kEdge), m_resolution - 1);
    }

    // The voxel of axis w in which the plane is at the offset (u, v) from the first corner.
    [[nodiscard]] std::int64_t layer(int w, std::int64_t u, std::int64_t v) const
    {
        const std::int64_t n_u = m_n[(w + 1) % 3];
        const std::int64_t n_v = m_n[(w + 2) % 3];
        const std::int64_t sign = m_n[w] < 0 ? -1 : 1;
        const std::int64_t height = sign * (m_v[0][w] * m_n[w] - n_u * u - n_v * v); // times |n_w|
        const std::int64_t cell = floorDivision(height, sign * m_n[w] * kEdge);
        return n_u == 0 && n_v == 0 && cell == m_resolution ? cell - 1 : cell; // the grid's upper face
    }

    // Whether a voxel's diamonds meet the triangle in all three projections.
    [[nodiscard]] bool isInside(const glm::i64vec3& voxel) const
    {
        const glm::i64vec3 centre = kEdge * voxel + kEdge / 2;
        for (int axis = 0; axis < 3; ++axis)
        {
            const int a = (axis + 1) % 3;
            const int b = (axis + 2) % 3;
            const std::int64_t sign = m_n[axis] < 0 ? -1 : 1;
            for (std::size_t i = 0; i < 3; ++i)
            {
                const glm::i64vec3 e = m_v[(i + 1) % 3] - m_v[i];
                const glm::i64vec3 to_centre = centre - m_v[i];
                if (sign * (e[a] * to_centre[b] - e[b] * to_centre[a]) +
                        kEdge / 2 * std::max(std::abs(e[a]), std::abs(e[b])) <
                    0)
                {
                    return false;
                }
            }
        }
        return true;
    }

    const LatticeCorners& m_v;
    glm::i64vec3 m_low;
    glm::i64vec3 m_high;
    glm::i64vec3 m_n;
    std::int64_t m_resolution;
};

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
            state = !corners ? state : ThinTriangle(*corners, grid).hasVoxel() ? State::Covered : State::Lost;
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
