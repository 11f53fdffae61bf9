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

/// How a dynamic tree works.
struct DynamicTreeInfo
{
    Coverage coverage = Coverage::Thin; // of the dynamic objects: as the static tree's
    MergeRule merge = MergeRule::DynamicWins;
    std::uint32_t frames_in_flight = 2;       // recorded before Context::frameDone() of the first; 1 to 16
    std::size_t history_entries = 1;          // updates that undo() can go back by, at least 1
    std::uint64_t history_bytes = UINT64_MAX; // that they may hold
    std::size_t strokes = 1024;               // that undoEdit() can go back by, at least 1
    std::uint64_t edit_bytes = 256U << 20;    // that they may hold
    float emission_scale = 0; // common to the static tree and all dynamic objects; 0: nothing emits light
};

/// A dab of a brush on the voxels of a grid.
struct BrushInfo
{
    BrushShape shape = BrushShape::Sphere;
    BrushAction action = BrushAction::Carve;
    std::array<std::int32_t, 3> center{}; // voxel; may lie outside of the grid
    std::uint32_t radius = 0;             // voxels beside the centre, at most 64
    std::uint32_t color = 0;              // Fill, Paint: sRGB red | green << 8 | blue << 16
};

/// What an update came to, known once its frame is done.
struct UpdateStats
{
    bool failed = false;            // something was too small: the last complete tree is shown, see needsUpdate()
    std::uint64_t node_count = 0;   // of the overlay
    std::uint64_t voxel_count = 0;  // with attributes of their own in the overlay
    std::uint64_t moving_count = 0; // voxels that dynamic objects cover
    std::map<std::string, std::uint64_t> dropped; // dynamic objects' triangles that were left out, by reason
};

/// Number of a dynamic object, never used again. undo() to an entry from before the dynamic object was added takes it
/// away, and the next update() then for good; redo(), or undo() of its removal, brings it back under its number.
using DynamicObjectId = std::uint32_t;

/// A tree that a brush edits and into which moving models are merged, frame by frame (Y. Pan, Dynamic Update of Sparse
/// Voxel Octree Based on Morton Code, 2021). The static tree never changes: an update copies the paths that dynamic
/// objects touch behind it, and shows the copy; undo shows an older one. The result equals a rebuild of everything.
///
/// At most 4 * frames_in_flight updates in all frames together that are recorded and not yet done
/// (Context::frameDone()); undo() and redo() as often as one likes. All that records: first stages ALL_TRANSFER,
/// COMPUTE_SHADER and DRAW_INDIRECT, last stages COMPUTE_SHADER and ALL_TRANSFER, on resources of its own. What fails
/// is reported, not waited for: what an update needs beyond the memory that there is, it reports when its frame is
/// done; the frame shows the last complete tree, and a later update has more.
class ZVO_API DynamicTree
{
public:
    /// Takes over a static tree; records its move to buffers with room behind it. Throws Error{Usage} for attributes in
    /// fewer than 8 bytes, for MergeRule::Average without kept sums, for another emission scale and for numbers out of
    /// range: the tree stays as it is then. Throws Error{Memory}: the tree is used up.
    DynamicTree(Recorder& recorder, Tree&& fixed, const DynamicTreeInfo& info);
    ~DynamicTree();
    DynamicTree(DynamicTree&&) noexcept;
    DynamicTree& operator=(DynamicTree&&) noexcept;

    /// Adds a dynamic object; shown from the next update() on, as all changes are. to_world: finite and affine, else
    /// Error{Usage}, which it also throws for more than 1024 dynamic objects and for another emission scale;
    /// Error{Memory}.
    DynamicObjectId addObject(Recorder& recorder, const Model& model, const Mat4& to_world);

    /// Moves it. Records nothing and costs nothing until update(). Throws Error{Usage} for one that is not there, as
    /// removeObject() does, and for transforms as addObject().
    void setTransform(DynamicObjectId object, const Mat4& to_world);
    void removeObject(DynamicObjectId object);

    /// Records an update: dynamic objects that changed are voxelized, all are merged with the static tree, and the
    /// result is shown. Under a budget of device time, as much of it as is thought to fit, and the rest in the next
    /// calls; 0: no bound. What fits is learnt from ContextInfo::timed_passes_per_frame: without, it is a guess that
    /// nothing puts right. Returns whether the update is complete. Work is proportional to the voxels that move. Throws
    /// Error{Usage} for more updates than frames_in_flight allow and for a budget that is negative or not finite,
    /// Error{Memory}.
    bool update(Recorder& recorder, double budget_ms = 0);

    /// Whether something has to be shown by another update(): one failed, was given up, was lost or had to wait.
    [[nodiscard]] bool needsUpdate();

    /// Records that the entry of the history before, or behind, the one that is shown is shown again, with the dynamic
    /// objects of that time where they were. False if there is none. The first entry is the static tree without dynamic
    /// objects; edit(), undoEdit() and redoEdit() begin anew with the edited one. Cost: constant.
    bool undo(Recorder& recorder);
    bool redo(Recorder& recorder);

    /// Records a dab of a brush on what does not move. Dabs up to endStroke() are one stroke. False, and no dab, while
    /// the device has to tell first how much room there is: to be tried again in a later frame. Throws Error{Usage} for
    /// a radius that is too large, a shape or action that there is not, and for more than 32 dabs in a frame,
    /// Error{Memory}. Cost: the brush's volume.
    bool edit(Recorder& recorder, const BrushInfo& brush);
    void endStroke();

    /// Records that the strokes before, or behind, are shown again. False if there are none. Cost: constant.
    bool undoEdit(Recorder& recorder);
    bool redoEdit(Recorder& recorder);

    /// What updates came to whose frames are done since the last call, in order.
    std::vector<UpdateStats> takeUpdates();

    /// Of the static tree.
    [[nodiscard]] const TreeInfo& info() const;

    /// As Tree::address(): it stays the same, however the tree grows.
    [[nodiscard]] std::uint64_t address() const;

    struct Impl;
    [[nodiscard]] Impl* impl() const { return m_impl.get(); } // of the library; null where it was moved from

private:
    std::unique_ptr<Impl> m_impl;
};

} // namespace zvo
