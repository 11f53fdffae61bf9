// SPDX-License-Identifier: MIT
#include "demo/app/view_controls.h"

#include "common/names.h"
#include "core/scene/sky.h"
#include "demo/input/sun_control.h"
#include "demo/panels/panel_text.h"
#include "demo/world/resolution_ladder.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

namespace zvo::demo
{

namespace
{

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

void showView(ViewState& view, const ViewInfo&)
{
    View& shown = view.frame.trace.view;
    if (ImGui::BeginCombo("view", std::string(cli::nameOf(cli::kViews, shown)).c_str()))
    {
        for (const cli::Named<View>& named : cli::kViews)
        {
            if (ImGui::Selectable(std::string(named.name).c_str(), named.value == shown))
            {
                shown = named.value;
            }
        }
        ImGui::EndCombo();
    }
    if (shown == View::Iterations)
    {
        iterationsLegend();
    }
}

void showIntegrator(ViewState& view, const ViewInfo& info)
{
    constexpr std::array kNames = {"primary rays", "paths", "radiance cache", "through cones"};
    int chosen = static_cast<int>(view.frame.integrator);
    if (ImGui::Combo("light", &chosen, kNames.data(), static_cast<int>(kNames.size())))
    {
        view.frame.integrator = static_cast<Integrator>(chosen);
    }
    if (info.samples)
    {
        tell(fmt::format("{} {} a pixel", *info.samples,
                         view.frame.integrator == Integrator::Path ? "paths" : "samples"));
    }
    if (info.cache_frames)
    {
        tell(fmt::format("light of {} frames", *info.cache_frames));
    }
}

void showShading(ViewState& view, const ViewInfo&)
{
    constexpr std::array kNames = {"smooth", "by faces"};
    int chosen = static_cast<int>(view.frame.shading);
    if (ImGui::Combo("shading", &chosen, kNames.data(), static_cast<int>(kNames.size())))
    {
        view.frame.shading = static_cast<Shading>(chosen);
    }
}

void showDenoise(ViewState& view, const ViewInfo&)
{
    ImGui::Checkbox("denoise", &view.frame.denoise);
}

void showShadows(ViewState& view, const ViewInfo& info)
{
    if (info.has_map && view.frame.integrator != Integrator::Primary)
    {
        ImGui::Checkbox("sun", &view.map_sun);
        return;
    }
    ImGui::Checkbox(view.frame.integrator == Integrator::Primary ? "shadows" : "sun", &view.frame.trace.shadows);
}

void showOcclusion(ViewState& view, const ViewInfo&)
{
    int rays = static_cast<int>(view.frame.trace.occlusion_rays);
    if (ImGui::SliderInt("sky rays", &rays, 0, static_cast<int>(kOcclusionRaysMax), "%d", ImGuiSliderFlags_AlwaysClamp))
    {
        view.frame.trace.occlusion_rays = static_cast<std::uint32_t>(rays);
    }
}

void showSun(ViewState& view, const ViewInfo&)
{
    auto hour = static_cast<float>(hourOfSun(view.frame.trace.to_sun));
    const int minutes = static_cast<int>(std::lround(60 * hour)) % (24 * 60);
    const std::string clock = fmt::format("{}:{:02}", minutes / 60, minutes % 60);
    if (ImGui::SliderFloat("time of day", &hour, 0.0F, 24.0F, clock.c_str(), ImGuiSliderFlags_AlwaysClamp))
    {
        view.frame.trace.to_sun = sunAtHour(hour);
    }
    const SunAngles before = sunAngles(view.frame.trace.to_sun);
    auto azimuth = static_cast<float>(before.azimuth);
    auto elevation = static_cast<float>(before.elevation);
    bool is_moved = ImGui::SliderFloat("sun azimuth", &azimuth, 0.0F, 360.0F, "%.0f deg", ImGuiSliderFlags_AlwaysClamp);
    is_moved |= ImGui::SliderFloat("sun height", &elevation, -89.0F, 89.0F, "%.0f deg", ImGuiSliderFlags_AlwaysClamp);
    if (is_moved)
    {
        view.frame.trace.to_sun = toSun({azimuth, elevation});
    }
}

void showBounces(ViewState& view, const ViewInfo&)
{
    constexpr int kUsefulMost = 32;
    int bounces = static_cast<int>(view.frame.path.bounces);
    if (ImGui::SliderInt("bounces", &bounces, 0, kUsefulMost, "%d", ImGuiSliderFlags_AlwaysClamp))
    {
        view.frame.path.bounces = static_cast<std::uint32_t>(bounces);
    }
}

void showAperture(ViewState& view, const ViewInfo&)
{
    PathOptions& path = view.frame.path;
    // At the far end, what is twice as far away as the focus has a blur of a twentieth of its distance.
    ImGui::SliderFloat("aperture", &path.lens_radius, 0.0F, 0.1F * path.focus_distance, "%.3g",
                       ImGuiSliderFlags_AlwaysClamp | ImGuiSliderFlags_NoRoundToFormat);
}

void showFocus(ViewState& view, const ViewInfo&)
{
    PathOptions& path = view.frame.path;
    ImGui::DragFloat("focus (G)", &path.focus_distance, 0.005F * path.focus_distance, 1e-4F, 1e6F, "%.3g");
}

void showExposure(ViewState& view, const ViewInfo&)
{
    ImGui::SliderFloat("exposure", &view.frame.exposure.factor, 0.05F, 20.0F, "%.2f",
                       ImGuiSliderFlags_Logarithmic | ImGuiSliderFlags_AlwaysClamp);
}

void showDetail(ViewState& view, const ViewInfo&)
{
    ImGui::SliderFloat("detail", &view.frame.trace.detail_pixels, 0.0F, 16.0F, "%.1f pixels",
                       ImGuiSliderFlags_AlwaysClamp);
}

void showResolution(ViewState& view, const ViewInfo& info)
{
    const std::string current = view.internal_scale ? fmt::format("{:g}", *view.internal_scale)
                                                    : fmt::format("auto ({:g})", info.internal_scale);
    if (ImGui::BeginCombo("resolution", current.c_str()))
    {
        if (ImGui::Selectable("auto", !view.internal_scale))
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

void showPresentMode(ViewState& view, const ViewInfo& info)
{
    constexpr std::array kNames = {"fifo (vsync)", "mailbox", "immediate"};
    int chosen = static_cast<int>(view.present_mode);
    if (ImGui::Combo("present", &chosen, kNames.data(), static_cast<int>(kNames.size())))
    {
        view.present_mode = static_cast<vk::PresentMode>(chosen);
    }
    if (info.mode != view.present_mode)
    {
        ImGui::SameLine();
        tell("(fifo: the window has no other)");
    }
}

} // namespace zvo::demo
