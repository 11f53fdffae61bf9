// SPDX-License-Identifier: MIT
#pragma once

#include "zvo/context.h"
#include "zvo/export.h"
#include "zvo/model.h"
#include "zvo/tree.h"
#include "zvo/types.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace zvo
{

/// Options of a dynamic tree.
struct DynamicTreeInfo
{
    Coverage coverage = Coverage::Thin; // of the dynamic objects; should be the static tree's
    MergeRule merge = MergeRule::DynamicWins;
    std::uint32_t frames_in_flight = 2;       // frames recorded before Context::frameDone() of the first one; 1 to 16
    std::size_t history_entries = 1;          // updates that undo() can go back by, at least 1
    std::uint64_t history_bytes = UINT64_MAX; // device memory that these updates may hold
    std::size_t strokes = 1024;               // strokes that undoEdit() can go back by, at least 1
    std::uint64_t edit_bytes = 256U << 20;    // device memory that these strokes may hold
    float emission_scale = 0; // common to the static tree and all dynamic objects; 0: nothing emits light
};

/// What a dynamic object does to the tree.
struct DynamicObjectInfo
{
    /// It takes its voxels away in place of adding them: first, all objects that carve take theirs from the static tree
    /// and the strokes of brushes, then the others are merged with what is left.
    bool carves = false;
    /// Only with carves: what is inside of its mesh goes, too. None takes the voxels of the surface alone. Not Robust.
    Fill fill = Fill::None;
};

/// A dab of a brush on the voxels of a grid.
struct BrushInfo
{
    BrushShape shape = BrushShape::Sphere;
    BrushAction action = BrushAction::Carve;
    std::array<std::int32_t, 3> center{}; // voxel; may lie outside of the grid
    std::uint32_t radius = 0;             // voxels beside the centre, at most 64
    std::uint32_t color = 0;              // Fill, Paint: sRGB red | green << 8 | blue << 16
    Vec3 emission{};                      // Fill, Paint: radiance, linear; needs DynamicTreeInfo::emission_scale
};

/// The result of an update, known once its frame is done.
struct UpdateStats
{
    bool failed = false;            // a buffer was too small: the last complete tree is shown; see needsUpdate()
    std::uint64_t node_count = 0;   // of the overlay
    std::uint64_t voxel_count = 0;  // with attributes of their own in the overlay
    std::uint64_t moving_count = 0; // voxels that dynamic objects cover
    std::map<std::string, std::uint64_t> dropped; // dynamic objects' triangles that were left out, by reason
};

/// Number of a dynamic object; never used again. undo() to an entry from before the object was added takes it away, and
/// the next update() removes it for good. redo(), or undo() of its removal, brings it back under the same number.
using DynamicObjectId = std::uint32_t;

/// A tree that brushes edit and into which moving models are merged, frame by frame (Y. Pan, Dynamic Update of Sparse
/// Voxel Octree Based on Morton Code, 2021). The static tree never changes: an update writes copies of the paths that
/// dynamic objects touch behind it, and shows the copy; undo() shows an older one. The result equals a rebuild of
/// everything.
///
/// At most 4 * frames_in_flight updates may be under way: recorded in frames that are not done yet
/// (Context::frameDone()). undo() and redo() are not limited. First stages of everything that is recorded:
/// ALL_TRANSFER, COMPUTE_SHADER and DRAW_INDIRECT; last stages: COMPUTE_SHADER and ALL_TRANSFER; on resources of zvo
/// only. Nothing waits for the device: an update that has too little memory says so in its stats when its frame is
/// done, the frame shows the last complete tree, and a later update gets more memory.
class ZVO_API DynamicTree
{
public:
    /// Takes over a static tree, and records its move to buffers with room behind it. Throws Error{Usage} for
    /// attributes in fewer than 8 bytes, for a DAG of a filled octree, for MergeRule::Average without kept sums, for
    /// another emission scale and for numbers out of range; then the tree stays as it is. Throws Error{Memory}; then
    /// the tree is gone.
    DynamicTree(Recorder& recorder, Tree&& fixed, const DynamicTreeInfo& info);
    ~DynamicTree();
    DynamicTree(DynamicTree&&) noexcept;
    DynamicTree& operator=(DynamicTree&&) noexcept;

    /// Adds a dynamic object. Like all changes, it is shown from the next update() on. to_world: finite and affine.
    /// Throws Error{Usage} for other transforms, for more than 1024 dynamic objects, for another emission scale and for
    /// an info that no object can have; Error{Memory}.
    DynamicObjectId addObject(Recorder& recorder, const Model& model, const Mat4& to_world,
                              const DynamicObjectInfo& info = {});

    /// Moves a dynamic object. Records nothing; the work is done by update(). Throws Error{Usage} for an object that
    /// does not exist, as removeObject() does, and for transforms as addObject().
    void setTransform(DynamicObjectId object, const Mat4& to_world);
    void removeObject(DynamicObjectId object);

    /// Records an update: dynamic objects that have changed are voxelized, all are merged with the static tree, and the
    /// result is shown. budget_ms: device time for this call; 0: no bound. Under a budget, as much of the update is
    /// recorded as is expected to fit, and the rest by the next calls. The expectation is learnt from the times of
    /// passes; without ContextInfo::timed_passes_per_frame it stays a guess. Returns whether the update is complete.
    /// Work is proportional to the voxels that move. Throws Error{Usage} for more updates than frames_in_flight allows
    /// and for a budget that is negative or not finite, and Error{Memory}.
    bool update(Recorder& recorder, double budget_ms = 0);

    /// Whether another update() is needed to show the current state: one has failed, was given up, was lost or had to
    /// wait.
    [[nodiscard]] bool needsUpdate();

    /// Record that the previous or the next entry of the history is shown, with the dynamic objects where they were
    /// then. Return false if there is none. The first entry is the static tree without dynamic objects; edit(),
    /// undoEdit() and redoEdit() begin a new history with the edited tree. Constant cost.
    bool undo(Recorder& recorder);
    bool redo(Recorder& recorder);

    /// Records a dab of a brush on everything but dynamic objects. Dabs up to endStroke() are one stroke. Returns
    /// false, and records no dab, while the device has yet to report how much room there is: try again in a later
    /// frame. Throws Error{Usage} for a radius that is too large, for a shape or action that does not exist, and for
    /// more than 32 dabs in a frame; Error{Memory}. Cost: the brush's volume.
    bool edit(Recorder& recorder, const BrushInfo& brush);

    /// Records a dab with the voxels of an octree, such as one of a filled mesh (TreeBuildInfo::fill), as edit() does:
    /// carves them (the difference), or fills them in, as they look (the union), black without attributes. offset: the
    /// voxel of this tree where the octree's first one lies. It takes up to 30 MB of device memory until its frame is
    /// done. The octree has at most 128 voxels per edge, attributes of 8 bytes or none, and this
    /// tree's emission scale if it emits. Returns and throws as edit(); Error{Usage} also for another octree or action.
    bool stamp(Recorder& recorder, const Tree& octree, const std::array<std::int32_t, 3>& offset, BrushAction action);
    void endStroke();

    /// Record that the previous or the next stroke's state is shown. Return false if there is none. Constant cost.
    bool undoEdit(Recorder& recorder);
    bool redoEdit(Recorder& recorder);

    /// The results of the updates whose frames became done since the last call, in order.
    std::vector<UpdateStats> takeUpdates();

    /// The static tree's properties.
    [[nodiscard]] const TreeInfo& info() const;

    /// As Tree::address(). It stays the same, however the tree grows.
    [[nodiscard]] std::uint64_t address() const;

    struct Impl;
    [[nodiscard]] Impl* impl() const { return m_impl.get(); } // only for the library; null after a move

private:
    std::unique_ptr<Impl> m_impl;
};

} // namespace zvo
