// SPDX-License-Identifier: MIT
#include "demo/input/camera_control.h"

#include "common/parse.h"
#include "common/view.h"
#include "zvo/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <variant>
#include <vector>

namespace zvo::demo
{

namespace
{

constexpr double kTurn = std::numbers::pi; // radians for a drag over the window's height
constexpr double kPitchMax = 1.55;         // radians up and down, so that the camera is never quite vertical
constexpr double kZoom = 0.85;             // factor on the distance for each notch of the wheel
constexpr double kSpeedStep = 1.25;        // factor for each notch
constexpr double kFast = 4;                // factor with Shift
constexpr double kUsualSpeed = 0.25;       // subjects a second
constexpr double kSpeedMin = 1e-4;         // subjects a second
constexpr double kSpeedMax = 1e2;
constexpr double kPivotMin = 1e-3; // subjects

double pitchOf(const glm::dvec3& forward)
{
    return std::asin(std::clamp(forward.y, -1.0, 1.0));
}

// Sets the camera's axes, with y up.
void setDirection(ViewCamera& camera, double yaw, double pitch)
{
    const glm::dvec3 forward(std::cos(pitch) * std::sin(yaw), std::sin(pitch), -std::cos(pitch) * std::cos(yaw));
    const glm::dvec3 right(std::cos(yaw), 0.0, std::sin(yaw));
    camera.forward = forward;
    camera.right = right;
    camera.up = glm::cross(right, forward);
}

} // namespace

CameraControl::CameraControl(const ViewCamera& camera, const Bounds& subject) : m_camera(camera)
{
    setSubject(subject);
    show(camera);
}

void CameraControl::setSubject(const Bounds& subject)
{
    const double size = glm::length(glm::dvec3(subject.max) - glm::dvec3(subject.min));
    m_subject_size = std::isfinite(size) && size > 0 ? size : 1.0;
    m_speed = kUsualSpeed * m_subject_size;
    m_pivot_distance = m_subject_size;
    const glm::dvec3 center = 0.5 * (glm::dvec3(subject.min) + glm::dvec3(subject.max));
    const double ahead = glm::dot(center - m_camera.position, m_camera.forward);
    if (ahead > kPivotMin * m_subject_size)
    {
        m_pivot_distance = ahead;
    }
}

void CameraControl::show(const ViewCamera& camera)
{
    m_camera = camera;
}

void CameraControl::setSpeed(double speed)
{
    m_speed = std::clamp(speed, kSpeedMin * m_subject_size, kSpeedMax * m_subject_size);
}

void CameraControl::release()
{
    m_held.fill(false);
    m_drag = Drag::None;
}

void CameraControl::handle(const InputEvent& event, bool has_tool, double height)
{
    if (const auto* const key = std::get_if<KeyEvent>(&event))
    {
        onKey(*key);
    }
    else if (const auto* const button = std::get_if<MouseButtonEvent>(&event))
    {
        onButton(*button, has_tool);
    }
    else if (const auto* const move = std::get_if<MouseMoveEvent>(&event))
    {
        onMove(*move, height);
    }
    else if (const auto* const wheel = std::get_if<WheelEvent>(&event))
    {
        onWheel(wheel->y);
    }
}

void CameraControl::onKey(const KeyEvent& event)
{
    // Keys with Ctrl or Alt do something else, and do not move.
    const bool is_other = event.modifiers.control || event.modifiers.alt;
    m_held[static_cast<std::size_t>(event.key)] = event.pressed && !is_other;
}

void CameraControl::onButton(const MouseButtonEvent& event, bool has_tool)
{
    if (!event.pressed)
    {
        m_drag = event.button == m_drag_button ? Drag::None : m_drag;
        return;
    }
    if (m_drag != Drag::None || (event.button == MouseButton::Left && has_tool && !event.modifiers.alt))
    {
        return;
    }
    m_drag_button = event.button;
    m_drag = event.button == MouseButton::Right    ? Drag::Look
             : event.button == MouseButton::Middle ? Drag::Pan
                                                   : Drag::Orbit;
}

void CameraControl::onMove(const MouseMoveEvent& event, double height)
{
    const std::optional<MouseMoveEvent> before = m_mouse;
    m_mouse = event;
    if (!before || m_drag == Drag::None || !(height > 0))
    {
        return;
    }
    const double right = (event.x - before->x) / height;
    const double down = (event.y - before->y) / height;
    switch (m_drag)
    {
    case Drag::Look:
        turn(kTurn * right, -kTurn * down);
        break;
    case Drag::Orbit:
    {
        const glm::dvec3 center = pivot();
        turn(kTurn * right, -kTurn * down);
        m_camera.position = center - m_pivot_distance * m_camera.forward;
        break;
    }
    case Drag::Pan:
    {
        const double half_height =
            m_camera.orthographic ? m_camera.half_height : m_pivot_distance * std::tan(0.5 * m_camera.vertical_fov);
        m_camera.position += 2 * half_height * (down * m_camera.up - right * m_camera.right);
        break;
    }
    case Drag::None:
        break;
    }
}

void CameraControl::onWheel(double notches)
{
    if (m_drag == Drag::Look)
    {
        setSpeed(m_speed * std::pow(kSpeedStep, notches));
        return;
    }
    const double part = std::pow(kZoom, notches);
    const glm::dvec3 center = pivot();
    m_pivot_distance = std::max(m_pivot_distance * part, kPivotMin * m_subject_size);
    if (m_camera.orthographic)
    {
        m_camera.half_height *= part;
    }
    m_camera.position = center - m_pivot_distance * m_camera.forward;
}

void CameraControl::turn(double right, double up)
{
    const double yaw = std::atan2(m_camera.forward.x, -m_camera.forward.z) + right;
    setDirection(m_camera, yaw, std::clamp(pitchOf(m_camera.forward) + up, -kPitchMax, kPitchMax));
}

void CameraControl::advance(double seconds)
{
    const auto along = [this](Key plus, Key minus)
    {
        return (m_held[static_cast<std::size_t>(plus)] ? 1.0 : 0.0) -
               (m_held[static_cast<std::size_t>(minus)] ? 1.0 : 0.0);
    };
    const glm::dvec3 way = along(Key::W, Key::S) * m_camera.forward + along(Key::D, Key::A) * m_camera.right +
                           along(Key::E, Key::Q) * m_camera.up;
    if (way == glm::dvec3(0.0))
    {
        return;
    }
    const bool is_fast =
        m_held[static_cast<std::size_t>(Key::LeftShift)] || m_held[static_cast<std::size_t>(Key::RightShift)];
    m_camera.position += seconds * m_speed * (is_fast ? kFast : 1.0) * way;
}

std::optional<std::string> cameraText(const ViewCamera& camera, double target_distance)
{
    if (camera.orthographic)
    {
        return std::nullopt;
    }
    const glm::vec3 eye(camera.position);
    const glm::vec3 target(camera.position + target_distance * camera.forward);
    std::string text = fmt::format("{},{},{},{},{},{},{}", eye.x, eye.y, eye.z, target.x, target.y, target.z,
                                   static_cast<float>(glm::degrees(camera.vertical_fov)));
    return cameraOfText(text) ? std::optional(std::move(text)) : std::nullopt;
}

std::optional<ViewCamera> cameraOfText(std::string_view text)
{
    constexpr std::string_view kBlank = " \t\r\n";
    const std::size_t first = text.find_first_not_of(kBlank);
    if (first == std::string_view::npos)
    {
        return std::nullopt;
    }
    text = text.substr(first, text.find_last_not_of(kBlank) - first + 1);
    const std::optional<std::vector<float>> numbers = cli::tryParseFloats(text);
    if (!numbers)
    {
        return std::nullopt;
    }
    try
    {
        return cli::cameraOfNumbers(*numbers);
    }
    catch (const Error&) // too few numbers, or no direction
    {
        return std::nullopt;
    }
}

} // namespace zvo::demo
