// SPDX-License-Identifier: MIT
#include "common/view.h"
#include "demo/panels/panel_text.h"
#include "demo/panels/panels.h"
#include "demo/world/resolution_ladder.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <string>

namespace zvo::demo
{

namespace
{

constexpr std::array kModes = {vk::PresentMode::Fifo, vk::PresentMode::Mailbox, vk::PresentMode::Immediate};
constexpr std::array kModeNames = {"fifo (vsync)", "mailbox", "immediate"};

void viewChoice(FrameOptions& frame)
{
    const auto views = cli::allViews();
    const auto current = std::ranges::find(views, frame.trace.view, &cli::NamedView::view);
    if (ImGui::BeginCombo("view", std::string(current->name).c_str()))
    {
        for (const cli::NamedView& named : views)
        {
            if (ImGui::Selectable(std::string(named.name).c_str(), named.view == frame.trace.view))
            {
                frame.trace.view = named.view;
            }
        }
        ImGui::EndCombo();
    }
}

void integratorChoice(FrameOptions& frame)
{
    constexpr std::array kNames = {"primary rays", "paths", "kept on voxels", "through cones"};
    int chosen = static_cast<int>(frame.integrator);
    if (ImGui::Combo("light", &chosen, kNames.data(), static_cast<int>(kNames.size())))
    {
        frame.integrator = static_cast<Integrator>(chosen);
    }
}

void resolutionChoice(ViewState& view, const ViewInfo& info)
{
    const std::string current = view.internal_scale ? fmt::format("{:g}", *view.internal_scale)
                                                    : fmt::format("automatic ({:g})", info.internal_scale);
    if (ImGui::BeginCombo("resolution", current.c_str()))
    {
        if (ImGui::Selectable("automatic", !view.internal_scale))
        {
            view.internal_scale.reset();
        }
        for (const double scale : ResolutionLadder::kScales)
        {
            if (ImGui::Selectable(fmt::format("{:g}", scale).c_str(), view.internal_scale == scale))
            {
                view.internal_scale = scale;
            }
        }
        ImGui::EndCombo();
    }
}

void presentChoice(ViewState& view, const ViewInfo& info)
{
    int chosen = static_cast<int>(view.present_mode);
    if (ImGui::Combo("present", &chosen, kModeNames.data(), static_cast<int>(kModeNames.size())))
    {
        view.present_mode = kModes[static_cast<std::size_t>(chosen)];
    }
    if (info.mode != view.present_mode)
    {
        ImGui::SameLine();
        tell("(fifo: the window has no other)");
    }
}

// A legend of the colours of the iterations view (trace/views.comp).
void iterationsLegend()
{
    constexpr std::array kCounts = {1, 3, 7, 15, 31, 63, 127};
    const auto heat = [](float x)
    {
        const float blue = x < 0.5F ? 4 * x * (1 - x) - 2 * std::max(x - 0.25F, 0.0F) : 4 * x - 3;
        return ImVec4(std::clamp(3 * x - 0.75F, 0.0F, 1.0F), std::clamp(3 * x - 1.75F, 0.0F, 1.0F),
                      std::clamp(blue, 0.0F, 1.0F), 1.0F);
    };
    for (std::size_t i = 0; i < kCounts.size(); ++i)
    {
        if (i != 0)
        {
            ImGui::SameLine();
        }
        ImGui::ColorButton(fmt::format("{} iterations", kCounts[i]).c_str(), heat(static_cast<float>(i + 1) / 7.0F),
                           ImGuiColorEditFlags_NoAlpha | ImGuiColorEditFlags_NoInputs | ImGuiColorEditFlags_NoPicker);
        ImGui::SameLine();
        ImGui::Text("%d", kCounts[i]);
    }
}

} // namespace

void viewPanel(ViewState& view, const ViewInfo& info)
{
    if (!ImGui::CollapsingHeader("View", ImGuiTreeNodeFlags_DefaultOpen))
    {
        return;
    }
    FrameOptions& frame = view.frame;
    viewChoice(frame);
    if (frame.trace.view == View::Iterations)
    {
        iterationsLegend();
    }
    if (frame.trace.view == View::Color)
    {
        integratorChoice(frame);
        if (info.samples)
        {
            tell(fmt::format("{} paths a pixel", *info.samples));
            ImGui::Checkbox("denoise", &frame.denoise);
        }
        if (info.kept_frames)
        {
            tell(fmt::format("light of {} frames, {} faces a frame at most", *info.kept_frames, info.kept_faces));
        }
        ImGui::Checkbox(frame.integrator == Integrator::Primary ? "shadows" : "sun", &frame.trace.shadows);
        int rays = static_cast<int>(frame.trace.occlusion_rays);
        if (ImGui::SliderInt("occlusion rays", &rays, 0, static_cast<int>(kOcclusionRaysMax), "%d",
                             ImGuiSliderFlags_AlwaysClamp))
        {
            frame.trace.occlusion_rays = static_cast<std::uint32_t>(rays);
        }
        ImGui::SliderFloat("exposure", &frame.exposure.factor, 0.05F, 20.0F, "%.2f",
                           ImGuiSliderFlags_Logarithmic | ImGuiSliderFlags_AlwaysClamp);
    }
    ImGui::SliderFloat("detail, pixels", &frame.trace.detail_pixels, 0.0F, 16.0F, "%.1f", ImGuiSliderFlags_AlwaysClamp);
    resolutionChoice(view, info);
    presentChoice(view, info);
    tell(fmt::format("speed {:.3g} units/s", info.camera_speed));
}

} // namespace zvo::demo
