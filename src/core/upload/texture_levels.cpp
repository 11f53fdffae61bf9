// SPDX-License-Identifier: MIT
#include "core/upload/texture_levels.h"

#include "core/upload/fixed_uv.h"
#include "core/upload/lattice_corners.h"
#include "shared/scene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <optional>

namespace zvo
{

namespace
{

// What a device may round an area to, relative to what is computed here: some units in the last place.
constexpr float kRounding = 0x1p-20F;

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
        for (const glm::uvec3& t : primitive.triangles)
        {
            const std::optional<LatticeCorners> corners = latticeCorners(primitive, t, instance.transform, grid);
            const glm::i64vec3 n = corners ? glm::abs(normalOf(*corners)) : glm::i64vec3(0);
            const std::int64_t area = std::max({n.x, n.y, n.z});
            if (!corners || (area == 0 && coverage == Coverage::Thin && !primitive.is_points))
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
