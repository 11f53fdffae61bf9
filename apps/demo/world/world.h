// SPDX-License-Identifier: MIT
#pragma once

#include "common/scene_options.h"
#include "core/dynamic/dynamic_octree.h"
#include "core/scene/camera.h"
#include "core/tree/device_tree.h"
#include "core/tree/tree_data.h"
#include "io/scene/stage.h"
#include "vk/headless.h"
#include "zvo/dynamic_tree.h"

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

namespace zvo::demo
{

/// What becomes of files.
struct WorldOptions
{
    cli::VoxelOptions voxels;               // scenes: the files; none: an empty world
    std::optional<TreeStructure> structure; // of what stands still; not given: an octree, or the file's
    std::uint32_t frames_in_flight = DynamicTreeInfo().frames_in_flight;
};

/// What there is to tell of a world.
struct WorldInfo
{
    std::string name; // of the file
    Grid grid;
    TreeStructure structure = TreeStructure::Svo;
    std::uint64_t static_triangle_count = 0;
    std::uint64_t moving_triangle_count = 0;
    std::uint64_t static_voxel_count = 0;
    std::uint64_t static_node_count = 0;
    std::uint64_t geometry_bytes = 0;
    std::uint64_t attribute_bytes = 0;
    std::size_t mover_count = 0;
    double build_ms = 0;   // voxelization, construction, compression; 0: it came out of a file
    UpdateReport update{}; // the last one that is known
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

/// What a brush is to do to a world: a dab of the stroke that is under way, or of a new one.
using EditRequest = std::variant<Brush, EndStroke, UndoStroke, RedoStroke>;

/// What files hold, before the device has any of it. A .vox file is read when the world is made.
struct WorldInput
{
    std::optional<Stage> stage;
    std::optional<TreeData> tree;
};

/// Is told what is being done, and how much of everything is done before that: 0 to 1.
using StepListener = std::function<void(std::string_view step, double done)>;

/// What is shown: the voxels of what stands still with what moves merged into them, in device memory. A frame:
/// beginFrame(), then update() into the frame's commands, then frameDone() once the device is done with it. The device
/// must be done with all frames when a World goes.
class World
{
public:
    /// Loads what options name, as `zvo render` does, .vox files, too; tells of what was left out. Waits. Throws what
    /// `zvo render` throws: Error{Input}, Error{Usage} and Error{Memory}. Other worlds stay as they are.
    static std::unique_ptr<World> load(vk::HeadlessDevice& device, const WorldOptions& options);

    /// The same in two steps: read() needs no device, and may be called on any thread.
    static WorldInput read(const WorldOptions& options);
    static std::unique_ptr<World> make(vk::HeadlessDevice& device, const WorldOptions& options, WorldInput input,
                                       const StepListener& listener);

    World(const World&) = delete;
    World& operator=(const World&) = delete;

    /// Numbers the frame that is to be recorded.
    std::uint64_t beginFrame();

    /// Records what it takes to show the world at a time of the stage; nothing where that is shown already. Memory may
    /// not suffice for what moves: then it stays where it is, and trouble() says why. Throws what making a kernel
    /// throws: then the frame is lost, if it is not submitted.
    void update(vk::FrameGraph& graph, double seconds);

    /// Whether a brush can change what stands still: not where attributes are packed.
    [[nodiscard]] bool canEdit() const { return m_dynamic != nullptr; }

    /// Has something done by the next updates, in order. For worlds that can be edited.
    void request(const EditRequest& request) { m_requests.push_back(request); }

    /// What was done by brushes, and what of it can be undone; null where nothing can be edited.
    [[nodiscard]] const Edits* edits() const { return m_dynamic ? &m_dynamic->edits() : nullptr; }

    /// What is shown as an octree, or a DAG, of its own, for a file; a tree that cannot be edited as it is. Waits for
    /// the device. Throws Error{Memory}.
    [[nodiscard]] TreeData copyTree(TreeStructure structure);

    /// Which of what moves is around a point of the world, as it is shown; nothing where there is none.
    [[nodiscard]] std::optional<std::size_t> moverAt(const glm::dvec3& point) const;

    /// Puts something that moves elsewhere, beside its motion: so far, in world space, in all. 0: where the stage has
    /// it.
    void setOffset(std::size_t mover, const glm::dvec3& offset);
    [[nodiscard]] const glm::dvec3& offset(std::size_t mover) const { return m_offsets[mover]; }

    /// The same, in a frame of its own, until it is shown, and waits: update() has nothing more to do then.
    void settle(double seconds);

    /// The device is done with a frame and all before it.
    void frameDone(std::uint64_t frame, std::span<const vk::PassTime> passes);

    /// The frame that began last does not reach the device.
    void frameLost();

    [[nodiscard]] const DeviceTree& tree() const { return m_dynamic ? m_dynamic->tree() : m_fixed; }
    [[nodiscard]] const WorldInfo& info() const { return m_info; }
    [[nodiscard]] const Stage& stage() const { return m_stage; }

    /// What a picture is about.
    [[nodiscard]] const Bounds& subject() const { return m_subject; }

    [[nodiscard]] bool moves() const { return !m_movers.empty(); }

    /// Whether voxels were made of triangles, which another resolution needs.
    [[nodiscard]] bool isVoxelized() const { return m_info.build_ms > 0; }

    /// Why something does not move as it should; empty: nothing is wrong.
    [[nodiscard]] const std::string& trouble() const { return m_trouble; }

private:
    World(vk::HeadlessDevice& device, Stage stage, const Bounds& subject);

    static std::unique_ptr<World> ofTree(vk::HeadlessDevice& device, const WorldOptions& options, TreeData tree,
                                         const StepListener& listener);
    static std::unique_ptr<World> ofStage(vk::HeadlessDevice& device, const WorldOptions& options, Stage stage,
                                          const StepListener& listener);
    void keep(DeviceTree&& tree, const WorldOptions& options);
    void build(const WorldOptions& options, const Grid& grid, const StepListener& listener);
    void recordRequests(vk::FrameGraph& graph);
    bool record(vk::FrameGraph& graph, const EditRequest& request);
    void updateMovers(vk::FrameGraph& graph, double seconds);
    [[nodiscard]] Pose poseOf(std::size_t mover, double seconds) const;
    [[nodiscard]] bool isSettled() const;

    vk::HeadlessDevice& m_device;
    Stage m_stage;
    Bounds m_subject;
    DeviceTree m_fixed; // that nothing can be merged with; otherwise
    std::unique_ptr<DynamicOctree> m_dynamic;
    std::vector<MoverId> m_movers;         // in the order of the stage
    std::vector<glm::dvec3> m_offsets;     // of movers
    std::optional<double> m_shown_seconds; // that the movers were placed for
    std::deque<EditRequest> m_requests;    // to be recorded
    std::deque<EditRequest> m_recorded;    // in the last frame
    std::uint64_t m_frame = 0;             // of worlds that nothing can be merged with
    std::string m_trouble;
    WorldInfo m_info;
};

} // namespace zvo::demo
