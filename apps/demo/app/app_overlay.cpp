// SPDX-License-Identifier: MIT
// App: what is drawn over the picture, with panels or without.
#include "demo/app/app.h"

#include "demo/panels/brush_cursor.h"

#include <imgui.h>

namespace zvo::demo
{

// Returns whether anything is drawn.
bool App::drawOverlay()
{
    const bool has_brush = drawBrushCursor();
    return drawDialogs() || has_brush;
}

// The tool that edits voxels: where it is, what is selected, and the mirror.
bool App::drawBrushCursor()
{
    const ToolState& tool = m_editor.state;
    const PictureSize size = m_window.size();
    const bool edits = tool.tool == Tool::Brush || tool.tool == Tool::Select;
    if (!edits || !m_world->scene.canEdit())
    {
        return false;
    }
    const MouseMoveEvent mouse = m_mouse.value_or(MouseMoveEvent{});
    const PointerView view = {m_camera.camera(), {size.width, size.height}, {mouse.x, mouse.y}};
    const Grid& grid = m_world->scene.tree().grid;
    drawMirror(view, grid, tool.mirror);
    const std::optional<VoxelBox> drawn = m_editor.drawnBox();
    const std::optional<VoxelBox> box = drawn || tool.tool == Tool::Brush ? drawn : tool.selection;
    if (box)
    {
        drawVoxelBox(view, grid, *box);
    }
    const bool is_over_picture = !m_panels.shows_panels || !ImGui::GetIO().WantCaptureMouse;
    const std::optional<BrushPlace> place =
        is_over_picture && m_mouse && m_inspected ? brushPlace(view, grid, *m_inspected) : std::nullopt;
    if (place && tool.tool == Tool::Select)
    {
        drawFace(view, grid, *place);
    }
    else if (place && !drawn)
    {
        drawBrush(view, grid, tool, *place);
    }
    return place || box || tool.mirror != Mirror{};
}

} // namespace zvo::demo
