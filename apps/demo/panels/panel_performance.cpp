// SPDX-License-Identifier: MIT
#include "demo/panels/panel_text.h"
#include "demo/panels/panels.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cfloat>

namespace zvo::demo
{

namespace
{

constexpr double kMiB = 1 << 20;

// A row of the table, for an operation, which can be opened, or for a pass. Returns whether it is open.
bool timeRow(const std::string& name, const History& history, bool is_operation)
{
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    const ImGuiTreeNodeFlags leaf = ImGuiTreeNodeFlags_Leaf | ImGuiTreeNodeFlags_NoTreePushOnOpen;
    const bool is_open = ImGui::TreeNodeEx(name.c_str(), is_operation ? ImGuiTreeNodeFlags_None : leaf);
    ImGui::TableNextColumn();
    tell(fmt::format("{:.2f}", history.mean()));
    ImGui::TableNextColumn();
    tell(fmt::format("{:.2f}", history.p95()));
    ImGui::TableNextColumn();
    ImGui::PushID(name.c_str());
    ImGui::PlotLines("##curve", history.values().data(), static_cast<int>(history.values().size()), 0, nullptr, 0.0F,
                     FLT_MAX, {ImGui::GetFontSize() * 6, ImGui::GetTextLineHeight()});
    ImGui::PopID();
    return is_open && is_operation;
}

// The passes of an operation.
void passRows(const FrameStats& stats, const std::string& operation)
{
    for (const std::string& name : stats.names())
    {
        if (operationOf(name) == operation)
        {
            timeRow(name, stats.pass(name), false);
        }
    }
}

} // namespace

void performancePanel(const FrameStats& stats, const MemoryUse& memory)
{
    if (!ImGui::CollapsingHeader("Performance", ImGuiTreeNodeFlags_DefaultOpen))
    {
        return;
    }
    tell(stats.frameMs().values().empty()
             ? std::string("the picture stands still")
             : fmt::format("{:.1f} frames/s, {:.1f} ms (95 %: {:.1f} ms)", stats.framesPerSecond(),
                           stats.frameMs().mean(), stats.frameMs().p95()));
    tell(fmt::format("{:.1f} Mrays/s {}", stats.megaraysPerSecond(),
                     stats.integrator() == Integrator::Path ? "of paths" : "primary"));
    const auto mib = [](std::uint64_t bytes) { return static_cast<double>(bytes) / kMiB; };
    tell(fmt::format("memory, MiB: {:.1f} used of {:.1f}", mib(memory.used), mib(memory.held)));
    const std::uint64_t known = memory.geometry + memory.attributes + memory.pictures;
    tell(fmt::format("geometry {:.1f}, attributes {:.1f}", mib(memory.geometry), mib(memory.attributes)));
    tell(fmt::format("pictures {:.1f}, other {:.1f}", mib(memory.pictures),
                     mib(memory.used - std::min(known, memory.used))));
    if (ImGui::BeginTable("passes", 4, ImGuiTableFlags_RowBg | ImGuiTableFlags_SizingFixedFit))
    {
        ImGui::TableSetupColumn("pass");
        ImGui::TableSetupColumn("mean ms");
        ImGui::TableSetupColumn("95 %");
        ImGui::TableSetupColumn("last frames");
        ImGui::TableHeadersRow();
        timeRow("device, all", stats.gpuMs(), false);
        for (const std::string& operation : stats.operations())
        {
            if (timeRow(operation, stats.operation(operation), true))
            {
                passRows(stats, operation);
                ImGui::TreePop();
            }
        }
        ImGui::EndTable();
    }
}

} // namespace zvo::demo
