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
#include <optional>
#include <vector>

namespace zvo::demo
{

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

    /// Whether a tool needs to know what is under the pointer; and the number of that request, for the next frame.
    [[nodiscard]] bool wantsPixel() const { return m_stroke.isActive(); }
    [[nodiscard]] std::uint64_t probe() const { return m_stroke.probe(); }

    /// Takes the answer to the request with this number.
    void found(std::uint64_t probe, const gpu::PixelReport& report, World& world);

    /// Queues an edit behind the stroke that is under way.
    void request(const EditRequest& request, World& world);

    /// Ends everything that is under way, because the world was replaced.
    void release();

    /// Sets the brush's colour to that of a pixel.
    void takeColor(const gpu::PixelReport& report);

private:
    struct Drag
    {
        std::size_t object;
        glm::dvec3 grabbed; // point in the world
        glm::dvec3 offset;  // of the dynamic object then
    };

    void grab(const glm::ivec3& voxel, World& world);
    void drag(World& world);
    void finishStroke(World& world);

    Stroke m_stroke;
    ToolState m_used;                  // for the stroke that is under way, whatever is chosen since it began
    bool m_has_grabbed = false;        // in the stroke, maybe nothing
    std::vector<EditRequest> m_behind; // the stroke
    std::optional<Drag> m_drag;
    ViewCamera m_camera;
    glm::dvec2 m_size{1.0};
    glm::dvec2 m_pointer{0.0};
};

} // namespace zvo::demo
