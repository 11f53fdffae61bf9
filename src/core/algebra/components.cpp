// SPDX-License-Identifier: MIT
#include "core/algebra/components.h"

#include "core/algebra/node_places.h"
#include "core/base/divide_up.h"
#include "core/tree/tree_limits.h"
#include "core/voxelize/fragment_sums.h"

#include <algorithm>
#include <tuple>

namespace zvo
{

namespace
{

// Directions as algebra/unite takes them, each -1 to 1 along an axis: across faces, or all.
std::vector<std::uint32_t> directions(bool corners)
{
    std::vector<std::uint32_t> result;
    for (std::uint32_t z = 0; z < 3; ++z)
    {
        for (std::uint32_t y = 0; y < 3; ++y)
        {
            for (std::uint32_t x = 0; x < 3; ++x)
            {
                const int steps = (x != 1) + (y != 1) + (z != 1);
                if (steps == 1 || (corners && steps != 0))
                {
                    result.push_back(x | y << 2U | z << 4U);
                }
            }
        }
    }
    return result;
}

// The parameters that all kernels of units have.
gpu::UnitsParams unitsOf(vk::AnyPass& pass, const DeviceTree& octree)
{
    gpu::UnitsParams params{};
    params.tree = {pass.read(octree.nodes), pass.read(octree.leaf_groups)};
    params.node_count = octree.node_count;
    params.inner_count = octree.innerCount();
    params.level_count = static_cast<std::uint32_t>(octree.levels.size());
    return params;
}

} // namespace

ComponentFinder::ComponentFinder(vk::Device& device, const DeviceTree& octree, const ComponentOptions& options)
    : m_device(device), m_octree(octree), m_options(options), m_counts(device, "algebra/component_counts", 1)
{
    requireOperand(octree);
    m_readback = {device, sizeof(gpu::ComponentCounts)};
    if (octree.node_count == 0)
    {
        finish();
        return;
    }
    const std::uint64_t nodes = octree.node_count;
    device.memory().require(3 * nodes * sizeof(gpu::uvec2), "the parts of nodes");
    m_places = {device, "algebra/places", nodes};
    m_result.firsts = {device, "algebra/firsts", nodes};
    m_result.ranks = {device, "algebra/ranks", nodes};
    m_partials = {device, "algebra/partials", divideUp(nodes, gpu::kScanBlock)};
    m_total = {device, "algebra/unit_count", 1};
    m_step = {&ComponentFinder::find, &ComponentFinder::learnUnits};
}

void ComponentFinder::find(vk::FrameGraph& graph)
{
    placeNodes(graph, m_octree, m_octree.levels.size(), m_places);
    {
        vk::Pass pass =
            graph.addPass(gpu::algebra::FindUnits{.background = m_options.background, .corners = m_options.corners});
        gpu::UnitsParams params = unitsOf(pass, m_octree);
        params.firsts = pass.write(m_result.firsts);
        params.ranks = pass.write(m_result.ranks);
        pass.dispatch(m_octree.node_count, params);
    }
    rankBits(graph, m_result.ranks, m_partials, m_total);
    m_offset = m_readback.copy(graph, m_total, 0, 1);
}

void ComponentFinder::learnUnits()
{
    const std::uint64_t units = std::uint64_t{m_readback.at<gpu::uint>(m_offset, 1).front()} + 1;
    if (units > kIndicesMax)
    {
        throwUncountable("parts of nodes");
    }
    const std::uint64_t sizes = m_options.background ? 0 : units;
    m_device.memory().require(units * sizeof(gpu::uint) + 2 * sizes * sizeof(gpu::Component), "components");
    m_result.labels = {m_device, "algebra/labels", units};
    m_result.sizes = {m_device, "algebra/sizes", sizes};
    m_list = {m_device, "algebra/components", sizes};
    m_step = {&ComponentFinder::unite, &ComponentFinder::learnLabels};
}

void ComponentFinder::unite(vk::FrameGraph& graph)
{
    const auto unit_count = static_cast<std::uint32_t>(m_result.labels.count());
    const auto label = [&](bool clear)
    {
        vk::Pass pass = graph.addPass(gpu::algebra::FlattenLabels{.clear = clear});
        gpu::LabelsParams params{};
        params.labels = pass.readWrite(m_result.labels);
        params.counts = pass.readWrite(m_counts);
        params.unit_count = unit_count;
        pass.dispatch(unit_count, params);
    };
    graph.fill(m_counts, 0);
    if (!m_is_united)
    {
        label(true);
    }
    for (const std::uint32_t direction : directions(m_options.corners))
    {
        vk::Pass pass =
            graph.addPass(gpu::algebra::UniteUnits{.background = m_options.background, .corners = m_options.corners});
        gpu::UnitsParams params = unitsOf(pass, m_octree);
        params.places = pass.read(m_places);
        params.firsts = {pass.read(m_result.firsts).address};
        params.ranks = {pass.read(m_result.ranks).address};
        params.labels = pass.accumulate(m_result.labels);
        params.counts = pass.accumulate(m_counts);
        params.direction = direction;
        pass.dispatch(m_octree.node_count, params);
    }
    label(false);
    m_offset = m_readback.copy(graph, m_counts, 0, 1);
}

// Repeats the step where threads ran out of steps: labels are lower each time.
void ComponentFinder::learnLabels()
{
    m_is_united = true;
    if (m_readback.at<gpu::ComponentCounts>(m_offset, 1).front().unfinished != 0)
    {
        return;
    }
    if (m_options.background)
    {
        m_places = {};
        finish();
        return;
    }
    m_step = {&ComponentFinder::measure, &ComponentFinder::learnCount};
}

void ComponentFinder::measure(vk::FrameGraph& graph)
{
    graph.fill(m_counts, 0);
    graph.fill(m_result.sizes, 0);
    {
        vk::Pass pass = graph.addPass(gpu::algebra::AddSizes{.background = false, .corners = m_options.corners});
        gpu::UnitsParams params = unitsOf(pass, m_octree);
        params.places = pass.read(m_places);
        params.firsts = {pass.read(m_result.firsts).address};
        params.ranks = {pass.read(m_result.ranks).address};
        params.labels = {pass.read(m_result.labels).address};
        params.sizes = pass.readWrite(m_result.sizes);
        pass.dispatch(m_octree.node_count, params);
    }
    vk::Pass pass = graph.addPass(gpu::algebra::ListComponents{});
    gpu::LabelsParams params{};
    params.labels = {pass.read(m_result.labels).address};
    params.sizes = pass.read(m_result.sizes);
    params.list = pass.write(m_list);
    params.counts = pass.readWrite(m_counts);
    params.unit_count = static_cast<std::uint32_t>(m_result.labels.count());
    pass.dispatch(params.unit_count, params);
    m_offset = m_readback.copy(graph, m_counts, 0, 1);
}

void ComponentFinder::learnCount()
{
    m_places = {};
    m_component_count = m_readback.at<gpu::ComponentCounts>(m_offset, 1).front().count;
    m_readback = {m_device, std::uint64_t{m_component_count} * sizeof(gpu::Component) + sizeof(std::uint64_t)};
    m_step = {&ComponentFinder::copyList, &ComponentFinder::readList};
}

void ComponentFinder::copyList(vk::FrameGraph& graph)
{
    m_offset = m_readback.copy(graph, m_list, 0, m_component_count);
}

void ComponentFinder::readList()
{
    for (const gpu::Component& component : m_readback.at<gpu::Component>(m_offset, m_component_count))
    {
        m_result.list.push_back({component.root,
                                 component.size_lo | std::uint64_t{component.size_hi} << 32U,
                                 {component.voxel.x, component.voxel.y, component.voxel.z}});
    }
    std::ranges::sort(m_result.list, [](const ComponentSize& a, const ComponentSize& b)
                      { return std::tie(b.voxels, a.root) < std::tie(a.voxels, b.root); });
    m_list = {};
    finish();
}

ComponentThreshold largestComponents(const Components& components, std::size_t count)
{
    if (count == 0 || components.list.empty())
    {
        return {.voxels = UINT64_MAX, .last_root = 0};
    }
    const ComponentSize& last = components.list[std::min(count, components.list.size()) - 1];
    return {last.voxels, last.root};
}

ComponentThreshold componentsFrom(std::uint64_t voxels)
{
    return {voxels, UINT32_MAX};
}

void maskComponents(vk::FrameGraph& graph, const DeviceTree& octree, const ComponentOptions& options,
                    const Components& components, const ComponentThreshold& threshold, vk::BufferOf<gpu::uvec2>& masks)
{
    if (octree.node_count == 0)
    {
        return;
    }
    vk::Pass pass =
        graph.addPass(gpu::algebra::KeepUnits{.background = options.background, .corners = options.corners});
    gpu::UnitsParams params = unitsOf(pass, octree);
    params.firsts = {pass.read(components.firsts).address};
    params.ranks = {pass.read(components.ranks).address};
    params.labels = {pass.read(components.labels).address};
    params.sizes = {pass.read(components.sizes).address};
    params.kept = pass.write(masks);
    params.least_lo = static_cast<std::uint32_t>(threshold.voxels);
    params.least_hi = static_cast<std::uint32_t>(threshold.voxels >> 32U);
    params.last_root = threshold.last_root;
    pass.dispatch(octree.node_count, params);
}

} // namespace zvo
