// SPDX-License-Identifier: MIT
#pragma once

#include "core/edit/brush.h"
#include "core/scene/scene.h"
#include "core/tree/device_tree.h"
#include "core/tree/tree_data.h"
#include "vk/headless.h"
#include "zvo/tree.h"
#include "zvo/types.h"

#include <functional>

namespace zvo
{

/// How a mesh edits a tree.
struct MeshDabOptions
{
    BrushAction action = BrushAction::Carve; // or Fill
    Coverage coverage = TreeBuildInfo().coverage;
    Fill fill = Fill::Solid;
};

/// Voxelizes a mesh on the lattice of a tree's grid, as far as floats tell and as far as it reaches, and calls dab()
/// with stamps and boxes that together carve its voxels from the tree, or fill them in; they must be applied in that
/// order. A stamp is a cube of 64^3 voxels at most. tree: which is edited; its emission scale is that of the mesh's
/// emission. Waits. Throws Error{Input} for a mesh that is more than eight times as long as the grid, and
/// Error{Memory}. Cost: the mesh's surface in voxels, and stamps of the nodes of 64^3 voxels that it touches; if it is
/// filled in, its volume.
void forMeshDabs(vk::HeadlessDevice& device, const Scene& mesh, const DeviceTree& tree, const MeshDabOptions& options,
                 const std::function<void(const Brush&)>& dab);

/// The same with dabs that carve what the mesh does not have: the intersection is left. contents: the voxels of the
/// tree, as flattenTree() copies them. Cost: the nodes of 64^3 voxels of the tree.
void forDabsOutside(vk::HeadlessDevice& device, const Scene& mesh, const DeviceTree& tree, const TreeData& contents,
                    const MeshDabOptions& options, const std::function<void(const Brush&)>& dab);

} // namespace zvo
