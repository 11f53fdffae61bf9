// SPDX-License-Identifier: MIT
#include "core/upload/texture_levels.h"

#include "core/base/finite.h"
#include "core/upload/fixed_uv.h"
#include "shared/scene.h"
#include "voxelize/voxelize.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <optional>

namespace zvo
{

namespace
{

using Corners = std::array<glm::i64vec3, 3>;

// What a device may round an area to, relative to what is computed here: some units in the last place.
constexpr float kRounding = 0x1p-20F;

// The vertices of a primitive on the lattice of a grid, as shaders/voxelize/vertex.glsl snaps them. Nothing where a
// vertex has no place on it.
std::vector<std::optional<glm::i64vec3>> latticePoints(const Primitive& primitive, const glm::mat4& transform,
                                                       const Grid& grid)
{
    const auto scale = static_cast<float>(gpu::kVoxelLattice / static_cast<double>(grid.voxel_size));
    constexpr auto kLimit = static_cast<float>(gpu::kLatticeLimit);
    std::vector<std::optional<glm::i64vec3>> points;
    points.reserve(primitive.positions.size());
    for (const glm::vec3& position : primitive.positions)
    {
        const glm::vec3 scaled = (transformPoint(transform, position) - grid.origin) * scale;
        const glm::vec3 q(std::nearbyint(scaled.x), std::nearbyint(scaled.y), std::nearbyint(scaled.z));
        const bool is_placed = isFinite(q) && std::max({std::abs(q.x), std::abs(q.y), std::abs(q.z)}) <= kLimit;
        points.push_back(is_placed ? std::optional(glm::i64vec3(q)) : std::nullopt);
    }
    return points;
}

bool touchesGrid(const Corners& corners, const Grid& grid)
{
    const std::int64_t end = std::int64_t{gpu::kVoxelLattice} * grid.resolution();
    for (int axis = 0; axis < 3; ++axis)
    {
        const auto [low, high] = std::minmax({corners[0][axis], corners[1][axis], corners[2][axis]});
        if (high < 0 || low > end)
        {
            return false;
        }
    }
    return true;
}

// The largest component of the cross product of two edges, |n_w|.
std::int64_t doubleArea(const Corners& corners)
{
    const glm::i64vec3 e1 = corners[1] - corners[0];
    const glm::i64vec3 e2 = corners[2] - corners[0];
    return std::max({std::abs(e1.y * e2.z - e1.z * e2.y), std::abs(e1.z * e2.x - e1.x * e2.z),
                     std::abs(e1.x * e2.y - e1.y * e2.x)});
}

std::int64_t uvArea(const std::array<glm::i64vec2, 3>& uvs)
{
    const glm::i64vec2 d1 = uvs[1] - uvs[0];
    const glm::i64vec2 d2 = uvs[2] - uvs[0];
    return std::abs(d1.x * d2.y - d2.x * d1.y);
}

// An image of a primitive, and the coordinates by which it is sampled.
struct SampledImage
{
    std::uint32_t image; // index into Scene::images
    const std::vector<glm::vec2>* uvs;
};

// The level that a triangle samples, or the one before it where rounding decides; at most `most`.
std::uint32_t levelOf(const Image& image, std::int64_t uv_area, std::int64_t double_area, std::uint32_t most)
{
    const float texels = static_cast<float>(uv_area) *
                         (static_cast<float>(image.width * image.height) * (1.0F / static_cast<float>(gpu::kUvOne)));
    float budget = static_cast<float>(double_area) * 2.0F;
    std::uint32_t level = 0;
    for (; level < most && texels * (1.0F - kRounding) > budget; ++level)
    {
        budget *= 4.0F;
    }
    return level;
}

} // namespace

std::uint32_t levelCount(std::uint32_t width, std::uint32_t height)
{
    std::uint32_t count = 1;
    for (; width > 1 || height > 1; ++count)
    {
        width = std::max(width / 2, 1U);
        height = std::max(height / 2, 1U);
    }
    return count;
}

std::vector<std::uint32_t> leastLevels(const Scene& scene, const std::vector<bool>& needed, const Grid& grid,
                                       Coverage coverage)
{
    std::vector<std::uint32_t> least;
    for (const Image& image : scene.images)
    {
        least.push_back(levelCount(image.width, image.height) - 1);
    }
    for (const Instance& instance : scene.instances)
    {
        const Primitive& primitive = scene.primitives[instance.primitive];
        const Material& material = scene.materials[primitive.material];
        std::vector<SampledImage> images; // whose least level the instance may lower
        const auto addImage = [&](std::optional<std::uint32_t> texture, const std::vector<glm::vec2>& uvs)
        {
            if (texture && needed[*texture] && !uvs.empty() && least[scene.textures[*texture].image] != 0)
            {
                images.push_back({scene.textures[*texture].image, &uvs});
            }
        };
        addImage(material.base_color_texture, primitive.uvs);
        addImage(material.emission_texture, primitive.emission_uvs.empty() ? primitive.uvs : primitive.emission_uvs);
        if (images.empty())
        {
            continue;
        }
        const auto points = latticePoints(primitive, instance.transform, grid);
        for (const glm::uvec3& t : primitive.triangles)
        {
            if (!points[t.x] || !points[t.y] || !points[t.z])
            {
                continue;
            }
            const Corners corners = {*points[t.x], *points[t.y], *points[t.z]};
            const std::int64_t area = doubleArea(corners);
            if ((area == 0 && coverage == Coverage::Thin) || !touchesGrid(corners, grid))
            {
                continue;
            }
            for (const auto& [image, uvs] : images)
            {
                const std::int64_t uv_area =
                    uvArea({toFixedUv((*uvs)[t.x]), toFixedUv((*uvs)[t.y]), toFixedUv((*uvs)[t.z])});
                least[image] = levelOf(scene.images[image], uv_area, area, least[image]);
            }
        }
    }
    return least;
}

} // namespace zvo
