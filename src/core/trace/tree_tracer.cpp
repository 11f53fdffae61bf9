// SPDX-License-Identifier: MIT
#include "core/trace/tree_tracer.h"

namespace zvo
{

void TreeTracer::resize(std::uint32_t width, std::uint32_t height)
{
    if (m_buffers == nullptr || m_buffers->width != width || m_buffers->height != height)
    {
        vk::replace(m_deletion_queue, m_buffers, std::make_unique<TraceBuffers>(m_device, width, height, m_texels));
    }
}

void TreeTracer::reserve(const DeviceTree& tree)
{
    if (m_paths == nullptr || (tree.isDag() && !m_paths_are_for_dags))
    {
        vk::replace(m_deletion_queue, m_paths, std::make_unique<NodePaths>(m_device, tree.isDag()));
        m_paths_are_for_dags = tree.isDag();
        forget();
    }
}

void TreeTracer::prepare(vk::FrameGraph& graph, const DeviceTree& tree)
{
    if (m_paths_version == tree.version)
    {
        return;
    }
    reserve(tree);
    forget(); // should the next line throw
    buildNodePaths(graph, tree, *m_paths);
    m_paths_version = tree.version;
}

void TreeTracer::tracePrimary(vk::FrameGraph& graph, const DeviceTree& tree, const TraceCamera& camera,
                              const TraceOptions& options)
{
    prepare(graph, tree);
    zvo::tracePrimary(graph, tree, *m_paths, camera, options, *m_buffers);
}

void TreeTracer::trace(vk::FrameGraph& graph, const DeviceTree& tree, const TraceCamera& camera,
                       const TraceOptions& options)
{
    prepare(graph, tree);
    zvo::trace(graph, tree, *m_paths, camera, options, *m_buffers);
}

void TreeTracer::traceTo(vk::FrameGraph& graph, const DeviceTree& tree, const TraceCamera& camera,
                         const TraceOptions& options, const TexelTarget& target)
{
    prepare(graph, tree);
    zvo::traceTo(graph, tree, *m_paths, camera, options, *m_buffers, target);
}

} // namespace zvo
