// SPDX-License-Identifier: MIT
#include "demo/app/editor.h"

#include "core/edit/edit.h"
#include "demo/world/hit_face.h"
#include "demo/world/mirror.h"

#include <algorithm>
#include <cmath>
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
        if (m_used.tool != Tool::Move)
        {
            m_stroke.move(m_pointer);
        }
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
        endDrag(world);
    }
    else if (hasButton() && !button->modifiers.alt && world.scene.canEdit())
    {
        if (!m_stroke.isActive())
        {
            m_used = state;
            m_dabs.clear();
            m_has_reached = false;
            m_was_outside = false;
            m_has_grabbed = false;
            m_has_shift = false;
            m_first_voxel.reset();
            m_last_voxel.reset();
        }
        m_stroke.press(m_pointer, button->modifiers.shift);
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
    case Action::UseSelection:
        choose(Tool::Select);
        break;
    case Action::NextForm:
        state.form = static_cast<BrushForm>((static_cast<std::uint32_t>(state.form) + 1) % 3);
        break;
    case Action::NextMirror:
        state.mirror.axes = state.mirror.axes[0]   ? std::array{false, true, false}
                            : state.mirror.axes[1] ? std::array{false, false, true}
                                                   : std::array{!state.mirror.axes[2], false, false};
        break;
    case Action::TakeColor:
    case Action::PlaceMirror:
    case Action::Paste:
        m_pick = {action, m_pointer};
        break;
    default:
        break;
    }
}

EditorLooks Editor::takeLooks()
{
    return {std::exchange(m_pick, std::nullopt), m_stroke.takePoints()};
}

void Editor::found(Action pick, const gpu::PixelReport& report, const World& world)
{
    const Grid& grid = world.scene.tree().grid;
    const glm::ivec3 voxel(report.cell);
    if (pick == Action::TakeColor)
    {
        takeColor(report);
    }
    else if (report.hit != 0 && report.level == grid.nodeLevels() && pick == Action::PlaceMirror)
    {
        state.mirror.at = voxel;
    }
    else if (report.hit != 0 && report.level == grid.nodeLevels())
    {
        order(PasteOrder{voxel, stepAcross(m_camera, grid, voxel, report.face)});
    }
}

void Editor::found(std::span<const gpu::PixelReport> stroke, World& world)
{
    paint(stroke, world);
    if (m_stroke.takeEnd())
    {
        finishStroke(world);
    }
}

void Editor::paint(std::span<const gpu::PixelReport> reports, World& world)
{
    const Grid& grid = world.scene.tree().grid;
    for (const gpu::PixelReport& report : reports)
    {
        if (m_stroke.nextIsPress())
        {
            finishBox(world); // a press continues the stroke before it, but is a box of its own
            m_has_shift = m_stroke.nextEndsLine();
        }
        const bool is_voxel = report.hit != 0 && report.level == grid.nodeLevels();
        const std::optional<glm::ivec3> center = is_voxel ? dabCenter(report, grid) : std::nullopt;
        const DabSpacing spacing = center ? spacingAt(*center, grid) : DabSpacing{};
        const std::vector<glm::ivec3> dabs = m_stroke.found({&center, 1}, spacing);
        if (center)
        {
            m_first_voxel = m_first_voxel ? m_first_voxel : center;
            m_last_voxel = center;
        }
        for (const glm::ivec3& dab : dabs)
        {
            if (m_used.tool == Tool::Brush && m_used.form == BrushForm::Stroke)
            {
                stamp(dab, world);
            }
            else if (m_used.tool == Tool::Move && m_stroke.isDown())
            {
                grab(report, world);
            }
        }
    }
}

// A dab of the stroke, and its images in the mirror.
void Editor::stamp(const glm::ivec3& voxel, World& world)
{
    const Grid& grid = world.scene.tree().grid;
    for (const glm::ivec3& image : imagesOf(voxel, m_used.mirror, grid))
    {
        m_dabs.push_back(image);
        if (noteReach(m_used.brushAt(image), grid))
        {
            world.scene.request(m_used.brushAt(image));
        }
    }
}

// Notes whether a brush reaches the grid, and returns whether it is to be applied. A brush that fills from outside of
// the grid would make nothing but what is hidden behind the face that it is used on.
bool Editor::noteReach(const Brush& brush, const Grid& grid)
{
    const VoxelBox whole = {glm::ivec3(0), glm::ivec3(grid.resolution()) - 1};
    const bool is_shape = brush.stamp == nullptr;
    const bool is_outside = is_shape && VoxelBox::of(brush.center, brush.center + brush.span).within(whole).isEmpty();
    const bool reaches = !brush.box().within(whole).isEmpty() && !(is_outside && brush.action == BrushAction::Fill);
    m_was_outside = m_was_outside || is_outside;
    m_has_reached = m_has_reached || reaches;
    return reaches;
}

// Where a dab at a voxel has its centre. A brush that fills builds on the face, and not on what its stroke has built,
// or else it would grow towards the camera.
std::optional<glm::ivec3> Editor::dabCenter(const gpu::PixelReport& report, const Grid& grid) const
{
    const glm::ivec3 voxel(report.cell);
    if (m_used.tool != Tool::Brush || m_used.action != BrushAction::Fill || m_used.form == BrushForm::Flood)
    {
        return voxel;
    }
    const bool is_built =
        std::ranges::any_of(m_dabs, [&](const glm::ivec3& dab) { return m_used.brushAt(dab).covers(voxel); });
    return is_built ? m_stroke.lastDab() : voxel + stepAcross(m_camera, grid, voxel, report.face);
}

// The step is half the radius. As far as a few points of the stroke see at the voxel's distance, it is joined to the
// one before; a picture of a low resolution has the same voxel at several points.
DabSpacing Editor::spacingAt(const glm::ivec3& voxel, const Grid& grid) const
{
    constexpr double kJoinedUnits = 24; // of the window
    const double depth = glm::dot(voxelCenter(grid, voxel) - m_camera.position, m_camera.forward);
    const double half_height =
        m_camera.orthographic ? m_camera.half_height : depth * std::tan(0.5 * m_camera.vertical_fov);
    const double voxels_a_unit = 2 * half_height / m_size.y / double{grid.voxel_size};
    const auto radius = static_cast<double>(m_used.radius);
    return {std::max(0.5 * radius, 1.0), 4 * radius + 2 + kJoinedUnits * voxels_a_unit};
}

// Chooses the dynamic object by the point at which the button was pressed.
void Editor::grab(const gpu::PixelReport& report, World& world)
{
    if (std::exchange(m_has_grabbed, true))
    {
        return;
    }
    const glm::dvec3 point = voxelCenter(world.scene.tree().grid, glm::ivec3(report.cell));
    if (const std::optional<std::size_t> object = world.objectAt(point))
    {
        m_drag = {*object, point, world.scene.offset(*object)};
    }
}

// What was dragged is an entry of the history.
void Editor::endDrag(World& world)
{
    if (m_drag && world.scene.offset(m_drag->object) != m_drag->offset)
    {
        world.scene.request(ObjectMove{m_drag->object, m_drag->offset, world.scene.offset(m_drag->object)});
    }
    m_drag.reset();
}

void Editor::finishStroke(World& world)
{
    endDrag(world);
    if (m_used.tool == Tool::Brush && m_used.form == BrushForm::Stroke)
    {
        world.scene.request(EndStroke{});
        m_has_missed = !m_dabs.empty() && !m_has_reached;
    }
    finishBox(world);
    sendBehind(world);
}

// The pointer went from a voxel to another one while the button was held.
void Editor::finishBox(World& world)
{
    const std::optional<glm::ivec3> first = std::exchange(m_first_voxel, std::nullopt);
    const std::optional<glm::ivec3> last = std::exchange(m_last_voxel, std::nullopt);
    if (!first || !last)
    {
        return;
    }
    const VoxelBox box = VoxelBox::of(*first, *last);
    if (m_used.tool == Tool::Select && m_has_shift && state.selection)
    {
        order(MoveOrder{*state.selection, *last - *first});
    }
    else if (m_used.tool == Tool::Select)
    {
        state.selection = box;
    }
    else if (m_used.tool == Tool::Brush && m_used.form == BrushForm::Box)
    {
        const Brush brush = m_used.boxBetween(*first, *last);
        requestStroke({&brush, 1}, m_used.mirror, world);
        m_has_missed = !m_has_reached;
    }
    else if (m_used.tool == Tool::Brush && m_used.form == BrushForm::Flood)
    {
        order(FloodOrder{m_used, *first});
    }
}

std::optional<VoxelBox> Editor::drawnBox() const
{
    const bool draws = m_used.tool == Tool::Select || (m_used.tool == Tool::Brush && m_used.form == BrushForm::Box);
    if (!draws || !m_stroke.isActive() || !m_first_voxel || !m_last_voxel)
    {
        return std::nullopt;
    }
    if (m_used.tool == Tool::Select && m_has_shift && state.selection)
    {
        return state.selection->movedBy(*m_last_voxel - *m_first_voxel);
    }
    return m_used.tool == Tool::Select ? VoxelBox::of(*m_first_voxel, *m_last_voxel)
                                       : m_used.boxBetween(*m_first_voxel, *m_last_voxel).box();
}

std::optional<EditOrder> Editor::nextOrder() const
{
    return m_orders.empty() || m_stroke.isActive() ? std::nullopt : std::optional(m_orders.front());
}

void Editor::orderDone(World& world)
{
    m_orders.pop_front();
    sendBehind(world);
}

// Queues what waits behind a stroke or an order.
void Editor::sendBehind(World& world)
{
    if (m_orders.empty())
    {
        for (const EditRequest& request : std::exchange(m_behind, {}))
        {
            world.scene.request(request);
        }
    }
}

void Editor::requestStroke(std::span<const Brush> brushes, const Mirror& mirror, World& world)
{
    const Grid& grid = world.scene.tree().grid;
    for (const Brush& brush : brushes)
    {
        for (const Brush& image : imagesOf(brush, mirror, grid))
        {
            const std::vector<Brush> parts = noteReach(image, grid) ? partsOf(image, grid) : std::vector<Brush>();
            for (const Brush& part : parts)
            {
                world.scene.request(part);
            }
        }
    }
    world.scene.request(EndStroke{});
}

void Editor::request(const EditRequest& request, World& world)
{
    if (m_stroke.isActive() || !m_orders.empty())
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
    m_pick.reset();
    m_orders.clear();
    m_behind.clear();
    m_drag.reset();
    state.selection.reset();
    state.mirror.at.reset();
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
