// SPDX-License-Identifier: MIT
#include "core/scene/points.h"

#include <cassert>
#include <utility>

namespace zvo
{

void makePoints(Primitive& primitive)
{
    primitive.is_points = true;
    primitive.triangles.clear();
    primitive.triangles.reserve(primitive.positions.size());
    for (std::size_t i = 0; i < primitive.positions.size(); ++i)
    {
        primitive.triangles.emplace_back(static_cast<std::uint32_t>(i));
    }
}

void widenPoints(Scene& scene, std::uint32_t size)
{
    assert(size >= 1 && size <= kPointSizeMax);
    const auto edge = static_cast<int>(size);
    std::vector<Instance> instances;
    for (const Instance& instance : scene.instances)
    {
        const int count = scene.primitives[instance.primitive].is_points ? edge * edge * edge : 1;
        for (int i = 0; i < count; ++i)
        {
            Instance& voxel = instances.emplace_back(instance);
            const glm::ivec3 cell(i % edge, i / edge % edge, i / (edge * edge));
            voxel.point_shift = count == 1 ? glm::ivec3(0) : 2 * cell - (edge - 1);
        }
    }
    scene.instances = std::move(instances);
}

} // namespace zvo
