// SPDX-License-Identifier: MIT
#pragma once

#include "core/deform/deform_mesh.h"
#include "core/deform/dynamic_object.h"
#include "core/overlay/root_history.h"
#include "core/scene/animation.h"
#include "core/update/layer.h"
#include "core/update/update_stage.h"
#include "vk/deletion_queue.h"
#include "vk/device.h"
#include "vk/frame_list.h"
#include "vk/uploader.h"
#include "zvo/types.h"

#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace zvo
{

/// A mesh that can move, in device memory. Several dynamic objects may share it.
struct DynamicMesh
{
    Scene scene; // what poses it: without images, and without what primitives consist of
    DynamicObjectPlan plan;
    GpuScene uploaded;
    DeformMesh deform;
    bool emits = false; // any of its materials
};

/// Uploads scene as a dynamic object by way of device: done when that says (vk/uploader.h). emission_scale: the common
/// one. Throws as uploadScene and uploadDeformMesh.
std::shared_ptr<const DynamicMesh> uploadDynamicMesh(vk::Uploader& device, Scene scene, bool attributes,
                                                     float emission_scale);

/// Number of a dynamic object, for as long as its octree lives.
using DynamicObjectId = std::uint32_t;

/// How dynamic objects are voxelized.
struct DynamicObjectOptions
{
    Coverage coverage = Coverage::Thin;
    LayerContents contents;          // of the octree that they are merged with
    float emission_scale = 0;        // common to the static scene and all dynamic objects
    std::uint32_t updates_max = 1;   // that may be under way on the device
    bool minimal_capacities = false; // everything starts with room for one
};

/// The dynamic objects of an octree: where each is to be, and its layer, the voxels of where it was last. Poses have
/// versions, so that an entry of the history names its dynamic objects' states by numbers. Knows nothing of merging and
/// of what is shown.
class DynamicObjects final : public vk::FrameParticipant
{
public:
    /// What frames in flight may use goes to deletion_queue, which outlives this.
    DynamicObjects(vk::Uploader& device, const Grid& grid, const DynamicObjectOptions& options,
                   vk::DeletionQueue& deletion_queue);

    /// See DynamicOctree.
    DynamicObjectId add(std::shared_ptr<const DynamicMesh> mesh, Pose pose);
    void setPose(DynamicObjectId object, Pose pose);
    void remove(DynamicObjectId object);

    /// Throws Error{Usage} for a dynamic object that is not there.
    [[nodiscard]] const DynamicMesh& mesh(DynamicObjectId object) { return *presentObject(object).mesh; }

    /// Dynamic objects, present ones only, and their poses become those of an earlier time.
    void bringBack(std::span<const LayerState> states);

    [[nodiscard]] bool isEmpty() const; // no dynamic object is present
    [[nodiscard]] std::vector<LayerState> states() const;
    [[nodiscard]] std::vector<const LayerBuffers*> layers();
    [[nodiscard]] std::uint64_t leafCapacity(); // of all layers

    /// Gives dynamic objects that changed and have no layer one. Throws Error{Memory} when the device's budget does not
    /// suffice or a layer can never be large enough, Error{Usage} where more updates are under way than were announced.
    void makeLayers();

    /// Adds everything that voxelizes the dynamic objects which changed; they count as voxelized from now on. Returns
    /// them. What is recorded must be recorded before a dynamic object of them is removed.
    std::vector<DynamicObjectId> addStages(std::uint32_t sum_shift, RecordedStages& stages);

    /// What was voxelized into their layers does not count: they are voxelized again.
    void forgetLayers(std::span<const DynamicObjectId> objects);
    void forgetLayers();

    /// Layers that turned out too small get more room and are to be made again.
    void frameDone(std::uint64_t frame) override;

    /// Whether there were any since this was asked last.
    [[nodiscard]] bool takeFailure() { return std::exchange(m_has_failed, false); }

    /// Everything is voxelized again.
    void frameLost() override;

    /// Triangles left out, by reason, of all dynamic objects as they were voxelized last.
    [[nodiscard]] std::map<std::string, std::uint64_t> droppedTriangles();

    /// Whether so many poses are kept that forgetPoses() is worth its time.
    [[nodiscard]] bool hasManyPoses() const { return m_poses.size() >= m_poses_max; }

    /// Drops the poses, and the dynamic objects, that are not present and not in states.
    void forgetPoses(std::span<const LayerState> states);

private:
    struct Object
    {
        std::shared_ptr<const DynamicMesh> mesh;
        DynamicObjectBuffers buffers;
        LayerCapacities capacities;
        std::unique_ptr<LayerBuffers> layer;
        bool present = true;          // or taken away, for as long as an entry shows it
        std::uint64_t version = 0;    // of the pose that it is to be in
        std::uint64_t voxelized = 0;  // version that layer shows; 0: none
        gpu::LayerCounters dropped{}; // as it was voxelized last
        bool is_hopeless = false;     // no layer is large enough
    };
    struct PendingLayer
    {
        std::uint64_t frame;
        DynamicObjectId object;
        std::uint64_t report; // counted: element of m_reports, a ring
        LayerCapacities capacities;
    };

    std::uint64_t addPose(Pose pose);
    [[nodiscard]] Object& presentObject(DynamicObjectId id);
    [[nodiscard]] std::vector<Object*> presentObjects();
    void dropLayer(Object& object);
    bool learn(const PendingLayer& pending);

    vk::Uploader& m_device;
    const Grid& m_grid;
    DynamicObjectOptions m_options;
    vk::DeletionQueue& m_deletion_queue;
    std::map<DynamicObjectId, Object> m_objects;
    DynamicObjectId m_next_object = 1;
    std::uint64_t m_next_version = 1;
    std::map<std::uint64_t, std::shared_ptr<const Pose>> m_poses; // by version
    std::size_t m_poses_max = 1024;                               // until those that are not used are dropped
    vk::BufferOf<gpu::LayerCounters> m_reports;                   // host-visible, a ring
    std::uint64_t m_report_count = 0;
    std::deque<PendingLayer> m_pending; // in order of frames
    bool m_has_failed = false;          // a layer, for takeFailure()
};

} // namespace zvo
