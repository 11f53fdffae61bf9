// SPDX-License-Identifier: MIT
// App: what frames are asked about single pixels, and what becomes of the answers.
#include "demo/app/app.h"

#include <utility>

namespace zvo::demo
{

// The pixel at a point of the window; nothing outside.
std::optional<glm::uvec2> App::pixelAt(const glm::dvec2& point) const
{
    const PictureSize size = m_window.size();
    const PictureSize pixels = m_window.framebufferSize();
    if (!(point.x >= 0 && point.x < size.width && point.y >= 0 && point.y < size.height))
    {
        return std::nullopt;
    }
    const glm::uvec2 pixel(point.x * pixels.width / size.width, point.y * pixels.height / size.height);
    return glm::min(pixel, glm::uvec2(pixels.width - 1, pixels.height - 1));
}

App::FrameLooks App::takeLooks()
{
    std::vector<glm::uvec2> pixels;
    const auto place = [&](const glm::dvec2& point) -> std::optional<std::size_t>
    {
        const std::optional<glm::uvec2> pixel = pixelAt(point);
        if (!pixel)
        {
            return std::nullopt;
        }
        pixels.push_back(*pixel);
        return pixels.size() - 1;
    };
    FrameLooks looks;
    if (m_mouse && (m_panels.shows_panels || m_editor.hasButton()))
    {
        looks.inspected = place({m_mouse->x, m_mouse->y});
        looks.inspected_pixel = looks.inspected ? pixels.front() : glm::uvec2(0U);
    }
    const EditorLooks wanted = m_editor.takeLooks();
    if (wanted.pick)
    {
        looks.picked = place(wanted.pick->at);
        looks.pick = wanted.pick->action;
    }
    if (std::exchange(m_wants_focus, false) && m_mouse)
    {
        looks.focus = place({m_mouse->x, m_mouse->y});
    }
    for (const glm::dvec2& point : wanted.stroke)
    {
        looks.stroke.push_back(place(point));
    }
    if (!pixels.empty())
    {
        looks.probe = std::make_unique<PixelProbe>(m_device.device(), std::move(pixels));
    }
    return looks;
}

// Once the device is done with the frame.
void App::answer(const FrameLooks& looks)
{
    const std::span<const gpu::PixelReport> reports =
        looks.probe != nullptr ? looks.probe->reports() : std::span<const gpu::PixelReport>();
    if (looks.inspected)
    {
        m_inspected = {looks.inspected_pixel, reports[*looks.inspected]};
    }
    if (looks.focus)
    {
        focusOn(reports[*looks.focus]);
    }
    std::vector<gpu::PixelReport> stroke;
    for (const std::optional<std::size_t>& place : looks.stroke)
    {
        stroke.push_back(place ? reports[*place] : gpu::PixelReport{});
    }
    if (looks.picked)
    {
        m_editor.found(looks.pick, reports[*looks.picked], *m_world);
    }
    m_editor.found(stroke, *m_world);
    noteIdleStrokes();
}

// Strokes that change nothing are no entries of the history; the user is told why.
void App::noteIdleStrokes()
{
    const bool has_changed_nothing = m_world->scene.dropUnchangedStrokes() != 0;
    if (m_editor.takeMissed() || (has_changed_nothing && m_editor.wasOutside()))
    {
        note(m_world->isVoxelized()
                 ? "the grid ends there; a margin (--margin, or in the build panel) is room to build in"
                 : "the grid ends there");
    }
    else if (has_changed_nothing)
    {
        note(m_editor.state.action == BrushAction::Fill ? "nothing to fill there: there are voxels already"
                                                        : "the stroke has changed nothing");
    }
}

} // namespace zvo::demo
