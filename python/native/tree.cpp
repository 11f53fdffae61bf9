// SPDX-License-Identifier: MIT
#include "tree.h"

#include "common/output.h"
#include "common/tree_export.h"
#include "core/base/morton.h"
#include "core/tree/normal.h"
#include "runtime/trees.h"
#include "zvo/error.h"

#include <fmt/format.h>

#include <utility>

namespace zvo::python
{

Tree::Tree(std::shared_ptr<Session> session, DeviceTree tree) : m_session(std::move(session)), m_tree(std::move(tree))
{
}

Tree::~Tree()
{
    m_session->retire(std::move(m_tree));
}

TreeData Tree::download() const
{
    return m_session->use([&](vk::HeadlessDevice& device) { return downloadTree(device, m_tree); });
}

Voxels Tree::voxels() const
{
    const TreeData tree = download();
    const std::uint64_t numbers = 3 * tree.occupiedCount();
    Voxels voxels;
    voxels.coords.reserve(numbers);
    if (tree.hasAttributes())
    {
        voxels.colors.reserve(numbers);
        voxels.normals.reserve(numbers);
    }
    std::uint64_t voxel = 0; // of those on the surface
    forEachCell(tree,
                [&](std::uint64_t code, bool on_surface)
                {
                    const glm::ivec3 cell(cellOfCode(code));
                    voxels.coords.insert(voxels.coords.end(), {cell.x, cell.y, cell.z});
                    if (!tree.hasAttributes())
                    {
                        return;
                    }
                    const gpu::Attribute attribute =
                        on_surface ? tree.voxelAttribute(voxel++) : tree.interiorAttribute();
                    for (std::uint32_t shift = 0; shift < 24; shift += 8)
                    {
                        voxels.colors.push_back(static_cast<std::uint8_t>(attribute.color >> shift));
                    }
                    const glm::vec3 normal = decodeNormal(attribute.normal);
                    voxels.normals.insert(voxels.normals.end(), {normal.x, normal.y, normal.z});
                });
    return voxels;
}

std::unique_ptr<Tree> Tree::compress() const
{
    if (m_tree.isDag())
    {
        throw Error(ErrorCode::Usage, "the tree is a DAG already");
    }
    return m_session->use(
        [&](vk::HeadlessDevice& device)
        {
            DeviceTree copy = uploadTree(device, downloadTree(device, m_tree));
            return std::make_unique<Tree>(m_session, zvo::compress(device, std::move(copy)).dag);
        });
}

void Tree::save(const std::string& path) const
{
    const std::string format = cli::treeFormatOf(path);
    if (format.empty())
    {
        throw Error(ErrorCode::Usage, fmt::format("{}: the kind of file is not clear; its name ends in .{}", path,
                                                  fmt::join(cli::kTreeFormats, ", .")));
    }
    cli::Output output(path, true);
    cli::writeTree(download(), format, output);
    output.finish();
}

} // namespace zvo::python
