// SPDX-License-Identifier: MIT
#include "core/upload/lattice_corners.h"

#include "core/base/finite.h"
#include "voxelize/voxelize.h"

#include <algorithm>
#include <cmath>

namespace zvo
{

glm::i64vec3 normalOf(const LatticeCorners& corners)
{
    const glm::i64vec3 a = corners[1] - corners[0];
    const glm::i64vec3 b = corners[2] - corners[0];
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

std::optional<LatticeCorners> latticeCorners(const Primitive& primitive, const glm::uvec3& triangle,
                                             const glm::mat4& transform, const Grid& grid)
{
    const auto scale = static_cast<float>(gpu::kVoxelLattice / static_cast<double>(grid.voxel_size));
    constexpr auto kLimit = static_cast<float>(gpu::kLatticeLimit);
    LatticeCorners corners;
    for (int i = 0; i < 3; ++i)
    {
        const glm::vec3 scaled = (transformPoint(transform, primitive.positions[triangle[i]]) - grid.origin) * scale;
        const glm::vec3 q(std::nearbyint(scaled.x), std::nearbyint(scaled.y), std::nearbyint(scaled.z));
        if (!isFinite(q) || std::max({std::abs(q.x), std::abs(q.y), std::abs(q.z)}) > kLimit)
        {
            return std::nullopt;
        }
        corners[static_cast<std::size_t>(i)] = glm::i64vec3(q);
    }
    const std::int64_t end = std::int64_t{gpu::kVoxelLattice} * grid.resolution();
    const glm::i64vec3 low = glm::min(glm::min(corners[0], corners[1]), corners[2]);
    const glm::i64vec3 high = glm::max(glm::max(corners[0], corners[1]), corners[2]);
    const bool touches = std::min({high.x, high.y, high.z}) >= 0 && std::max({low.x, low.y, low.z}) <= end;
    return touches ? std::optional(corners) : std::nullopt;
}

} // namespace zvo
