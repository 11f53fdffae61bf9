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

#include <array>
#include <fstream>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

namespace zvo::cli
{

bool isVoxFile(const std::filesystem::path& path)
{
    std::error_code failure;
    if (extensionOf(path.string()) == ".vox" || !std::filesystem::is_regular_file(path, failure))
    {
        return extensionOf(path.string()) == ".vox"; // a pipe gives its first bytes only once
    }
    std::array<char, 4> first{};
    std::ifstream(path, std::ios::binary).read(first.data(), first.size());
    return std::string_view(first.data(), first.size()) == "VOX ";
}

bool isTreeFile(const std::filesystem::path& path)
{
    return isZvoFile(path) || isVoxFile(path);
}

TreeData treeOfVox(std::span<const std::uint8_t> bytes, const std::filesystem::path& path, bool strict)
{
    const VoxVoxels voxels = readVox(bytes, path);
    warnOrRefuse(voxels.warnings, strict);
    TreeData tree = octreeOfVoxels(voxels.grid, voxels.codes);
    addColors(tree, voxels.colors);
    addEmission(tree, voxels.emission);
    return tree;
}

TreeData loadVox(const std::filesystem::path& path, vk::HeadlessDevice& device, bool strict)
{
    TreeData tree = treeOfVox(readFile(path), path, strict);
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

TreeData loadTree(const std::filesystem::path& path, const std::function<vk::HeadlessDevice&()>& device, bool strict)
{
    return isVoxFile(path) ? loadVox(path, device(), strict) : readZvo(path).tree;
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
