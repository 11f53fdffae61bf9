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

constexpr std::array<const char*, 4> kToolNames = {"camera", "brush", "move", "select"};
constexpr std::array<const char*, 3> kFormNames = {"stroke", "box", "flood"};
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

// Mirror planes across the axes, and where they are.
void chooseMirror(Mirror& mirror)
{
    constexpr std::array<const char*, 3> kAxisNames = {"x", "y", "z"};
    ImGui::TextUnformatted("mirror");
    for (std::size_t axis = 0; axis < kAxisNames.size(); ++axis)
    {
        ImGui::SameLine();
        ImGui::Checkbox(kAxisNames[axis], &mirror.axes[axis]);
    }
    if (mirror.at)
    {
        ImGui::SameLine();
        if (ImGui::Button("to the middle"))
        {
            mirror.at.reset();
        }
    }
}

void chooseBrush(ToolState& state)
{
    choose(state.form, kFormNames);
    choose(state.action, kActionNames);
    if (state.form == BrushForm::Flood)
    {
        ImGui::SliderInt("tolerance", &state.tolerance, 0, ToolState::kToleranceMax, "%d of 255",
                         ImGuiSliderFlags_AlwaysClamp);
    }
    else
    {
        ImGui::BeginDisabled(state.form == BrushForm::Box);
        choose(state.shape, kShapeNames);
        ImGui::EndDisabled();
        ImGui::SliderInt("radius", &state.radius, 0, static_cast<int>(gpu::kBrushRadiusMax), "%d voxels",
                         ImGuiSliderFlags_AlwaysClamp);
    }
    if (state.action != BrushAction::Carve)
    {
        ImGui::ColorEdit3("colour", state.color.data());
        ImGui::SliderFloat("emission", &state.emission, 0.0F, ToolState::kEmissionMax, "%.2f",
                           ImGuiSliderFlags_Logarithmic | ImGuiSliderFlags_AlwaysClamp);
    }
}

// The corners of the selected box, which can be changed.
void chooseSelection(std::optional<VoxelBox>& selection, int resolution)
{
    if (!selection)
    {
        return tell("drag over voxels to select a box");
    }
    VoxelBox box = *selection;
    const bool is_lo = ImGui::DragInt3("from", &box.lo.x, 0.2F, 0, resolution - 1, "%d", ImGuiSliderFlags_AlwaysClamp);
    const bool is_hi = ImGui::DragInt3("to", &box.hi.x, 0.2F, 0, resolution - 1, "%d", ImGuiSliderFlags_AlwaysClamp);
    if (is_lo || is_hi)
    {
        selection = VoxelBox::of(box.lo, box.hi);
    }
    const glm::ivec3 size = box.size();
    tell(fmt::format("{} x {} x {} voxels", size.x, size.y, size.z));
    tell("Shift and drag moves it");
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
        chooseBrush(state);
    }
    if (state.tool == Tool::Select)
    {
        chooseSelection(state.selection, static_cast<int>(world.scene.tree().grid.resolution()));
    }
    if (state.tool == Tool::Brush || state.tool == Tool::Select)
    {
        chooseMirror(state.mirror);
    }
    answer.undoes = button("undo", world.scene.undoCount() != 0);
    ImGui::SameLine();
    answer.redoes = button("redo", world.scene.redoCount() != 0);
    ImGui::SameLine();
    answer.saves = ImGui::Button("save");
    tell(fmt::format("edits: {} to undo, {} to redo, {:.1f} MiB", world.scene.undoCount(), world.scene.redoCount(),
                     static_cast<double>(edits->heldBytes()) / (1 << 20)));
    return answer;
}

} // namespace zvo::demo
