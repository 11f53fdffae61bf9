// SPDX-License-Identifier: MIT
#pragma once

#include <imgui.h>

#include <string>

namespace zvo::demo
{

/// Adds a line of text to the current panel.
inline void tell(const std::string& text)
{
    ImGui::TextUnformatted(text.c_str());
}

} // namespace zvo::demo
