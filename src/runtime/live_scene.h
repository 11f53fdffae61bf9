// SPDX-License-Identifier: MIT
#pragma once

#include "core/dynamic/dynamic_octree.h"
#include "core/tree/tree_data.h"
#include "io/scene/animated_scene.h"
#include "runtime/copy_voxels.h"
#include "runtime/object_moves.h"
#include "runtime/static_part.h"

#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace zvo
{

/// Options of a LiveScene.
struct LiveOptions
{
    Coverage coverage = BuildOptions().coverage;
    bool attributes = BuildOptions().attributes;
    TreeStructure structure = TreeStructure::Svo; // of the static part
    std::uint32_t frames_in_flight = DynamicOptions().frames_in_flight;
    bool brushes_emit = false; // of a scene in which nothing emits: brushes may give voxels emission
    /// Called with the reason when a dab is left out.
    std::function<void(std::string_view)> warn = [](std::string_view) {};
    Fill fill = Fill::None; // of the static part
    Shell shell = Shell::Surface;
};

struct EndStroke
{
};
struct UndoStroke
{
};
struct RedoStroke
{
};

/// What is to be edited: a dab of the stroke that is under way or of a new one, the end of a stroke, an object that has
/// been moved by setOffset(), undo, or redo of the last stroke or move.
using EditRequest = std::variant<Brush, EndStroke, ObjectMove, UndoStroke, RedoStroke>;

/// Counts and sizes of a LiveScene.
struct LiveInfo
{
    StaticInfo fixed;
    std::uint64_t moving_triangle_count = 0;
    UpdateReport update{}; // of the last update that is known
};

/// What it took to show a point in time.
struct LiveUpdate
{
    UpdateReport report;
    std::vector<vk::PassTime> passes; // of the last frame
    std::uint32_t retry_count = 0;    // frames before that one, which did not complete the update
};

/// A place in the history of edits. While it is the same, and no stroke is under way, so is what is edited.
struct EditPoint
{
    std::uint64_t stroke = 0; // numbers of the last ones that are not undone, or 0
    std::uint64_t move = 0;

    bool operator==(const EditPoint&) const = default;
};

/// A scene in device memory: a static part, which is made once, into which the dynamic objects of an AnimatedScene are
/// merged with their poses at a given time, and which brushes edit. A frame: beginFrame(); then update() into the
/// frame's commands; then frameDone() once the device is done with it, or frameLost(). The device must outlive a
/// LiveScene, and be done with all frames when it is destroyed.
class LiveScene
{
public:
    /// An empty scene. Nothing can be merged with it.
    explicit LiveScene(vk::HeadlessDevice& device) : m_device(device) {}

    /// The scene of a tree from a file. Of options, frames_in_flight, brushes_emit and warn are used. A tree with
    /// packed attributes cannot be edited. Throws Error{Memory}.
    LiveScene(vk::HeadlessDevice& device, const TreeData& tree, const LiveOptions& options);

    /// Uploads an animated scene and builds its static part; the dynamic objects are voxelized by the first
    /// update(). Waits. Of the static part of `animated`, only the cameras are kept. Throws Error{Memory} when the
    /// device's budget does not suffice.
    LiveScene(vk::HeadlessDevice& device, AnimatedScene animated, const Grid& grid, const LiveOptions& options,
              const StaticListener& listener = {});

    /// Begins the next frame and returns its number.
    std::uint64_t beginFrame() { return m_dynamic ? m_dynamic->beginFrame() : 0; }

    /// Records what it takes to show the scene at a time of the animated scene; nothing if that is shown already. If
    /// memory does not suffice, the dynamic objects stay where they are, and trouble() tells why. Throws what making a
    /// kernel throws; then the frame may be submitted, or frameLost() must be called.
    void update(vk::FrameGraph& graph, double seconds);

    /// Calls update() in frames of its own and waits, until the time is shown and there are no more requests. Throws
    /// Error{Memory} if that takes too many frames.
    LiveUpdate settle(double seconds);

    /// Merges the dynamic objects at a time, whether or not that is shown already, and waits. Throws Error{Memory}
    /// where memory does not suffice.
    LiveUpdate updateAndWait(double seconds);

    /// Tells that the device is done with `frame` and all frames before it.
    void frameDone(std::uint64_t frame, std::span<const vk::PassTime> passes);

    /// Tells that the frame that began last does not reach the device.
    void frameLost();

    /// Whether brushes can edit the scene.
    [[nodiscard]] bool canEdit() const { return m_dynamic != nullptr; }

    /// Queues a request for the next updates, which carry requests out in order. Only for scenes that can be edited.
    void request(const EditRequest& request) { m_requests.push_back(request); }

    /// Whether requests wait for the next update.
    [[nodiscard]] bool hasRequests() const { return !m_requests.empty(); }

    /// The edits: which strokes can be undone, and how much memory they hold. Null if the scene cannot be edited.
    [[nodiscard]] const Edits* edits() const { return m_dynamic ? &m_dynamic->edits() : nullptr; }

    /// How many strokes and moves of objects can be undone and redone; 0 if the scene cannot be edited.
    [[nodiscard]] std::size_t undoCount() const { return canEdit() ? edits()->undoCount() + m_moves.undoCount() : 0; }
    [[nodiscard]] std::size_t redoCount() const { return canEdit() ? edits()->redoCount() + m_moves.redoCount() : 0; }

    /// The place in the history, as far as strokes and moves have been recorded.
    [[nodiscard]] EditPoint editPoint() const
    {
        return canEdit() ? EditPoint{edits()->stroke(), m_moves.move()} : EditPoint{};
    }

    /// Copies the voxels of a box, without dynamic objects, as requests that were recorded have made them. Waits. Only
    /// for scenes that can be edited. Throws Error{Memory}.
    [[nodiscard]] VoxelClip copyVoxels(const VoxelBox& box) const
    {
        return zvo::copyVoxels(m_device, tree(), m_dynamic->editedRoot(), box);
    }

    /// Drops strokes that have changed nothing from the history, once that is known, and returns their number. Not
    /// between beginFrame() and the end of the frame's submission.
    std::size_t dropUnchangedStrokes() { return m_dynamic ? m_dynamic->dropUnchangedStrokes() : 0; }

    /// Moves a dynamic object by an offset in world space, in addition to its motion. The offset replaces the last one;
    /// 0 restores the object's own position.
    void setOffset(std::size_t object, const glm::dvec3& offset);
    [[nodiscard]] const glm::dvec3& offset(std::size_t object) const { return m_offsets[object]; }

    /// The pose in which a dynamic object is shown, its offset included.
    [[nodiscard]] Pose shownPose(std::size_t object) const { return poseOf(object, m_shown_seconds.value_or(0.0)); }

    /// The tree to trace.
    [[nodiscard]] const DeviceTree& tree() const { return m_dynamic ? m_dynamic->tree() : m_fixed; }

    [[nodiscard]] const LiveInfo& info() const { return m_info; }
    [[nodiscard]] const AnimatedScene& animated() const { return m_animated; }
    [[nodiscard]] bool moves() const { return !m_objects.empty(); }

    /// Whether the last update() has carried out requests.
    [[nodiscard]] bool isEdited() const { return !m_recorded.empty(); }

    /// Why the dynamic objects could not be shown as they should be; empty if nothing is wrong.
    [[nodiscard]] const std::string& trouble() const { return m_trouble; }

private:
    void recordRequests(vk::FrameGraph& graph);
    bool record(vk::FrameGraph& graph, const EditRequest& request);
    bool recordDab(vk::FrameGraph& graph, const Brush& brush);
    void undo(vk::FrameGraph& graph);
    void redo(vk::FrameGraph& graph);
    void updateObjects(vk::FrameGraph& graph, double seconds);
    [[nodiscard]] Pose poseOf(std::size_t object, double seconds) const;
    [[nodiscard]] bool isSettled() const;

    vk::HeadlessDevice& m_device;
    AnimatedScene m_animated;
    LiveInfo m_info;
    std::function<void(std::string_view)> m_warn;
    DeviceTree m_fixed; // a tree that cannot be edited; else empty
    std::unique_ptr<DynamicOctree> m_dynamic;
    std::vector<DynamicObjectId> m_objects; // in the order of the animated scene
    std::vector<glm::dvec3> m_offsets;      // of dynamic objects
    std::optional<double> m_shown_seconds;  // the time of the dynamic objects' poses
    ObjectMoves m_moves;
    ObjectMoves m_moves_before;         // the last frame
    std::deque<EditRequest> m_requests; // to be recorded
    std::deque<EditRequest> m_recorded; // requests that the last frame has recorded
    std::string m_trouble;
};

/// The largest emission of anything in an animated scene: the scale for all that is voxelized into one octree.
float brightestEmission(const AnimatedScene& animated);

} // namespace zvo
