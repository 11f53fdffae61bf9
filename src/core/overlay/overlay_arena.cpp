// SPDX-License-Identifier: MIT
#include "core/overlay/overlay_arena.h"

#include "core/base/divide_up.h"

#include <algorithm>
#include <cassert>

namespace zvo
{

namespace
{

// The whole blocks behind the static part: [first, end).
std::uint64_t firstBlock(const OverlaySpace& space)
{
    return divideUp(space.static_voxels, kVoxelBlock);
}

std::uint64_t endBlock(const OverlaySpace& space)
{
    return std::max<std::uint64_t>(firstBlock(space), space.voxel_capacity / kVoxelBlock);
}

} // namespace

OverlayArena::OverlayArena(const OverlaySpace& space) : m_space(space)
{
    assert(space.static_nodes <= space.node_capacity && space.static_voxels <= space.voxel_capacity);
    m_free_nodes.give(space.static_nodes, space.node_capacity - space.static_nodes);
    m_free_blocks.give(firstBlock(space), endBlock(space) - firstBlock(space));
}

std::optional<OverlayRegion> OverlayArena::allocate(std::uint64_t nodes, std::uint64_t voxels)
{
    if (nodes > m_free_nodes.total() || voxels > m_free_blocks.total() * kVoxelBlock)
    {
        return std::nullopt;
    }
    const std::uint64_t blocks = divideUp(voxels, kVoxelBlock);
    OverlayRegion region;
    if (nodes != 0)
    {
        const std::optional<std::uint64_t> first = m_free_nodes.take(nodes);
        if (!first)
        {
            return std::nullopt;
        }
        region.first_node = static_cast<std::uint32_t>(*first);
        region.node_capacity = static_cast<std::uint32_t>(nodes);
    }
    if (blocks != 0)
    {
        const std::optional<std::uint64_t> first = m_free_blocks.take(blocks);
        if (!first)
        {
            m_free_nodes.give(region.first_node, region.node_capacity);
            return std::nullopt;
        }
        region.first_voxel = static_cast<std::uint32_t>(*first * kVoxelBlock);
        region.voxel_capacity = static_cast<std::uint32_t>(blocks * kVoxelBlock);
    }
    m_held_bytes += bytes(region);
    return region;
}

OverlayRegion OverlayArena::shrink(const OverlayRegion& region, std::uint32_t nodes, std::uint32_t voxels)
{
    assert(nodes <= region.node_capacity && voxels <= region.voxel_capacity);
    const std::uint64_t first_block = region.first_voxel / kVoxelBlock;
    const std::uint64_t blocks = region.voxel_capacity / kVoxelBlock;
    const std::uint64_t blocks_left = divideUp(voxels, kVoxelBlock);
    OverlayRegion left = region;
    left.node_capacity = nodes;
    left.voxel_capacity = static_cast<std::uint32_t>(blocks_left * kVoxelBlock);
    m_free_nodes.give(std::uint64_t{region.first_node} + nodes, region.node_capacity - nodes);
    m_free_blocks.give(first_block + blocks_left, blocks - blocks_left);
    m_held_bytes -= bytes(region) - bytes(left);
    return left;
}

void OverlayArena::release(const OverlayRegion& region)
{
    shrink(region, 0, 0);
}

void OverlayArena::grow(std::uint32_t node_capacity, std::uint32_t voxel_capacity)
{
    assert(node_capacity >= m_space.node_capacity && voxel_capacity >= m_space.voxel_capacity);
    const OverlaySpace before = m_space;
    m_space.node_capacity = node_capacity;
    m_space.voxel_capacity = voxel_capacity;
    m_free_nodes.give(before.node_capacity, node_capacity - before.node_capacity);
    m_free_blocks.give(endBlock(before), endBlock(m_space) - endBlock(before));
}

std::uint64_t OverlayArena::bytes(const OverlayRegion& region) const
{
    return std::uint64_t{region.node_capacity} * m_space.node_bytes +
           std::uint64_t{region.voxel_capacity / kVoxelBlock} * m_space.voxel_block_bytes;
}

} // namespace zvo
