// SPDX-License-Identifier: MIT
#include "demo/panels/panels.h"

#include <imgui.h>

namespace zvo::demo
{

void shadersPanel(std::string& message)
{
    if (message.empty())
    {
        return;
    }
    bool is_open = true;
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({display.x * 0.5F, display.y * 0.5F}, ImGuiCond_Appearing, {0.5F, 0.5F});
    ImGui::SetNextWindowSize({display.x * 0.75F, 0.0F}, ImGuiCond_Appearing);
    if (ImGui::Begin("Shaders that do not compile: the old ones go on", &is_open))
    {
        ImGui::TextWrapped("%s", message.c_str());
    }
    ImGui::End();
    if (!is_open)
    {
        message.clear();
    }
}

} // namespace zvo::demo
