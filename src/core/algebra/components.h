// SPDX-License-Identifier: MIT
#pragma once

#include "algebra/algebra.h"
#include "core/base/step_job.h"
#include "core/tree/device_tree.h"
#include "vk/timer.h"

#include <array>
#include <cstdint>
#include <vector>

namespace zvo
{

/// Of what components are found.
struct ComponentOptions
{
    bool background = false; // of the space around voxels, of which those are wanted that do not reach out of the grid
    bool corners = false;    // neighbours are all 26, else the 6 across faces; not of the background
};

/// A connected component.
struct ComponentSize
{
    std::uint32_t root = 0; // its number among units
    std::uint64_t voxels = 0;
    std::array<std::uint32_t, 3> voxel{}; // cell of one of them
};

/// The components of an octree (shaders/algebra/algebra.h).
struct Components
{
    std::vector<ComponentSize> list; // the largest first, of equals the one with the lowest root; not of the background
    vk::BufferOf<gpu::uvec2> firsts; // [nodes] the lowest cell of each of a node\'s units
    vk::BufferOf<gpu::uvec2> ranks;  // [nodes] x: a bit for each unit; y: units before
    vk::BufferOf<gpu::uint> labels;  // [units + 1] roots
    vk::BufferOf<gpu::Component> sizes; // [units + 1] of roots; empty for the background
    std::vector<vk::PassTime> passes;
    std::uint32_t retry_count = 0;
};

/// Finds the components of an octree. Cost: nodes, leaves included.
class ComponentFinder final : public BuildJob<ComponentFinder, Components>
{
public:
    /// octree outlives the job. Throws Error{Usage} for other trees.
    ComponentFinder(vk::Device& device, const DeviceTree& octree, const ComponentOptions& options);

private:
    void find(vk::FrameGraph& graph);
    void learnUnits();
    void unite(vk::FrameGraph& graph);
    void learnLabels();
    void measure(vk::FrameGraph& graph);
    void learnCount();
    void copyList(vk::FrameGraph& graph);
    void readList();

    vk::Device& m_device;
    const DeviceTree& m_octree;
    ComponentOptions m_options;
    vk::BufferOf<gpu::uvec2> m_places;
    vk::BufferOf<gpu::uint> m_partials;
    vk::BufferOf<gpu::uint> m_total;
    vk::BufferOf<gpu::ComponentCounts> m_counts;
    vk::BufferOf<gpu::Component> m_list;
    std::uint64_t m_offset = 0;
    std::uint32_t m_component_count = 0;
    bool m_is_united = false; // labels have been set
};

/// Which components are kept: those of more voxels, and those of as many whose root is at most last_root.
struct ComponentThreshold
{
    std::uint64_t voxels = 0;
    std::uint32_t last_root = 0;
};

/// The threshold that keeps the `count` largest, or those with at least `voxels` voxels.
ComponentThreshold largestComponents(const Components& components, std::size_t count);
ComponentThreshold componentsFrom(std::uint64_t voxels);

/// Records the pass that writes the cells of each node that belong to kept components, or are enclosed: the masks of
/// TreeOperation::Keep and Enclose. masks: [nodes].
void maskComponents(vk::FrameGraph& graph, const DeviceTree& octree, const ComponentOptions& options,
                    const Components& components, const ComponentThreshold& threshold, vk::BufferOf<gpu::uvec2>& masks);

} // namespace zvo
