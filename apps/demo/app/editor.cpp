// SPDX-License-Identifier: MIT
#include "demo/app/editor.h"

#include <algorithm>
#include <utility>
#include <variant>

namespace zvo::demo
{

void Editor::handle(const InputEvent& event, const ViewCamera& camera, const glm::dvec2& size, World& world)
{
    m_camera = camera;
    m_size = size;
    if (const auto* const move = std::get_if<MouseMoveEvent>(&event))
    {
        m_pointer = {move->x, move->y};
        m_stroke.move();
        drag(world);
    }
    const auto* const button = std::get_if<MouseButtonEvent>(&event);
    if (button == nullptr || button->button != MouseButton::Left)
    {
        return;
    }
    if (!button->pressed)
    {
        m_stroke.release();
        m_drag.reset();
    }
    else if (hasButton() && !button->modifiers.alt && world.scene.canEdit())
    {
        if (!m_stroke.isActive())
        {
            m_used = state;
            m_has_grabbed = false;
        }
        m_stroke.press();
    }
}

void Editor::perform(Action action)
{
    const auto choose = [this](Tool tool) { state.tool = state.tool == tool ? Tool::Camera : tool; };
    switch (action)
    {
    case Action::UseBrush:
        choose(Tool::Brush);
        break;
    case Action::UseHand:
        choose(Tool::Move);
        break;
    case Action::UseCamera:
        state.tool = Tool::Camera;
        break;
    case Action::NextBrush:
        state.action = static_cast<BrushAction>((static_cast<std::uint32_t>(state.action) + 1) % 3);
        break;
    case Action::SmallerBrush:
        state.radius = std::max(state.radius - 1, 0);
        break;
    case Action::LargerBrush:
        state.radius = std::min(state.radius + 1, static_cast<int>(gpu::kBrushRadiusMax));
        break;
    default:
        break;
    }
}

void Editor::found(std::uint64_t probe, const gpu::PixelReport& report, World& world)
{
    const bool has_voxel = report.hit != 0 && report.level == world.scene.tree().grid.nodeLevels();
    if (m_stroke.found(probe, has_voxel))
    {
        const glm::ivec3 voxel(report.cell);
        if (m_used.tool == Tool::Brush)
        {
            world.scene.request(m_used.brushAt(voxel));
        }
        else if (m_stroke.isDown())
        {
            grab(voxel, world);
        }
    }
    if (m_stroke.takeEnd())
    {
        finishStroke(world);
    }
}

// Chooses the dynamic object by the point at which the button was pressed.
void Editor::grab(const glm::ivec3& voxel, World& world)
{
    if (std::exchange(m_has_grabbed, true))
    {
        return;
    }
    const Grid& grid = world.scene.tree().grid;
    const glm::dvec3 point = glm::dvec3(grid.origin) + (glm::dvec3(voxel) + 0.5) * static_cast<double>(grid.voxel_size);
    if (const std::optional<std::size_t> object = world.objectAt(point))
    {
        m_drag = {*object, point, world.scene.offset(*object)};
    }
}

void Editor::finishStroke(World& world)
{
    m_drag.reset();
    if (m_used.tool == Tool::Brush)
    {
        world.scene.request(EndStroke{});
    }
    for (const EditRequest& request : std::exchange(m_behind, {}))
    {
        world.scene.request(request);
    }
}

void Editor::request(const EditRequest& request, World& world)
{
    if (m_stroke.isActive())
    {
        m_behind.push_back(request);
    }
    else
    {
        world.scene.request(request);
    }
}

// Moves the object parallel to the plane that faces the camera, with the grabbed point under the pointer.
void Editor::drag(World& world)
{
    if (m_drag)
    {
        const glm::dvec3 point = onPlane(pointerRay(m_camera, m_pointer, m_size), m_camera, m_drag->grabbed);
        world.scene.setOffset(m_drag->object, m_drag->offset + point - m_drag->grabbed);
    }
}

void Editor::release()
{
    m_stroke = {};
    m_behind.clear();
    m_drag.reset();
}

void Editor::takeColor(const gpu::PixelReport& report)
{
    if (report.hit == 0)
    {
        return;
    }
    for (std::size_t i = 0; i < state.color.size(); ++i)
    {
        state.color[i] = static_cast<float>(report.look.color >> (8 * i) & 255U) / 255.0F;
    }
}

} // namespace zvo::demo
