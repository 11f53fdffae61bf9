// SPDX-License-Identifier: MIT
// The contents of a MagicaVoxel file, before its models are placed; vox_file.h reads whole files.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <glm/glm.hpp>
#include <map>
#include <set>
#include <span>
#include <string>
#include <vector>

namespace zvo
{

constexpr std::int32_t kVoxTranslationMax = 1 << 24; // of an axis
constexpr std::size_t kVoxPaletteSize = 255;

/// What a voxel's bytes say: coordinates in its model, and its colour's index.
struct VoxModelVoxel
{
    std::uint8_t x;
    std::uint8_t y;
    std::uint8_t z;
    std::uint8_t index;
};
static_assert(sizeof(VoxModelVoxel) == 4);

struct VoxModel
{
    glm::ivec3 size{0};
    std::span<const std::uint8_t> voxels; // VoxModelVoxel each

    [[nodiscard]] std::size_t voxelCount() const { return voxels.size() / sizeof(VoxModelVoxel); }
    [[nodiscard]] VoxModelVoxel voxel(std::size_t index) const
    {
        VoxModelVoxel result{};
        std::memcpy(&result, voxels.data() + index * sizeof(result), sizeof(result));
        return result;
    }
};

/// A rotation by quarter turns, which may mirror, followed by a translation by whole voxels.
struct VoxPlacement
{
    glm::ivec3 axis{0, 1, 2}; // which coordinate becomes the i-th one
    glm::ivec3 sign{1};
    glm::ivec3 move{0};

    // Of points in half voxels: voxels' centres are odd.
    [[nodiscard]] glm::ivec3 operator()(const glm::ivec3& halves) const
    {
        return sign * glm::ivec3(halves[axis.x], halves[axis.y], halves[axis.z]) + 2 * move;
    }

    // inner first.
    [[nodiscard]] VoxPlacement after(const VoxPlacement& inner) const
    {
        VoxPlacement both;
        for (int i = 0; i < 3; ++i)
        {
            both.axis[i] = inner.axis[axis[i]];
            both.sign[i] = sign[i] * inner.sign[axis[i]];
            both.move[i] = sign[i] * inner.move[axis[i]] + move[i];
        }
        return both;
    }
};

struct VoxNode
{
    bool hidden = false;
    std::int32_t layer = -1;
    VoxPlacement placement;             // of a transform
    std::vector<std::int32_t> children; // nodes
    std::vector<std::int32_t> models;   // of a shape
};

struct VoxScene
{
    std::array<std::uint32_t, kVoxPaletteSize> palette{}; // red in the lowest byte; of indices from 1 on
    std::array<float, kVoxPaletteSize> emission{};        // likewise; radiance, over the colour in linear light
    std::array<std::string, kVoxPaletteSize> kinds{};     // likewise; of materials that are more than diffuse or emit
    bool has_frames = false;                              // more than one, of nodes
    std::vector<VoxModel> models;
    std::map<std::int32_t, VoxNode> nodes; // empty in files without places
    std::set<std::int32_t> hidden_layers;
};

/// Reads all chunks. The result refers to bytes. Voxels are known to lie in their models; but nodes may name others
/// that do not exist, and may form cycles. name: for messages. Throws Error{Input}.
VoxScene readVoxScene(std::span<const std::uint8_t> bytes, const std::filesystem::path& name);

} // namespace zvo
