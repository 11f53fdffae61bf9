// SPDX-License-Identifier: MIT
// The controls of the view panel, one for each setting that has one (view_settings.h). They are built within a frame of
// Dear ImGui, and change what the user changes.
#pragma once

#include "demo/app/view_settings.h"

namespace zvo::demo
{

void showView(ViewState& view, const ViewInfo& info);
void showIntegrator(ViewState& view, const ViewInfo& info);
void showShading(ViewState& view, const ViewInfo& info);
void showDenoise(ViewState& view, const ViewInfo& info);
void showShadows(ViewState& view, const ViewInfo& info);
void showOcclusion(ViewState& view, const ViewInfo& info);
void showSun(ViewState& view, const ViewInfo& info);
void showBounces(ViewState& view, const ViewInfo& info);
void showAperture(ViewState& view, const ViewInfo& info);
void showFocus(ViewState& view, const ViewInfo& info);
void showExposure(ViewState& view, const ViewInfo& info);
void showDetail(ViewState& view, const ViewInfo& info);
void showResolution(ViewState& view, const ViewInfo& info);
void showPresentMode(ViewState& view, const ViewInfo& info);

} // namespace zvo::demo
