// SPDX-License-Identifier: MIT
#include "core/edit/brush.h"

#include "core/tree/device_tree.h"

namespace zvo
{

VoxelBox TreeStamp::box() const
{
    return {offset, offset + static_cast<int>(tree->grid.resolution()) - 1};
}

std::vector<Brush> partsOf(const Brush& brush, const Grid& grid)
{
    constexpr int kEdge = 2 * static_cast<int>(gpu::kBrushRadiusMax); // whole leaves
    const VoxelBox reach = brush.box().within({glm::ivec3(0), glm::ivec3(grid.resolution()) - 1});
    const glm::ivec3 size = reach.size();
    if (reach.isEmpty())
    {
        return {};
    }
    if (glm::max(size.x, glm::max(size.y, size.z)) <= static_cast<int>(gpu::kDabEdgeMax))
    {
        return {brush};
    }
    std::vector<Brush> parts;
    const glm::ivec3 first = reach.lo / kEdge;
    const glm::ivec3 last = reach.hi / kEdge;
    for (int z = first.z; z <= last.z; ++z)
    {
        for (int y = first.y; y <= last.y; ++y)
        {
            for (int x = first.x; x <= last.x; ++x)
            {
                const glm::ivec3 lo = kEdge * glm::ivec3(x, y, z);
                parts.push_back(brush);
                parts.back().part = VoxelBox{lo, lo + kEdge - 1};
            }
        }
    }
    return parts;
}

} // namespace zvo
