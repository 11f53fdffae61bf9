// SPDX-License-Identifier: MIT
#pragma once

#include "core/edit/brush.h"

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <glm/gtc/color_space.hpp>
#include <optional>

namespace zvo::demo
{

/// The tool of the left mouse button.
enum class Tool
{
    Camera, ///< orbits
    Brush,  ///< edits voxels
    Move,   ///< drags dynamic objects
    Select  ///< selects a box of voxels
};

/// What the brush draws while the button is held.
enum class BrushForm
{
    Stroke, ///< dabs along the pointer's way
    Box,    ///< everything between the first voxel and the last one
    Flood   ///< what is connected to the first voxel and looks like it
};

/// Planes across the axes at which strokes are mirrored.
struct Mirror
{
    std::array<bool, 3> axes = {};
    std::optional<glm::ivec3> at =
        std::nullopt; // voxel through whose middle the planes go; nothing: the middle of the grid

    bool operator==(const Mirror&) const = default;

    /// The sum of a voxel's and its image's coordinates.
    [[nodiscard]] glm::ivec3 sum(const Grid& grid) const { return at ? 2 * *at : glm::ivec3(grid.resolution()) - 1; }
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
    BrushForm form = BrushForm::Stroke;
    int tolerance = 24;                               // of colours that a flood takes for the same, of 255
    Mirror mirror = {};                               // of whatever is edited
    std::optional<VoxelBox> selection = std::nullopt; // what the selecting tool has selected

    static constexpr float kEmissionMax = 100;
    static constexpr int kToleranceMax = 255;

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

    /// The brush around everything between two voxels.
    [[nodiscard]] Brush boxBetween(const glm::ivec3& from, const glm::ivec3& to) const
    {
        Brush box = brushAt(from);
        box.shape = BrushShape::Box;
        box.span = to - from;
        return box;
    }
};

} // namespace zvo::demo
