// SPDX-License-Identifier: MIT
#include "support/materials_scene.h"

#include "support/scenes.h"

#include <random>

namespace zvo::test
{

Scene materialsScene(float extent, std::size_t count, std::uint32_t seed)
{
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> uniform(0.0F, 1.0F);
    Scene scene;
    // Braces draw numbers in the order in which they stand, with any compiler.
    for (std::uint32_t kind = 0; kind < 5; ++kind)
    {
        Scene part = randomTriangles(23 + seed + kind, count, extent);
        Material& material = part.materials[0];
        Primitive& primitive = part.primitives[0];
        material.base_color = {uniform(random), uniform(random), uniform(random), 0.6F};
        if (kind != 0)
        {
            Image image{"noise", 9, 6, {}};
            for (std::uint32_t i = 0; i < image.width * image.height * 4; ++i)
            {
                image.rgba.push_back(static_cast<std::uint8_t>(random()));
            }
            part.images.push_back(std::move(image));
            part.textures.push_back({0, WrapMode::Repeat, WrapMode::MirroredRepeat});
            material.base_color_texture = 0;
            for (std::size_t i = 0; i < primitive.positions.size(); ++i)
            {
                primitive.uvs.push_back({uniform(random), uniform(random)});
                primitive.colors.push_back({uniform(random), uniform(random), uniform(random), 1.0F});
            }
        }
        material.alpha_mode = kind == 2 ? AlphaMode::Mask : (kind == 3 ? AlphaMode::Blend : AlphaMode::Opaque);
        material.alpha_cutoff = 0.3F;
        if (kind == 0 || kind == 4)
        {
            material.emission = {3.0F, 2.0F, 0.5F};
        }
        if (kind == 4)
        {
            material.emission_texture = 0;
        }
        scene.append(std::move(part));
    }
    return scene;
}

} // namespace zvo::test
