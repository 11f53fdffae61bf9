// SPDX-License-Identifier: MIT
#pragma once

#include "core/overlay/overlay_arena.h"
#include "core/tree/device_tree.h"
#include "vk/deletion_queue.h"
#include "vk/device.h"
#include "vk/frame_graph.h"
#include "vk/frame_list.h"
#include "vk/uploader.h"

#include <cstdint>
#include <optional>

namespace zvo
{

/// What the nodes and voxels of overlays have besides their geometry.
struct OverlayContents
{
    bool attributes = true;   // whether overlays have attributes; used where the static tree is empty
    float emission_scale = 0; // 0: nothing emits light
};

/// A static octree or DAG in buffers with room for overlays behind it:
///
///     nodes       | slot | static nodes, lists ... | static root | overlays and room
///     attributes  | static voxels ...              | overlays and room
///
/// nodes[0], the slot, is the root that is traced. Nothing static is ever written again. When the buffers grow, their
/// addresses change and their contents stay.
class OverlayBuffers final : public vk::FrameParticipant
{
public:
    /// Takes over a static tree. It can be traced and overlaid only after settle(); if settle() is never called, the
    /// tree is handed to uploads, which keeps it until the device is done with it. Whatever frames in flight may still
    /// use is put into deletion_queue. Both must outlive this object.
    OverlayBuffers(vk::Uploader& uploads, DeviceTree fixed, const OverlayContents& contents,
                   vk::DeletionQueue& deletion_queue);
    ~OverlayBuffers();
    OverlayBuffers(const OverlayBuffers&) = delete;
    OverlayBuffers& operator=(const OverlayBuffers&) = delete;

    /// Makes the longer buffers that settle() moves the static tree to, with room for that many nodes and that many
    /// voxels. Throws Error{Memory} when the device's budget does not suffice.
    void reserve(std::uint64_t room);

    /// Records the copies that move the static tree to the buffers of reserve().
    void settle(vk::FrameGraph& graph, vk::DeletionQueue& deletion_queue);

    /// Makes room for one more region of that many nodes and voxels, besides all regions that are held: records the
    /// copies to longer buffers. The old buffers are put into the deletion queue when the frame is submitted. Throws
    /// Error{Memory} when the device's budget does not suffice; then nothing was recorded and nothing has changed.
    void grow(vk::FrameGraph& graph, std::uint64_t nodes, std::uint64_t voxels);

    void frameSubmitted() override { deleteBefore(m_deletion_queue); }

    /// Restores the buffers from before the frame with all their contents. The arena keeps its size, so regions may lie
    /// beyond the end of the buffers until catchUp().
    void frameLost() override;

    /// Makes the buffers as long as the arena again, as grow() does. To be called before a region is used that was
    /// allocated after frameLost(). Does nothing where the lengths match. Throws as grow().
    void catchUp(vk::FrameGraph& graph);

    [[nodiscard]] const DeviceTree& tree() const { return m_tree; }
    [[nodiscard]] DeviceTree& tree() { return m_tree; }

    /// Tells that what is traced has changed.
    void renewVersion() { m_tree.version = newVersion(); }

    [[nodiscard]] OverlayArena& arena() { return m_arena; }
    [[nodiscard]] bool hasAttributes() const { return m_has_attributes; }
    [[nodiscard]] bool emits() const { return m_emits; }

    /// The number that, added to the index of an overlay's voxel, gives the index of its value in tree().emission;
    /// modulo 2^32.
    [[nodiscard]] std::uint32_t emissionOffset() const;

private:
    struct Capacities
    {
        std::uint32_t nodes = 0;
        std::uint32_t voxels = 0;
    };
    // The buffers that grow. Those that the tree does not have are empty.
    struct Buffers
    {
        vk::BufferOf<gpu::Node> nodes;
        vk::BufferOf<gpu::BeforeChild> ranks;
        vk::BufferOf<gpu::Attribute> node_attributes;
        vk::BufferOf<gpu::Attribute> voxel_attributes;
        vk::BufferOf<gpu::uvec2> emission_words;
        vk::BufferOf<gpu::uint> emission;
    };

    [[nodiscard]] Capacities grownCapacities(std::uint64_t nodes, std::uint64_t voxels) const;
    [[nodiscard]] Buffers makeBuffers(const Capacities& capacities);
    void swapBuffers(Buffers& buffers);
    void lengthen(vk::FrameGraph& graph, Buffers&& longer);
    void deleteBefore(vk::DeletionQueue& deletion_queue);
    [[nodiscard]] bool hasRanks() const { return m_tree.isDag() && m_has_attributes; }
    [[nodiscard]] std::uint32_t nodeBytes() const;
    [[nodiscard]] std::uint32_t voxelBlockBytes() const;
    [[nodiscard]] std::uint32_t firstOverlayVoxel() const;
    [[nodiscard]] OverlaySpace staticSpace() const;

    vk::Uploader& m_uploads;
    vk::Device& m_device;
    vk::DeletionQueue& m_deletion_queue;
    bool m_is_empty;
    bool m_has_attributes;
    bool m_emits;
    std::uint64_t m_static_emissive; // voxels
    DeviceTree m_tree;
    OverlayArena m_arena;
    bool m_is_settled = false;
    Buffers m_reserved;              // for settle()
    Capacities m_room;               // of m_reserved
    std::optional<Buffers> m_before; // the tree's buffers when the last frame began, if they were replaced since
};

} // namespace zvo
