// SPDX-License-Identifier: MIT
#include "demo/panels/panels.h"

#include <fmt/format.h>
#include <imgui.h>

#include <array>

namespace zvo::demo
{

namespace
{

constexpr std::uint32_t kDepthMin = 5;
constexpr std::uint32_t kDepthMax = 12;
constexpr std::array<const char*, 2> kStructureNames = {"octree", "DAG"};
constexpr std::array<const char*, 2> kCoverageNames = {"thin", "conservative"};
constexpr std::array<const char*, 4> kFillNames = {"nothing", "solid", "parity (even-odd)",
                                                   "robust (holes)"}; // by Fill

// 0 is none, as a scene file's own grid is used then.
void setMargin(cli::VoxelOptions& options, std::uint32_t margin)
{
    options.margin = margin != 0 ? std::optional(margin) : std::nullopt;
}

// The margin stays the same part of the grid.
bool chooseResolution(WorldOptions& options, std::uint32_t depth)
{
    bool is_chosen = false;
    if (ImGui::BeginCombo("voxels an edge", fmt::format("{}", 1U << depth).c_str()))
    {
        for (std::uint32_t choice = kDepthMin; choice <= kDepthMax; ++choice)
        {
            if (ImGui::Selectable(fmt::format("{}", 1U << choice).c_str(), choice == depth) && choice != depth)
            {
                options.voxels.depth = choice;
                setMargin(options.voxels, (options.voxels.margin.value_or(0) << choice) >> depth);
                is_chosen = true;
            }
        }
        ImGui::EndCombo();
    }
    return is_chosen;
}

bool chooseMargin(WorldOptions& options, std::uint32_t resolution)
{
    const std::uint32_t margin = options.voxels.margin.value_or(0);
    bool is_chosen = false;
    if (ImGui::BeginCombo("margin", fmt::format("{} voxels", margin).c_str()))
    {
        for (const std::uint32_t part : {0U, 32U, 16U, 8U, 4U}) // of the resolution
        {
            const std::uint32_t choice = part == 0 ? 0 : resolution / part;
            if (ImGui::Selectable(fmt::format("{} voxels", choice).c_str(), choice == margin) && choice != margin)
            {
                setMargin(options.voxels, choice);
                options.voxels.bounds.reset();
                options.voxels.grid_position.reset();
                is_chosen = true;
            }
        }
        ImGui::EndCombo();
    }
    return is_chosen;
}

template <std::size_t count>
bool chooseOne(const char* label, const std::array<const char*, count>& names, std::size_t& current)
{
    auto index = static_cast<int>(current);
    const bool is_chosen = ImGui::Combo(label, &index, names.data(), static_cast<int>(count)) &&
                           static_cast<std::size_t>(index) != current;
    current = static_cast<std::size_t>(index);
    return is_chosen;
}

} // namespace

void loadingPanel(const WorldOptions& options, const Loading& loading)
{
    const ImVec2 middle = {ImGui::GetIO().DisplaySize.x * 0.5F, ImGui::GetIO().DisplaySize.y * 0.5F};
    ImGui::SetNextWindowPos(middle, ImGuiCond_Always, {0.5F, 0.5F});
    constexpr ImGuiWindowFlags kFlags = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_AlwaysAutoResize |
                                        ImGuiWindowFlags_NoInputs | ImGuiWindowFlags_NoSavedSettings |
                                        ImGuiWindowFlags_NoNav;
    if (ImGui::Begin("loading", nullptr, kFlags))
    {
        ImGui::TextUnformatted(options.voxels.scenes.front().filename().string().c_str());
        ImGui::ProgressBar(static_cast<float>(loading.done()), {ImGui::GetFontSize() * 24, 0},
                           loading.operation().c_str());
    }
    ImGui::End();
}

BuildAnswer buildPanel(const WorldOptions& options, const World& world, const Loading* loading)
{
    BuildAnswer answer;
    if (loading != nullptr)
    {
        ImGui::ProgressBar(static_cast<float>(loading->done()), {ImGui::GetFontSize() * 16, 0},
                           loading->operation().c_str());
        ImGui::SameLine();
        answer.cancels = ImGui::Button("cancel");
        return answer;
    }
    if (!world.isVoxelized() || !ImGui::CollapsingHeader("Build"))
    {
        return answer;
    }
    WorldOptions wanted = options;
    bool is_chosen = chooseResolution(wanted, world.scene.tree().grid.depth);
    is_chosen = chooseMargin(wanted, world.scene.tree().grid.resolution()) || is_chosen;
    std::size_t coverage = options.voxels.coverage == Coverage::Thin ? 0 : 1;
    if (chooseOne("coverage", kCoverageNames, coverage))
    {
        wanted.voxels.coverage = coverage == 0 ? Coverage::Thin : Coverage::Conservative;
        is_chosen = true;
    }
    auto fill = static_cast<std::size_t>(options.voxels.fill);
    if (chooseOne("filled", kFillNames, fill))
    {
        wanted.voxels.fill = static_cast<Fill>(fill);
        wanted.structure = TreeStructure::Svo;
        is_chosen = true;
    }
    std::size_t structure = world.scene.tree().isDag() ? 1 : 0;
    if (chooseOne("structure", kStructureNames, structure))
    {
        wanted.structure = structure == 0 ? TreeStructure::Svo : TreeStructure::Svdag;
        wanted.voxels.fill = structure == 0 ? wanted.voxels.fill : Fill::None;
        is_chosen = true;
    }
    if (is_chosen)
    {
        answer.rebuild = std::move(wanted);
    }
    return answer;
}

} // namespace zvo::demo
