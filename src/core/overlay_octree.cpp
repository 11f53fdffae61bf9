// SPDX-License-Identifier: MIT
#include "core/overlay_octree.h"

#include "core/divide_up.h"
#include "zvo/error.h"

#include <algorithm>
#include <utility>

namespace zvo
{

namespace
{

constexpr std::uint64_t kCountMax = UINT32_MAX; // kernels count in 32 bits

constexpr std::uint64_t roundUp(std::uint64_t value, std::uint64_t multiple)
{
    return divideUp(value, multiple) * multiple;
}

// Half as much room again, or what is asked for, if that is more.
std::uint64_t grownRoom(std::uint64_t room, std::uint64_t asked)
{
    return room + std::max(room / 2, asked);
}

// A static octree; an empty one is a root without children.
Octree adopted(Octree&& from)
{
    Octree octree = std::move(from);
    octree.node_count = std::max(octree.node_count, 1U);
    octree.levels.clear();
    return octree;
}

template <typename T> void copyAll(vk::FrameGraph& graph, const vk::BufferOf<T>& from, vk::BufferOf<T>& to)
{
    if (from.count() != 0)
    {
        graph.copy(from, 0, to, 0, from.bytes());
    }
}

} // namespace

OverlayOctree::OverlayOctree(vk::HeadlessDevice& device, BuildResult built, const OverlayContents& contents,
                             std::uint64_t room)
    : m_device(device), m_is_empty(built.octree.node_count == 0),
      m_has_attributes(m_is_empty ? contents.attributes : built.octree.hasAttributes()),
      m_emits(m_has_attributes && contents.emission_scale > 0), m_static_emissive(built.octree.emission.count()),
      m_sums(std::move(built.sums)), m_octree(adopted(std::move(built.octree))), m_arena(staticSpace())
{
    m_octree.emission_scale = m_emits ? contents.emission_scale : 1.0F;
    vk::Retired retired;
    m_device.run(
        [&](vk::FrameGraph& graph)
        {
            grow(graph, room, room, retired);
            if (m_is_empty)
            {
                graph.fill(m_octree.nodes, 0);
                graph.fill(m_octree.node_attributes, 0);
            }
            graph.copy(m_octree.nodes, 0, m_octree.nodes, staticRoot() * sizeof(gpu::Node), sizeof(gpu::Node));
            if (m_has_attributes)
            {
                graph.copy(m_octree.node_attributes, 0, m_octree.node_attributes, staticRoot() * sizeof(gpu::Attribute),
                           sizeof(gpu::Attribute));
            }
        });
    m_before.reset();
}

OverlaySpace OverlayOctree::staticSpace() const
{
    return {
        .static_nodes = staticRoot() + 1,
        .node_capacity = staticRoot() + 1,
        .static_voxels = m_octree.voxel_count,
        .voxel_capacity = m_octree.voxel_count,
        .node_bytes = static_cast<std::uint32_t>(sizeof(gpu::Node) + (m_has_attributes ? sizeof(gpu::Attribute) : 0)),
        .voxel_block_bytes = voxelBlockBytes(),
    };
}

std::uint32_t OverlayOctree::voxelBlockBytes() const
{
    std::size_t bytes = m_has_attributes ? kVoxelBlock * sizeof(gpu::Attribute) : 0;
    bytes += m_emits ? kVoxelBlock * sizeof(gpu::uint) + sizeof(gpu::uvec2) : 0;
    return static_cast<std::uint32_t>(bytes);
}

std::uint32_t OverlayOctree::firstOverlayVoxel() const
{
    return static_cast<std::uint32_t>(roundUp(m_octree.voxel_count, kVoxelBlock));
}

std::uint32_t OverlayOctree::emissionOffset() const
{
    return static_cast<std::uint32_t>(m_static_emissive - firstOverlayVoxel());
}

void OverlayOctree::grow(vk::FrameGraph& graph, std::uint64_t nodes, std::uint64_t voxels, vk::Retired& retired)
{
    const OverlaySpace& space = m_arena.space();
    const std::uint64_t voxel_room = space.voxel_capacity - std::min(space.voxel_capacity, firstOverlayVoxel());
    const std::uint64_t node_capacity =
        space.static_nodes + grownRoom(std::uint64_t{space.node_capacity} - space.static_nodes, nodes);
    const std::uint64_t voxel_capacity = firstOverlayVoxel() + roundUp(grownRoom(voxel_room, voxels), kVoxelBlock);
    if (node_capacity > kCountMax || voxel_capacity > kCountMax)
    {
        throw Error(ErrorCode::Memory, "overlays need more nodes or voxels than 32-bit numbers count: keep fewer steps "
                                       "of history, or lower the resolution");
    }
    lengthen(graph, node_capacity, voxel_capacity, retired);
    m_arena.grow(static_cast<std::uint32_t>(node_capacity), static_cast<std::uint32_t>(voxel_capacity));
}

OverlayOctree::Buffers OverlayOctree::makeBuffers(std::uint64_t node_capacity, std::uint64_t voxel_capacity)
{
    const std::uint64_t attribute_nodes = m_has_attributes ? node_capacity : 0;
    const std::uint64_t attribute_voxels = m_has_attributes ? voxel_capacity : 0;
    const std::uint64_t emission_words = m_emits ? voxel_capacity / kVoxelBlock : 0;
    const std::uint64_t emission = m_emits ? m_static_emissive + voxel_capacity - firstOverlayVoxel() : 0;
    m_device.device().memory().require(node_capacity * sizeof(gpu::Node) +
                                           (attribute_nodes + attribute_voxels) * sizeof(gpu::Attribute) +
                                           emission_words * sizeof(gpu::uvec2) + emission * sizeof(gpu::uint),
                                       "room for overlays");
    vk::Device& d = m_device.device();
    return {{d, m_octree.nodes.name(), node_capacity},
            {d, m_octree.node_attributes.name(), attribute_nodes},
            {d, m_octree.voxel_attributes.name(), attribute_voxels},
            {d, m_octree.emission_words.name(), emission_words},
            {d, m_octree.emission.name(), emission}};
}

void OverlayOctree::swapBuffers(Buffers& buffers)
{
    std::swap(m_octree.nodes, buffers.nodes);
    std::swap(m_octree.node_attributes, buffers.node_attributes);
    std::swap(m_octree.voxel_attributes, buffers.voxel_attributes);
    std::swap(m_octree.emission_words, buffers.emission_words);
    std::swap(m_octree.emission, buffers.emission);
}

void OverlayOctree::lengthen(vk::FrameGraph& graph, std::uint64_t node_capacity, std::uint64_t voxel_capacity,
                             vk::Retired& retired)
{
    Buffers from = makeBuffers(node_capacity, voxel_capacity); // all of them, before anything is recorded
    swapBuffers(from);
    copyAll(graph, from.nodes, m_octree.nodes);
    if (m_has_attributes)
    {
        copyAll(graph, from.node_attributes, m_octree.node_attributes);
        copyAll(graph, from.voxel_attributes, m_octree.voxel_attributes);
    }
    if (m_emits)
    {
        copyAll(graph, from.emission_words, m_octree.emission_words);
        copyAll(graph, from.emission, m_octree.emission);
        if (from.emission_words.count() == 0) // nothing of the static octree emits
        {
            graph.fill(m_octree.emission_words, 0);
        }
    }
    if (m_before) // made in this frame
    {
        retired.keep(std::move(from));
    }
    else
    {
        m_before = std::move(from);
    }
}

void OverlayOctree::frameSubmitted(vk::Retired& retired)
{
    if (m_before)
    {
        retired.keep(std::move(*m_before));
        m_before.reset();
    }
}

void OverlayOctree::frameLost(vk::Retired& retired)
{
    if (m_before)
    {
        swapBuffers(*m_before);
        frameSubmitted(retired);
    }
}

void OverlayOctree::catchUp(vk::FrameGraph& graph, vk::Retired& retired)
{
    const OverlaySpace& space = m_arena.space();
    if (m_octree.nodes.count() != space.node_capacity)
    {
        lengthen(graph, space.node_capacity, space.voxel_capacity, retired);
    }
}

} // namespace zvo
