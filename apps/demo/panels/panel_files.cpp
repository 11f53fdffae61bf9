// SPDX-License-Identifier: MIT
#include "demo/panels/panel_files.h"

#include <imgui.h>

#include <string>

namespace zvo::demo
{

namespace
{

constexpr const char* kQuestion = "Strokes are not saved";

std::string nameOf(const Files& files)
{
    const std::string first = files.empty() ? "" : files.front().filename().string();
    return files.size() > 1 ? first + ", ..." : first;
}

} // namespace

FilesAnswer filesPanel(const std::vector<Files>& recent)
{
    FilesAnswer answer;
    answer.opens = ImGui::Button("open...");
    ImGui::SameLine();
    answer.saves_as = ImGui::Button("save as...");
    ImGui::SameLine();
    ImGui::BeginDisabled(recent.empty());
    if (ImGui::Button("recent"))
    {
        ImGui::OpenPopup("recent files");
    }
    ImGui::EndDisabled();
    if (ImGui::BeginPopup("recent files"))
    {
        for (std::size_t i = 0; i < recent.size(); ++i)
        {
            ImGui::PushID(static_cast<int>(i));
            if (ImGui::Selectable(nameOf(recent[i]).c_str()))
            {
                answer.recent = recent[i];
            }
            if (ImGui::IsItemHovered())
            {
                ImGui::SetTooltip("%s", recent[i].front().parent_path().c_str());
            }
            ImGui::PopID();
        }
        ImGui::EndPopup();
    }
    return answer;
}

std::optional<LossAnswer> lossQuestion()
{
    if (!ImGui::IsPopupOpen(kQuestion))
    {
        ImGui::OpenPopup(kQuestion);
    }
    const ImVec2 middle = {ImGui::GetIO().DisplaySize.x * 0.5F, ImGui::GetIO().DisplaySize.y * 0.5F};
    ImGui::SetNextWindowPos(middle, ImGuiCond_Always, {0.5F, 0.5F});
    std::optional<LossAnswer> answer;
    if (ImGui::BeginPopupModal(kQuestion, nullptr, ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoMove))
    {
        ImGui::TextUnformatted("What the brush has changed will be lost.");
        if (ImGui::Button("save"))
        {
            answer = LossAnswer::Save;
        }
        ImGui::SameLine();
        if (ImGui::Button("discard"))
        {
            answer = LossAnswer::Discard;
        }
        ImGui::SameLine();
        if (ImGui::Button("cancel") || ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape)))
        {
            answer = LossAnswer::Cancel;
        }
        if (answer)
        {
            ImGui::CloseCurrentPopup();
        }
        ImGui::EndPopup();
    }
    return answer;
}

} // namespace zvo::demo
