// SPDX-License-Identifier: MIT
#include "demo/panels/panel_text.h"
#include "demo/panels/panels.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <string_view>

namespace zvo::demo
{

namespace
{

constexpr std::array<const char*, 3> kToolNames = {"camera", "brush", "move"};
constexpr std::array<const char*, 3> kActionNames = {"carve", "fill", "paint"};
constexpr std::array<const char*, 2> kShapeNames = {"sphere", "box"};

// Radio buttons for choices, side by side.
template <typename Choice, std::size_t count> void choose(Choice& choice, const std::array<const char*, count>& names)
{
    for (std::size_t i = 0; i < count; ++i)
    {
        if (i != 0)
        {
            ImGui::SameLine();
        }
        if (ImGui::RadioButton(names[i], choice == static_cast<Choice>(i)))
        {
            choice = static_cast<Choice>(i);
        }
    }
}

bool button(const char* label, bool is_enabled)
{
    ImGui::BeginDisabled(!is_enabled);
    const bool is_pressed = ImGui::Button(label);
    ImGui::EndDisabled();
    return is_pressed && is_enabled;
}

} // namespace

ToolsAnswer toolsPanel(ToolState& state, const World& world)
{
    ToolsAnswer answer;
    if (!ImGui::CollapsingHeader("Tools", ImGuiTreeNodeFlags_DefaultOpen))
    {
        return answer;
    }
    choose(state.tool, kToolNames);
    const Edits* const edits = world.scene.edits();
    if (edits == nullptr)
    {
        tell(world.name.empty() ? "nothing to edit" : "packed attributes: nothing can be edited");
        return answer;
    }
    if (state.tool == Tool::Brush)
    {
        choose(state.action, kActionNames);
        choose(state.shape, kShapeNames);
        ImGui::SliderInt("radius", &state.radius, 0, static_cast<int>(gpu::kBrushRadiusMax), "%d voxels",
                         ImGuiSliderFlags_AlwaysClamp);
        if (state.action != BrushAction::Carve)
        {
            ImGui::ColorEdit3("colour", state.color.data());
            ImGui::SliderFloat("emission", &state.emission, 0.0F, ToolState::kEmissionMax, "%.2f",
                               ImGuiSliderFlags_Logarithmic | ImGuiSliderFlags_AlwaysClamp);
        }
    }
    answer.undoes = button("undo", edits->undoCount() != 0);
    ImGui::SameLine();
    answer.redoes = button("redo", edits->redoCount() != 0);
    ImGui::SameLine();
    answer.saves = ImGui::Button("save");
    tell(fmt::format("strokes: {} to undo, {} to redo, {:.1f} MiB", edits->undoCount(), edits->redoCount(),
                     static_cast<double>(edits->heldBytes()) / (1 << 20)));
    return answer;
}

} // namespace zvo::demo
