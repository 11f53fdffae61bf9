// SPDX-License-Identifier: MIT
#include "core/overlay/overlay_buffers.h"

#include "core/base/divide_up.h"
#include "core/tree/tree_limits.h"
#include "zvo/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace zvo
{

namespace
{

static_assert(kIndicesMax <= gpu::kChildList); // numbers of nodes and voxels have no flag for lists

constexpr std::uint64_t roundUp(std::uint64_t value, std::uint64_t multiple)
{
    return divideUp(value, multiple) * multiple;
}

// The room with half as much added, or with what is asked for, if that is more.
std::uint64_t grownRoom(std::uint64_t room, std::uint64_t asked)
{
    return room + std::max(room / 2, asked);
}

// Makes an empty tree a root without children.
DeviceTree adopted(DeviceTree&& tree)
{
    tree.lists.octree_node_count = std::max(tree.lists.octree_node_count, 1U);
    tree.node_count = std::max(tree.node_count, 1U);
    tree.levels.clear();
    tree.overlays.static_root = std::max(static_cast<std::uint32_t>(tree.nodes.count()), 1U);
    return std::move(tree);
}

template <typename T> void copyAll(vk::FrameGraph& graph, const vk::BufferOf<T>& from, vk::BufferOf<T>& to)
{
    if (from.count() != 0)
    {
        graph.copy(from, 0, to, 0, from.bytes());
    }
}

} // namespace

OverlayBuffers::OverlayBuffers(vk::Uploader& uploads, DeviceTree fixed, const OverlayContents& contents,
                               vk::DeletionQueue& deletion_queue)
    : m_uploads(uploads), m_device(uploads.device()), m_deletion_queue(deletion_queue),
      m_is_empty(fixed.node_count == 0), m_has_attributes(m_is_empty ? contents.attributes : fixed.hasAttributes()),
      m_emits(m_has_attributes && contents.emission_scale > 0), m_static_emissive(fixed.emission.count()),
      m_tree(adopted(std::move(fixed))), m_arena(staticSpace())
{
    m_tree.emission_scale = m_emits ? contents.emission_scale : 1.0F;
    renewVersion();
}

OverlayBuffers::~OverlayBuffers()
{
    if (!m_is_settled) // frames under way may show the static tree
    {
        m_uploads.keep(std::make_shared<DeviceTree>(std::move(m_tree)));
    }
}

void OverlayBuffers::reserve(std::uint64_t room)
{
    m_room = grownCapacities(room, room);
    m_reserved = makeBuffers(m_room);
}

void OverlayBuffers::settle(vk::FrameGraph& graph, vk::DeletionQueue& deletion_queue)
{
    lengthen(graph, std::move(m_reserved));
    m_arena.grow(m_room.nodes, m_room.voxels);
    if (m_is_empty)
    {
        graph.fill(m_tree.nodes, 0);
        graph.fill(m_tree.node_attributes, 0);
    }
    graph.copy(m_tree.nodes, 0, m_tree.nodes, m_tree.overlays.static_root * sizeof(gpu::Node), sizeof(gpu::Node));
    if (m_has_attributes)
    {
        graph.copy(m_tree.node_attributes, 0, m_tree.node_attributes, m_tree.octreeNodeCount() * sizeof(gpu::Attribute),
                   sizeof(gpu::Attribute));
    }
    deleteBefore(deletion_queue);
    m_is_settled = true;
}

OverlaySpace OverlayBuffers::staticSpace() const
{
    return {
        .static_nodes = m_tree.overlays.static_root + 1,
        .node_capacity = m_tree.overlays.static_root + 1,
        .static_voxels = m_tree.voxel_count,
        .voxel_capacity = m_tree.voxel_count,
        .node_bytes = nodeBytes(),
        .voxel_block_bytes = voxelBlockBytes(),
    };
}

std::uint32_t OverlayBuffers::nodeBytes() const
{
    return static_cast<std::uint32_t>(sizeof(gpu::Node) + (m_has_attributes ? sizeof(gpu::Attribute) : 0) +
                                      (hasRanks() ? sizeof(gpu::BeforeChild) : 0));
}

std::uint32_t OverlayBuffers::voxelBlockBytes() const
{
    std::size_t bytes = m_has_attributes ? kVoxelBlock * sizeof(gpu::Attribute) : 0;
    bytes += m_emits ? kVoxelBlock * sizeof(gpu::uint) + sizeof(gpu::uvec2) : 0;
    return static_cast<std::uint32_t>(bytes);
}

std::uint32_t OverlayBuffers::firstOverlayVoxel() const
{
    return static_cast<std::uint32_t>(roundUp(m_tree.voxel_count, kVoxelBlock));
}

std::uint32_t OverlayBuffers::emissionOffset() const
{
    return static_cast<std::uint32_t>(m_static_emissive - firstOverlayVoxel());
}

void OverlayBuffers::grow(vk::FrameGraph& graph, std::uint64_t nodes, std::uint64_t voxels)
{
    const Capacities capacities = grownCapacities(nodes, voxels);
    lengthen(graph, makeBuffers(capacities)); // all of them, before anything is recorded
    m_arena.grow(capacities.nodes, capacities.voxels);
}

// Capacities with room for one more region of so many nodes and voxels.
OverlayBuffers::Capacities OverlayBuffers::grownCapacities(std::uint64_t nodes, std::uint64_t voxels) const
{
    const OverlaySpace& space = m_arena.space();
    const std::uint64_t voxel_room = space.voxel_capacity - std::min(space.voxel_capacity, firstOverlayVoxel());
    const std::uint64_t node_capacity =
        space.static_nodes + grownRoom(std::uint64_t{space.node_capacity} - space.static_nodes, nodes);
    const std::uint64_t voxel_capacity = firstOverlayVoxel() + roundUp(grownRoom(voxel_room, voxels), kVoxelBlock);
    const std::uint64_t attribute_nodes = m_tree.octreeNodeCount() + node_capacity - m_tree.overlays.static_root;
    if (node_capacity > kNodesMax || voxel_capacity > kIndicesMax || attribute_nodes > kIndicesMax)
    {
        throw Error(ErrorCode::Memory, fmt::format("overlays need more than the {} nodes or {} voxels that kernels "
                                                   "reach: keep fewer entries of the history, or lower the resolution",
                                                   kNodesMax, kIndicesMax));
    }
    return {static_cast<std::uint32_t>(node_capacity), static_cast<std::uint32_t>(voxel_capacity)};
}

OverlayBuffers::Buffers OverlayBuffers::makeBuffers(const Capacities& capacities)
{
    const std::uint64_t node_capacity = capacities.nodes;
    const std::uint64_t voxel_capacity = capacities.voxels;
    const std::uint64_t overlay_nodes = node_capacity - m_tree.overlays.static_root; // with the static root
    const std::uint64_t attribute_nodes = m_has_attributes ? m_tree.octreeNodeCount() + overlay_nodes : 0;
    const std::uint64_t rank_count = hasRanks() ? overlay_nodes - 1 : 0;
    const std::uint64_t attribute_voxels = m_has_attributes ? voxel_capacity : 0;
    const std::uint64_t emission_words = m_emits ? voxel_capacity / kVoxelBlock : 0;
    const std::uint64_t emission = m_emits ? m_static_emissive + voxel_capacity - firstOverlayVoxel() : 0;
    m_device.memory().require(node_capacity * sizeof(gpu::Node) + rank_count * sizeof(gpu::BeforeChild) +
                                  (attribute_nodes + attribute_voxels) * sizeof(gpu::Attribute) +
                                  emission_words * sizeof(gpu::uvec2) + emission * sizeof(gpu::uint),
                              "room for overlays");
    vk::Device& d = m_device;
    return {{d, m_tree.nodes.name(), node_capacity},
            {d, "update/ranks", rank_count},
            {d, m_tree.node_attributes.name(), attribute_nodes},
            {d, m_tree.voxel_attributes.name(), attribute_voxels},
            {d, m_tree.emission_words.name(), emission_words},
            {d, m_tree.emission.name(), emission}};
}

void OverlayBuffers::swapBuffers(Buffers& buffers)
{
    std::swap(m_tree.nodes, buffers.nodes);
    std::swap(m_tree.overlays.ranks, buffers.ranks);
    std::swap(m_tree.node_attributes, buffers.node_attributes);
    std::swap(m_tree.voxel_attributes, buffers.voxel_attributes);
    std::swap(m_tree.emission_words, buffers.emission_words);
    std::swap(m_tree.emission, buffers.emission);
}

void OverlayBuffers::lengthen(vk::FrameGraph& graph, Buffers&& longer)
{
    // In safety before anything is recorded: that may fail half way, with the device at work on what went before.
    Buffers& from = m_before ? m_deletion_queue.keep(std::move(longer)) : m_before.emplace(std::move(longer));
    swapBuffers(from);
    copyAll(graph, from.nodes, m_tree.nodes);
    if (m_has_attributes)
    {
        copyAll(graph, from.ranks, m_tree.overlays.ranks);
        copyAll(graph, from.node_attributes, m_tree.node_attributes);
        copyAll(graph, from.voxel_attributes, m_tree.voxel_attributes);
    }
    if (m_emits)
    {
        copyAll(graph, from.emission_words, m_tree.emission_words);
        copyAll(graph, from.emission, m_tree.emission);
        if (from.emission_words.count() == 0) // nothing of the static tree emits
        {
            graph.fill(m_tree.emission_words, 0);
        }
    }
}

void OverlayBuffers::deleteBefore(vk::DeletionQueue& deletion_queue)
{
    if (m_before)
    {
        deletion_queue.keep(std::move(*m_before));
        m_before.reset();
    }
}

void OverlayBuffers::frameLost()
{
    if (m_before)
    {
        swapBuffers(*m_before);
        frameSubmitted();
    }
}

void OverlayBuffers::catchUp(vk::FrameGraph& graph)
{
    const OverlaySpace& space = m_arena.space();
    if (m_tree.nodes.count() != space.node_capacity)
    {
        lengthen(graph, makeBuffers({space.node_capacity, space.voxel_capacity}));
    }
}

} // namespace zvo
