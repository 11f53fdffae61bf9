// SPDX-License-Identifier: MIT
// MagicaVoxel's files: voxels in models of up to 256^3 with 255 colours, placed by a scene graph. After:
// ephtracy, MagicaVoxel .vox File Format and its extension (github.com/ephtracy/voxel-model).
//
// MagicaVoxel's z points up. Its voxel (X, Y, Z) is zvo's cell (X, Z, -1 - Y): nothing is mirrored.
#pragma once

#include "core/tree/tree_data.h"
#include "io/voxel/write_bytes.h"

#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <span>
#include <string>
#include <vector>

namespace zvo
{

/// The voxels of a .vox file, in the smallest grid from the origin on. If voxels lie below the origin, the grid begins
/// there.
struct VoxVoxels
{
    Grid grid;                         // voxels of size 1
    std::vector<std::uint64_t> codes;  // Morton codes, ascending, each once
    std::vector<std::uint32_t> colors; // [codes] sRGB red | green << 8 | blue << 16
    std::vector<glm::vec3> emission;   // [codes] linear radiance; empty where nothing emits
    std::vector<std::string> warnings; // about what was left out
};

/// The voxels of all models that the scene graph shows. Models are placed in its order; where they overlap, the last
/// one counts. Hidden nodes and layers are left out; with a warning, all frames of an animation but the first. Of
/// materials only emission is read; others of voxels are named in a warning. Without a scene graph, only the first
/// model is read. Throws Error{Input}: one line that begins with name.
VoxVoxels readVox(std::span<const std::uint8_t> bytes, const std::filesystem::path& name);

/// Hands the bytes of a .vox file to write, piece by piece: a model for each block of 256^3 voxels that has any, in
/// Morton order, and 255 colours for those of the voxels (io/voxel/quantize.h), of which up to 128, and at least 32,
/// are those of lamps (core/tree/lamps.h). Normals are left out. Throws Error{Usage} for more voxels than 2 GiB hold.
void writeVox(const TreeData& tree, const WriteBytes& write);

} // namespace zvo
