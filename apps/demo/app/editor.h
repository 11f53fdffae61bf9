// SPDX-License-Identifier: MIT
#pragma once

#include "demo/input/input_event.h"
#include "demo/input/keys.h"
#include "demo/input/pointer_ray.h"
#include "demo/panels/panels.h"
#include "demo/world/stroke.h"
#include "demo/world/tool.h"
#include "demo/world/world.h"

#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <utility>
#include <variant>
#include <vector>

namespace zvo::demo
{

/// A look for a key.
struct Pick
{
    Action action; // of the key: takes the colour, pastes, or places the mirror
    glm::dvec2 at; // point of the window
};

/// Edits of many voxels at once, most of which need voxels in the host's memory. Whoever carries one out calls
/// Editor::orderDone().
struct FloodOrder
{
    ToolState tool;
    glm::ivec3 seed;
};
struct CopyOrder
{
    VoxelBox box;
    bool cuts = false;
};
struct PasteOrder
{
    glm::ivec3 voxel; // that is seen
    glm::ivec3 step;  // across its face, or 0
};
struct MoveOrder
{
    VoxelBox box;
    glm::ivec3 by;
};
struct DeleteOrder
{
    VoxelBox box;
};
using EditOrder = std::variant<FloodOrder, CopyOrder, PasteOrder, MoveOrder, DeleteOrder>;

/// Points of the window, in its units, at which a frame looks for tools.
struct EditorLooks
{
    std::optional<Pick> pick;
    std::vector<glm::dvec2> stroke;
};

/// The tools under the left mouse button: the brush, and the hand that drags dynamic objects. What is under the pointer
/// becomes known to them only some frames later; still, strokes and other edits happen in the order of the events.
class Editor
{
public:
    ToolState state;

    /// Whether the left button belongs to a tool.
    [[nodiscard]] bool hasButton() const { return state.tool != Tool::Camera; }

    /// Handles an event of the mouse. camera: of the frame. size: of the window, in its units.
    void handle(const InputEvent& event, const ViewCamera& camera, const glm::dvec2& size, World& world);

    /// Performs the action of a key for tools.
    void perform(Action action);

    /// Whether frames must follow each other for a tool.
    [[nodiscard]] bool wantsFrames() const { return m_stroke.isActive() || m_drag || m_pick || !m_orders.empty(); }

    /// Takes the points at which the next frame is to look.
    EditorLooks takeLooks();

    /// Takes the answers to the oldest looks for strokes that have none yet, one a point; hit is 0 where there is no
    /// pixel.
    void found(std::span<const gpu::PixelReport> stroke, World& world);

    /// Takes the answer to a pick.
    void found(Action pick, const gpu::PixelReport& report, const World& world);

    /// Queues an edit behind the stroke that is under way.
    void request(const EditRequest& request, World& world);

    /// Queues a brush, with its images in the mirror, as a stroke.
    void requestStroke(std::span<const Brush> brushes, const Mirror& mirror, World& world);

    /// Asks for an edit, behind the stroke that is under way.
    void order(const EditOrder& order) { m_orders.push_back(order); }

    /// The order to be carried out now; nothing if there is none. It is kept until orderDone().
    [[nodiscard]] std::optional<EditOrder> nextOrder() const;
    void orderDone(World& world);

    /// Whether a stroke has ended that was wholly outside of the grid; true once.
    bool takeMissed() { return std::exchange(m_has_missed, false); }

    /// Whether the last stroke had its middle outside of the grid somewhere.
    [[nodiscard]] bool wasOutside() const { return m_was_outside; }

    /// Whether a stroke is not finished yet.
    [[nodiscard]] bool isBusy() const
    {
        return (m_used.tool == Tool::Brush && m_stroke.isActive()) || !m_orders.empty();
    }

    /// The box that the stroke under way has drawn or selected so far.
    [[nodiscard]] std::optional<VoxelBox> drawnBox() const;

    /// Ends everything that is under way, because the world was replaced.
    void release();

private:
    struct Drag
    {
        std::size_t object;
        glm::dvec3 grabbed; // point in the world
        glm::dvec3 offset;  // of the dynamic object then
    };

    [[nodiscard]] std::optional<glm::ivec3> dabCenter(const gpu::PixelReport& report, const Grid& grid) const;
    [[nodiscard]] DabSpacing spacingAt(const glm::ivec3& voxel, const Grid& grid) const;
    void paint(std::span<const gpu::PixelReport> reports, World& world);
    void stamp(const glm::ivec3& voxel, World& world);
    bool noteReach(const Brush& brush, const Grid& grid);
    void finishBox(World& world);
    void sendBehind(World& world);
    void takeColor(const gpu::PixelReport& report);
    void grab(const gpu::PixelReport& report, World& world);
    void drag(World& world);
    void endDrag(World& world);
    void finishStroke(World& world);

    Stroke m_stroke;
    ToolState m_used;               // for the stroke that is under way, whatever is chosen since it began
    std::vector<glm::ivec3> m_dabs; // centres of the stroke
    bool m_has_reached = false;     // the grid, with a dab of the stroke
    bool m_has_missed = false;
    bool m_was_outside = false;
    bool m_has_grabbed = false;        // in the stroke, maybe nothing
    std::vector<EditRequest> m_behind; // the stroke
    std::optional<Drag> m_drag;
    std::optional<glm::ivec3> m_first_voxel; // since the last press
    std::optional<glm::ivec3> m_last_voxel;
    bool m_has_shift = false; // the last press
    std::deque<EditOrder> m_orders;
    ViewCamera m_camera;
    glm::dvec2 m_size{1.0};
    glm::dvec2 m_pointer{0.0};
    std::optional<Pick> m_pick;
};

} // namespace zvo::demo
