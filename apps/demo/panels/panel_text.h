// SPDX-License-Identifier: MIT
#pragma once

#include <imgui.h>

#include <string>

namespace zvo::demo
{

/// A line of text in the panel at hand.
inline void tell(const std::string& text)
{
    ImGui::TextUnformatted(text.c_str());
}

} // namespace zvo::demo
