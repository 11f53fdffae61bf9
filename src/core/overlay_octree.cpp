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

template <typename T>
void lengthen(vk::FrameGraph& graph, vk::BufferOf<T>& buffer, vk::BufferOf<T>&& longer, vk::Retired& retired)
{
    if (buffer.count() != 0)
    {
        graph.copy(buffer, 0, longer, 0, buffer.bytes());
    }
    retired.keep(std::exchange(buffer, std::move(longer)));
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
    const std::uint64_t attribute_nodes = m_has_attributes ? node_capacity : 0;
    const std::uint64_t attribute_voxels = m_has_attributes ? voxel_capacity : 0;
    const std::uint64_t emission_words = m_emits ? voxel_capacity / kVoxelBlock : 0;
    const std::uint64_t emission = m_emits ? m_static_emissive + voxel_capacity - firstOverlayVoxel() : 0;
    m_device.device().memory().require(node_capacity * sizeof(gpu::Node) +
                                           (attribute_nodes + attribute_voxels) * sizeof(gpu::Attribute) +
                                           emission_words * sizeof(gpu::uvec2) + emission * sizeof(gpu::uint),
                                       "room for overlays");

    // All of them, before anything is recorded.
    vk::Device& d = m_device.device();
    vk::BufferOf<gpu::Node> longer_nodes(d, m_octree.nodes.name(), node_capacity);
    vk::BufferOf<gpu::Attribute> averages(d, m_octree.node_attributes.name(), attribute_nodes);
    vk::BufferOf<gpu::Attribute> attributes(d, m_octree.voxel_attributes.name(), attribute_voxels);
    vk::BufferOf<gpu::uvec2> words(d, m_octree.emission_words.name(), emission_words);
    vk::BufferOf<gpu::uint> emission_values(d, m_octree.emission.name(), emission);
    lengthen(graph, m_octree.nodes, std::move(longer_nodes), retired);
    if (m_has_attributes)
    {
        lengthen(graph, m_octree.node_attributes, std::move(averages), retired);
        lengthen(graph, m_octree.voxel_attributes, std::move(attributes), retired);
    }
    if (m_emits)
    {
        const bool had_words = m_octree.emission_words.count() != 0;
        lengthen(graph, m_octree.emission_words, std::move(words), retired);
        lengthen(graph, m_octree.emission, std::move(emission_values), retired);
        if (!had_words) // nothing of the static octree emits
        {
            graph.fill(m_octree.emission_words, 0);
        }
    }
    m_arena.grow(static_cast<std::uint32_t>(node_capacity), static_cast<std::uint32_t>(voxel_capacity));
}

} // namespace zvo
