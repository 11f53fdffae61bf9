// SPDX-License-Identifier: MIT
#pragma once

#include "api/context_impl.h"
#include "core/overlay/overlay_octree.h"
#include "core/tree/tree_view.h"
#include "shared/tree_table.h"
#include "zvo/tree.h"

#include <cstdint>
#include <memory>
#include <utility>

namespace zvo
{

struct ZVO_LOCAL Tree::Impl
{
    Impl(Context::Impl& context_impl, StaticTree&& tree);
    ~Impl()
    {
        context.retire(std::move(fixed));
        context.retire(std::move(table));
    }
    Impl(const Impl&) = delete;
    Impl& operator=(const Impl&) = delete;

    [[nodiscard]] TreeView view() const { return fixed.has_lists ? TreeView(fixed.dag) : TreeView(fixed.dag.tree); }

    /// Records what writes the table.
    void publish(vk::FrameGraph& graph);

    Context::Impl& context;
    StaticTree fixed;
    TreeFacts facts;
    vk::BufferOf<gpu::TreeTable> table;
    std::uint64_t version;
    std::shared_ptr<FrameState> made_in = nullptr; // null: by a TreeBuild, when the device was done
};

/// What a tree is like.
TreeFacts factsOf(const StaticTree& tree);

/// Throws Error{Usage} for a tree that was lost with its frame, or taken away.
Tree::Impl& usable(const Tree& tree);

} // namespace zvo
