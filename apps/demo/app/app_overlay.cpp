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

bool App::drawBrushCursor()
{
    const bool has_brush = m_editor.state.tool == Tool::Brush && m_world->scene.canEdit();
    const bool is_over_picture = !m_panels.shows_panels || !ImGui::GetIO().WantCaptureMouse;
    if (!has_brush || !is_over_picture || !m_mouse || !m_inspected)
    {
        return false;
    }
    const PictureSize size = m_window.size();
    const PointerView view = {m_camera.camera(), {size.width, size.height}, {m_mouse->x, m_mouse->y}};
    const Grid& grid = m_world->scene.tree().grid;
    const std::optional<BrushPlace> place = brushPlace(view, grid, *m_inspected);
    if (place)
    {
        drawBrush(view, grid, m_editor.state, *place);
    }
    return place.has_value();
}

} // namespace zvo::demo
