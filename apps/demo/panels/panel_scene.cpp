// SPDX-License-Identifier: MIT
#include "common/report.h"
#include "demo/panels/panel_text.h"
#include "demo/panels/panels.h"

#include <fmt/format.h>
#include <imgui.h>

namespace zvo::demo
{

namespace
{

void motionControls(const LiveScene& scene, Timeline& timeline)
{
    const UpdateReport& update = scene.info().update;
    tell(fmt::format("{} moving: {} voxels", scene.animated().objects.size(), update.dynamic_count));
    tell(fmt::format("overlay of {} nodes", update.node_count));
    if (ImGui::Button(timeline.plays() ? "stop" : "play"))
    {
        timeline.play(!timeline.plays());
    }
    ImGui::SameLine();
    if (ImGui::Button("step"))
    {
        timeline.nextFrame(scene.animated());
    }
    auto speed = static_cast<float>(timeline.speed());
    if (ImGui::SliderFloat("speed", &speed, 0.0F, 4.0F, "%.2f", ImGuiSliderFlags_AlwaysClamp))
    {
        timeline.setSpeed(double{speed});
    }
    auto seconds = static_cast<float>(timeline.secondsIn(scene.animated()));
    if (ImGui::SliderFloat("time", &seconds, 0.0F, static_cast<float>(scene.animated().seconds), "%.2f s",
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
    const LiveScene& scene = world.scene;
    const StaticInfo& info = scene.info().fixed;
    if (world.name.empty())
    {
        tell("drop a file onto the window");
        return;
    }
    tell(world.name);
    tell(fmt::format("{} of {}^3", scene.tree().isDag() ? "DAG" : "octree", scene.tree().grid.resolution()));
    tell(fmt::format("{} voxels, {} nodes", info.voxel_count, info.node_count));
    if (info.voxel_count != 0)
    {
        const auto voxels = static_cast<double>(info.voxel_count);
        tell(fmt::format("bytes a voxel: {:.2f} + {:.2f}", static_cast<double>(info.geometry_bytes) / voxels,
                         static_cast<double>(info.attribute_bytes) / voxels));
    }
    if (world.isVoxelized())
    {
        tell(fmt::format("{} triangles, in {:.0f} ms", info.triangle_count,
                         cli::sumMs(info.passes) + cli::sumMs(info.compress_passes)));
    }
    if (scene.moves())
    {
        motionControls(scene, timeline);
    }
    if (!scene.trouble().empty())
    {
        ImGui::TextWrapped("%s", scene.trouble().c_str());
    }
}

} // namespace zvo::demo
