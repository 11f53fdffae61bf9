// SPDX-License-Identifier: MIT
// App: the panels of a frame, and what the user asks for in them.
#include "demo/app/app.h"

#include <imgui.h>

namespace zvo::demo
{

namespace
{

// Begins a window of panels at the left or right edge, of at most about half the width. ImGui::End() ends it, whether
// or not it is open.
bool beginPanels(const char* title, bool is_right)
{
    const float margin = 0.7F * ImGui::GetFontSize();
    const ImVec2 size = ImGui::GetMainViewport()->WorkSize;
    ImGui::SetNextWindowPos({is_right ? size.x - margin : margin, margin}, ImGuiCond_Always,
                            {is_right ? 1.0F : 0.0F, 0.0F});
    ImGui::SetNextWindowSizeConstraints({0, 0}, {0.5F * size.x - margin, size.y - 2 * margin});
    ImGui::SetNextWindowBgAlpha(0.85F);
    const bool is_open = ImGui::Begin(title, nullptr, ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoMove);
    ImGui::PushItemWidth(9 * ImGui::GetFontSize());
    return is_open;
}

void endPanels()
{
    ImGui::PopItemWidth();
    ImGui::End();
}

} // namespace

void App::buildPanels()
{
    const PictureSize size = m_window.size();
    if (size.width == 0 || size.height == 0)
    {
        return;
    }
    m_ui.build(size, m_window.framebufferSize(), m_frame_seconds,
               [this]
               {
                   if (m_is_first_world)
                   {
                       m_has_overlay = true;
                       return loadingPanel(m_world_options, *m_loading);
                   }
                   m_has_overlay = drawOverlay();
                   if (!m_panels.shows_panels)
                   {
                       return;
                   }
                   constexpr float kLinesMin = 30; // of a window that has room for open panels
                   ImGui::SetNextWindowCollapsed(ImGui::GetIO().DisplaySize.y < kLinesMin * ImGui::GetFontSize(),
                                                 ImGuiCond_Once);
                   if (beginPanels("zvo", false))
                   {
                       scenePanel(*m_world, m_timeline);
                       filesPanel();
                       buildPanel();
                       toolsPanel();
                       viewPanel(m_view, {internalScale(), m_swapchain.mode(), m_camera.speed(), shownSamples(),
                                          m_renderer.cacheFrames(), m_has_map});
                       cameraPanel(m_camera);
                       ImGui::TextUnformatted("F1: keys");
                   }
                   endPanels();
                   ImGui::SetNextWindowCollapsed(true, ImGuiCond_Once);
                   if (beginPanels("measurements", true))
                   {
                       performancePanel(m_stats, memoryUse());
                       inspectorPanel(m_inspected, m_world->scene.tree().grid);
                   }
                   endPanels();
                   shadersPanel(m_shader_message);
                   keysPanel(m_panels.shows_keys);
                   noticesPanel(m_notices);
               });
    m_swapchain.setMode(m_view.present_mode);
}

void App::buildPanel()
{
    BuildAnswer answer = demo::buildPanel(m_world_options, *m_world, m_loading.get());
    if (answer.cancels)
    {
        m_loads_next.reset();
        m_loading->cancel();
    }
    if (answer.rebuild)
    {
        loseStrokes([this, options = *answer.rebuild] { beginLoading(options); });
    }
}

void App::toolsPanel()
{
    const ToolsAnswer answer = demo::toolsPanel(m_editor.state, *m_world);
    if (answer.undoes)
    {
        request(UndoStroke{});
    }
    if (answer.redoes)
    {
        request(RedoStroke{});
    }
    if (answer.saves)
    {
        whenFree([this] { save(); });
    }
}

// Of each pixel of the picture, where it has several.
std::optional<std::uint32_t> App::shownSamples() const
{
    const bool has_samples = m_is_refined ? m_refined.options.hasSamples() : m_view.frame.hasSamples();
    return has_samples ? std::optional(m_renderer.sampleCount()) : std::nullopt;
}

} // namespace zvo::demo
