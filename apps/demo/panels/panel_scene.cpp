// SPDX-License-Identifier: MIT
#include "demo/panels/panel_text.h"
#include "demo/panels/panels.h"

#include <fmt/format.h>
#include <imgui.h>

namespace zvo::demo
{

namespace
{

void motionControls(const World& world, Timeline& timeline)
{
    const WorldInfo& info = world.info();
    tell(fmt::format("{} moving: {} voxels, overlay of {} nodes", info.mover_count, info.update.dynamic_count,
                     info.update.node_count));
    if (ImGui::Button(timeline.plays() ? "stop" : "play"))
    {
        timeline.play(!timeline.plays());
    }
    ImGui::SameLine();
    if (ImGui::Button("step"))
    {
        timeline.step(world.stage());
    }
    auto speed = static_cast<float>(timeline.speed());
    if (ImGui::SliderFloat("speed", &speed, 0.0F, 4.0F, "%.2f", ImGuiSliderFlags_AlwaysClamp))
    {
        timeline.setSpeed(double{speed});
    }
    auto seconds = static_cast<float>(timeline.secondsIn(world.stage()));
    if (ImGui::SliderFloat("time", &seconds, 0.0F, static_cast<float>(world.stage().seconds), "%.2f s",
                           ImGuiSliderFlags_AlwaysClamp))
    {
        timeline.start(double{seconds});
    }
}

} // namespace

void scenePanel(const World& world, Timeline& timeline)
{
    if (!ImGui::CollapsingHeader("Scene", ImGuiTreeNodeFlags_DefaultOpen))
    {
        return;
    }
    const WorldInfo& info = world.info();
    if (info.name.empty())
    {
        tell("drop a file onto the window");
        return;
    }
    tell(fmt::format("{}: {} of {}^3", info.name, structureName(info.structure), info.grid.resolution()));
    tell(fmt::format("{} voxels, {} nodes", info.static_voxel_count, info.static_node_count));
    if (info.static_voxel_count != 0)
    {
        const auto voxels = static_cast<double>(info.static_voxel_count);
        tell(fmt::format("bytes a voxel: geometry {:.2f}, attributes {:.2f}",
                         static_cast<double>(info.geometry_bytes) / voxels,
                         static_cast<double>(info.attribute_bytes) / voxels));
    }
    if (info.build_ms > 0)
    {
        tell(fmt::format("{} triangles, voxelized and built in {:.0f} ms", info.static_triangle_count, info.build_ms));
    }
    if (world.moves())
    {
        motionControls(world, timeline);
    }
    if (!world.trouble().empty())
    {
        ImGui::TextWrapped("%s", world.trouble().c_str());
    }
}

} // namespace zvo::demo
