// SPDX-License-Identifier: MIT
#pragma once

#include "core/dynamic/dynamic_octree.h"
#include "core/tree/tree_data.h"
#include "io/scene/animated_scene.h"
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

/// How a LiveScene works.
struct LiveOptions
{
    Coverage coverage = BuildOptions().coverage;
    bool attributes = BuildOptions().attributes;
    TreeStructure structure = TreeStructure::Svo; // of what stands still
    std::uint32_t frames_in_flight = DynamicOptions().frames_in_flight;
    std::function<void(std::string_view)> warn = [](std::string_view) {}; // is told why a dab was left out
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

/// What a brush is to do: a dab of the stroke that is under way, or of a new one.
using EditRequest = std::variant<Brush, EndStroke, UndoStroke, RedoStroke>;

/// What there is to tell of a LiveScene.
struct LiveInfo
{
    StaticInfo fixed;
    std::uint64_t moving_triangle_count = 0;
    UpdateReport update{}; // the last one that is known
};

/// What it took to show a time.
struct LiveUpdate
{
    UpdateReport report;
    std::vector<vk::PassTime> passes; // of the frame that succeeded
    std::uint32_t retry_count = 0;    // frames before it that had too little memory
};

/// A scene in device memory: a static part, made once, with the dynamic objects of an AnimatedScene merged into it at
/// the time that is asked for, and edited by brushes. A frame: beginFrame(), then update() into the frame's commands,
/// then frameDone() once the device is done with it, or frameLost(). The device must be done with all frames when a
/// LiveScene goes, and outlive it.
class LiveScene
{
public:
    /// A scene of nothing, with which nothing can be merged.
    explicit LiveScene(vk::HeadlessDevice& device) : m_device(device) {}

    /// What a file holds. Of options, frames_in_flight and warn count. Packed attributes cannot be merged with
    /// anything. Throws Error{Memory}.
    LiveScene(vk::HeadlessDevice& device, const TreeData& tree, const LiveOptions& options);

    /// Uploads and builds everything but the voxels of what moves. Waits. Keeps of what stands still the cameras alone.
    /// Throws Error{Memory} when the device's budget does not suffice.
    LiveScene(vk::HeadlessDevice& device, AnimatedScene animated, const Grid& grid, const LiveOptions& options,
              const StaticListener& listener = {});

    /// Numbers the frame that is to be recorded.
    std::uint64_t beginFrame() { return m_dynamic ? m_dynamic->beginFrame() : 0; }

    /// Records what it takes to show the scene at a time of the animated scene; nothing where that is shown already.
    /// Memory may not suffice for what moves: then it stays where it is, and trouble() says why. Throws what making a
    /// kernel throws: then the frame is lost, if it is not submitted.
    void update(vk::FrameGraph& graph, double seconds);

    /// The same, in frames of its own, until it is shown, and waits: update() has nothing more to do then. Throws
    /// Error{Memory} should that take too many frames.
    LiveUpdate settle(double seconds);

    /// Merges what moves at a time, whether or not that is shown already, and waits. Throws Error{Memory} where memory
    /// does not suffice.
    LiveUpdate place(double seconds);

    /// The device is done with a frame and all before it.
    void frameDone(std::uint64_t frame, std::span<const vk::PassTime> passes);

    /// The frame that began last does not reach the device.
    void frameLost();

    /// Whether a brush can change what stands still.
    [[nodiscard]] bool canEdit() const { return m_dynamic != nullptr; }

    /// Has something done by the next updates, in order. For scenes that can be edited.
    void request(const EditRequest& request) { m_requests.push_back(request); }

    /// What was done by brushes, and what of it can be undone; null where nothing can be edited.
    [[nodiscard]] const Edits* edits() const { return m_dynamic ? &m_dynamic->edits() : nullptr; }

    /// Puts something that moves elsewhere, beside its motion: so far, in world space, in all. 0: where the animated
    /// scene has it.
    void setOffset(std::size_t object, const glm::dvec3& offset);
    [[nodiscard]] const glm::dvec3& offset(std::size_t object) const { return m_offsets[object]; }

    /// Where it is, as it is shown.
    [[nodiscard]] Pose shownPose(std::size_t object) const { return poseOf(object, m_shown_seconds.value_or(0.0)); }

    /// What to trace.
    [[nodiscard]] const DeviceTree& tree() const { return m_dynamic ? m_dynamic->tree() : m_fixed; }

    [[nodiscard]] const LiveInfo& info() const { return m_info; }
    [[nodiscard]] const AnimatedScene& animated() const { return m_animated; }
    [[nodiscard]] bool moves() const { return !m_objects.empty(); }

    /// Why something does not move as it should; empty: nothing is wrong.
    [[nodiscard]] const std::string& trouble() const { return m_trouble; }

private:
    void recordRequests(vk::FrameGraph& graph);
    bool record(vk::FrameGraph& graph, const EditRequest& request);
    void updateObjects(vk::FrameGraph& graph, double seconds);
    [[nodiscard]] Pose poseOf(std::size_t object, double seconds) const;
    [[nodiscard]] bool isSettled() const;

    vk::HeadlessDevice& m_device;
    AnimatedScene m_animated;
    LiveInfo m_info;
    std::function<void(std::string_view)> m_warn;
    DeviceTree m_fixed; // with which nothing can be merged; else empty
    std::unique_ptr<DynamicOctree> m_dynamic;
    std::vector<DynamicObjectId> m_objects; // in the order of the animated scene
    std::vector<glm::dvec3> m_offsets;      // of dynamic objects
    std::optional<double> m_shown_seconds;  // that the dynamic objects were placed for
    std::deque<EditRequest> m_requests;     // to be recorded
    std::deque<EditRequest> m_recorded;     // in the last frame
    std::string m_trouble;
};

/// The largest emission of anything in animated scene: the scale of everything that is voxelized into one octree.
float brightestEmission(const AnimatedScene& animated);

} // namespace zvo
