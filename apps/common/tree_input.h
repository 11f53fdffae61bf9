// SPDX-License-Identifier: MIT
// Reading files that hold voxels already.
#pragma once

#include "core/scene/scene.h"
#include "core/tree/tree_data.h"
#include "vk/headless.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>

namespace zvo::cli
{

/// Whether a file is a .vox file of MagicaVoxel, by its name or its first bytes.
bool isVoxFile(const std::filesystem::path& path);

/// Whether a file holds voxels in place of triangles: a .zvo or .vox file.
bool isTreeFile(const std::filesystem::path& path);

/// The octree of the voxels in the bytes of a .vox file, without attributes of nodes. Reports what was left out;
/// strict: refuses that. path: of messages. Throws Error{Input}.
TreeData treeOfVox(std::span<const std::uint8_t> bytes, const std::filesystem::path& path, bool strict = false);

/// The same of a file, with attributes of nodes, which the device computes. Throws Error{Memory}, too, when the
/// device's budget does not suffice.
TreeData loadVox(const std::filesystem::path& path, vk::HeadlessDevice& device, bool strict);

/// The tree of a .zvo or .vox file. device: called where one is needed, for .vox files. Throws as loadVox() and
/// readZvo().
TreeData loadTree(const std::filesystem::path& path, const std::function<vk::HeadlessDevice&()>& device, bool strict);

/// The box around a tree's voxels in world space; empty where there are none.
Bounds boundsOf(const TreeData& tree);

} // namespace zvo::cli
