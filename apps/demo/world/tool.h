// SPDX-License-Identifier: MIT
#pragma once

#include "core/edit/brush.h"

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <glm/gtc/color_space.hpp>

namespace zvo::demo
{

/// The tool of the left mouse button.
enum class Tool
{
    Camera, ///< orbits
    Brush,  ///< edits voxels
    Move    ///< drags dynamic objects
};

/// What the tools panel shows and changes.
struct ToolState
{
    Tool tool = Tool::Camera;
    BrushAction action = BrushAction::Carve;
    BrushShape shape = BrushShape::Sphere;
    int radius = 8;                                   // voxels
    std::array<float, 3> color = {0.85F, 0.2F, 0.1F}; // sRGB, from 0 to 1
    float emission = 0;                               // radiance, over the colour in linear light

    static constexpr float kEmissionMax = 100;

    bool operator==(const ToolState&) const = default;

    /// The dab at a voxel.
    [[nodiscard]] Brush brushAt(const glm::ivec3& voxel) const
    {
        std::uint32_t packed = 0;
        for (std::size_t i = 0; i < color.size(); ++i)
        {
            packed |= static_cast<std::uint32_t>(glm::clamp(color[i], 0.0F, 1.0F) * 255.0F + 0.5F) << (8 * i);
        }
        const glm::vec3 linear = glm::convertSRGBToLinear(glm::vec3(color[0], color[1], color[2]));
        return {shape, action, voxel, static_cast<std::uint32_t>(radius), packed, emission * linear};
    }
};

} // namespace zvo::demo
