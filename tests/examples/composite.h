// SPDX-License-Identifier: MIT
// Which of a mesh and voxels a pixel of the examples' pictures shows, without any of the devices' work.
#pragma once

#include "common/mesh.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <set>
#include <vector>

namespace zvo::test
{

/// A picture of the examples' size, rows from the top.
struct Picture
{
    static constexpr std::size_t kWidth = 320;
    static constexpr std::size_t kHeight = 200;
    using Rgb = std::array<std::uint8_t, 3>;

    std::vector<Rgb> rgb = std::vector<Rgb>(kWidth * kHeight);

    [[nodiscard]] std::size_t colorCount() const { return std::set(rgb.begin(), rgb.end()).size(); }
    friend bool operator==(const Picture&, const Picture&) = default;
};

enum class Winner
{
    Neither,         ///< no mesh here: a voxel, or nothing
    Mesh,            ///< before all voxels
    VoxelBeforeMesh, ///< both are here
    Open,            ///< the mesh's vertices are rounded to parts of a pixel by devices: either may win
};

using Winners = std::vector<Winner>; // of all pixels

/// Of the camera that the examples share. knot: the scene that is voxelized, thin, in the smallest grid around it.
/// A pixel is open where its answer changes when it moves by a 64th of its edge, or the mesh by a 1000th of a voxel.
Winners winnersOf(const std::filesystem::path& knot, std::uint32_t depth, const host::Mesh& mesh);

/// Pixels in which the mesh wins, beside one in which a voxel does that is before it.
std::size_t edgeCount(const Winners& winners);

} // namespace zvo::test
