// SPDX-License-Identifier: MIT
#include "zvo/tree.h"

#include "api/convert.h"
#include "api/tree_impl.h"
#include "core/file/zvo_file.h"
#include "core/tree/tree_data.h"
#include "core/tree/tree_table.h"

namespace zvo
{

namespace
{

std::unique_ptr<Tree::Impl> uploaded(Recorder& recorder, const TreeData& data)
{
    return recording(recorder,
                     [&](Recorder::Impl& impl)
                     {
                         auto tree = std::make_unique<Tree::Impl>(impl.context, uploadTree(impl.context.uploads, data));
                         tree->made_in = impl.frame;
                         impl.context.uploads.flush();
                         tree->publish(impl.graph);
                         return tree;
                     });
}

} // namespace

TreeInfo infoOf(const DeviceTree& tree)
{
    TreeInfo tree_info;
    tree_info.structure = tree.structure;
    tree_info.format = tree.attributeFormat();
    tree_info.grid = gridInfo(tree.grid);
    tree_info.voxel_count = tree.voxel_count;
    tree_info.node_count = tree.node_count;
    tree_info.bytes = tree.geometryBytes() + tree.lists.rankBytes() + tree.attributeBytes() + tree.sums.bytes();
    tree_info.emission_scale = tree.emission.count() != 0 ? tree.emission_scale : 0;
    return tree_info;
}

Tree::Impl::Impl(Context::Impl& context_impl, DeviceTree&& tree)
    : context(context_impl), fixed(std::move(tree)), tree_info(infoOf(fixed)), table(context.device, "tree table", 1)
{
}

void Tree::Impl::publish(vk::FrameGraph& graph)
{
    const gpu::TreeTable values = treeTable(fixed);
    graph.update(table, 0, std::span(&values, 1));
}

Tree::Tree(Recorder& recorder, std::span<const std::byte> file)
    : m_impl(uploaded(recorder, readZvo(file, "the tree in memory").tree))
{
}

Tree::Tree(Recorder& recorder, const std::filesystem::path& path) : m_impl(uploaded(recorder, readZvo(path).tree)) {}

Tree::Tree(std::unique_ptr<Impl> impl) : m_impl(std::move(impl)) {}

std::unique_ptr<Tree::Impl> Tree::release()
{
    return std::move(m_impl);
}

Tree::~Tree() = default;
Tree::Tree(Tree&&) noexcept = default;
Tree& Tree::operator=(Tree&&) noexcept = default;

const TreeInfo& Tree::info() const
{
    return usable(*this).tree_info;
}

std::uint64_t Tree::address() const
{
    return usable(*this).table.address();
}

} // namespace zvo
