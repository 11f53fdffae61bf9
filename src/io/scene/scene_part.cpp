// SPDX-License-Identifier: MIT
#include "io/scene/scene_part.h"

#include "core/scene/animation.h"

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <fmt/format.h>
#include <fnmatch.h>
#include <type_traits>
#include <utility>

namespace zvo
{

namespace
{

/// The items of a list that are in use, and their new numbers.
class Used
{
public:
    explicit Used(std::size_t count) : m_numbers(count, kNone) {}

    /// Marks the item as used, and returns its new number.
    std::uint32_t number(std::uint32_t index)
    {
        std::uint32_t& number = m_numbers[index];
        if (number == kNone)
        {
            number = static_cast<std::uint32_t>(m_indices.size());
            m_indices.push_back(index);
        }
        return number;
    }

    /// Old indices, in order of the new numbers.
    [[nodiscard]] const std::vector<std::uint32_t>& indices() const { return m_indices; }

private:
    std::vector<std::uint32_t> m_numbers;
    std::vector<std::uint32_t> m_indices;
};

/// scene: a const one is copied from, one that is not is moved from.
template <typename AnyScene> Scene takePart(AnyScene& scene, const std::vector<bool>& keep)
{
    assert(keep.size() == scene.instances.size());
    const auto take = [](auto& items, const Used& used)
    {
        std::vector<typename std::remove_reference_t<decltype(items)>::value_type> taken;
        for (const std::uint32_t index : used.indices())
        {
            taken.push_back(std::move(items[index])); // a copy of an item that is const
        }
        return taken;
    };
    Scene part;
    Used primitives(scene.primitives.size());
    for (std::size_t i = 0; i < scene.instances.size(); ++i)
    {
        if (keep[i])
        {
            Instance& instance = part.instances.emplace_back(scene.instances[i]);
            instance.primitive = primitives.number(instance.primitive);
        }
    }
    part.primitives = take(scene.primitives, primitives);
    Used materials(scene.materials.size());
    for (Primitive& primitive : part.primitives)
    {
        primitive.material = materials.number(primitive.material);
    }
    part.materials = take(scene.materials, materials);
    Used textures(scene.textures.size());
    for (Material& material : part.materials)
    {
        for (std::optional<std::uint32_t>* texture : {&material.base_color_texture, &material.emission_texture})
        {
            *texture = *texture ? std::optional(textures.number(**texture)) : std::nullopt;
        }
    }
    part.textures = take(scene.textures, textures);
    Used images(scene.images.size());
    for (Texture& texture : part.textures)
    {
        texture.image = images.number(texture.image);
    }
    part.images = take(scene.images, images);
    part.cameras = scene.cameras;
    part.nodes = scene.nodes;
    part.skins = scene.skins;
    part.animations = scene.animations;
    part.warnings = scene.warnings;
    return part;
}

} // namespace

Scene partOf(const Scene& scene, const std::vector<bool>& keep)
{
    return takePart(scene, keep);
}

Scene partOf(Scene&& scene, const std::vector<bool>& keep)
{
    return takePart(scene, keep);
}

Scene asModelled(Scene scene)
{
    scene.nodes.clear();
    scene.skins.clear();
    scene.animations.clear();
    for (Primitive& primitive : scene.primitives)
    {
        primitive.joints.clear();
        primitive.weights.clear();
        primitive.morph_targets.clear();
    }
    for (Instance& instance : scene.instances)
    {
        instance.node = kNone;
        instance.skin = kNone;
    }
    return scene;
}

Scene atRest(Scene scene)
{
    scene.animations.clear();
    const Pose pose = poseAt(scene, 0.0);
    std::vector<bool> deforms(scene.primitives.size());
    for (std::size_t i = 0; i < scene.instances.size(); ++i)
    {
        const std::vector<float>& weights = pose.morph_weights[i];
        if (scene.instances[i].skin != kNone ||
            std::any_of(weights.begin(), weights.end(), [](float weight) { return weight != 0.0F; }))
        {
            deforms[scene.instances[i].primitive] = true;
        }
    }
    if (std::find(deforms.begin(), deforms.end(), true) == deforms.end())
    {
        return asModelled(std::move(scene));
    }
    for (std::size_t i = 0; i < deforms.size(); ++i)
    {
        if (!deforms[i])
        {
            scene.primitives[i].morph_targets.clear(); // so that its instances go on sharing it
        }
    }
    std::vector<Image> images = std::exchange(scene.images, {}); // are not copied
    Scene posed = posedScene(scene, pose);
    posed.images = std::move(images);
    return posed;
}

SkippedMaterials::SkippedMaterials(std::vector<std::string> patterns)
    : m_patterns(std::move(patterns)), m_found(m_patterns.size())
{
}

void SkippedMaterials::leaveOut(Scene& scene)
{
    std::vector<bool> skipped(scene.materials.size());
    for (std::size_t i = 0; i < m_patterns.size(); ++i)
    {
        for (std::size_t k = 0; k < scene.materials.size(); ++k)
        {
            if (fnmatch(m_patterns[i].c_str(), scene.materials[k].name.c_str(), 0) == 0)
            {
                skipped[k] = true;
                m_found[i] = true;
            }
        }
    }
    std::erase_if(scene.instances,
                  [&](const Instance& instance) { return skipped[scene.primitives[instance.primitive].material]; });
}

std::vector<std::string> SkippedMaterials::warnings() const
{
    std::vector<std::string> lines;
    for (std::size_t i = 0; i < m_patterns.size(); ++i)
    {
        if (!m_found[i])
        {
            lines.push_back(fmt::format("--skip-material: no material has a name like \"{}\"", m_patterns[i]));
        }
    }
    return lines;
}

} // namespace zvo
