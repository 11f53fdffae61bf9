// SPDX-License-Identifier: MIT
#include "common/normal.h"
#include "demo/panels/panel_text.h"
#include "demo/panels/panels.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <string>

namespace zvo::demo
{

namespace
{

const char* faceName(std::uint32_t face)
{
    constexpr std::array kFaces = {"x", "y", "z", "none: the ray began inside"};
    return kFaces[std::min<std::size_t>(face, kFaces.size() - 1)];
}

} // namespace

void inspectorPanel(const std::optional<InspectedPixel>& pixel, const Grid& grid)
{
    if (!ImGui::CollapsingHeader("Pixel", ImGuiTreeNodeFlags_DefaultOpen))
    {
        return;
    }
    // The number of lines is constant, so that the panel does not jump.
    if (!pixel || pixel->report.hit == 0)
    {
        tell(pixel ? fmt::format("pixel {}, {}: nothing", pixel->position.x, pixel->position.y) : "no pixel");
        tell(pixel ? fmt::format("steps {}", pixel->report.iterations) : "");
        ImGui::NewLine();
        ImGui::NewLine();
        ImGui::NewLine();
        return;
    }
    const gpu::PixelReport& report = pixel->report;
    const std::uint32_t levels = grid.nodeLevels();
    const bool is_voxel = report.level == levels;
    tell(fmt::format("pixel {}, {}: {} {}, {}, {}", pixel->position.x, pixel->position.y, is_voxel ? "voxel" : "cell",
                     report.cell.x, report.cell.y, report.cell.z));
    tell(fmt::format("level {} of {}, steps {}, face {}", report.level, levels, report.iterations,
                     faceName(report.face)));
    tell(fmt::format("node {}, attribute {}", report.node, report.index));
    const gpu::uint color = report.look.color;
    const auto channel = [color](int shift) { return color >> shift & 255U; };
    ImGui::ColorButton("colour",
                       {static_cast<float>(channel(0)) / 255, static_cast<float>(channel(8)) / 255,
                        static_cast<float>(channel(16)) / 255, 1.0F},
                       ImGuiColorEditFlags_NoAlpha | ImGuiColorEditFlags_NoTooltip,
                       {ImGui::GetTextLineHeight(), ImGui::GetTextLineHeight()});
    ImGui::SameLine();
    tell(fmt::format("colour {}, {}, {}{}", channel(0), channel(8), channel(16),
                     (channel(24) & gpu::kAttributeEmissive) != 0 ? ", emits light" : ""));
    const glm::vec3 normal = cli::decodeNormal(report.look.normal);
    tell(report.look.normal == gpu::kNoNormal
             ? std::string("no normal")
             : fmt::format("normal {:.2f}, {:.2f}, {:.2f}", normal.x, normal.y, normal.z));
}

} // namespace zvo::demo
