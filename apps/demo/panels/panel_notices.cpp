// SPDX-License-Identifier: MIT
#include "demo/panels/panels.h"

#include <imgui.h>

namespace zvo::demo
{

void noticesPanel(const Notices& notices)
{
    if (notices.all().empty())
    {
        return;
    }
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    constexpr float kMargin = 10;
    ImGui::SetNextWindowPos({kMargin, display.y - kMargin}, ImGuiCond_Always, {0.0F, 1.0F});
    ImGui::SetNextWindowSize({display.x - 2 * kMargin, 0.0F});
    ImGui::SetNextWindowBgAlpha(0.75F);
    constexpr ImGuiWindowFlags kFlags = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoInputs |
                                        ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoFocusOnAppearing |
                                        ImGuiWindowFlags_NoNav;
    if (ImGui::Begin("notices", nullptr, kFlags))
    {
        for (const Notices::Notice& notice : notices.all())
        {
            ImGui::PushTextWrapPos(0.0F);
            ImGui::TextUnformatted(notice.text.c_str());
            ImGui::PopTextWrapPos();
        }
    }
    ImGui::End();
}

} // namespace zvo::demo
