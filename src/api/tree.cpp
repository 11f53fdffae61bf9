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

TreeFacts factsOf(const DeviceTree& tree)
{
    TreeFacts facts;
    facts.structure = tree.structure;
    facts.form = tree.attributeForm();
    facts.grid = gridInfo(tree.grid);
    facts.voxel_count = tree.voxel_count;
    facts.node_count = tree.node_count;
    facts.bytes = tree.geometryBytes() + tree.lists.rankBytes() + tree.attributeBytes() + tree.sums.bytes();
    facts.emission_scale = tree.emission.count() != 0 ? tree.emission_scale : 0;
    return facts;
}

Tree::Impl& usable(const Tree& tree)
{
    Tree::Impl& impl = contentOf(tree.impl(), "tree");
    if (impl.made_in)
    {
        requireUsable(*impl.made_in, "tree");
    }
    return impl;
}

Tree::Impl::Impl(Context::Impl& context_impl, DeviceTree&& tree)
    : context(context_impl), fixed(std::move(tree)), facts(factsOf(fixed)), table(context.device, "tree table", 1)
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

const TreeFacts& Tree::facts() const
{
    return usable(*this).facts;
}

std::uint64_t Tree::address() const
{
    return usable(*this).table.address();
}

} // namespace zvo
