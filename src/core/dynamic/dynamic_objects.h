// SPDX-License-Identifier: MIT
#pragma once

#include "core/deform/deform_mesh.h"
#include "core/deform/dynamic_object.h"
#include "core/overlay/root_history.h"
#include "core/scene/animation.h"
#include "core/update/layer.h"
#include "core/update/update_budget.h"
#include "vk/deletion_queue.h"
#include "vk/device.h"
#include "vk/frame_list.h"
#include "vk/uploader.h"
#include "zvo/dynamic_tree.h"
#include "zvo/types.h"

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
    Scene scene; // what a pose needs of it: without images and without the primitives' arrays
    DynamicObjectPlan plan;
    GpuScene uploaded;
    DeformMesh deform;
    bool emits = false; // any of its materials
};

/// Uploads scene as the mesh of dynamic objects through `device`, whose uploads take effect as vk/uploader.h says.
/// emission_scale: the one that the octree and all dynamic objects share. Throws as uploadScene and uploadDeformMesh.
std::shared_ptr<const DynamicMesh> uploadDynamicMesh(vk::Uploader& device, Scene scene, bool attributes,
                                                     float emission_scale);

/// How dynamic objects are voxelized.
struct DynamicObjectOptions
{
    Coverage coverage = Coverage::Thin;
    LayerContents contents;          // as of the octree that the objects are merged with
    float emission_scale = 0;        // common to the static scene and all dynamic objects
    std::uint32_t updates_max = 1;   // updates that may be under way on the device at once
    bool minimal_capacities = false; // everything starts with room for one
};

/// The dynamic objects of an octree. Each has the pose that it is to be in, and a layer: the voxels of the pose in
/// which it was voxelized last. An object that was removed, and a pose, live on as long as a LayerState keeps them.
/// This class knows nothing of merging, nor of what is shown.
class DynamicObjects final : public vk::FrameParticipant
{
public:
    /// Whatever frames in flight may still use is put into deletion_queue, which must outlive this object.
    DynamicObjects(vk::Uploader& device, const Grid& grid, const DynamicObjectOptions& options,
                   vk::DeletionQueue& deletion_queue);

    /// As the functions of DynamicOctree.
    DynamicObjectId add(std::shared_ptr<const DynamicMesh> mesh, Pose pose, const DynamicObjectInfo& info);
    void setPose(DynamicObjectId object, Pose pose);
    void remove(DynamicObjectId object);

    /// Throws Error{Usage} for a dynamic object that does not exist.
    [[nodiscard]] const DynamicMesh& mesh(DynamicObjectId object) { return *presentObject(object).mesh; }

    /// Restores an earlier state: the dynamic objects named in states are present, in those poses; all others are not.
    void bringBack(std::span<const LayerState> states);

    [[nodiscard]] bool isEmpty() const { return m_objects.empty(); }
    [[nodiscard]] std::vector<LayerState> states() const;
    [[nodiscard]] std::vector<const LayerBuffers*> layers();
    [[nodiscard]] std::uint64_t leafCapacity(); // of all layers
    [[nodiscard]] bool carve() const;           // any of them

    /// Makes layers for the dynamic objects that have changed and have none. Throws Error{Memory} when the device's
    /// budget does not suffice or when no layer can be large enough, and Error{Usage} when more updates are under way
    /// than DynamicObjectOptions::updates_max.
    void makeLayers();

    /// Adds the stages that voxelize the dynamic objects which have changed, and returns these objects. They count as
    /// voxelized from now on. The stages must be recorded before one of the objects is removed.
    std::vector<DynamicObjectId> addStages(std::uint32_t sum_shift, UpdateStages& stages);

    /// Declares the contents of these objects' layers, or of all layers, invalid: those that are present are voxelized
    /// again.
    void forgetLayers(std::span<const DynamicObjectId> objects);
    void forgetLayers();

    /// Reads the reports of the frames that are done. Layers that were too small are dropped and get larger capacities.
    void frameDone(std::uint64_t frame) override;

    /// Whether a layer has turned out too small since the last call.
    [[nodiscard]] bool takeFailure() { return std::exchange(m_has_failed, false); }

    /// All layers become invalid: every object is voxelized again.
    void frameLost() override;

    /// Triangles that were left out when the dynamic objects were voxelized last, by reason, summed over all objects.
    [[nodiscard]] std::map<std::string, std::uint64_t> droppedTriangles();

private:
    struct Object
    {
        std::shared_ptr<const DynamicMesh> mesh;
        DynamicObjectInfo info;
        DynamicObjectBuffers buffers;
        LayerCapacities capacities;
        std::unique_ptr<LayerBuffers> layer;
        std::shared_ptr<const Pose> pose; // that the object is to be in
        std::uint64_t version = 0;        // of pose
        std::uint64_t voxelized = 0;      // version of the pose in `layer`; 0: none
        gpu::BinCounters bins{};          // counts of the last voxelization
        bool is_hopeless = false;         // no layer can be large enough
    };
    // What a LayerState keeps.
    struct Shown
    {
        std::shared_ptr<Object> object;
        std::shared_ptr<const Pose> pose;
    };
    struct PendingLayer
    {
        std::uint64_t frame;
        std::shared_ptr<Object> object;
        std::uint64_t report; // number of the report; its element in the ring m_reports is this modulo the ring's size
        LayerCapacities capacities;
    };

    void put(Object& object, Pose&& pose);
    [[nodiscard]] Object& presentObject(DynamicObjectId id);
    [[nodiscard]] LayerContents contentsOf(const Object& object) const;
    void dropLayer(Object& object);
    bool learn(const PendingLayer& pending);

    vk::Uploader& m_device;
    const Grid& m_grid;
    DynamicObjectOptions m_options;
    vk::DeletionQueue& m_deletion_queue;
    std::map<DynamicObjectId, std::shared_ptr<Object>> m_objects; // that are present
    DynamicObjectId m_next_object = 1;
    std::uint64_t m_last_version = 0;           // of all poses
    vk::BufferOf<gpu::LayerCounters> m_reports; // host-visible, a ring
    std::uint64_t m_report_count = 0;
    std::deque<PendingLayer> m_pending; // in order of frames
    bool m_has_failed = false;          // a layer was too small (takeFailure())
};

} // namespace zvo
