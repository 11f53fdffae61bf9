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

/// What overlays have.
struct OverlayContents
{
    bool attributes = true;   // where the static tree is empty and does not say
    float emission_scale = 0; // 0: nothing emits light
};

/// A static octree or DAG in buffers with room for overlays behind it:
///
///     nodes       | slot | static nodes, lists ... | static root | overlays and room
///     attributes  | static voxels ...              | overlays and room
///
/// nodes[0] is the root that is traced. Nothing static is ever written again. When the buffers grow their addresses
/// change, and all contents stay.
class OverlayBuffers final : public vk::FrameParticipant
{
public:
    /// Takes over a static tree: traced and overlaid only behind settle(). uploads keeps it, should it not come so far.
    /// What frames in flight may use goes to deletion_queue. Both outlive this.
    OverlayBuffers(vk::Uploader& uploads, DeviceTree fixed, const OverlayContents& contents,
                   vk::DeletionQueue& deletion_queue);
    ~OverlayBuffers();
    OverlayBuffers(const OverlayBuffers&) = delete;
    OverlayBuffers& operator=(const OverlayBuffers&) = delete;

    /// Makes the buffers that settle() takes, with room for that many nodes, and voxels. Throws Error{Memory} when the
    /// device's budget does not suffice.
    void reserve(std::uint64_t room);

    /// Records what moves the static tree to what was reserved.
    void settle(vk::FrameGraph& graph, vk::DeletionQueue& deletion_queue);

    /// Makes room for one more region of that many nodes and voxels, whatever is held: records the copies to longer
    /// buffers; the old ones go to the deletion queue when the frame was submitted. Throws Error{Memory} when the
    /// device's budget does not suffice: then nothing was recorded and nothing has changed.
    void grow(vk::FrameGraph& graph, std::uint64_t nodes, std::uint64_t voxels);

    void frameSubmitted() override { deleteBefore(m_deletion_queue); }

    /// The buffers are those from before the frame again, with all their contents. The arena keeps its size; regions
    /// may lie beyond the buffers until catchUp().
    void frameLost() override;

    /// Before a region is used that was handed out after frameLost(): makes the buffers as long as the arena, as grow()
    /// does. Nothing to do otherwise. Throws as grow().
    void catchUp(vk::FrameGraph& graph);

    [[nodiscard]] const DeviceTree& tree() const { return m_tree; }
    [[nodiscard]] DeviceTree& tree() { return m_tree; }

    /// What is traced has changed.
    void renewVersion() { m_tree.version = newTreeVersion(); }

    [[nodiscard]] OverlayArena& arena() { return m_arena; }
    [[nodiscard]] bool hasAttributes() const { return m_has_attributes; }
    [[nodiscard]] bool emits() const { return m_emits; }

    /// From the index of an overlay's voxel to its place in tree().emission, modulo 2^32.
    [[nodiscard]] std::uint32_t emissionOffset() const;

private:
    struct Capacities
    {
        std::uint32_t nodes = 0;
        std::uint32_t voxels = 0;
    };
    // That grow: empty where the tree has no such thing.
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
    Capacities m_room;               // of them
    std::optional<Buffers> m_before; // of the tree when the last frame began, if they have been replaced in it
};

} // namespace zvo
