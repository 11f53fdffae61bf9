// SPDX-License-Identifier: MIT
#include "core/scene/scene.h"

#include "core/base/finite.h"

#include <cmath>
#include <iterator>
#include <utility>

namespace zvo
{

namespace
{

template <typename T> void moveBehind(std::vector<T>& into, std::vector<T>& from)
{
    into.insert(into.end(), std::make_move_iterator(from.begin()), std::make_move_iterator(from.end()));
    from.clear();
}

/// Moves an index behind count items that come first, but none stays none.
void shift(std::uint32_t& index, std::size_t count)
{
    if (index != kNone)
    {
        index += static_cast<std::uint32_t>(count);
    }
}

} // namespace

std::uint64_t Scene::triangleCount() const
{
    std::uint64_t count = 0;
    for (const Instance& instance : instances)
    {
        count += primitives[instance.primitive].triangles.size();
    }
    return count;
}

Bounds Scene::bounds() const
{
    Bounds bounds;
    for (const Instance& instance : instances)
    {
        const Primitive& primitive = primitives[instance.primitive];
        for (const glm::uvec3& triangle : primitive.triangles)
        {
            for (const std::uint32_t vertex : {triangle.x, triangle.y, triangle.z})
            {
                const glm::vec3 point = transformPoint(instance.transform, primitive.positions[vertex]);
                if (isFinite(point))
                {
                    bounds.extend(point);
                }
            }
        }
    }
    return bounds;
}

void Scene::append(Scene&& other)
{
    const auto first_image = static_cast<std::uint32_t>(images.size());
    const auto first_texture = static_cast<std::uint32_t>(textures.size());
    const auto first_material = static_cast<std::uint32_t>(materials.size());
    const auto first_primitive = static_cast<std::uint32_t>(primitives.size());
    for (Texture& texture : other.textures)
    {
        texture.image += first_image;
    }
    for (Material& material : other.materials)
    {
        for (std::optional<std::uint32_t>* texture : {&material.base_color_texture, &material.emission_texture})
        {
            if (texture->has_value())
            {
                **texture += first_texture;
            }
        }
    }
    for (Primitive& primitive : other.primitives)
    {
        primitive.material += first_material;
    }
    for (Instance& instance : other.instances)
    {
        instance.primitive += first_primitive;
        shift(instance.node, nodes.size());
        shift(instance.skin, skins.size());
    }
    for (Node& node : other.nodes)
    {
        shift(node.parent, nodes.size());
    }
    for (Skin& skin : other.skins)
    {
        for (std::uint32_t& joint : skin.joints)
        {
            shift(joint, nodes.size());
        }
    }
    for (Animation& animation : other.animations)
    {
        for (Channel& channel : animation.channels)
        {
            shift(channel.node, nodes.size());
        }
    }
    moveBehind(images, other.images);
    moveBehind(textures, other.textures);
    moveBehind(materials, other.materials);
    moveBehind(primitives, other.primitives);
    moveBehind(instances, other.instances);
    moveBehind(cameras, other.cameras);
    moveBehind(nodes, other.nodes);
    moveBehind(skins, other.skins);
    moveBehind(animations, other.animations);
    moveBehind(warnings, other.warnings);
}

// Compiled without contraction (zvo_options), so that no product and sum are fused.
glm::vec3 transformPoint(const glm::mat4& transform, const glm::vec3& point)
{
    const auto component = [&](int row)
    {
        return ((transform[0][row] * point.x + transform[1][row] * point.y) + transform[2][row] * point.z) +
               transform[3][row];
    };
    return {component(0), component(1), component(2)};
}

} // namespace zvo
