// SPDX-License-Identifier: MIT
#include "io/mesh/polygon_triangulator.h"

namespace zvo
{

void PolygonTriangulator::triangulate(std::span<const glm::vec3> positions, std::span<const std::uint32_t> vertices,
                                      std::vector<glm::uvec3>& triangles)
{
    const std::size_t count = positions.size();
    const std::size_t first = triangles.size();
    if (count > 3 && projectPolygon(positions, m_points) && !isConvex(m_points) &&
        m_sweep.triangulate(m_points, triangles))
    {
        for (std::size_t i = first; i < triangles.size(); ++i)
        {
            const glm::uvec3 corners = triangles[i];
            triangles[i] = {vertices[corners.x], vertices[corners.y], vertices[corners.z]};
        }
        return;
    }
    for (std::size_t i = 2; i < count; ++i)
    {
        triangles.emplace_back(vertices[0], vertices[i - 1], vertices[i]);
    }
}

} // namespace zvo
