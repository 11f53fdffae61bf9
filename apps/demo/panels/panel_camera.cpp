// SPDX-License-Identifier: MIT
#include "demo/panels/panels.h"

#include <imgui.h>

namespace zvo::demo
{

void cameraPanel(CameraControl& camera)
{
    constexpr float kNarrowest = 5; // degrees
    constexpr float kWidest = 120;
    ViewCamera view = camera.camera();
    if (view.orthographic)
    {
        return;
    }
    auto degrees = static_cast<float>(glm::degrees(view.vertical_fov));
    if (ImGui::SliderFloat("field of view", &degrees, kNarrowest, kWidest, "%.0f deg", ImGuiSliderFlags_AlwaysClamp))
    {
        view.vertical_fov = glm::radians(double{degrees});
        camera.show(view);
    }
}

} // namespace zvo::demo
