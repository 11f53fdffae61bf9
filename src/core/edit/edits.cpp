// SPDX-License-Identifier: MIT
#include "core/edit/edits.h"

#include "core/base/divide_up.h"
#include "zvo/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace zvo
{

namespace
{

constexpr std::uint64_t kDabsAtFirst = 4; // that the first region has room for, whatever they touch

std::uint32_t capacityOf(std::uint32_t capacity, std::uint64_t needed)
{
    const std::uint64_t grown =
        needed > capacity ? std::max<std::uint64_t>(2 * std::uint64_t{capacity}, needed) : capacity;
    return static_cast<std::uint32_t>(std::min<std::uint64_t>(grown, UINT32_MAX - kVoxelBlock));
}

OverlayRegion regionOf(std::uint64_t nodes, std::uint64_t voxels)
{
    return {0, static_cast<std::uint32_t>(nodes), 0,
            static_cast<std::uint32_t>(divideUp(voxels, kVoxelBlock) * kVoxelBlock)};
}

// The words of the brush's stamp for the leaves of a dab, which may be a part of those of the stamp.
vk::BufferOf<gpu::uint> stampFor(vk::Device& device, const Brush& brush, const DabExtent& extent)
{
    if (brush.tree_stamp.tree != nullptr)
    {
        return {device, "edit/stamp", std::uint64_t{extent.leafCount()} * gpu::kStampWords};
    }
    if (brush.stamp == nullptr)
    {
        return {};
    }
    vk::BufferOf<gpu::uint> buffer(device, "edit/stamp", std::uint64_t{extent.leafCount()} * gpu::kStampWords,
                                   vk::MemoryKind::Upload);
    const VoxelBox stamp = {brush.stamp->box.lo / kLeafEdge, brush.stamp->box.hi / kLeafEdge}; // in leaves
    const VoxelBox leaves = {glm::ivec3(extent.box.lo) / kLeafEdge, glm::ivec3(extent.box.hi) / kLeafEdge};
    const VoxelBox both = leaves.within(stamp);
    std::fill_n(buffer.mappedData(), buffer.count(), 0U);
    const auto leafNumber = [](const VoxelBox& box, const glm::ivec3& leaf)
    {
        const glm::ivec3 at = leaf - box.lo;
        return at.x + std::int64_t{box.size().x} * (at.y + std::int64_t{box.size().y} * at.z);
    };
    for (int z = both.lo.z; z <= both.hi.z; ++z)
    {
        for (int y = both.lo.y; y <= both.hi.y; ++y)
        {
            const glm::ivec3 first(both.lo.x, y, z);
            std::copy_n(brush.stamp->words.begin() + leafNumber(stamp, first) * gpu::kStampWords,
                        std::int64_t{both.size().x} * gpu::kStampWords,
                        buffer.mappedData() + leafNumber(leaves, first) * gpu::kStampWords);
        }
    }
    return buffer;
}

} // namespace

Edits::Edits(vk::Device& device, OverlayBuffers& overlays, RootHistory& regions, const HistoryBounds& bounds,
             std::uint32_t frames_in_flight, vk::DeletionQueue& deletion_queue)
    : m_device(device), m_overlays(overlays), m_regions(regions), m_deletion_queue(deletion_queue),
      m_bytes_max(bounds.bytes_max), m_now{.history = EditHistory(bounds.entries_max)},
      m_ring_slot_count(std::uint64_t{frames_in_flight} + 1)
{
    m_now.changes.resize(m_now.history.slotCount());
}

EditSite Edits::site()
{
    return {m_overlays.tree(), *m_now.region, *m_now.states, m_overlays.emissionOffset()};
}

std::uint32_t Edits::root() const
{
    return m_now.region ? m_now.region->first_node + m_now.history.slot() : m_overlays.tree().overlays.static_root;
}

std::uint64_t Edits::heldBytes() const
{
    return m_now.region ? m_overlays.arena().bytes(*m_now.region) : 0;
}

std::uint64_t Edits::shownBytes() const
{
    const EditTop& top = m_now.history.top(m_now.history.slot());
    return m_now.region ? m_overlays.arena().bytes(regionOf(top.nodes, top.voxels)) : 0;
}

std::uint32_t Edits::voxelCount() const
{
    return m_now.region ? m_now.history.top(m_now.history.slot()).voxel_count
                        : static_cast<std::uint32_t>(m_overlays.tree().occupiedCount());
}

bool Edits::dab(vk::FrameGraph& graph, const Brush& brush, const vk::BufferOf<gpu::SceneView>& tables)
{
    const DeviceTree& tree = m_overlays.tree();
    const std::optional<DabExtent> extent = DabExtent::of(brush, tree.grid, tree.filled && m_overlays.hasAttributes());
    if (!extent)
    {
        return true;
    }
    if (m_dab_count == kDabsPerFrameMax)
    {
        throw Error(ErrorCode::Usage, fmt::format("a frame takes at most {} dabs of a brush", kDabsPerFrameMax));
    }
    ++m_dab_count;
    saveFrame();
    Saved before = save();
    const bool has_written = std::exchange(m_has_written, false);
    try
    {
        const bool is_done = tryDab(graph, brush, *extent, tables);
        m_has_written = m_has_written || has_written;
        return is_done;
    }
    catch (...)
    {
        restore(std::move(before));
        if (m_has_written) // a part of the dab was recorded, where entries to redo may have theirs
        {
            m_now.history.dropRedo();
        }
        m_has_written = m_has_written || has_written;
        throw;
    }
}

// The slot that was shown when the frame began. Its room is kept, as the frame may be lost after the device has run
// some of it.
std::uint32_t Edits::keptSlot() const
{
    const bool is_kept = m_before && m_before->state.region == m_now.region; // otherwise it stands elsewhere
    return (is_kept ? m_before->state : m_now).history.slot();
}

bool Edits::tryDab(vk::FrameGraph& graph, const Brush& brush, const DabExtent& extent,
                   const vk::BufferOf<gpu::SceneView>& tables)
{
    m_overlays.catchUp(graph);
    if (!m_now.region)
    {
        begin(graph, extent);
    }
    const bool attributes = m_overlays.hasAttributes();
    const EditTop top = m_now.history.topAbove(keptSlot());
    const EditTop needed = {top.nodes + extent.node_bound, attributes ? top.voxels + extent.voxel_bound : 0};
    if ((needed.nodes > m_now.region->node_capacity || needed.voxels > m_now.region->voxel_capacity) &&
        !makeRoom(graph, needed))
    {
        return false;
    }
    if (!m_buffers || m_buffers->cells.count() < extent.cell_count)
    {
        DabBuffers larger(m_device, extent.cell_count);
        if (m_buffers)
        {
            m_deletion_queue.keep(std::move(*m_buffers));
        }
        m_buffers = std::move(larger);
    }
    vk::BufferOf<gpu::uint>& stamp = m_deletion_queue.keep(stampFor(m_device, brush, extent));
    if (brush.tree_stamp.tree != nullptr)
    {
        recordStamp(graph, brush.tree_stamp, extent, stamp);
    }
    DabSlots slots = {.from = m_now.history.slot(), .kept = keptSlot()};
    slots.to = m_now.history.push(extent.node_bound, attributes ? extent.voxel_bound : 0, slots.kept);
    m_now.is_compact = false;
    m_has_written = true;
    EditSite where = site();
    recordDab(graph, where, brush, extent, slots, tables, stamp, *m_buffers);
    report(graph, slots.to, 1);
    return true;
}

OverlayRegion Edits::allocateRegion(vk::FrameGraph& graph, std::uint64_t nodes, std::uint64_t voxels)
{
    OverlayArena& arena = m_overlays.arena();
    if (const std::optional<OverlayRegion> region = arena.allocate(nodes, voxels))
    {
        return *region;
    }
    m_overlays.grow(graph, nodes, voxels);
    return arena.allocate(nodes, voxels).value();
}

// The deletion queue keeps the states for frames in flight that outlive their owners here.
std::shared_ptr<vk::BufferOf<gpu::EditState>> Edits::makeStates()
{
    return m_deletion_queue.keep(
        std::make_shared<vk::BufferOf<gpu::EditState>>(m_device, "edit/states", m_now.history.slotCount()));
}

// Makes the first region, whose slot 0 is the unedited tree.
void Edits::begin(vk::FrameGraph& graph, const DabExtent& extent)
{
    vk::Device& d = m_device;
    const std::uint32_t slots = m_now.history.slotCount();
    m_now.states = makeStates();
    if (m_reports.count() == 0)
    {
        m_reports = {d, "edit/reports", m_ring_slot_count * slots, vk::MemoryKind::Readback};
    }
    const std::uint64_t voxels = m_overlays.hasAttributes() ? kDabsAtFirst * extent.voxel_bound : 0;
    m_now.region = allocateRegion(graph, slots + kDabsAtFirst * extent.node_bound, voxels);
    EditTop top = m_now.history.top(0);
    top.voxel_count = static_cast<std::uint32_t>(m_overlays.tree().occupiedCount());
    m_now.history.learn(0, top);
    EditSite where = site();
    beginEdits(graph, where);
}

// Makes room for what is needed. Returns false while the device has yet to report how much room is left.
bool Edits::makeRoom(vk::FrameGraph& graph, const EditTop& needed)
{
    const OverlayRegion& region = *m_now.region;
    const EditTop same = {region.node_capacity, region.voxel_capacity};
    const EditTop grown = {capacityOf(region.node_capacity, needed.nodes),
                           capacityOf(region.voxel_capacity, needed.voxels)};
    if (m_overlays.arena().bytes(regionOf(grown.nodes, grown.voxels)) <= m_bytes_max)
    {
        compact(graph, grown);
        return true;
    }
    if (!m_now.history.isExact())
    {
        return false;
    }
    if (m_now.is_compact && m_now.history.undoCount() == 0 && m_now.history.redoCount() == 0)
    {
        compact(graph, grown);
        return true;
    }
    if (m_now.history.redoCount() != 0) // which the dab would drop, too
    {
        m_now.history.dropRedo();
    }
    else if (m_now.is_compact)
    {
        m_now.history.dropOldest();
    }
    compact(graph, same);
    return false;
}

// Moves the slots of all entries to a region of that capacity.
void Edits::compact(vk::FrameGraph& graph, const EditTop& capacity)
{
    m_device.memory().require(CompactBuffers::bytes(*m_now.region), "making room for edits");
    auto& buffers = m_deletion_queue.keep(CompactBuffers(m_device, *m_now.region));
    const OverlayRegion to = allocateRegion(graph, capacity.nodes, capacity.voxels);
    m_left.push_back(to); // given back should something throw
    EditSite where = site();
    std::shared_ptr<vk::BufferOf<gpu::EditState>> states = makeStates();
    recordCompaction(graph, where, to, *states, m_now.history.used(), buffers);
    m_left.back() = std::exchange(*m_now.region, to);
    m_deletion_queue.keep(std::exchange(m_now.states, std::move(states)));
    m_now.history.forgetTops();
    m_now.is_compact = true;
    report(graph, 0, m_now.history.slotCount());
}

// Records the copy of states to mapped memory, which the host reads when the frame is done.
void Edits::report(vk::FrameGraph& graph, std::uint32_t first_slot, std::uint32_t slot_count)
{
    constexpr std::uint64_t kBytes = sizeof(gpu::EditState);
    const bool has_ring_slot = !m_pending.empty() && m_pending.back().frame == m_deletion_queue.frame();
    m_ring_slot = has_ring_slot ? m_ring_slot : (m_ring_slot + 1) % m_ring_slot_count;
    const std::uint64_t first = m_ring_slot * m_now.history.slotCount() + first_slot;
    graph.copy(*m_now.states, first_slot * kBytes, m_reports, first * kBytes, slot_count * kBytes);
    graph.releaseToHost();
    ++m_change_count;
    std::fill_n(m_now.changes.begin() + first_slot, slot_count, m_change_count);
    m_pending.push_back({m_deletion_queue.frame(), m_ring_slot, first_slot, slot_count, *m_now.region, m_change_count});
}

void Edits::learn(const Report& report, State& state) const
{
    const std::uint64_t first = report.ring_slot * m_now.history.slotCount();
    for (std::uint32_t slot = report.first_slot; slot < report.first_slot + report.slot_count; ++slot)
    {
        const gpu::EditState& told = m_reports.mappedData()[first + slot];
        if (state.changes[slot] == report.change)
        {
            state.history.learn(slot, {told.node_top - report.region.first_node,
                                       told.voxel_top - report.region.first_voxel, told.voxel_count, true});
        }
    }
}

void Edits::endStroke()
{
    m_now.history.endStroke();
}

bool Edits::undo()
{
    saveFrame();
    return m_now.history.undo();
}

bool Edits::redo()
{
    saveFrame();
    return m_now.history.redo();
}

void Edits::dropRedo()
{
    saveFrame();
    m_now.history.dropRedo();
}

std::size_t Edits::dropUnchanged()
{
    // The dabs of a root that is a leaf take no nodes, whatever they change.
    const bool can_tell = !m_before && m_overlays.tree().grid.nodeLevels() > 1;
    return can_tell ? m_now.history.dropUnchanged() : 0;
}

void Edits::saveFrame()
{
    if (!m_before)
    {
        m_before = save();
    }
}

// Restores a saved state. Regions allocated since then are given back late, as recorded commands may write them.
void Edits::restore(Saved saved)
{
    const auto giveBack = [&](const OverlayRegion& region)
    {
        if (saved.state.region != region)
        {
            m_regions.giveBack(region);
        }
    };
    if (m_now.region)
    {
        giveBack(*m_now.region);
    }
    for (; m_left.size() > saved.left_count; m_left.pop_back())
    {
        giveBack(m_left.back());
    }
    m_now = std::move(saved.state);
}

void Edits::frameSubmitted()
{
    for (const OverlayRegion& region : m_left)
    {
        m_regions.giveBack(region);
    }
    m_left.clear();
    m_before.reset();
    m_has_written = false;
}

void Edits::frameDone(std::uint64_t frame)
{
    for (; !m_pending.empty() && m_pending.front().frame <= frame; m_pending.pop_front())
    {
        learn(m_pending.front(), m_now);
        if (m_before)
        {
            learn(m_pending.front(), m_before->state);
        }
    }
}

void Edits::frameLost()
{
    const auto isLost = [&](const Report& report) { return report.frame == m_deletion_queue.frame(); };
    if (std::erase_if(m_pending, isLost) != 0)
    {
        m_ring_slot = (m_ring_slot + m_ring_slot_count - 1) % m_ring_slot_count; // frames in flight have the others
    }
    if (!m_before)
    {
        return;
    }
    restore(std::move(*m_before));
    m_before.reset();
    m_now.history.endStroke();
    if (m_has_written) // what the device did of the frame may stand where entries to redo had theirs
    {
        m_now.history.dropRedo();
    }
    m_has_written = false;
}

} // namespace zvo
