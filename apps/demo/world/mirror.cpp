// SPDX-License-Identifier: MIT
#include "demo/world/mirror.h"

#include "core/edit/voxel_clip.h"

#include <algorithm>

namespace zvo::demo
{

namespace
{

glm::ivec3 imageOf(glm::ivec3 voxel, glm::length_t axis, const glm::ivec3& sum)
{
    voxel[axis] = sum[axis] - voxel[axis];
    return voxel;
}

Brush imageOf(Brush brush, glm::length_t axis, const glm::ivec3& sum, const Grid& grid)
{
    if (brush.stamp != nullptr)
    {
        glm::ivec3 lo = brush.stamp->box.lo;
        lo[axis] = sum[axis] - brush.stamp->box.hi[axis];
        brush.stamp = VoxelClip(*brush.stamp).mirrored(axis).stampAt(lo, grid);
        return brush;
    }
    brush.center = imageOf(brush.center, axis, sum);
    brush.span[axis] = -brush.span[axis];
    return brush;
}

// Adds the images of all that is there, axis by axis, where they differ. image(thing, axis)
template <typename Thing, typename Image>
std::vector<Thing> withImages(const Thing& thing, const Mirror& mirror, Image image)
{
    std::vector<Thing> all = {thing};
    for (glm::length_t axis = 0; axis < 3; ++axis)
    {
        const std::size_t count = mirror.axes[static_cast<std::size_t>(axis)] ? all.size() : 0;
        for (std::size_t i = 0; i < count; ++i)
        {
            const Thing other = image(all[i], axis);
            if (std::ranges::find(all, other) == all.end())
            {
                all.push_back(other);
            }
        }
    }
    return all;
}

} // namespace

std::vector<glm::ivec3> imagesOf(const glm::ivec3& voxel, const Mirror& mirror, const Grid& grid)
{
    return withImages(voxel, mirror,
                      [sum = mirror.sum(grid)](const glm::ivec3& at, glm::length_t axis)
                      { return imageOf(at, axis, sum); });
}

std::vector<Brush> imagesOf(const Brush& brush, const Mirror& mirror, const Grid& grid)
{
    const bool has_stamp = brush.stamp != nullptr;
    std::vector<Brush> all =
        withImages(brush, mirror,
                   [&, sum = mirror.sum(grid)](const Brush& original, glm::length_t axis)
                   { return original.stamp || !has_stamp ? imageOf(original, axis, sum, grid) : original; });
    std::erase_if(all, [has_stamp](const Brush& image) { return has_stamp && image.stamp == nullptr; });
    return all;
}

} // namespace zvo::demo
