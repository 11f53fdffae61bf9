// SPDX-License-Identifier: MIT
#include "core/algebra/algebra_job.h"

#include "zvo/error.h"

#include <cassert>
#include <utility>

namespace zvo
{

AlgebraJob::AlgebraJob(vk::Device& device, const GpuScene& color_tables, const AlgebraInfo& info, const DeviceTree& a,
                       const DeviceTree* b)
    : m_device(device), m_tables(color_tables), m_info(info), m_a(a), m_b(b)
{
    assert(info.voxels != 0 && info.least_voxels != 0);
    if ((info.operation < TreeOperation::Keep) != (b != nullptr))
    {
        throw Error(ErrorCode::Usage,
                    b == nullptr ? "this operation takes a second tree" : "this operation takes no second tree");
    }
    if (info.operation != TreeOperation::Keep && info.operation != TreeOperation::Enclose)
    {
        operate(a);
        return;
    }
    m_finder.emplace(device, a, componentOptions());
    if (m_finder->isDone()) // without voxels
    {
        endComponents();
    }
}

ComponentOptions AlgebraJob::componentOptions() const
{
    const bool background = m_info.operation == TreeOperation::Enclose;
    return {.background = background, .corners = !background && m_info.corners};
}

void AlgebraJob::operate(const DeviceTree& a)
{
    m_operator.emplace(m_device, m_tables,
                       OperationInfo{.operation = m_info.operation,
                                     .corners = m_info.corners,
                                     .a = &a,
                                     .b = m_b,
                                     .masks = m_masks.count() != 0 ? &m_masks : nullptr});
}

void AlgebraJob::record(vk::FrameGraph& graph)
{
    if (m_finder)
    {
        m_finder->record(graph);
        return;
    }
    if (m_masks.count() != 0 && !m_is_masked)
    {
        const ComponentThreshold threshold =
            m_info.largest != 0 ? largestComponents(m_components, m_info.largest) : componentsFrom(m_info.least_voxels);
        maskComponents(graph, m_a, componentOptions(), m_components, threshold, m_masks);
    }
    m_operator->record(graph);
}

void AlgebraJob::resume(std::vector<vk::PassTime> passes)
{
    if (m_finder)
    {
        m_finder->resume(std::move(passes));
        if (m_finder->isDone())
        {
            endComponents();
        }
        return;
    }
    m_is_masked = true;
    m_operator->resume(std::move(passes));
    if (m_operator->isDone())
    {
        endOperation();
    }
}

void AlgebraJob::endComponents()
{
    m_components = m_finder->take();
    m_finder.reset();
    m_device.memory().require(m_a.node_count * sizeof(gpu::uvec2), "what is kept of nodes");
    m_masks = {m_device, "algebra/kept", m_a.node_count};
    operate(m_a);
}

void AlgebraJob::endOperation()
{
    DeviceTree result = m_operator->take().octree;
    m_operator.reset();
    m_result = std::move(result);
    const bool repeats = m_info.operation == TreeOperation::Dilate || m_info.operation == TreeOperation::Erode;
    if (repeats && --m_info.voxels != 0)
    {
        operate(m_result);
        return;
    }
    m_components = {};
    m_masks = {};
}

} // namespace zvo
