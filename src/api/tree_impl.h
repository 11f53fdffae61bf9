// SPDX-License-Identifier: MIT
#pragma once

#include "api/context_impl.h"
#include "core/tree/device_tree.h"
#include "shared/tree_table.h"
#include "zvo/tree.h"

#include <cstdint>
#include <memory>
#include <utility>

namespace zvo
{

struct ZVO_LOCAL Tree::Impl
{
    static constexpr const char* kName = "tree"; // in messages

    Impl(Context::Impl& context_impl, DeviceTree&& tree);
    ~Impl()
    {
        context.deleteLater(std::move(fixed));
        context.deleteLater(std::move(table));
    }
    Impl(const Impl&) = delete;
    Impl& operator=(const Impl&) = delete;

    /// Records the passes that write the table.
    void publish(vk::FrameGraph& graph);

    Context::Impl& context;
    DeviceTree fixed;
    TreeInfo tree_info;
    vk::BufferOf<gpu::TreeTable> table;
    std::shared_ptr<FrameState> made_in = nullptr; // null: known to be done, as in a TreeBuild
};

/// The properties of a tree.
TreeInfo infoOf(const DeviceTree& tree);

} // namespace zvo
