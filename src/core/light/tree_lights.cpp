// SPDX-License-Identifier: MIT
#include "core/light/tree_lights.h"

#include "core/tree/tree_table.h"

#include <array>

namespace zvo
{

void TreeLights::prepare(vk::FrameGraph& graph, const DeviceTree& tree)
{
    if (m_version == tree.version)
    {
        return;
    }
    m_version = 0; // should anything below throw
    graph.update(m_table, 0, std::array{treeTable(tree)});
    if (hasEmission(tree))
    {
        if (m_lights == nullptr || !m_lights->suffices(tree))
        {
            vk::replace(m_deletion_queue, m_lights, std::make_unique<LightTree>(m_device, tree));
        }
        buildLightTree(graph, tree, m_table, *m_lights);
    }
    m_version = tree.version;
}

std::uint64_t TreeLights::bytes() const
{
    if (m_lights == nullptr)
    {
        return m_table.bytes();
    }
    return m_table.bytes() + m_lights->nodes.bytes() + m_lights->bricks.bytes() + m_lights->items.bytes() +
           m_lights->levels.bytes() + m_lights->args.bytes();
}

} // namespace zvo
