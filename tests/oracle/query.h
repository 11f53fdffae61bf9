// SPDX-License-Identifier: MIT
// Answers questions to a set of voxels by looking at each voxel (docs/queries.md has the definitions). Positions are
// 256ths of voxels.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

namespace zvo::oracle
{

/// The answer to a question: a voxel, and the numbers that belong to it.
struct QueryAnswer
{
    glm::ivec3 cell{0};
    std::uint32_t face = 3;
    std::int64_t numerator = 0;
    std::int64_t denominator = 1;

    friend bool operator==(const QueryAnswer&, const QueryAnswer&) = default;
};

/// A set of voxels, in ascending Morton order.
class VoxelSet
{
public:
    explicit VoxelSet(std::span<const std::uint64_t> codes);

    [[nodiscard]] std::optional<QueryAnswer> atPoint(const glm::ivec3& position) const;
    [[nodiscard]] std::optional<QueryAnswer> inBox(const glm::ivec3& low, const glm::ivec3& high) const;
    [[nodiscard]] std::optional<QueryAnswer> nearest(const glm::ivec3& position, std::uint32_t reach) const;

    /// By the time when each voxel is met, as a multiple of 1 / the product of the motion's numbers that are not 0.
    [[nodiscard]] std::optional<QueryAnswer> onWay(const glm::ivec3& low, const glm::ivec3& high,
                                                   const glm::ivec3& motion) const;

private:
    std::vector<glm::ivec3> m_cells;
};

} // namespace zvo::oracle
