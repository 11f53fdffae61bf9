// SPDX-License-Identifier: MIT
#pragma once

#include "core/scene/camera.h"
#include "core/scene/scene.h"
#include "demo/input/input_event.h"

#include <array>
#include <optional>

namespace zvo::demo
{

/// The camera under mouse and keyboard: orbits and flies, whichever is being done. The camera that it was given is
/// shown as it is, whatever its field of view and its roll, until it is moved; then up is y.
///
/// - W, A, S, D, E, Q move: forward, left, back, right, up, down; four times as fast with Shift
/// - the right button looks around; the wheel changes the speed while it is held
/// - the left button, where no tool has it, orbits around the pivot; with Alt, always
/// - the middle button moves sideways; the wheel goes nearer to the pivot, which is what an orthographic camera shows
/// larger
class CameraControl
{
public:
    /// subject: what is looked at; its size is the unit of all speeds.
    CameraControl(const ViewCamera& camera, const Bounds& subject);

    /// Another camera, or another subject.
    void show(const ViewCamera& camera);
    void setSubject(const Bounds& subject);

    /// Takes an event. has_tool: the left button belongs to a tool. height: of the window, in its units.
    void handle(const InputEvent& event, bool has_tool, double height);

    /// Lets go of all that is held.
    void release();

    /// Moves as the keys that are held say.
    void advance(double seconds);

    [[nodiscard]] const ViewCamera& camera() const { return m_camera; }

    /// The point that orbits go around, in front of the camera.
    [[nodiscard]] glm::dvec3 pivot() const { return m_camera.position + m_pivot_distance * m_camera.forward; }

    /// World units a second.
    [[nodiscard]] double speed() const { return m_speed; }
    void setSpeed(double speed);

    /// Whether a button turns or moves it at the moment.
    [[nodiscard]] bool isDragging() const { return m_drag != Drag::None; }

private:
    enum class Drag
    {
        None,
        Look,
        Orbit,
        Pan
    };

    void onKey(const KeyEvent& event);
    void onButton(const MouseButtonEvent& event, bool has_tool);
    void onMove(const MouseMoveEvent& event, double height);
    void onWheel(double notches);
    void turn(double right, double up);

    ViewCamera m_camera;
    double m_subject_size = 1;
    double m_pivot_distance = 1;
    double m_speed = 1;
    std::array<bool, kKeyCount> m_held{};
    Drag m_drag = Drag::None;
    MouseButton m_drag_button = MouseButton::Left;
    std::optional<MouseMoveEvent> m_mouse;
};

/// A camera as `--camera` takes it: "ex,ey,ez,tx,ty,tz,fov". target_distance: from the eye to the target. Nothing for
/// an orthographic camera, and for one that single precision does not hold.
std::optional<std::string> cameraText(const ViewCamera& camera, double target_distance);

/// The camera that such a text names, spaces around it aside; nothing for any other text.
std::optional<ViewCamera> cameraOfText(std::string_view text);

} // namespace zvo::demo
