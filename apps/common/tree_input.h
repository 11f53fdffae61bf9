// SPDX-License-Identifier: MIT
// Reading files that hold voxels already.
#pragma once

#include "core/scene/scene.h"
#include "core/tree/tree_data.h"
#include "vk/headless.h"

#include <filesystem>

namespace zvo::cli
{

/// Whether a file, by its name, is a .vox file of MagicaVoxel.
bool isVoxFile(const std::filesystem::path& path);

/// The octree of the voxels in a .vox file, with attributes of nodes, which the device computes. Reports what was left
/// out. Throws Error{Input}, and Error{Memory} when the device's budget does not suffice.
TreeData loadVox(const std::filesystem::path& path, vk::HeadlessDevice& device);

/// The box around a tree's voxels in world space; empty where there are none.
Bounds boundsOf(const TreeData& tree);

} // namespace zvo::cli
