// SPDX-License-Identifier: MIT
#include "common/tree_input.h"

#include "common/output.h"
#include "common/progress.h"
#include "core/base/read_file.h"
#include "core/file/zvo_file.h"
#include "core/octree/octree_build.h"
#include "core/tree/tree_build.h"
#include "core/upload/gpu_scene.h"
#include "io/voxel/vox_file.h"

#include <fmt/format.h>

#include <optional>
#include <string>
#include <vector>

namespace zvo::cli
{

bool isVoxFile(const std::filesystem::path& path)
{
    return extensionOf(path.string()) == ".vox";
}

bool isTreeFile(const std::filesystem::path& path)
{
    return isZvoFile(path) || isVoxFile(path);
}

TreeData treeOfVox(std::span<const std::uint8_t> bytes, const std::filesystem::path& path)
{
    const VoxVoxels voxels = readVox(bytes, path);
    for (const std::string& warning : voxels.warnings)
    {
        talk(fmt::format("warning: {}", warning));
    }
    TreeData tree = octreeOfVoxels(voxels.grid, voxels.codes);
    addColors(tree, voxels.colors);
    addEmission(tree, voxels.emission);
    return tree;
}

TreeData loadVox(const std::filesystem::path& path, vk::HeadlessDevice& device)
{
    TreeData tree = treeOfVox(readFile(path), path);
    if (tree.nodes.empty())
    {
        return tree;
    }
    const GpuScene tables = uploadColorTables(device);
    DeviceTree octree = uploadTree(device, tree);
    octree.node_attributes = {device.device(), "octree/node_attributes", octree.node_count};
    device.run([&](vk::FrameGraph& graph) { averageNodes(graph, tables, octree); });
    tree.node_attributes = device.download(octree.node_attributes);
    return tree;
}

TreeData loadTree(const std::filesystem::path& path, const std::function<vk::HeadlessDevice&()>& device)
{
    return isVoxFile(path) ? loadVox(path, device()) : readZvo(path).tree;
}

Bounds boundsOf(const TreeData& tree)
{
    const std::optional<CellBox> box = voxelBox(tree);
    Bounds bounds;
    if (box)
    {
        const auto corner = [&grid = tree.grid](const glm::uvec3& cell)
        { return glm::vec3(glm::dvec3(grid.origin) + glm::dvec3(cell) * double{grid.voxel_size}); };
        bounds = {corner(box->min), corner(box->max)};
    }
    return bounds;
}

} // namespace zvo::cli
