// SPDX-License-Identifier: MIT
#include "demo/input/keys.h"
#include "demo/panels/panels.h"

#include <imgui.h>

namespace zvo::demo
{

void keysPanel(bool& is_open)
{
    if (!is_open)
    {
        return;
    }
    const ImVec2 middle = {ImGui::GetIO().DisplaySize.x * 0.5F, ImGui::GetIO().DisplaySize.y * 0.5F};
    ImGui::SetNextWindowPos(middle, ImGuiCond_Appearing, {0.5F, 0.5F});
    if (ImGui::Begin("Keys", &is_open, ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoCollapse) &&
        ImGui::BeginTable("keys", 2, ImGuiTableFlags_RowBg | ImGuiTableFlags_SizingFixedFit))
    {
        for (const KeyBinding& binding : kKeyBindings)
        {
            ImGui::TableNextRow();
            ImGui::TableNextColumn();
            ImGui::TextUnformatted(binding.keys.data(), binding.keys.data() + binding.keys.size());
            ImGui::TableNextColumn();
            ImGui::TextUnformatted(binding.what.data(), binding.what.data() + binding.what.size());
        }
        ImGui::EndTable();
    }
    ImGui::End();
}

} // namespace zvo::demo
